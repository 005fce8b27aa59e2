#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/block_surface.kernel.hpp"
#include "pelagic/sim/kernels/gradients.kernel.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/kernels/mipmaps.kernel.hpp"
#include "pelagic/simd/bytes.kernel.hpp"
#include "pelagic/simd/half.kernel.hpp"
#include "pelagic/simd/neighbours.kernel.hpp"

namespace pelagic::kernels {

enum SlopePlane { h_x, h_z, d_xx, d_zz, d_xz, h_x_h_x, h_z_h_z, h_x_h_z };
static_assert(h_x_h_z + 1 == slope_planes);

/// W texels of a level.
template <class Arch>
struct SlopeTexels {
    xsimd::batch<std::int32_t, Arch> slopes, moments;
};

template <class Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> slopes_word(const xsimd::batch<float, Arch> (&planes)[slope_planes]) {
    return four_bytes<Arch>(planes[h_x], planes[h_z], planes[d_xx], planes[d_zz]);
}

/// Of averages: what the mean squares have beyond the squares of the means is the variance within a texel.
template <class Arch>
PELAGIC_INLINE SlopeTexels<Arch> texels_of_slopes(const xsimd::batch<float, Arch> (&planes)[slope_planes],
                                                  float variance_factor) {
    using V = xsimd::batch<float, Arch>;
    const auto variance = [&](SlopePlane square, SlopePlane a, SlopePlane b) {
        return planes[square] - planes[a] * planes[b];
    };
    const V from_zero(255.f * variance_factor), around_zero(127.f * variance_factor), zero(-128.f);
    return {slopes_word<Arch>(planes), four_bytes<Arch>(planes[d_xz], variance(h_x_h_x, h_x, h_x) * from_zero + zero,
                                                        variance(h_z_h_z, h_z, h_z) * from_zero + zero,
                                                        variance(h_x_h_z, h_x, h_z) * around_zero)};
}

/// Where the texels of a level go.
struct SlopeRows {
    std::uint32_t *slopes, *moments;
    std::size_t stride;

    PELAGIC_INLINE SlopeRows from(std::size_t row, std::size_t column) const {
        return {slopes + row * stride + column, moments + row * stride + column, stride};
    }
};

/// The first `count` of W texels; all, but for levels narrower than a register.
template <class Arch>
PELAGIC_INLINE void store_slope_texels(const SlopeTexels<Arch>& texels, const SlopeRows& to, std::size_t count) {
    constexpr std::size_t lanes = xsimd::batch<float, Arch>::size;
    if (count >= lanes) {
        store_texels<Arch>(texels.slopes, to.slopes);
        store_texels<Arch>(texels.moments, to.moments);
        return;
    }
    std::uint32_t slopes[lanes], moments[lanes];
    store_texels<Arch>(texels.slopes, slopes);
    store_texels<Arch>(texels.moments, moments);
    for (std::size_t i = 0; i < count; ++i) {
        to.slopes[i] = slopes[i];
        to.moments[i] = moments[i];
    }
}

/// Averages of a level: rows of slope_planes planes, `stride` floats each.
template <class Float>
struct SlopeAverages {
    Float* values;
    std::size_t stride;

    PELAGIC_INLINE Float* at(std::size_t row, std::size_t plane, std::size_t column) const {
        return values + (row * slope_planes + plane) * stride + column;
    }
};

/// W averages of 2 x 2 from sums(plane, i), the sums of two rows in the columns from i on, i being 0 or W.
template <class Arch, class Sums>
PELAGIC_INLINE void average_slopes(Sums sums, xsimd::batch<float, Arch> (&average)[slope_planes]) {
    using V = xsimd::batch<float, Arch>;
    for (std::size_t plane = 0; plane < slope_planes; ++plane)
        average[plane] = pair_sums<Arch>(sums(plane, 0), sums(plane, V::size)) * V(0.25f);
}

template <class Arch>
PELAGIC_INLINE void store_averages(const xsimd::batch<float, Arch> (&average)[slope_planes],
                                   const SlopeAverages<float>& level, std::size_t row, std::size_t column) {
    for (std::size_t plane = 0; plane < slope_planes; ++plane)
        average[plane].store_unaligned(level.at(row, plane, column));
}

/// A level's rows from those of the finer one.
template <class Arch, class Float>
inline void make_slope_level(std::size_t rows, std::size_t columns, const SlopeAverages<Float>& finer,
                             const SlopeAverages<float>& level, float variance_factor, const SlopeRows& texels) {
    using V = xsimd::batch<float, Arch>;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t x = 0; x < columns; x += V::size) {
            V average[slope_planes];
            average_slopes<Arch>(
                [&](std::size_t plane, std::size_t i) {
                    return V::load_unaligned(finer.at(2 * row, plane, 2 * x + i)) +
                           V::load_unaligned(finer.at(2 * row + 1, plane, 2 * x + i));
                },
                average);
            store_averages<Arch>(average, level, row, x);
            store_slope_texels<Arch>(texels_of_slopes<Arch>(average, variance_factor), texels.from(row, x),
                                     columns - x);
        }
    }
}

