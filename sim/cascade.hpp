// A cascade: a wavelength band of a frame and its square domain, which repeats over the whole sea.
// The displacements of a frame are the sums over its cascades.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "pelagic/sim/frame_bounds.hpp"
#include "pelagic/sim/slope_sum.hpp"
#include "pelagic/sim/snapshot_foam.hpp"
#include "pelagic/sim/water_levels.hpp"

namespace pelagic {

/// A square array of floats in blocks of a few columns, which is the order of computation. Texel
/// (i, j) is data[i / block_columns * block_stride + j * row_stride + i % block_columns]; strides
/// are in floats. The number of columns in a block depends on the instruction set. A plain array is
/// one block.
struct PlaneView {
    const float* data = nullptr;
    int resolution = 0;
    int block_columns = 0;
    std::ptrdiff_t row_stride = 0;
    std::ptrdiff_t block_stride = 0;

    /// Returns the value of column i, row j. \pre both are in [0, resolution)
    float at(int i, int j) const {
        return data[i / block_columns * block_stride + j * row_stride + i % block_columns];
    }
    /// Writes row j, which has `resolution` floats.
    void copy_row(int j, float* out) const {
        for (int i = 0; i < resolution; i += block_columns)
            std::memcpy(out + i, data + i / block_columns * block_stride + j * row_stride,
                        static_cast<std::size_t>(block_columns) * sizeof(float));
    }
};

/// Returns the number of levels in a mipmap chain: resolution, resolution / 2, ..., 1.
constexpr int mip_levels(int resolution) { return std::bit_width(static_cast<unsigned>(resolution)); }

/// Returns the first texel of a level in a chain (VR Ocean, equation 55, which counts texels, not
/// bytes).
constexpr std::size_t mip_offset(int resolution, int level) {
    const std::size_t all = (4 * static_cast<std::size_t>(resolution) * resolution - 1) / 3;
    const std::size_t from_here = ((std::size_t{1} << 2 * (mip_levels(resolution) - level)) - 1) / 3;
    return all - from_here;
}

/// Undisplaced positions of a cascade's texels. The grid may be rotated by an angle with the cosine
/// c and the sine s. Texel (i, j), N being the resolution, has the position x = (c i - s j) L/N, z
/// = (s i + c j) L/N. Texels hold values in the world's axes, whatever the rotation.
struct CascadeGrid {
    double side_m = 0;            ///< L, the period along both axes of the cascade
    double cosine = 1, sine = 0;  ///< of the rotation, from +x towards +z

    /// Returns whether the grid is rotated against the world's axes.
    bool is_rotated() const { return sine != 0; }

    /// A position, velocity or wave number along the axes of the cascade, or of the world.
    struct Vector {
        double along, across;
    };
    /// Converts a position in the world to metres along the cascade's axes.
    Vector in_cascade(double x_m, double z_m) const { return {cosine * x_m + sine * z_m, cosine * z_m - sine * x_m}; }
    /// Converts metres along the cascade's axes to x and z in the world.
    Vector in_world(double along_m, double across_m) const {
        return {cosine * along_m - sine * across_m, sine * along_m + cosine * across_m};
    }
};

/// Bounds of a cascade's horizontal contraction, for queries of frames with several cascades or a
/// rotated one (buffers/contraction_map.hpp).
struct ContractionBound {
    /// The byte that stands for 1. The largest byte, 255, stands for 255 / one or more.
    static constexpr int one = 160;

    /// Bounds for blocks of one column by 4 rows of cells, in rows of N; then of 2 by 4 cells, 4 by
    /// 4, 8 by 8, and so on to one byte for all.
    std::span<const std::uint8_t> blocks;
    /// N^2 / 4: the largest bound around a block, as far as other reference points of one drawn
    /// position can be.
    std::span<const std::uint8_t> around;
    /// Largest sum of the bytes `around` a point, of this and all coarser cascades, with which
    /// those of finer cascades hold. Of the finest: with which the point is the only one.
    int max_sum = 0;
    float largest_m = 0;  ///< largest horizontal displacement
    /// Lipschitz constants: displacements and heights of two reference points differ by at most
    /// these times their distance. That of the heights is below 0 until a ray computes it
    /// (query/height_change.hpp); null in copies of a frame.
    float stretch = 0;
    std::atomic<float>* steepness = nullptr;

    /// Returns the largest bound of all blocks.
    double max() const { return static_cast<double>(blocks.back()) / one; }

