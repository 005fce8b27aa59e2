#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/block_surface.kernel.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/kernels/mipmaps.kernel.hpp"
#include "pelagic/simd/exact.kernel.hpp"
#include "pelagic/simd/half.kernel.hpp"

namespace pelagic::kernels {

/// What the tile keeps for its mipmaps: sums of row pairs of level 0, and the levels made from them. Whole registers
/// are read and written, two at a time.
template <class Arch>
struct MipScratch {
    static constexpr std::size_t slack = 2 * xsimd::batch<float, Arch>::size;
    static constexpr std::size_t columns = GradientsJob::tile_columns + slack;
    static constexpr std::size_t level_columns = GradientsJob::tile_columns / 2 + slack;
    static constexpr std::size_t rows = GradientsJob::tile_rows / 2;

    alignas(64) float sums[rows][mip_planes][columns];
    alignas(64) float levels[2][rows][mip_planes + 1][level_columns];
};

/// A normal of any length, and the factor that makes it a unit vector.
template <class Arch>
struct Normal {
    using V = xsimd::batch<float, Arch>;
    V x, y, z, inverse_length;

    static constexpr std::size_t floats = 4 * V::size;
    static Normal load(const float* from) {
        return {V::load_aligned(from), V::load_aligned(from + V::size), V::load_aligned(from + 2 * V::size),
                V::load_aligned(from + 3 * V::size)};
    }
    void store(float* to) const {
        x.store_aligned(to);
        y.store_aligned(to + V::size);
        z.store_aligned(to + 2 * V::size);
        inverse_length.store_aligned(to + 3 * V::size);
    }
};

/// Equations 45 to 48, times (2 L/N)^2: differences are not divided by the distance, because the normal's length
/// doesn't matter, and J, which is its y, takes the square of it later.
template <class Arch>
PELAGIC_INLINE Normal<Arch> normal_of(const Differences<Arch>& dx, const Differences<Arch>& h,
                                      const Differences<Arch>& dz, xsimd::batch<float, Arch> two_texels) {
    using V = xsimd::batch<float, Arch>;
    const V j_xx = two_texels + dx.x;
    const V j_zz = two_texels + dz.z;
    const V n_x = h.z * dz.x - h.x * j_zz;
    const V n_y = j_xx * j_zz - dx.z * dz.x;
    const V n_z = h.x * dx.z - h.z * j_xx;
    // A surface crushed to a point has no normal; the guard keeps it finite.
    const V squared = xsimd::max(n_x * n_x + n_y * n_y + n_z * n_z, V(1e-30f));
    return {n_x, n_y, n_z, divided<Arch>(V(1.f), square_root<Arch>(squared))};
}

/// 0 where the surface keeps at least half of its area, 1 where it folds, linear between.
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> foam_of(xsimd::batch<float, Arch> jacobian) {
    return clamped<Arch>(xsimd::batch<float, Arch>(1.f) - (jacobian + jacobian), 0.f, 1.f);
}

/// Writes W texels of level 0 and, if wanted, of the half floats; returns in `averages` what the mipmaps average.
template <class Arch>
PELAGIC_INLINE void pack_texels(const GradientsJob& job, const Normal<Arch>& normal, xsimd::batch<float, Arch> dx,
                                xsimd::batch<float, Arch> height, xsimd::batch<float, Arch> dz, std::size_t texel,
                                xsimd::batch<float, Arch> (&averages)[mip_planes]) {
    using V = xsimd::batch<float, Arch>;
    const V jacobian = normal.y * V(job.jacobian_factor);
    const V clamped_jacobian = clamped<Arch>(jacobian, -1.f, 1.f);
    const V to_byte = normal.inverse_length * V(signed_byte_factor);
    store_texels<Arch>(
        signed_bytes<Arch>(normal.x * to_byte, normal.z * to_byte, clamped_jacobian * V(signed_byte_factor)) |
            xsimd::batch<std::int32_t, Arch>(job.smoothness_bits),
        job.levels[0] + texel);

    if (job.rgba16f) store_halves<Arch>(dx, height, dz, foam_of<Arch>(jacobian), job.rgba16f + 4 * texel);

    const V scaled = normal.inverse_length * V(job.normal_length);
    averages[0] = normal.x * scaled;
    averages[1] = normal.y * scaled;
    averages[2] = normal.z * scaled;
    averages[3] = clamped_jacobian;
}

/// Two rows of the tile, whose axes `turn` takes to the world's. Normals first, packing afterwards: roots and divisions take long to come, and short loops let
/// the processor begin the next ones meanwhile.
template <class Arch, class Surface, class Turn>
inline void gradient_rows(const GradientsJob& job, const Surface& surface, const Turn& turn, std::size_t row,
                          std::size_t columns, MipScratch<Arch>& scratch) {
    using V = xsimd::batch<float, Arch>;
    constexpr std::size_t row_floats = Normal<Arch>::floats * GradientsJob::tile_columns / V::size;
    alignas(64) float normals[2][row_floats];
    const std::size_t z = job.first_row + row;
    const V two_texels(job.two_texels_m);
    for (std::size_t i = 0; i < 2; ++i) {
        float* to = normals[i];
        surface.differences_of_row(z + i, job.first_column, columns,
                                   [&](const auto& dx, const auto& h, const auto& dz) {
                                       normal_of<Arch>(turn(dx), turn(h), turn(dz), two_texels).store(to);
                                       to += Normal<Arch>::floats;
                                   });
    }
    for (std::size_t column = 0; column < columns; column += V::size) {
        const std::size_t x = job.first_column + column;
        V averages[2][mip_planes];
        for (std::size_t i = 0; i < 2; ++i)
            pack_texels<Arch>(job, Normal<Arch>::load(normals[i] + column / V::size * Normal<Arch>::floats),
                              surface.at(surface_dx, x, z + i), surface.at(surface_height, x, z + i),
                              surface.at(surface_dz, x, z + i), (z + i) * job.resolution + x, averages[i]);
        for (std::size_t plane = 0; plane < mip_planes; ++plane)
            (averages[0][plane] + averages[1][plane]).store_aligned(scratch.sums[row / 2][plane] + column);
    }
}

/// The stage's whole job, for any surface that has at() and differences_of_row().
template <class Arch, class Surface>
inline void gradients_of(const GradientsJob& job, const Surface& surface) {
    using V = xsimd::batch<float, Arch>;
    const std::size_t n = job.resolution;
    const std::size_t rows = n < GradientsJob::tile_rows ? n : GradientsJob::tile_rows;
    const std::size_t columns = n < GradientsJob::tile_columns ? n : GradientsJob::tile_columns;
    MipScratch<Arch> scratch;
    const auto all_rows = [&](const auto& turn) {
        for (std::size_t row = 0; row < rows; row += 2)
            gradient_rows<Arch>(job, surface, turn, row, columns, scratch);
    };
    if (job.sine != 0 || job.cosine != 1)
        all_rows(Turned<Arch>{V(job.cosine), V(job.sine)});
    else
        all_rows(NotTurned{});

    for (int level = 1; level <= GradientsJob::tile_levels; ++level) {
        const std::size_t side = n >> level;
        const std::size_t first_row = job.first_row >> level, first_column = job.first_column >> level;
        std::uint32_t* texels = job.levels[level] + first_row * side + first_column;
        const LevelScratch finer{scratch.levels[level % 2][0][0], MipScratch<Arch>::level_columns};
        const LevelScratch coarser{scratch.levels[(level + 1) % 2][0][0], MipScratch<Arch>::level_columns};
        if (level == 1)
            make_level<Arch>(
                rows >> level, columns >> level,
                [&](std::size_t row, std::size_t plane, std::size_t x) {
                    return V::load_aligned(scratch.sums[row][plane] + x);
                },
                coarser, texels, side);
        else
            make_level<Arch>(
                rows >> level, columns >> level,
                [&](std::size_t row, std::size_t plane, std::size_t x) {
                    return row_pair_sum<Arch>(finer, row, plane, x);
                },
                coarser, texels, side);
        if (level < GradientsJob::tile_levels) continue;
        const LevelScratch all{job.averages, job.average_stride};
        for (std::size_t row = 0; row < rows >> level; ++row)
            for (std::size_t plane = 0; plane < mip_planes; ++plane)
                std::memcpy(all.row(first_row + row) + plane * all.plane_stride + first_column,
                            coarser.row(row) + plane * coarser.plane_stride, (columns >> level) * sizeof(float));
    }
}

template <class Arch>
void gradients(const GradientsJob& job) {
    gradients_of<Arch>(job, BlockSurface<Arch>(job.surface, job.resolution, job.block_stride));
}

}  // namespace pelagic::kernels