/// The slopes at W texels, and their squares.
template <class Arch, class Turn>
PELAGIC_INLINE void slopes_at(const SlopesJob& job, const typename BlockSurface<Arch>::Blocks& blocks,
                              const typename BlockSurface<Arch>::Rows& rows, const Turn& turn,
                              xsimd::batch<float, Arch> (&planes)[slope_planes]) {
    using V = xsimd::batch<float, Arch>;
    const auto difference = [&](SurfaceComponent component) {
        const V far_weight(static_cast<float>(SlopesJob::far_weight / SlopesJob::near_weight));
        Differences<Arch> along = BlockSurface<Arch>::wide_difference(component, blocks, rows, far_weight);
        turn(along);
        return along;
    };
    const V factor(job.difference_factor);
    const Differences<Arch> dx = difference(surface_dx), dz = difference(surface_dz);
    planes[d_xx] = dx.x * factor;
    planes[d_zz] = dz.z * factor;
    planes[d_xz] = (dx.z + dz.x) * (V(0.5f) * factor);
    const Differences<Arch> h = difference(surface_height);
    planes[h_x] = h.x * factor;
    planes[h_z] = h.z * factor;
    planes[h_x_h_x] = planes[h_x] * planes[h_x];
    planes[h_z_h_z] = planes[h_z] * planes[h_z];
    planes[h_x_h_z] = planes[h_x] * planes[h_z];
}

/// Writes W texels of level 0 and, if wanted, of the half floats.
template <class Arch>
PELAGIC_INLINE void pack_slopes(const SlopesJob& job, const typename BlockSurface<Arch>::Blocks& blocks,
                                const typename BlockSurface<Arch>::Rows& rows,
                                const xsimd::batch<float, Arch> (&planes)[slope_planes], std::size_t texel) {
    using V = xsimd::batch<float, Arch>;
    using Surface = BlockSurface<Arch>;
    store_texels<Arch>(slopes_word<Arch>(planes), job.slopes[0] + texel);
    const V no_variance(-128.f);
    store_texels<Arch>(four_bytes<Arch>(planes[d_xz], no_variance, no_variance, V(0.f)), job.moments[0] + texel);
    if (!job.rgba16f) return;
    const V one(1.f), step(job.slope_step);
    const V twist = planes[d_xz] * step;
    const V jacobian = (one + planes[d_xx] * step) * (one + planes[d_zz] * step) - twist * twist;
    store_halves<Arch>(Surface::at(surface_dx, blocks, rows), Surface::at(surface_height, blocks, rows),
                       Surface::at(surface_dz, blocks, rows), foam_of<Arch>(jacobian), job.rgba16f + 4 * texel);
}

/// What the tile keeps of its levels. Whole registers are read and written, two at a time.
template <class Arch>
struct SlopeScratch {
    static constexpr std::size_t slack = 2 * xsimd::batch<float, Arch>::size;
    static constexpr std::size_t rows(int level) { return SlopesJob::tile_rows >> level; }
    static constexpr std::size_t columns(int level) { return (SlopesJob::tile_columns >> level) + slack; }

    alignas(64) float level_1[rows(1) * slope_planes * columns(1)];
    alignas(64) float level_2[rows(2) * slope_planes * columns(2)];
    alignas(64) float level_3[rows(3) * slope_planes * columns(3)];

    SlopeAverages<float> level(int number) {
        float* const all[] = {level_1, level_2, level_3};
        return {all[number - 1], columns(number)};
    }
};

