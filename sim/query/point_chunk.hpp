// Positions of a batch that the kernels process together.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

/// Target of the search, as a fraction of the tolerance. It is below 1, because on a steep face a
/// horizontal error is a larger error in height.
inline constexpr double query_aim = 1.0 / 64;

/// Distance from the origin, in texels, beyond which doubles do not resolve texels.
inline constexpr double max_texels_away = 0x1p50;

/// Result of a position without a sample: a quiet NaN with equal bits on every machine.
inline constexpr float no_sample = std::bit_cast<float>(std::uint32_t{0x7fc00000});

inline std::int64_t floor_of(double x) {
    const auto cut = static_cast<std::int64_t>(x);
    return cut - (static_cast<double>(cut) > x);
}

inline std::int32_t floor_of(float x) {
    const auto cut = static_cast<std::int32_t>(x);
    return cut - (static_cast<float>(cut) > x);
}

/// A reference point along a cascade's axes: a texel, which may be outside the cascade, and a position in [0, 1]
/// from it to the next.
struct ReferenceCell {
    std::int32_t column, row;
    float u, v;
};

/// Lives on the stack. The 8 KB that one cascade uses fit the first-level cache.
struct PointChunk {
    static constexpr std::size_t capacity = 128;
    using Floats = float[capacity];
    using Cells = std::int32_t[capacity];

    /// Positions along the axes of a cascade.
    struct World {
        alignas(64) Cells cell_x, cell_z;
        alignas(64) Floats u, v;

        CellPositions positions() { return {cell_x, cell_z, u, v}; }
    };

    World world[max_cascades];
    World rest;  ///< reference points, of a frame with one cascade
    /// Of several: from position to reference point, metres.
    alignas(64) Floats offset_x, offset_z;
    alignas(64) Cells blocks[max_cascades];  ///< of several: block of the contraction map
    alignas(64) Floats error;                ///< metres, after find_reference_points()
    alignas(64) Floats height, normal_x, normal_y, normal_z, jacobian, velocity_x, velocity_y, velocity_z;
    alignas(64) double x[capacity], z[capacity];  ///< metres, in the water; 0 if it has no sample
    alignas(64) Floats weight[max_cascades];      ///< weight of each cascade at a shore

    std::size_t first = 0, count = 0;  ///< range of the batch
    std::size_t padded = 0;            ///< count, rounded up to whole SIMD registers
};

}  // namespace pelagic
