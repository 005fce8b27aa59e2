#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/exact.kernel.hpp"
#include "pelagic/simd/neighbours.kernel.hpp"

namespace pelagic::kernels {

template <class Arch>
inline xsimd::batch<float, Arch> clamped(xsimd::batch<float, Arch> v, float least, float most) {
    using V = xsimd::batch<float, Arch>;
    return xsimd::min(xsimd::max(v, V(least)), V(most));
}

/// Channels of [-1, 1] become bytes as v 127.5 + 128, cut: equations 50 and 51 with rounding.
inline constexpr float signed_byte_factor = 127.5f;

/// Normal x, normal z and Jacobian, each already times signed_byte_factor, as the lowest three bytes.
template <class Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> signed_bytes(xsimd::batch<float, Arch> n_x,
                                                             xsimd::batch<float, Arch> n_z,
                                                             xsimd::batch<float, Arch> jacobian) {
    const xsimd::batch<float, Arch> middle(128.f);
    return xsimd::to_int(n_x + middle) | (xsimd::to_int(n_z + middle) << 8) |
           (xsimd::to_int(jacobian + middle) << 16);
}

/// A smoothness in [0, 1] as the highest byte.
template <class Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> smoothness_byte(xsimd::batch<float, Arch> smoothness) {
    using V = xsimd::batch<float, Arch>;
    return xsimd::to_int(smoothness * V(255.f) + V(0.5f)) << 24;
}

template <class Arch>
PELAGIC_INLINE void store_texels(xsimd::batch<std::int32_t, Arch> texels, std::uint32_t* out) {
    xsimd::bitwise_cast<xsimd::batch<std::uint32_t, Arch>>(texels).store_unaligned(out);
}

/// W averages of a level and the length of their normals; `sums` are the sums of two finer rows in 2 W columns.
/// Rows of the planes stand `plane_stride` apart, the lengths behind the last plane.
template <class Arch, class Sums>
PELAGIC_INLINE void average_texels(Sums sums, float* averages, std::size_t plane_stride) {
    using V = xsimd::batch<float, Arch>;
    V average[mip_planes];
    for (std::size_t plane = 0; plane < mip_planes; ++plane) {
        average[plane] = pair_sums<Arch>(sums(plane, 0), sums(plane, V::size)) * V(0.25f);
        average[plane].store_unaligned(averages + plane * plane_stride);
    }
    const V squared = average[0] * average[0] + average[1] * average[1] + average[2] * average[2];
    square_root<Arch>(squared).store_unaligned(averages + mip_planes * plane_stride);
}

/// W texels from their averages: smoothness by equation 53, the normal of unit length again.
template <class Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> texels_of_averages(const float* averages, std::size_t plane_stride) {
    using V = xsimd::batch<float, Arch>;
    const auto plane = [&](std::size_t number) { return V::load_unaligned(averages + number * plane_stride); };
    const V one(1.f);
    const V length = plane(mip_planes);
    const V to_byte = divided<Arch>(V(signed_byte_factor), xsimd::max(length, V(1e-15f)));
    const V t = clamped<Arch>((length - V(2.f / 3.f)) * V(3.f), 0.f, 1.f);
    const V roughness = xsimd::max(one - t * (V(0.85f) + t * V(0.15f)), V(0.f));
    return signed_bytes<Arch>(plane(0) * to_byte, plane(2) * to_byte, plane(3) * V(signed_byte_factor)) |
           smoothness_byte<Arch>(one - square_root<Arch>(roughness));
}

/// What a job makes of one level: rows of averages in planes and the length of their normals, in whole registers.
struct LevelScratch {
    float* averages;  ///< [row][plane][column], the lengths as the plane behind the last
    std::size_t plane_stride;

    float* row(std::size_t number) const { return averages + number * (mip_planes + 1) * plane_stride; }
};

/// A level's rows from the rows of the finer one: averages first, texels afterwards. Roots and divisions take long to
/// come, and short loops let the processor begin the next ones meanwhile.
template <class Arch, class Sums>
inline void make_level(std::size_t rows, std::size_t columns, Sums sums, const LevelScratch& level,
                       std::uint32_t* texels, std::size_t texel_stride) {
    using V = xsimd::batch<float, Arch>;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t x = 0; x < columns; x += V::size)
            average_texels<Arch>([&](std::size_t plane, std::size_t i) { return sums(row, plane, 2 * x + i); },
                                 level.row(row) + x, level.plane_stride);

    for (std::size_t row = 0; row < rows; ++row) {
        std::uint32_t* to = texels + row * texel_stride;
        std::size_t x = 0;
        for (; x + V::size <= columns; x += V::size)
            store_texels<Arch>(texels_of_averages<Arch>(level.row(row) + x, level.plane_stride), to + x);
        if (x == columns) continue;
        std::uint32_t last[V::size];
        store_texels<Arch>(texels_of_averages<Arch>(level.row(row) + x, level.plane_stride), last);
        for (std::size_t i = 0; x + i < columns; ++i) to[x + i] = last[i];
    }
}

/// Sums of the rows 2 row and 2 row + 1 of a finer level.
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> row_pair_sum(const LevelScratch& finer, std::size_t row, std::size_t plane,
                                                      std::size_t x) {
    using V = xsimd::batch<float, Arch>;
    const std::size_t at = plane * finer.plane_stride + x;
    return V::load_unaligned(finer.row(2 * row) + at) + V::load_unaligned(finer.row(2 * row + 1) + at);
}

template <class Arch>
void mip_level(const MipLevelJob& job) {
    const LevelScratch finer{job.finer, job.finer_stride};
    make_level<Arch>(
        job.side, job.side,
        [&](std::size_t row, std::size_t plane, std::size_t x) { return row_pair_sum<Arch>(finer, row, plane, x); },
        LevelScratch{job.averages, job.stride}, job.texels, job.side);
}

}  // namespace pelagic::kernels
