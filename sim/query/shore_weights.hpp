// Weights of the cascades at a position of a shore.
#pragma once

#include <array>

#include "pelagic/sim/buffers/shore_at.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

/// Returns ShoreSample::weights without the cost of the other fields; all 1 if x or z is not a
/// number.
inline std::array<float, max_cascades> shore_weights_at(const ShoreSurface& shore, double x_m, double z_m) {
    std::array<float, max_cascades> weights;
    weights.fill(1);
    const ShoreAt at(shore, x_m, z_m);
    if (!at.is_place()) return weights;
    for (std::size_t cascade = 0; cascade < max_cascades; ++cascade)
        weights[cascade] = static_cast<float>(at.weight(cascade));
    return weights;
}

}  // namespace pelagic
