// What a frame yields, as views into the ocean that made it.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic {

/// A square of floats, stored in blocks of a few columns, which is how they are computed: texel (i, j) is
/// data[i / block_columns * block_stride + j * row_stride + i % block_columns]; strides are in floats. The number of
/// columns in a block depends on the instruction set. A plain array is one block.
struct PlaneView {
    const float* data = nullptr;
    int resolution = 0;
    int block_columns = 0;
    std::ptrdiff_t row_stride = 0;
    std::ptrdiff_t block_stride = 0;

    float at(int i, int j) const {
        return data[i / block_columns * block_stride + j * row_stride + i % block_columns];
    }
    /// Writes the resolution floats of row j.
    void copy_row(int j, float* out) const {
        for (int i = 0; i < resolution; i += block_columns)
            std::memcpy(out + i, data + i / block_columns * block_stride + j * row_stride,
                        static_cast<std::size_t>(block_columns) * sizeof(float));
    }
};

/// Extremes of a frame, for culling boxes. Exact, not estimates.
struct FrameBounds {
    float height_min_m = 0;
    float height_max_m = 0;
    float sideways_x_max_m = 0;  ///< largest |Dx|
    float sideways_z_max_m = 0;  ///< largest |Dz|
};

/// Levels in a gradient chain: resolution, resolution / 2, ..., 1.
constexpr int mip_levels(int resolution) { return std::bit_width(static_cast<unsigned>(resolution)); }

/// First texel of level `level` in the chain (VR Ocean, equation 55, which counts texels, not bytes).
constexpr std::size_t mip_offset(int resolution, int level) {
    const std::size_t all = (4 * static_cast<std::size_t>(resolution) * resolution - 1) / 3;
    const std::size_t from_here = ((std::size_t{1} << 2 * (mip_levels(resolution) - level)) - 1) / 3;
    return all - from_here;
}

/// What holds for all frames of a sea, found out when its spectrum is baked.
struct SeaFigures {
    /// 4 sqrt(variance), mean over all seeds, of the waves that the grid holds; as expected_waves() has it.
    double significant_wave_height_m = 0;
    /// Below this Jacobian the sea is white: as much of it, in the mean over time, as whitecaps cover in that wind
    /// (whitecaps.hpp).
    float whitecap_jacobian = 0;
};

/// One frame, which says what it is: whoever draws it or asks it needs nothing else about the sea.
/// Texel (i, j) rests at x = i L/N, z = j L/N, L being sea.patch_size_m, and is drawn at (x + Dx, height, z + Dz); metres.
/// Views stay valid until the ocean schedules the second frame after this one.
struct Frame {
    double time_s = 0;
    SeaState sea;
    SeaFigures figures;
    Isa isa = {};  ///< that computed it
    PlaneView dx, height, dz;
    /// How fast the water drawn at a texel moves: the derivatives of dx, height and dz in time, metres a second. No data
    /// unless OceanOptions::velocities.
    PlaneView velocity_x, velocity_y, velocity_z;
    /// Where the surface may lie over itself, for surface queries (fold_map.hpp). Empty unless OceanOptions::queries.
    std::span<const std::uint8_t> folds;
    /// resolution^2 texels of four IEEE half floats: Dx, height, Dz, foam (0 none to 1 covered). Rows are tight.
    std::span<const std::uint16_t> displacement_rgba16f;
    /// The chain of mip_levels() levels, one texel a word: normal x, normal z, Jacobian, smoothness from the lowest
    /// byte up (VR Ocean, equations 50 and 51); level m starts at mip_offset(resolution, m).
    std::span<const std::uint32_t> gradient_rgba8;
    FrameBounds bounds;

    int resolution() const { return height.resolution; }
    std::span<const std::uint32_t> gradient_level(int level) const {
        const std::size_t side = static_cast<std::size_t>(resolution()) >> level;
        return gradient_rgba8.subspan(mip_offset(resolution(), level), side * side);
    }
};

/// XXH3 of every output of the frame: the rows of dx, height and dz, the half floats, the gradient chain and the
/// bounds, in this order, little-endian. The time is not in it, nor are velocities and folds: whoever asks for them has
/// the same sea as one who doesn't. Two frames with equal hashes hold the same bits.
std::uint64_t hash_of(const Frame& frame);

}  // namespace pelagic
