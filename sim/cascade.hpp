// One square of waves of a frame, which repeats over the whole sea. A frame is a stack of them: displacements add.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "pelagic/sim/slope_sum.hpp"

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

/// Extremes of displacements, for culling boxes.
struct FrameBounds {
    float height_min_m = 0;
    float height_max_m = 0;
    float horizontal_x_max_m = 0;  ///< largest |Dx|
    float horizontal_z_max_m = 0;  ///< largest |Dz|
};

/// Levels in a gradient chain: resolution, resolution / 2, ..., 1.
constexpr int mip_levels(int resolution) { return std::bit_width(static_cast<unsigned>(resolution)); }

/// First texel of level `level` in the chain (VR Ocean, equation 55, which counts texels, not bytes).
constexpr std::size_t mip_offset(int resolution, int level) {
    const std::size_t all = (4 * static_cast<std::size_t>(resolution) * resolution - 1) / 3;
    const std::size_t from_here = ((std::size_t{1} << 2 * (mip_levels(resolution) - level)) - 1) / 3;
    return all - from_here;
}

/// Where the texels of a cascade rest. Its grid may be rotated against the world: texel (i, j), N being the resolution,
/// rests at x = (c i - s j) L/N, z = (s i + c j) L/N, c and s being the turn's cosine and sine. What the texels hold is in the
/// world's axes, whatever the turn.
struct CascadeGrid {
    double side_m = 0;            ///< L, the cascade repeats after this length along both of its axes
    double cosine = 1, sine = 0;  ///< of the turn, from +x towards +z

    bool is_rotated() const { return sine != 0; }

    struct Place {
        double along, across;
    };
    /// A place of the world along the cascade's own axes, metres.
    Place in_cascade(double x_m, double z_m) const { return {cosine * x_m + sine * z_m, cosine * z_m - sine * x_m}; }
    /// The other way round: x and z.
    Place in_world(double along_m, double across_m) const {
        return {cosine * along_m - sine * across_m, sine * along_m + cosine * across_m};
    }
};

/// How much a cascade contracts the water together, for queries of frames with several cascades (buffers/contraction_map.hpp).
struct ContractionBound {
    static constexpr int one = 160;  ///< bytes are parts of this; the largest byte means that or anything more

    /// By blocks of 2 x 2 cells, (N/2)^2 of them; then of 4 x 4, and so on to one byte for all.
    std::span<const std::uint8_t> blocks;
    /// (N/2)^2: the most around a block, as far as other reference points of the same place can be.
    std::span<const std::uint8_t> around;
    float largest_m = 0;  ///< of the horizontal displacements
    float stretch = 0;    ///< two reference points' displacements differ by at most this times their distance
    float steepness = 0;  ///< and their heights by this times their distance

    /// The most of all blocks.
    double max() const { return static_cast<double>(blocks.back()) / one; }

    bool empty() const { return blocks.empty(); }
};

/// What a cascade of one frame holds, as views into the ocean that made it.
struct Cascade {
    CascadeGrid grid;
    PlaneView dx, height, dz;  ///< metres, in the world's axes
    /// How fast the water drawn at a texel moves: the derivatives of dx, height and dz in time, metres a second. No data
    /// unless OceanOptions::velocities.
    PlaneView velocity_x, velocity_y, velocity_z;
    /// Where the surface may lie over itself, for surface queries (buffers/fold_map.hpp). Empty unless
    /// OceanOptions::queries, and where a frame has several cascades.
    std::span<const std::uint8_t> folds;
    ContractionBound contraction;  ///< instead of folds, where a frame has several cascades
    /// resolution^2 texels of four IEEE half floats: Dx, height, Dz, foam (0 none to 1 covered). Rows are tight.
    std::span<const std::uint16_t> displacement_rgba16f;
    /// The chain of mip_levels() levels, one texel a word: normal x, normal z, Jacobian, smoothness from the lowest
    /// byte up (VR Ocean, equations 50 and 51); level m starts at mip_offset(resolution, m). Of the cascade alone: normals of a
    /// sum are no sums of normals. Empty in a frame of several cascades unless OceanOptions::gradients.
    std::span<const std::uint32_t> gradient_rgba8;
    /// Two chains like it, of slopes that add to other cascades' and of how much they vary within a texel: slope_sum.hpp says
    /// what the bytes mean and how to get a normal. Empty in a frame of one cascade unless OceanOptions::slopes.
    std::span<const std::uint32_t> slopes_rgba8, moments_rgba8;
    SlopeRanges slope_ranges;
    /// The chain of mip_levels() levels of foam, one byte a texel, 0 none to 255 covered: what breaks now and what is left of
    /// earlier. Empty unless OceanOptions::foam. As a part of 1 it is the fourth of the half floats.
    std::span<const std::uint8_t> foam_r8;
    /// Of h_x plus of h_z over the whole cascade, as the chains' last level has it, also where they are in memory of the application's
    /// (texture_targets.hpp); 0 without slopes.
    double slope_variance = 0;
    FrameBounds bounds;  ///< exact, not estimates
    /// Water of the Jacobian J of the cascade makes foam of clamp(1/2 + (whitecap_jacobian - J) / whitecap_ramp, 0, 1): as much of it,
    /// in the mean over time and while it lasts, as whitecaps cover in that wind (foam/whitecaps.hpp), cascades together.
    /// no_whitecaps where the cascade makes none.
    float whitecap_jacobian = 0;
    float whitecap_ramp = 1;  ///< above 0
    static constexpr float no_whitecaps = -10;

    bool makes_whitecaps() const { return whitecap_jacobian != no_whitecaps; }

    int resolution() const { return height.resolution; }
    double texel_m() const { return grid.side_m / resolution(); }
    std::span<const std::uint32_t> gradient_level(int level) const { return level_of(gradient_rgba8, level); }
    /// One level of any of the chains.
    template <class Texel>
    std::span<const Texel> level_of(std::span<const Texel> chain, int level) const {
        const std::size_t side = static_cast<std::size_t>(resolution()) >> level;
        return chain.subspan(mip_offset(resolution(), level), side * side);
    }
};

}  // namespace pelagic
