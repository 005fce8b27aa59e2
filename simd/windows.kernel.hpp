// Loads of four consecutive floats at each of W indices: one load instead of four, then a
// transpose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/lanes.kernel.hpp"

namespace pelagic::kernels {

/// A quarter is four lanes of a register; a register of SSE and NEON is one quarter. Functions for
/// each register size:
///
/// fours_loaded    loads plane[places[4 q] ...] into quarter q
/// lane_in_all     fills each quarter with its lane k
/// lanes_rotated   puts lane lanes[j] % 4 of a quarter into its lane j
/// fours_rotated   transposes the 4 x 4 block of each quarter
#if defined(__AVX512F__)
template <HasLanes<16> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> fours_loaded(const float* plane, const std::uint32_t* places) {
    __m512 fours = _mm512_castps128_ps512(_mm_loadu_ps(plane + places[0]));
    fours = _mm512_insertf32x4(fours, _mm_loadu_ps(plane + places[4]), 1);
    fours = _mm512_insertf32x4(fours, _mm_loadu_ps(plane + places[8]), 2);
    return _mm512_insertf32x4(fours, _mm_loadu_ps(plane + places[12]), 3);
}
template <int k, HasLanes<16> Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> lane_in_all(xsimd::batch<std::int32_t, Arch> of) {
    return _mm512_shuffle_epi32(of, static_cast<_MM_PERM_ENUM>(k * 0x55));
}
template <HasLanes<16> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> lanes_rotated(xsimd::batch<float, Arch> of,
                                                       xsimd::batch<std::int32_t, Arch> lanes) {
    return _mm512_permutevar_ps(of, lanes);
}
template <HasLanes<16> Arch>
PELAGIC_INLINE void fours_rotated(xsimd::batch<float, Arch> (&fours)[4]) {
    const __m512 ab_low = _mm512_unpacklo_ps(fours[0], fours[1]), ab_high = _mm512_unpackhi_ps(fours[0], fours[1]);
    const __m512 cd_low = _mm512_unpacklo_ps(fours[2], fours[3]), cd_high = _mm512_unpackhi_ps(fours[2], fours[3]);
    fours[0] = _mm512_shuffle_ps(ab_low, cd_low, _MM_SHUFFLE(1, 0, 1, 0));
    fours[1] = _mm512_shuffle_ps(ab_low, cd_low, _MM_SHUFFLE(3, 2, 3, 2));
    fours[2] = _mm512_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(1, 0, 1, 0));
    fours[3] = _mm512_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(3, 2, 3, 2));
}
#endif
#if defined(__AVX2__)
template <HasLanes<8> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> fours_loaded(const float* plane, const std::uint32_t* places) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(plane + places[0])),
                                _mm_loadu_ps(plane + places[4]), 1);
}
template <int k, HasLanes<8> Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> lane_in_all(xsimd::batch<std::int32_t, Arch> of) {
    return _mm256_shuffle_epi32(of, k * 0x55);
}
template <HasLanes<8> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> lanes_rotated(xsimd::batch<float, Arch> of,
                                                       xsimd::batch<std::int32_t, Arch> lanes) {
    return _mm256_permutevar_ps(of, lanes);
}
template <HasLanes<8> Arch>
PELAGIC_INLINE void fours_rotated(xsimd::batch<float, Arch> (&fours)[4]) {
    const __m256 ab_low = _mm256_unpacklo_ps(fours[0], fours[1]), ab_high = _mm256_unpackhi_ps(fours[0], fours[1]);
    const __m256 cd_low = _mm256_unpacklo_ps(fours[2], fours[3]), cd_high = _mm256_unpackhi_ps(fours[2], fours[3]);
    fours[0] = _mm256_shuffle_ps(ab_low, cd_low, _MM_SHUFFLE(1, 0, 1, 0));
    fours[1] = _mm256_shuffle_ps(ab_low, cd_low, _MM_SHUFFLE(3, 2, 3, 2));
    fours[2] = _mm256_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(1, 0, 1, 0));
    fours[3] = _mm256_shuffle_ps(ab_high, cd_high, _MM_SHUFFLE(3, 2, 3, 2));
}
#endif
#if defined(__SSE4_2__)
template <HasLanes<4> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> fours_loaded(const float* plane, const std::uint32_t* places) {
    return _mm_loadu_ps(plane + places[0]);
}
template <int k, HasLanes<4> Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> lane_in_all(xsimd::batch<std::int32_t, Arch> of) {
    return _mm_shuffle_epi32(of, k * 0x55);
}
template <HasLanes<4> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> lanes_rotated(xsimd::batch<float, Arch> of,
                                                       xsimd::batch<std::int32_t, Arch> lanes) {
    // Bytes 4 l, 4 l + 1, 4 l + 2, 4 l + 3 of each lane l.
    const __m128i first = _mm_and_si128(_mm_slli_epi32(lanes, 2), _mm_set1_epi32(12));
    const __m128i bytes =
        _mm_add_epi32(_mm_mullo_epi32(first, _mm_set1_epi32(0x01010101)), _mm_set1_epi32(0x03020100));
    return _mm_castsi128_ps(_mm_shuffle_epi8(_mm_castps_si128(of), bytes));
}
template <HasLanes<4> Arch>
PELAGIC_INLINE void fours_rotated(xsimd::batch<float, Arch> (&fours)[4]) {
    __m128 a = fours[0], b = fours[1], c = fours[2], d = fours[3];
    _MM_TRANSPOSE4_PS(a, b, c, d);
    fours[0] = a, fours[1] = b, fours[2] = c, fours[3] = d;
}
#else
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> fours_loaded(const float* plane, const std::uint32_t* places) {
    return vld1q_f32(plane + places[0]);
}
template <int k, class Arch>
PELAGIC_INLINE xsimd::batch<std::int32_t, Arch> lane_in_all(xsimd::batch<std::int32_t, Arch> of) {
    return vdupq_laneq_s32(of, k);
}
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> lanes_rotated(xsimd::batch<float, Arch> of,
                                                       xsimd::batch<std::int32_t, Arch> lanes) {
    // Bytes 4 l, 4 l + 1, 4 l + 2, 4 l + 3 of each lane l.
    const int32x4_t first = vandq_s32(vshlq_n_s32(lanes, 2), vdupq_n_s32(12));
    const int32x4_t bytes = vmlaq_n_s32(vdupq_n_s32(0x03020100), first, 0x01010101);
    return vreinterpretq_f32_u8(vqtbl1q_u8(vreinterpretq_u8_f32(of), vreinterpretq_u8_s32(bytes)));
}
template <class Arch>
PELAGIC_INLINE void fours_rotated(xsimd::batch<float, Arch> (&fours)[4]) {
    const float32x4x2_t ab = vtrnq_f32(fours[0], fours[1]), cd = vtrnq_f32(fours[2], fours[3]);
    fours[0] = vcombine_f32(vget_low_f32(ab.val[0]), vget_low_f32(cd.val[0]));
    fours[1] = vcombine_f32(vget_low_f32(ab.val[1]), vget_low_f32(cd.val[1]));
    fours[2] = vcombine_f32(vget_high_f32(ab.val[0]), vget_high_f32(cd.val[0]));
    fours[3] = vcombine_f32(vget_high_f32(ab.val[1]), vget_high_f32(cd.val[1]));
}
#endif

}  // namespace pelagic::kernels
