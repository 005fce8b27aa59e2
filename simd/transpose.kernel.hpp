// Loads that transpose W rows of W floats, which xsimd 8.1 lacks.
#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "pelagic/simd/always_inline.hpp"

namespace pelagic::kernels {

/// Loads from[r * stride + c] into lane r of columns[c]. This version is for four lanes: SSE and
/// NEON.
/// \pre rows are aligned to the size of a register
template <class Arch>
PELAGIC_INLINE void load_transposed(const float* from, std::size_t stride, xsimd::batch<float, Arch> (&columns)[4]) {
#if defined(__SSE4_2__)
    __m128 a = _mm_load_ps(from), b = _mm_load_ps(from + stride);
    __m128 c = _mm_load_ps(from + 2 * stride), d = _mm_load_ps(from + 3 * stride);
    _MM_TRANSPOSE4_PS(a, b, c, d);
    columns[0] = a, columns[1] = b, columns[2] = c, columns[3] = d;
#else
    const float32x4x2_t ab = vtrnq_f32(vld1q_f32(from), vld1q_f32(from + stride));
    const float32x4x2_t cd = vtrnq_f32(vld1q_f32(from + 2 * stride), vld1q_f32(from + 3 * stride));
    columns[0] = vcombine_f32(vget_low_f32(ab.val[0]), vget_low_f32(cd.val[0]));
    columns[1] = vcombine_f32(vget_low_f32(ab.val[1]), vget_low_f32(cd.val[1]));
    columns[2] = vcombine_f32(vget_high_f32(ab.val[0]), vget_high_f32(cd.val[0]));
    columns[3] = vcombine_f32(vget_high_f32(ab.val[1]), vget_high_f32(cd.val[1]));
#endif
}

#if defined(__AVX__)
/// Version for eight lanes. Loads rows r and r + 4 as halves of one register, which avoids shuffles
/// between halves, then transposes four rows within each half.
template <class Arch>
PELAGIC_INLINE void load_transposed(const float* from, std::size_t stride, xsimd::batch<float, Arch> (&columns)[8]) {
    for (std::size_t half = 0; half < 2; ++half) {
        const auto rows = [&](std::size_t r) {
            const float* low = from + r * stride + 4 * half;
            return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_load_ps(low)), _mm_load_ps(low + 4 * stride), 1);
        };
        const __m256 a = rows(0), b = rows(1), c = rows(2), d = rows(3);
        const __m256 ab_low = _mm256_unpacklo_ps(a, b), ab_high = _mm256_unpackhi_ps(a, b);
        const __m256 cd_low = _mm256_unpacklo_ps(c, d), cd_high = _mm256_unpackhi_ps(c, d);
        columns[4 * half] = _mm256_shuffle_ps(ab_low, cd_low, _MM_SHUFFLE(1, 0, 1, 0));
        columns[4 * half + 1] = _mm256_shuffle_ps(ab_low, cd_low, _MM_SHUFFLE(3, 2, 3, 2));
        columns[4 * half + 2] = _mm256_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(1, 0, 1, 0));
        columns[4 * half + 3] = _mm256_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(3, 2, 3, 2));
    }
}
#endif

#if defined(__AVX512F__)
/// Version for sixteen lanes: transposes 4 x 4 blocks within each quarter, then the quarters.
template <class Arch>
PELAGIC_INLINE void load_transposed(const float* from, std::size_t stride, xsimd::batch<float, Arch> (&columns)[16]) {
    __m512 fours[16];
    for (std::size_t quarter = 0; quarter < 16; quarter += 4) {
        const auto row = [&](std::size_t r) { return _mm512_load_ps(from + (quarter + r) * stride); };
        const __m512 ab_low = _mm512_unpacklo_ps(row(0), row(1)), ab_high = _mm512_unpackhi_ps(row(0), row(1));
        const __m512 cd_low = _mm512_unpacklo_ps(row(2), row(3)), cd_high = _mm512_unpackhi_ps(row(2), row(3));
        fours[quarter] = _mm512_shuffle_ps(ab_low, cd_low, _MM_SHUFFLE(1, 0, 1, 0));
        fours[quarter + 1] = _mm512_shuffle_ps(ab_low, cd_low, _MM_SHUFFLE(3, 2, 3, 2));
        fours[quarter + 2] = _mm512_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(1, 0, 1, 0));
        fours[quarter + 3] = _mm512_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(3, 2, 3, 2));
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const __m512 ab_even = _mm512_shuffle_f32x4(fours[i], fours[i + 4], _MM_SHUFFLE(2, 0, 2, 0));
        const __m512 ab_odd = _mm512_shuffle_f32x4(fours[i], fours[i + 4], _MM_SHUFFLE(3, 1, 3, 1));
        const __m512 cd_even = _mm512_shuffle_f32x4(fours[i + 8], fours[i + 12], _MM_SHUFFLE(2, 0, 2, 0));
        const __m512 cd_odd = _mm512_shuffle_f32x4(fours[i + 8], fours[i + 12], _MM_SHUFFLE(3, 1, 3, 1));
        columns[i] = _mm512_shuffle_f32x4(ab_even, cd_even, _MM_SHUFFLE(2, 0, 2, 0));
        columns[i + 4] = _mm512_shuffle_f32x4(ab_odd, cd_odd, _MM_SHUFFLE(2, 0, 2, 0));
        columns[i + 8] = _mm512_shuffle_f32x4(ab_even, cd_even, _MM_SHUFFLE(3, 1, 3, 1));
        columns[i + 12] = _mm512_shuffle_f32x4(ab_odd, cd_odd, _MM_SHUFFLE(3, 1, 3, 1));
    }
}
#endif

}  // namespace pelagic::kernels
