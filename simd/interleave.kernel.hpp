// Stores of four registers whose lanes are interleaved, which xsimd 8.1 lacks.
#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/lanes.kernel.hpp"

namespace pelagic::kernels {

/// Stores a, b, c and d of lane 0, then those of lane 1, ...
/// \param out  aligned to the size of a register; receives 4 W floats
#if defined(__AVX512F__)
template <HasLanes<16> Arch>
PELAGIC_INLINE void store_interleaved(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b,
                                      xsimd::batch<float, Arch> c, xsimd::batch<float, Arch> d, float* out) {
    const __m512 ab_low = _mm512_unpacklo_ps(a, b), ab_high = _mm512_unpackhi_ps(a, b);
    const __m512 cd_low = _mm512_unpacklo_ps(c, d), cd_high = _mm512_unpackhi_ps(c, d);
    // Lanes 0, 4, 8 and 12 in the quarters of the first, and so on.
    const __m512 fours[] = {_mm512_shuffle_ps(ab_low, cd_low, _MM_SHUFFLE(1, 0, 1, 0)),
                            _mm512_shuffle_ps(ab_low, cd_low, _MM_SHUFFLE(3, 2, 3, 2)),
                            _mm512_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(1, 0, 1, 0)),
                            _mm512_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(3, 2, 3, 2))};
    const __m512 first[] = {_mm512_shuffle_f32x4(fours[0], fours[1], _MM_SHUFFLE(1, 0, 1, 0)),
                            _mm512_shuffle_f32x4(fours[2], fours[3], _MM_SHUFFLE(1, 0, 1, 0))};
    const __m512 last[] = {_mm512_shuffle_f32x4(fours[0], fours[1], _MM_SHUFFLE(3, 2, 3, 2)),
                           _mm512_shuffle_f32x4(fours[2], fours[3], _MM_SHUFFLE(3, 2, 3, 2))};
    _mm512_store_ps(out, _mm512_shuffle_f32x4(first[0], first[1], _MM_SHUFFLE(2, 0, 2, 0)));
    _mm512_store_ps(out + 16, _mm512_shuffle_f32x4(first[0], first[1], _MM_SHUFFLE(3, 1, 3, 1)));
    _mm512_store_ps(out + 32, _mm512_shuffle_f32x4(last[0], last[1], _MM_SHUFFLE(2, 0, 2, 0)));
    _mm512_store_ps(out + 48, _mm512_shuffle_f32x4(last[0], last[1], _MM_SHUFFLE(3, 1, 3, 1)));
}
#endif
#if defined(__AVX__)
template <HasLanes<8> Arch>
PELAGIC_INLINE void store_interleaved(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b,
                                      xsimd::batch<float, Arch> c, xsimd::batch<float, Arch> d, float* out) {
    const __m256 ab_low = _mm256_unpacklo_ps(a, b), ab_high = _mm256_unpackhi_ps(a, b);
    const __m256 cd_low = _mm256_unpacklo_ps(c, d), cd_high = _mm256_unpackhi_ps(c, d);
    const __m256 fours[] = {_mm256_shuffle_ps(ab_low, cd_low, _MM_SHUFFLE(1, 0, 1, 0)),
                            _mm256_shuffle_ps(ab_low, cd_low, _MM_SHUFFLE(3, 2, 3, 2)),
                            _mm256_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(1, 0, 1, 0)),
                            _mm256_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(3, 2, 3, 2))};
    _mm256_store_ps(out, _mm256_permute2f128_ps(fours[0], fours[1], 0x20));
    _mm256_store_ps(out + 8, _mm256_permute2f128_ps(fours[2], fours[3], 0x20));
    _mm256_store_ps(out + 16, _mm256_permute2f128_ps(fours[0], fours[1], 0x31));
    _mm256_store_ps(out + 24, _mm256_permute2f128_ps(fours[2], fours[3], 0x31));
}
#endif
#if defined(__SSE4_2__)
template <HasLanes<4> Arch>
PELAGIC_INLINE void store_interleaved(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b,
                                      xsimd::batch<float, Arch> c, xsimd::batch<float, Arch> d, float* out) {
    __m128 rows[] = {a, b, c, d};
    _MM_TRANSPOSE4_PS(rows[0], rows[1], rows[2], rows[3]);
    for (std::size_t i = 0; i < 4; ++i) _mm_store_ps(out + 4 * i, rows[i]);
}
#else
template <class Arch>
PELAGIC_INLINE void store_interleaved(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b,
                                      xsimd::batch<float, Arch> c, xsimd::batch<float, Arch> d, float* out) {
    const float32x4x4_t texels = {{a, b, c, d}};
    vst4q_f32(out, texels);
}
#endif

}  // namespace pelagic::kernels
