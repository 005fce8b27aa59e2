// Interpolation of a cascade's foam.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pelagic/sim/cascade.hpp"

namespace pelagic {

/// Returns the bilinearly interpolated foam, in [0, 1]. The code is scalar, so results are
/// bit-identical on every machine.
/// \param cell_x,cell_z  any cell; the cascade repeats
/// \param u,v            position in the cell, in [0, 1]
/// \pre the cascade has foam
inline double foam_at(const Cascade& cascade, std::int64_t cell_x, std::int64_t cell_z, double u, double v) {
    const auto side = static_cast<std::size_t>(cascade.resolution()), last = side - 1;
    const std::size_t left = static_cast<std::size_t>(cell_x) & last, right = (left + 1) & last;
    const std::size_t upper = (static_cast<std::size_t>(cell_z) & last) * side;
    const std::size_t lower = (static_cast<std::size_t>(cell_z + 1) & last) * side;
    const auto texel = [&](std::size_t at) { return static_cast<double>(cascade.foam_r8[at]); };
    const double above = texel(upper + left) + u * (texel(upper + right) - texel(upper + left));
    const double below = texel(lower + left) + u * (texel(lower + right) - texel(lower + left));
    return (above + v * (below - above)) * (1.0 / 255);
}

}  // namespace pelagic
