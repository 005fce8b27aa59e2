#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/block_surface.kernel.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/kernels/mipmaps.kernel.hpp"
#include "pelagic/simd/exact.kernel.hpp"
#include "pelagic/simd/half.kernel.hpp"

namespace pelagic::kernels {

/// Unnormalised normals of a row of a block, and the factors that normalise them.
enum NormalPlane { normal_x, normal_y, normal_z, inverse_length, normal_planes };
using NormalRow = float[normal_planes][GradientsJob::block_columns];

/// Working memory for the mip levels of a block. Whole registers are read and written, two at a
/// time.
template <class Arch>
struct MipScratch {
    static constexpr std::size_t columns(int level) {
        return (GradientsJob::block_columns >> level) + 2 * xsimd::batch<float, Arch>::size;
    }
    template <int level>
    using Rows = GradientRows<columns(level)>;

    alignas(64) float level_1[GradientsJob::block_rows / 2 * (mip_planes + 1) * columns(1)];
    alignas(64) float level_2[GradientsJob::block_rows / 4 * (mip_planes + 1) * columns(2)];
    alignas(64) float level_3[GradientsJob::block_rows / 8 * (mip_planes + 1) * columns(3)];
};

/// Computes equations 45 to 48, times (2 L/N)^2. Differences are not divided by the distance,
/// because the length of the normal is arbitrary. J is the normal's y; it is divided by the squared
/// distance later.
template <class Arch>
PELAGIC_INLINE void store_normal(const Differences<Arch> (&along)[surface_components],
                                 xsimd::batch<float, Arch> two_texels, NormalRow& row, std::size_t column) {
    using V = xsimd::batch<float, Arch>;
    const auto& [dx, h, dz] = along;
    const V j_xx = two_texels + dx.x;
    const V j_zz = two_texels + dz.z;
    const V n_x = h.z * dz.x - h.x * j_zz;
    const V n_y = j_xx * j_zz - dx.z * dz.x;
    const V n_z = h.x * dx.z - h.z * j_xx;
    // A surface contracted to a point has no normal; the lower bound keeps the result finite.
    const V squared = xsimd::max(n_x * n_x + n_y * n_y + n_z * n_z, V(1e-30f));
    n_x.store_aligned(row[normal_x] + column);
    n_y.store_aligned(row[normal_y] + column);
    n_z.store_aligned(row[normal_z] + column);
    divided<Arch>(V(1.f), square_root<Arch>(squared)).store_aligned(row[inverse_length] + column);
}

/// Computes the normals of two rows.
template <class Arch, class Surface, class Turn>
inline void normals_of_rows(const GradientsJob& job, const Surface& surface, const Turn& turn, std::size_t z,
                            std::size_t columns, NormalRow (&normals)[2]) {
    using V = xsimd::batch<float, Arch>;
    const V two_texels(job.two_texels_m);
    for (std::size_t i = 0; i < 2; ++i) {
        std::size_t column = 0;
        surface.differences_of_row(z + i, job.first_column, columns,
                                   [&](Differences<Arch>(&along)[surface_components]) {
                                       for (Differences<Arch>& differences : along) turn(differences);
                                       store_normal<Arch>(along, two_texels, normals[i], column);
                                       column += V::size;
                                   });
    }
}

/// Writes level 0 and the half floats of two rows of a block, and the averages of level 1. The
/// job's members are read once, before the stores, because the compiler must assume that stores
/// change them.
template <class Arch, bool with_halves, class Surface>
inline void pack_rows(const GradientsJob& job, const Surface& surface, std::size_t z, std::size_t columns,
                      const NormalRow (&normals)[2], float* averages, std::size_t plane_stride) {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;
    const V jacobian_factor(job.jacobian_factor), normal_length(job.normal_length), byte_factor(signed_byte_factor);
    const I smoothness(static_cast<std::int32_t>(static_cast<std::uint32_t>(job.smoothness_bits) >> 24));
    const std::size_t n = job.resolution;
    std::uint32_t* texels = job.levels[0] + z * n + job.first_column;
    std::uint16_t* halves = with_halves ? job.rgba16f + 4 * (z * n + job.first_column) : nullptr;
    auto rows = surface.rows(job.first_column, z);

    // Packs W columns of two rows and adds both rows.
    const auto pack = [&](std::size_t column, V(&sums)[mip_planes]) {
        for (std::size_t i = 0; i < 2; ++i) {
            const auto normal = [&](NormalPlane plane) { return V::load_aligned(normals[i][plane] + column); };
            const V inverse = normal(inverse_length);
            const V clamped_jacobian = clamped<Arch>(normal(normal_y) * jacobian_factor, -1.f, 1.f);
            const V to_byte = inverse * byte_factor;
            store_texels<Arch>(gradient_texels<Arch>(normal(normal_x) * to_byte, normal(normal_z) * to_byte,
                                                     clamped_jacobian * byte_factor, smoothness),
                               texels + i * n + column);
            if constexpr (with_halves)
                store_halves<Arch>(rows.at(surface_dx, i), rows.at(surface_height, i), rows.at(surface_dz, i),
                                   V(0.f), halves + 4 * (i * n + column));
            const V scaled = inverse * normal_length;
            const V averaged[mip_planes] = {normal(normal_x) * scaled, normal(normal_y) * scaled,
                                            normal(normal_z) * scaled, clamped_jacobian};
            for (std::size_t plane = 0; plane < mip_planes; ++plane)
                sums[plane] = i == 0 ? averaged[plane] : sums[plane] + averaged[plane];
        }
        rows.next();
    };
    V low[mip_planes], high[mip_planes];
    std::size_t column = 0;
    for (; column + 2 * V::size <= columns; column += 2 * V::size) {
        pack(column, low);
        pack(column + V::size, high);
        average_texels<Arch>(low, high, averages + column / 2, plane_stride);
    }
    // A row of N = 16 is one register of AVX-512.
    if constexpr (V::size == 16) {
        if (column < columns) {
            pack(column, low);
            average_texels<Arch>(low, low, averages + column / 2, plane_stride);
        }
    }
}

/// Executes a GradientsJob, for any surface type that has rows() and differences_of_row().
template <class Arch, class Surface>
inline void gradients_of(const GradientsJob& job, const Surface& surface) {
    using V = xsimd::batch<float, Arch>;
    using Scratch = MipScratch<Arch>;
    const std::size_t n = job.resolution;
    const std::size_t rows = n < GradientsJob::block_rows ? n : GradientsJob::block_rows;
    const std::size_t most_columns = n < GradientsJob::block_columns ? n : GradientsJob::block_columns;
    const std::size_t columns = job.narrow_columns ? job.narrow_columns : most_columns;
    const bool is_rotated = job.sine != 0 || job.cosine != 1;
    const Turned<Arch> turned{V(job.cosine), V(job.sine)};
    const auto texels = [&](int level) {
        return job.levels[level] + (job.first_row >> level) * (n >> level) + (job.first_column >> level);
    };
    alignas(64) NormalRow normals[2];
    Scratch scratch;
    const typename Scratch::template Rows<1> level_1{scratch.level_1};
    const typename Scratch::template Rows<2> level_2{scratch.level_2};
    const GradientRows<> all_of_level_3{job.averages, job.average_stride};
    const GradientRows<> level_3{all_of_level_3.row(job.first_row >> 3) + (job.first_column >> 3),
                                 job.average_stride};

    // Compute all normals of two rows before packing them. Square roots and divisions have a high
    // latency, and a short loop lets the processor overlap several of them.
    for (std::size_t row = 0; row < rows; row += 2) {
        const std::size_t z = job.first_row + row;
        if (is_rotated)
            normals_of_rows<Arch>(job, surface, turned, z, columns, normals);
        else
            normals_of_rows<Arch>(job, surface, NotTurned{}, z, columns, normals);
        float* averages = level_1.row(row / 2);
        if (job.rgba16f)
            pack_rows<Arch, true>(job, surface, z, columns, normals, averages, level_1.plane_stride());
        else
            pack_rows<Arch, false>(job, surface, z, columns, normals, averages, level_1.plane_stride());
        texels_of_row<Arch>(averages, level_1.plane_stride(), columns / 2, texels(1) + row / 2 * (n / 2));
    }
    make_level<Arch>(rows / 4, columns / 4, level_1, level_2, texels(2), n / 4);
    if (!job.narrow_columns) return make_level<Arch>(rows / 8, columns / 8, level_2, level_3, texels(3), n / 8);
    const typename Scratch::template Rows<3> narrow{scratch.level_3};
    make_level<Arch>(rows / 8, columns / 8, level_2, narrow, texels(3), n / 8);
    copy_averages(narrow, rows / 8, columns / 8, level_3);
}

template <class Arch>
void gradients(const GradientsJob& job) {
    gradients_of<Arch>(job, BlockSurface<Arch>(job.surface, job.resolution, job.block_stride));
}

}  // namespace pelagic::kernels
