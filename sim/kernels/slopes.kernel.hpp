#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/block_surface.kernel.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/kernels/mipmaps.kernel.hpp"
#include "pelagic/sim/kernels/snapshots.kernel.hpp"
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

/// Packs texels from averages. The variance within a texel is the mean square minus the square of
/// the mean.
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

/// Output rows of a level's texels.
struct SlopeRows {
    std::uint32_t *slopes, *moments;
    std::size_t stride;

    PELAGIC_INLINE SlopeRows from(std::size_t row, std::size_t column) const {
        return {slopes + row * stride + column, moments + row * stride + column, stride};
    }
};

/// Stores the first `count` of W texels. `count` is less than W only for levels narrower than a
/// register.
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

template <std::size_t known_stride = 0>
using SlopeAverages = AverageRows<slope_planes, known_stride>;

template <class Arch>
PELAGIC_INLINE void store_averages(const xsimd::batch<float, Arch> (&average)[slope_planes], float* to,
                                   std::size_t plane_stride) {
    for (std::size_t plane = 0; plane < slope_planes; ++plane)
        average[plane].store_unaligned(to + plane * plane_stride);
}

/// Computes a level's rows from the rows of the finer level.
template <class Arch, class Finer, class Level>
inline void make_slope_level(std::size_t rows, std::size_t columns, Finer finer, Level level, float variance_factor,
                             const SlopeRows& texels) {
    using V = xsimd::batch<float, Arch>;
    for (std::size_t row = 0; row < rows; ++row) {
        const float* above = finer.row(2 * row);
        const float* below = finer.row(2 * row + 1);
        for (std::size_t x = 0; x < columns; x += V::size) {
            V low[slope_planes], high[slope_planes], average[slope_planes];
            add_rows<Arch>(above + 2 * x, below + 2 * x, finer.plane_stride(), low);
            add_rows<Arch>(above + 2 * x + V::size, below + 2 * x + V::size, finer.plane_stride(), high);
            average_pairs<Arch>(low, high, average);
            store_averages<Arch>(average, level.row(row) + x, level.plane_stride());
            store_slope_texels<Arch>(texels_of_slopes<Arch>(average, variance_factor), texels.from(row, x),
                                     columns - x);
        }
    }
}

/// Computes the slopes at W texels, and their squares and product.
template <class Arch, class Turn>
PELAGIC_INLINE void slopes_at(const typename BlockSurface<Arch>::PairWalk& walk, int row, const Turn& turn,
                              xsimd::batch<float, Arch> factor, xsimd::batch<float, Arch> (&planes)[slope_planes]) {
    using V = xsimd::batch<float, Arch>;
    const V far_weight(static_cast<float>(SlopesJob::far_weight / SlopesJob::near_weight));
    Differences<Arch> dx, h, dz;
    walk.wide_difference(surface_dx, row, far_weight, dx);
    walk.wide_difference(surface_dz, row, far_weight, dz);
    turn(dx);
    turn(dz);
    planes[d_xx] = dx.x * factor;
    planes[d_zz] = dz.z * factor;
    planes[d_xz] = (dx.z + dz.x) * (V(0.5f) * factor);
    walk.wide_difference(surface_height, row, far_weight, h);
    turn(h);
    planes[h_x] = h.x * factor;
    planes[h_z] = h.z * factor;
    planes[h_x_h_x] = planes[h_x] * planes[h_x];
    planes[h_z_h_z] = planes[h_z] * planes[h_z];
    planes[h_x_h_z] = planes[h_x] * planes[h_z];
}

/// Packs the moments at W texels of level 0: D_xz, and variances of 0.
template <class Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> moments_at(xsimd::batch<float, Arch> d_xz) {
    constexpr std::uint32_t zeros = 0x80000080;
    return xsimd::nearbyint_as_int(clamped<Arch>(d_xz, -128.f, 127.f)) +
           xsimd::batch<std::int32_t, Arch>(static_cast<std::int32_t>(zeros));
}

/// Working memory for the levels of a block. Whole registers are read and written, two at a time.
template <class Arch>
struct SlopeScratch {
    static constexpr std::size_t columns(int level) {
        return (SlopesJob::block_columns >> level) + 2 * xsimd::batch<float, Arch>::size;
    }
    template <int level>
    using Rows = SlopeAverages<columns(level)>;

    alignas(64) float level_1[SlopesJob::block_rows / 2 * slope_planes * columns(1)];
    alignas(64) float level_2[SlopesJob::block_rows / 4 * slope_planes * columns(2)];
    alignas(64) float level_3[SlopesJob::block_rows / 8 * slope_planes * columns(3)];
};