    /// Returns whether there is no map, because the frame was made without queries.
    bool empty() const { return blocks.empty(); }
};

/// The data of a cascade in one frame, as views of memory that the ocean owns.
struct Cascade {
    CascadeGrid grid;
    /// Height in metres that all texels contain, so that the mean at fixed places of the world is 0
    /// over a loop: displacement moves water towards crests, which would lower that mean. It is
    /// choppiness times the sum of cos b k coth(k d) a^2 / 2 over the waves of the cascade, where b is
    /// the angle of their lean.
    float level_m = 0;
    /// Metres, in the world's axes. Without data if OceanOptions::planes is off.
    PlaneView dx, height, dz;
    /// Derivatives of dx, height and dz in time at the fixed reference point, m/s. Without data
    /// unless OceanOptions::velocities is drawn.
    PlaneView velocity_x, velocity_y, velocity_z;
    /// Pressure and velocity of the water below, with OceanOptions::depth, or the velocity at the surface
    /// alone, if OceanOptions::velocities is water.
    WaterLevels water;
    /// Fold map: where the surface may intersect itself, for queries (buffers/fold_map.hpp). Empty
    /// without OceanOptions::queries, and if the sea has more cascades than one or a regular wave.
    std::span<const std::uint8_t> folds;
    ContractionBound contraction;  ///< replaces `folds` otherwise
    /// resolution^2 texels of four IEEE half floats in tight rows: Dx, height, Dz, 0.
    std::span<const std::uint16_t> displacement_rgba16f;
    /// A chain of mip_levels() levels with one texel in a word: normal x, normal z, Jacobian,
    /// smoothness from the lowest byte up (VR Ocean, equations 50 and 51). Level m starts at
    /// mip_offset(resolution, m). These are normals of this cascade alone; the normal of a sum is
    /// not the sum of normals. Empty without OceanOptions::gradients.
    std::span<const std::uint32_t> gradient_rgba8;
    /// Two such chains, of slopes, which add over cascades, and of their moments within a texel.
    /// slope_sum.hpp defines the bytes and the normal. Empty without OceanOptions::slopes.
    std::span<const std::uint32_t> slopes_rgba8, moments_rgba8;
    SlopeRanges slope_ranges;
    /// Compression as bytes (snapshot_foam.hpp): resolution^2 bytes now, in tight rows, and four
    /// chains of mip_levels() levels with the snapshots. Empty unless OceanOptions::foam is set,
    /// and for a cascade whose compression has no weight.
    std::span<const std::uint8_t> compression_r8;
    std::array<std::span<const std::uint32_t>, SnapshotFoam::images> snapshots_rgba8;
    /// Differs whenever an image of snapshots differs, in all oceans of the process.
    std::array<std::uint64_t, SnapshotFoam::images> snapshots_version{};
    /// Offset of the snapshots, in texels along the cascade's axes, [0, resolution): snapshots are
    /// in the frame of drifting foam. Water at texel (i, j) has the compression of texel
    /// (i - drift_columns, j - drift_rows).
    double drift_columns = 0, drift_rows = 0;
    /// -q over Dx,x + Dz,z + front . grad h of this cascade (snapshot_foam.hpp), 0 if its waves make no
    /// foam, and the front, which all cascades share.
    float compression_scale = 0, compression_front_x = 0, compression_front_z = 0;
    /// Variance of h_x plus variance of h_z over the whole cascade, as in the last level of the
    /// chains; 0 without slopes. It is also set if the chains are in memory of the application
    /// (texture_targets.hpp).
    double slope_variance = 0;
    FrameBounds bounds;  ///< exact, not estimates

    /// Returns whether the cascade's waves make foam in the sum.
    bool makes_whitecaps() const { return compression_scale > 0; }

    /// Returns N, the texels along a side.
    int resolution() const { return height.resolution; }
    /// Returns the side of a texel in metres.
    double texel_m() const { return grid.side_m / resolution(); }
    /// Returns one level of gradient_rgba8; level 0 has N x N texels.
    std::span<const std::uint32_t> gradient_level(int level) const { return level_of(gradient_rgba8, level); }
    /// Returns one level of a chain.
    template <class Texel>
    std::span<const Texel> level_of(std::span<const Texel> chain, int level) const {
        const std::size_t side = static_cast<std::size_t>(resolution()) >> level;
        return chain.subspan(mip_offset(resolution(), level), side * side);
    }
};

}  // namespace pelagic