/// Level 0 of two rows, and level 1. Between texels a GPU shows less variance than stands at the texels, where
/// derivatives overstate short waves: of the variance among four texels a third is in the square between them. As one
/// square in four lies between such four texels, the mean squares from level 1 on are those of the surface that level 0 shows.
template <class Arch, class Turn>
inline void slope_rows(const SlopesJob& job, const BlockSurface<Arch>& surface, const Turn& turn, std::size_t row,
                       std::size_t columns, const SlopeAverages<float>& level, const SlopeRows& texels) {
    using V = xsimd::batch<float, Arch>;
    const std::size_t z = job.first_row + row;
    const typename BlockSurface<Arch>::Rows rows[] = {surface.rows_at(z), surface.rows_at(z + 1)};
    auto blocks = surface.blocks_at(job.first_column);
    alignas(64) float sums[slope_planes][2 * V::size] = {};
    for (std::size_t column = 0; column < columns; column += 2 * V::size) {
        for (std::size_t i = 0; i < 2 * V::size && column + i < columns; i += V::size) {
            const std::size_t x = job.first_column + column + i;
            const std::size_t texel = z * job.resolution + x;
            V above[slope_planes], below[slope_planes];
            slopes_at<Arch>(job, blocks, rows[0], turn, above);
            pack_slopes<Arch>(job, blocks, rows[0], above, texel);
            slopes_at<Arch>(job, blocks, rows[1], turn, below);
            pack_slopes<Arch>(job, blocks, rows[1], below, texel + job.resolution);
            for (std::size_t plane = 0; plane < slope_planes; ++plane)
                (above[plane] + below[plane]).store_aligned(sums[plane] + i);
            blocks = surface.next(blocks, x + V::size);
        }
        V average[slope_planes];
        average_slopes<Arch>([&](std::size_t plane, std::size_t i) { return V::load_aligned(sums[plane] + i); },
                             average);
        const auto shown = [&](SlopePlane square, SlopePlane a, SlopePlane b) {
            const V product = average[a] * average[b];
            average[square] = product + (average[square] - product) * V(1.f / 3.f);
        };
        shown(h_x_h_x, h_x, h_x);
        shown(h_z_h_z, h_z, h_z);
        shown(h_x_h_z, h_x, h_z);
        store_averages<Arch>(average, level, row / 2, column / 2);
        store_slope_texels<Arch>(texels_of_slopes<Arch>(average, job.variance_factor),
                                 texels.from(row / 2, column / 2), (columns - column) / 2);
    }
}

template <class Arch>
void slopes(const SlopesJob& job) {
    using V = xsimd::batch<float, Arch>;
    const std::size_t n = job.resolution;
    const std::size_t rows = n < SlopesJob::tile_rows ? n : SlopesJob::tile_rows;
    const std::size_t columns = n < SlopesJob::tile_columns ? n : SlopesJob::tile_columns;
    const BlockSurface<Arch> surface(job.surface, n, job.block_stride);
    const auto texels = [&](int level) {
        const SlopeRows all{job.slopes[level], job.moments[level], n >> level};
        return all.from(job.first_row >> level, job.first_column >> level);
    };
    SlopeScratch<Arch> scratch;
    const auto all_rows = [&](const auto& turn) {
        for (std::size_t row = 0; row < rows; row += 2)
            slope_rows<Arch>(job, surface, turn, row, columns, scratch.level(1), texels(1));
    };
    if (job.sine != 0 || job.cosine != 1)
        all_rows(Turned<Arch>{V(job.cosine), V(job.sine)});
    else
        all_rows(NotTurned{});

    for (int level = 2; level <= SlopesJob::tile_levels; ++level)
        make_slope_level<Arch>(rows >> level, columns >> level, scratch.level(level - 1), scratch.level(level),
                               job.variance_factor, texels(level));
    constexpr int last = SlopesJob::tile_levels;
    const SlopeAverages<float> from = scratch.level(last), to{job.averages, job.average_stride};
    for (std::size_t row = 0; row < rows >> last; ++row)
        for (std::size_t plane = 0; plane < slope_planes; ++plane)
            std::memcpy(to.at((job.first_row >> last) + row, plane, job.first_column >> last), from.at(row, plane, 0),
                        (columns >> last) * sizeof(float));
}

template <class Arch>
void slope_level(const SlopeLevelJob& job) {
    make_slope_level<Arch>(job.side, job.side, SlopeAverages<const float>{job.finer, job.finer_stride},
                           SlopeAverages<float>{job.averages, job.stride}, job.variance_factor,
                           SlopeRows{job.slopes, job.moments, job.side});
}

}  // namespace pelagic::kernels
