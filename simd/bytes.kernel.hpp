// Conversion of floats to bytes, four per lane, in the layout of RGBA8 texels. The saturating pack
// instructions clamp out-of-range values. Rounding is to nearest even.
#pragma once

#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/lanes.kernel.hpp"

namespace pelagic::kernels {

/// Returns 32-bit words with the bytes a, b, c and d, from the lowest to the highest.
/// \pre a, b, c and d are in [0, 255]
#if defined(__AVX512BW__)
template <HasLanes<16> Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> words_of_bytes(xsimd::batch<std::int32_t, Arch> a,
                                                               xsimd::batch<std::int32_t, Arch> b,
                                                               xsimd::batch<std::int32_t, Arch> c,
                                                               xsimd::batch<std::int32_t, Arch> d) {
    const __m512i by_lane = _mm512_set4_epi32(0x0F0B0703, 0x0E0A0602, 0x0D090501, 0x0C080400);
    return _mm512_shuffle_epi8(_mm512_packus_epi16(_mm512_packs_epi32(a, b), _mm512_packs_epi32(c, d)), by_lane);
}
#endif
#if defined(__AVX2__)
template <HasLanes<8> Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> words_of_bytes(xsimd::batch<std::int32_t, Arch> a,
                                                               xsimd::batch<std::int32_t, Arch> b,
                                                               xsimd::batch<std::int32_t, Arch> c,
                                                               xsimd::batch<std::int32_t, Arch> d) {
    const __m256i by_lane = _mm256_set_epi32(0x0F0B0703, 0x0E0A0602, 0x0D090501, 0x0C080400, 0x0F0B0703, 0x0E0A0602,
                                             0x0D090501, 0x0C080400);
    return _mm256_shuffle_epi8(_mm256_packus_epi16(_mm256_packs_epi32(a, b), _mm256_packs_epi32(c, d)), by_lane);
}
#endif
#if defined(__SSE4_2__)
template <HasLanes<4> Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> words_of_bytes(xsimd::batch<std::int32_t, Arch> a,
                                                               xsimd::batch<std::int32_t, Arch> b,
                                                               xsimd::batch<std::int32_t, Arch> c,
                                                               xsimd::batch<std::int32_t, Arch> d) {
    const __m128i by_lane = _mm_set_epi32(0x0F0B0703, 0x0E0A0602, 0x0D090501, 0x0C080400);
    return _mm_shuffle_epi8(_mm_packus_epi16(_mm_packs_epi32(a, b), _mm_packs_epi32(c, d)), by_lane);
}
#else
template <class Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> words_of_bytes(xsimd::batch<std::int32_t, Arch> a,
                                                               xsimd::batch<std::int32_t, Arch> b,
                                                               xsimd::batch<std::int32_t, Arch> c,
                                                               xsimd::batch<std::int32_t, Arch> d) {
    return vsliq_n_s32(vsliq_n_s32(vsliq_n_s32(a, b, 8), c, 16), d, 24);
}
#endif

/// Returns 32-bit words with the bytes of a, b, c and d, from the lowest to the highest. Each value
/// is rounded, clamped to [-128, 127] and offset by 128.
/// \pre magnitudes are below 2^31
#if defined(__AVX512BW__)
template <HasLanes<16> Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> four_bytes(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b,
                                                           xsimd::batch<float, Arch> c, xsimd::batch<float, Arch> d) {
    const __m512i ab = _mm512_packs_epi32(_mm512_cvtps_epi32(a), _mm512_cvtps_epi32(b));
    const __m512i cd = _mm512_packs_epi32(_mm512_cvtps_epi32(c), _mm512_cvtps_epi32(d));
    // Each 128 bits hold four bytes of a, of b, of c and of d.
    const __m512i by_lane = _mm512_set4_epi32(0x0F0B0703, 0x0E0A0602, 0x0D090501, 0x0C080400);
    return _mm512_xor_si512(_mm512_shuffle_epi8(_mm512_packs_epi16(ab, cd), by_lane),
                            _mm512_set1_epi32(static_cast<int>(0x80808080)));
}
#endif
#if defined(__AVX2__)
template <HasLanes<8> Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> four_bytes(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b,
                                                           xsimd::batch<float, Arch> c, xsimd::batch<float, Arch> d) {
    const __m256i ab = _mm256_packs_epi32(_mm256_cvtps_epi32(a), _mm256_cvtps_epi32(b));
    const __m256i cd = _mm256_packs_epi32(_mm256_cvtps_epi32(c), _mm256_cvtps_epi32(d));
    const __m256i by_lane = _mm256_set_epi32(0x0F0B0703, 0x0E0A0602, 0x0D090501, 0x0C080400, 0x0F0B0703, 0x0E0A0602,
                                             0x0D090501, 0x0C080400);
    return _mm256_xor_si256(_mm256_shuffle_epi8(_mm256_packs_epi16(ab, cd), by_lane),
                            _mm256_set1_epi32(static_cast<int>(0x80808080)));
}
#endif
#if defined(__SSE4_2__)
template <HasLanes<4> Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> four_bytes(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b,
                                                           xsimd::batch<float, Arch> c, xsimd::batch<float, Arch> d) {
    const __m128i ab = _mm_packs_epi32(_mm_cvtps_epi32(a), _mm_cvtps_epi32(b));
    const __m128i cd = _mm_packs_epi32(_mm_cvtps_epi32(c), _mm_cvtps_epi32(d));
    const __m128i by_lane = _mm_set_epi32(0x0F0B0703, 0x0E0A0602, 0x0D090501, 0x0C080400);
    return _mm_xor_si128(_mm_shuffle_epi8(_mm_packs_epi16(ab, cd), by_lane),
                         _mm_set1_epi32(static_cast<int>(0x80808080)));
}
#else
template <class Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> four_bytes(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b,
                                                           xsimd::batch<float, Arch> c, xsimd::batch<float, Arch> d) {
    const int16x8_t ab = vcombine_s16(vqmovn_s32(vcvtnq_s32_f32(a)), vqmovn_s32(vcvtnq_s32_f32(b)));
    const int16x8_t cd = vcombine_s16(vqmovn_s32(vcvtnq_s32_f32(c)), vqmovn_s32(vcvtnq_s32_f32(d)));
    const uint8x16_t bytes = vreinterpretq_u8_s8(vcombine_s8(vqmovn_s16(ab), vqmovn_s16(cd)));
    const uint8x16_t by_lane = {0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15};
    return vreinterpretq_s32_u8(veorq_u8(vqtbl1q_u8(bytes, by_lane), vdupq_n_u8(0x80)));
}
#endif

}  // namespace pelagic::kernels
