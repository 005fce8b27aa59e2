// Operations on neighbouring lanes: sums of pairs, and shifts of rows by one or two lanes. xsimd
// 8.1 has neither.
#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/lanes.kernel.hpp"

namespace pelagic::kernels {

/// Returns in lane i the sum of lanes 2i and 2i + 1 of `low` and `high`, concatenated to 2 W lanes.
#if defined(__AVX512F__)
template <HasLanes<16> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> pair_sums(xsimd::batch<float, Arch> low, xsimd::batch<float, Arch> high) {
    const __m512i evens = _mm512_set_epi32(30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 2, 0);
    const __m512i odds = _mm512_set_epi32(31, 29, 27, 25, 23, 21, 19, 17, 15, 13, 11, 9, 7, 5, 3, 1);
    return _mm512_add_ps(_mm512_permutex2var_ps(low, evens, high), _mm512_permutex2var_ps(low, odds, high));
}
#endif
#if defined(__AVX2__)
template <HasLanes<8> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> pair_sums(xsimd::batch<float, Arch> low, xsimd::batch<float, Arch> high) {
    const __m256 evens = _mm256_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0));
    const __m256 odds = _mm256_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1));
    // Each 128-bit half of the sum holds two sums of `low` and two of `high`.
    const __m256d sums = _mm256_castps_pd(_mm256_add_ps(evens, odds));
    return _mm256_castpd_ps(_mm256_permute4x64_pd(sums, _MM_SHUFFLE(3, 1, 2, 0)));
}
#endif
#if defined(__SSE4_2__)
template <HasLanes<4> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> pair_sums(xsimd::batch<float, Arch> low, xsimd::batch<float, Arch> high) {
    return _mm_add_ps(_mm_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)),
                      _mm_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1)));
}
#else
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> pair_sums(xsimd::batch<float, Arch> low, xsimd::batch<float, Arch> high) {
    const float32x4x2_t evens_odds = vuzpq_f32(low, high);
    return vaddq_f32(evens_odds.val[0], evens_odds.val[1]);
}
#endif

/// The operand that shifts lanes between two neighbouring registers. On AVX2 it is the middle of
/// the two, made by one instruction, and serves both registers. Elsewhere it is the two registers.
template <class Arch>
struct Seam {
    xsimd::batch<float, Arch> left, right;
};

/// lanes_before() returns lane i - count of `here` in lane i, and fills the first lanes from the
/// end of the register on its left. lanes_behind() returns lane i + count, and fills the last lanes
/// from the beginning of the register on its right. \tparam count  1 or 2
#if defined(__AVX512F__)
template <int count, HasLanes<16> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> lanes_before(const Seam<Arch>& seam, xsimd::batch<float, Arch> here) {
    return _mm512_castsi512_ps(
        _mm512_alignr_epi32(_mm512_castps_si512(here), _mm512_castps_si512(seam.left), 16 - count));
}
template <int count, HasLanes<16> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> lanes_behind(xsimd::batch<float, Arch> here, const Seam<Arch>& seam) {
    return _mm512_castsi512_ps(
        _mm512_alignr_epi32(_mm512_castps_si512(seam.right), _mm512_castps_si512(here), count));
}
#endif
#if defined(__AVX2__)
/// The last four lanes of the left register and the first four of the right register.
template <HasLanes<8> Arch>
struct Seam<Arch> {
    __m256i middle;

    Seam() = default;
    PELAGIC_INLINE Seam(xsimd::batch<float, Arch> left, xsimd::batch<float, Arch> right)
        : middle(_mm256_castps_si256(_mm256_permute2f128_ps(left, right, 0x21))) {}
};
template <int count, HasLanes<8> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> lanes_before(const Seam<Arch>& seam, xsimd::batch<float, Arch> here) {
    return _mm256_castsi256_ps(_mm256_alignr_epi8(_mm256_castps_si256(here), seam.middle, 16 - 4 * count));
}
template <int count, HasLanes<8> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> lanes_behind(xsimd::batch<float, Arch> here, const Seam<Arch>& seam) {
    return _mm256_castsi256_ps(_mm256_alignr_epi8(seam.middle, _mm256_castps_si256(here), 4 * count));
}
#endif
#if defined(__SSE4_2__)
template <int count, HasLanes<4> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> lanes_before(const Seam<Arch>& seam, xsimd::batch<float, Arch> here) {
    return _mm_castsi128_ps(_mm_alignr_epi8(_mm_castps_si128(here), _mm_castps_si128(seam.left), 16 - 4 * count));
}
template <int count, HasLanes<4> Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> lanes_behind(xsimd::batch<float, Arch> here, const Seam<Arch>& seam) {
    return _mm_castsi128_ps(_mm_alignr_epi8(_mm_castps_si128(seam.right), _mm_castps_si128(here), 4 * count));
}
#else
template <int count, class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> lanes_before(const Seam<Arch>& seam, xsimd::batch<float, Arch> here) {
    return vextq_f32(seam.left, here, 4 - count);
}
template <int count, class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> lanes_behind(xsimd::batch<float, Arch> here, const Seam<Arch>& seam) {
    return vextq_f32(here, seam.right, count);
}
#endif

/// Returns lanes_behind() for callers that shift in one direction only.
template <int count, class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> lanes_behind(xsimd::batch<float, Arch> here,
                                                      xsimd::batch<float, Arch> behind) {
    return lanes_behind<count, Arch>(here, Seam<Arch>{here, behind});
}

}  // namespace pelagic::kernels
