// Points of a batch that go through the kernels together.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

/// The search aims at this part of the tolerance, because on a steep face a horizontal step is a larger one in height.
inline constexpr double query_aim = 1.0 / 64;

/// Texels from the origin beyond which doubles can't tell them apart.
inline constexpr double max_texels_away = 0x1p50;

inline std::int64_t floor_of(double x) {
    const auto cut = static_cast<std::int64_t>(x);
    return cut - (static_cast<double>(cut) > x);
}

/// Splits a place along an axis, in texels, into a cell of the patch and where in it that is. In sums and bits only,
/// because compilers do those several at a time.
/// \pre |texels| <= max_texels_away
inline void split_place(double texels, int resolution, std::int32_t& cell, float& within) {
    constexpr double whole =
        0x1.8p52;  // so large that a double has no fraction, and its lowest bits are a whole number
    const double shifted = texels + whole;
    const double beyond = texels - (shifted - whole) + 0.0;  // from the nearest whole number; never -0
    const std::uint64_t is_below = std::bit_cast<std::uint64_t>(beyond) >> 63;
    const double one_if_below = std::bit_cast<double>((0 - is_below) & std::bit_cast<std::uint64_t>(1.0));
    const auto last = static_cast<std::uint64_t>(resolution - 1);
    cell = static_cast<std::int32_t>((std::bit_cast<std::uint64_t>(shifted) - is_below) & last);
    within = static_cast<float>(beyond + one_if_below);
}

/// On the stack, and what one cascade needs of it, 8 KB, stays in the first cache.
struct PointChunk {
    static constexpr std::size_t capacity = 128;
    using Floats = float[capacity];
    using Cells = std::int32_t[capacity];

    /// Where points are along the axes of a cascade.
    struct World {
        alignas(64) Cells cell_x, cell_z;
        alignas(64) Floats u, v;

        CellPlaces places() { return {cell_x, cell_z, u, v}; }
    };

    World world[max_cascades];
    World rest;                              ///< what rests there, of one cascade
    alignas(64) Floats offset_x, offset_z;   ///< the same of several, metres from the points
    alignas(64) Cells blocks[max_cascades];  ///< and in which 2 x 2 cells of each
    alignas(64) Floats error;                ///< metres, when all is done
    alignas(64) Floats height, normal_x, normal_y, normal_z, jacobian, velocity_x, velocity_y, velocity_z;
    alignas(64) double x[capacity], z[capacity];  ///< world, metres; 0 if a place has no sample
    alignas(64) Floats part[max_cascades];        ///< of each cascade at a shore

    std::size_t first = 0, count = 0;  ///< of the batch
    std::size_t padded = 0;            ///< count, up to whole registers
};

}  // namespace pelagic