/// Writes level 0 of two rows, the half floats if requested, and level 1.
///
/// Bilinear filtering between texels shows less variance than the texel values have, because
/// derivatives at texels amplify short waves. The square between four texels has a third of the
/// variance among them. One square in four lies between such four texels, so the mean squares from
/// level 1 on are those of the surface that level 0 shows.
///
/// The job's members are read once, before the stores, because the compiler must assume that stores
/// change them.
template <class Arch, bool with_halves, bool with_compression, class Turn>
inline void slope_rows(const SlopesJob& job, const BlockSurface<Arch>& surface, const Turn& turn, std::size_t z,
                       std::size_t columns, float* averages, std::size_t plane_stride, const SlopeRows& level_0,
                       const SlopeRows& level_1) {
    using V = xsimd::batch<float, Arch>;
    const V factor(job.difference_factor);
    const float variance_factor = job.variance_factor;
    const std::size_t n = job.resolution;
    const SlopeRows texels = level_0, coarser = level_1;
    std::uint16_t* halves = with_halves ? job.rgba16f + 4 * (z * n + job.first_column) : nullptr;
    CompressionRows<Arch, with_compression ? SlopesJob::block_columns : 1> compression(
        job.compression, z * n + job.first_column, n, columns);
    typename BlockSurface<Arch>::PairWalk walk(surface, job.first_column, z);

    const auto pack_row = [&](int row, std::size_t column, V(&planes)[slope_planes]) PELAGIC_INLINE_LAMBDA {
        slopes_at<Arch>(walk, row, turn, factor, planes);
        const std::size_t at = row * n + column;
        store_texels<Arch>(slopes_word<Arch>(planes), texels.slopes + at);
        store_texels<Arch>(moments_at<Arch>(planes[d_xz]), texels.moments + at);
        if constexpr (with_compression)
            compression.put(planes[d_xx] + planes[d_zz], planes[h_x], planes[h_z], static_cast<std::size_t>(row),
                            column);
        if constexpr (with_halves)
            store_halves<Arch>(walk.at(surface_dx, row), walk.at(surface_height, row), walk.at(surface_dz, row),
                               V(0.f), halves + 4 * at);
    };
    // Packs W columns of two rows and adds both rows.
    const auto pack = [&](std::size_t column, V(&sums)[slope_planes]) PELAGIC_INLINE_LAMBDA {
        V below[slope_planes];
        pack_row(0, column, sums);
        pack_row(1, column, below);
        for (std::size_t plane = 0; plane < slope_planes; ++plane) sums[plane] += below[plane];
        walk.next();
    };
    const auto average = [&](std::size_t column, const V(&low)[slope_planes], const V(&high)[slope_planes])
                             PELAGIC_INLINE_LAMBDA {
                                 V means[slope_planes];
                                 average_pairs<Arch>(low, high, means);
                                 const auto shown = [&](SlopePlane square, SlopePlane a, SlopePlane b) {
                                     const V product = means[a] * means[b];
                                     means[square] = product + (means[square] - product) * V(1.f / 3.f);
                                 };
                                 shown(h_x_h_x, h_x, h_x);
                                 shown(h_z_h_z, h_z, h_z);
                                 shown(h_x_h_z, h_x, h_z);
                                 store_averages<Arch>(means, averages + column / 2, plane_stride);
                                 store_slope_texels<Arch>(texels_of_slopes<Arch>(means, variance_factor),
                                                          coarser.from(0, column / 2), (columns - column) / 2);
                             };
    V low[slope_planes], high[slope_planes];
    std::size_t column = 0;
    for (; column + 2 * V::size <= columns; column += 2 * V::size) {
        pack(column, low);
        pack(column + V::size, high);
        average(column, low, high);
    }
    // A row of N = 16 is one register of AVX-512.
    if constexpr (V::size == 16) {
        if (column < columns) {
            pack(column, low);
            average(column, low, low);
        }
    }
    if constexpr (with_compression) compression.write();
}

template <class Arch>
void slopes(const SlopesJob& job) {
    using V = xsimd::batch<float, Arch>;
    using Scratch = SlopeScratch<Arch>;
    const std::size_t n = job.resolution;
    const std::size_t rows = n < SlopesJob::block_rows ? n : SlopesJob::block_rows;
    const std::size_t most_columns = n < SlopesJob::block_columns ? n : SlopesJob::block_columns;
    const std::size_t columns = job.narrow_columns ? job.narrow_columns : most_columns;
    const BlockSurface<Arch> surface(job.surface, n, job.block_stride);
    const auto texels = [&](int level) {
        const SlopeRows all{job.slopes[level], job.moments[level], n >> level};
        return all.from(job.first_row >> level, job.first_column >> level);
    };
    Scratch scratch;
    const typename Scratch::template Rows<1> level_1{scratch.level_1};
    const typename Scratch::template Rows<2> level_2{scratch.level_2};
    const SlopeAverages<> all_of_level_3{job.averages, job.average_stride};
    const SlopeAverages<> level_3{all_of_level_3.row(job.first_row >> 3) + (job.first_column >> 3),
                                  job.average_stride};

    const auto all_rows = [&]<bool with_halves, bool with_compression>(const auto& turn) {
        for (std::size_t row = 0; row < rows; row += 2)
            slope_rows<Arch, with_halves, with_compression>(job, surface, turn, job.first_row + row, columns,
                                                            level_1.row(row / 2), level_1.plane_stride(),
                                                            texels(0).from(row, 0), texels(1).from(row / 2, 0));
    };
    const auto rotated_rows = [&](const auto& turn) {
        if (!job.rgba16f)
            all_rows.template operator()<false, false>(turn);
        else if (!job.compression.bytes)
            all_rows.template operator()<true, false>(turn);
        else
            all_rows.template operator()<true, true>(turn);
    };
    if (job.sine != 0 || job.cosine != 1)
        rotated_rows(Turned<Arch>{V(job.cosine), V(job.sine)});
    else
        rotated_rows(NotTurned{});

    make_slope_level<Arch>(rows / 4, columns / 4, level_1, level_2, job.variance_factor, texels(2));
    if (!job.narrow_columns)
        return make_slope_level<Arch>(rows / 8, columns / 8, level_2, level_3, job.variance_factor, texels(3));
    const typename Scratch::template Rows<3> narrow{scratch.level_3};
    make_slope_level<Arch>(rows / 8, columns / 8, level_2, narrow, job.variance_factor, texels(3));
    copy_averages(narrow, rows / 8, columns / 8, level_3);
}

template <class Arch>
void slope_level(const SlopeLevelJob& job) {
    make_slope_level<Arch>(job.side, job.side, SlopeAverages<>{job.finer, job.finer_stride},
                           SlopeAverages<>{job.averages, job.stride}, job.variance_factor,
                           SlopeRows{job.slopes, job.moments, job.side});
}

}  // namespace pelagic::kernels
