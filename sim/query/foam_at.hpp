// Foam of a cascade between its texels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pelagic/sim/cascade.hpp"

namespace pelagic {

/// 0 to 1, bilinear between texels, at the reference point that is (u, v) into a cell, both in [0, 1]. Cells may lie any number of
/// cascades away. Plain code, so the same bits everywhere.
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
