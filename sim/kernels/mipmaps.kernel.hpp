#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/bytes.kernel.hpp"
#include "pelagic/simd/exact.kernel.hpp"
#include "pelagic/simd/neighbours.kernel.hpp"

namespace pelagic::kernels {

template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> clamped(xsimd::batch<float, Arch> v, float min, float max) {
    using V = xsimd::batch<float, Arch>;
    return xsimd::min(xsimd::max(v, V(min)), V(max));
}

/// A channel v in [-1, 1] becomes the byte trunc(v 127.5 + 128): equations 50 and 51 with rounding.
inline constexpr float signed_byte_factor = 127.5f;

/// Packs normal x, normal z and Jacobian, each already times signed_byte_factor, and a byte of
/// smoothness.
template <class Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> gradient_texels(xsimd::batch<float, Arch> n_x,
                                                                xsimd::batch<float, Arch> n_z,
                                                                xsimd::batch<float, Arch> jacobian,
                                                                xsimd::batch<std::int32_t, Arch> smoothness) {
    const xsimd::batch<float, Arch> middle(128.f);
    return words_of_bytes<Arch>(xsimd::to_int(n_x + middle), xsimd::to_int(n_z + middle),
                                xsimd::to_int(jacobian + middle), smoothness);
}

template <class Arch>
PELAGIC_INLINE void store_texels(xsimd::batch<std::int32_t, Arch> texels, std::uint32_t* out) {
    texels.store_unaligned(reinterpret_cast<std::int32_t*>(out));
}

/// Rows of averages of a level, in planes, in whole registers. A stride known at compile time
/// becomes an immediate operand.
template <std::size_t planes, std::size_t known_stride = 0>
struct AverageRows {
    float* first;
    std::size_t stride = known_stride;

    std::size_t plane_stride() const { return known_stride ? known_stride : stride; }
    float* row(std::size_t number) const { return first + number * planes * plane_stride(); }
};

/// Copies averages of a narrow block, whose registers hold more than its columns.
/// \param columns  even
template <class From, std::size_t planes>
inline void copy_averages(const From& from, std::size_t rows, std::size_t columns, AverageRows<planes> to) {
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t plane = 0; plane < planes; ++plane)
            for (std::size_t x = 0; x < columns; x += 2)
                std::memcpy(to.row(row) + plane * to.plane_stride() + x,
                            from.row(row) + plane * from.plane_stride() + x, 2 * sizeof(float));
}

/// Adds two rows in W columns.
template <class Arch, std::size_t planes>
PELAGIC_INLINE void add_rows(const float* above, const float* below, std::size_t plane_stride,
                             xsimd::batch<float, Arch> (&sums)[planes]) {
    using V = xsimd::batch<float, Arch>;
    for (std::size_t plane = 0; plane < planes; ++plane)
        sums[plane] =
            V::load_unaligned(above + plane * plane_stride) + V::load_unaligned(below + plane * plane_stride);
}

/// Computes W averages of 2 x 2 texels from the sums of two rows in 2 W columns.
template <class Arch, std::size_t planes>
PELAGIC_INLINE void average_pairs(const xsimd::batch<float, Arch> (&low)[planes],
                                  const xsimd::batch<float, Arch> (&high)[planes],
                                  xsimd::batch<float, Arch> (&average)[planes]) {
    using V = xsimd::batch<float, Arch>;
    for (std::size_t plane = 0; plane < planes; ++plane)
        average[plane] = pair_sums<Arch>(low[plane], high[plane]) * V(0.25f);
}

/// Rows of averages with one additional plane: the length of the averaged normals.
template <std::size_t known_stride = 0>
using GradientRows = AverageRows<mip_planes + 1, known_stride>;

/// Stores W averages and the length of their normals.
template <class Arch>
PELAGIC_INLINE void average_texels(const xsimd::batch<float, Arch> (&low)[mip_planes],
                                   const xsimd::batch<float, Arch> (&high)[mip_planes], float* averages,
                                   std::size_t plane_stride) {
    using V = xsimd::batch<float, Arch>;
    V average[mip_planes];
    average_pairs<Arch>(low, high, average);
    for (std::size_t plane = 0; plane < mip_planes; ++plane)
        average[plane].store_unaligned(averages + plane * plane_stride);
    const V squared = average[0] * average[0] + average[1] * average[1] + average[2] * average[2];
    square_root<Arch>(squared).store_unaligned(averages + mip_planes * plane_stride);
}

/// Packs W texels from their averages: smoothness by equation 53, normals renormalised to unit
/// length.
template <class Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> texels_of_averages(const float* averages, std::size_t plane_stride) {
    using V = xsimd::batch<float, Arch>;
    const auto plane = [&](std::size_t number) { return V::load_unaligned(averages + number * plane_stride); };
    const V one(1.f);
    const V length = plane(mip_planes);
    const V to_byte = divided<Arch>(V(signed_byte_factor), xsimd::max(length, V(1e-15f)));
    const V t = clamped<Arch>((length - V(2.f / 3.f)) * V(3.f), 0.f, 1.f);
    const V roughness = xsimd::max(one - t * (V(0.85f) + t * V(0.15f)), V(0.f));
    const V smoothness = one - square_root<Arch>(roughness);
    return gradient_texels<Arch>(plane(0) * to_byte, plane(2) * to_byte, plane(3) * V(signed_byte_factor),
                                 xsimd::to_int(smoothness * V(255.f) + V(0.5f)));
}

/// Packs a row of texels from its averages.
template <class Arch>
inline void texels_of_row(const float* averages, std::size_t plane_stride, std::size_t columns,
                          std::uint32_t* texels) {
    using V = xsimd::batch<float, Arch>;
    std::size_t x = 0;
    for (; x + V::size <= columns; x += V::size)
        store_texels<Arch>(texels_of_averages<Arch>(averages + x, plane_stride), texels + x);
    if (x == columns) return;
    std::uint32_t last[V::size];
    store_texels<Arch>(texels_of_averages<Arch>(averages + x, plane_stride), last);
    for (std::size_t i = 0; x + i < columns; ++i) texels[x + i] = last[i];
}

/// Computes a level's rows from the rows of the finer level, averages before texels. Square roots
/// and divisions have a high latency, and short loops let the processor overlap several of them.
template <class Arch, class Finer, class Level>
inline void make_level(std::size_t rows, std::size_t columns, Finer finer, Level level, std::uint32_t* texels,
                       std::size_t texel_stride) {
    using V = xsimd::batch<float, Arch>;
    for (std::size_t row = 0; row < rows; ++row) {
        const float* above = finer.row(2 * row);
        const float* below = finer.row(2 * row + 1);
        float* averages = level.row(row);
        for (std::size_t x = 0; x < columns; x += V::size) {
            V low[mip_planes], high[mip_planes];
            add_rows<Arch>(above + 2 * x, below + 2 * x, finer.plane_stride(), low);
            add_rows<Arch>(above + 2 * x + V::size, below + 2 * x + V::size, finer.plane_stride(), high);
            average_texels<Arch>(low, high, averages + x, level.plane_stride());
        }
    }
    for (std::size_t row = 0; row < rows; ++row)
        texels_of_row<Arch>(level.row(row), level.plane_stride(), columns, texels + row * texel_stride);
}

template <class Arch>
void mip_level(const MipLevelJob& job) {
    make_level<Arch>(job.side, job.side, GradientRows<>{job.finer, job.finer_stride},
                     GradientRows<>{job.averages, job.stride}, job.texels, job.side);
}

}  // namespace pelagic::kernels
