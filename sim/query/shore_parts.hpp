// How much of each tile there is at a place of a shore.
#pragma once

#include <array>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/shore_surface.hpp"

namespace pelagic {

/// As sample() of shore.hpp has them, for less. All 1 outside, and where x or z is no number.
inline std::array<float, most_tiles> shore_parts_at(const ShoreSurface& shore, double x_m, double z_m) {
    std::array<float, most_tiles> parts;
    parts.fill(1);
    const double u = (x_m - shore.x_m) / shore.texel_m, v = (z_m - shore.z_m) / shore.texel_m;
    if (!(u >= 0 && v >= 0 && u < shore.columns - 1 && v < shore.rows - 1)) return parts;
    const auto i = static_cast<std::size_t>(u), j = static_cast<std::size_t>(v);
    const double right = u - static_cast<double>(i), down = v - static_cast<double>(j);
    const std::uint32_t* const row = shore.parts_rgba8.data() + j * static_cast<std::size_t>(shore.columns) + i;
    const std::uint32_t* const below = row + shore.columns;
    for (std::size_t tile = 0; tile < most_tiles; ++tile) {
        const auto part = [tile](std::uint32_t texel) {
            return static_cast<double>(texel >> 8 * tile & 255) * (1.0 / 255);
        };
        const double upper = part(row[0]) + right * (part(row[1]) - part(row[0]));
        const double lower = part(below[0]) + right * (part(below[1]) - part(below[0]));
        parts[tile] = static_cast<float>(upper + down * (lower - upper));
    }
    return parts;
}

}  // namespace pelagic
