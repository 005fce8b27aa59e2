// Conversion between interleaved complex numbers, FFTW's layout, and registers of real and of
// imaginary parts.
#pragma once

#include <xsimd/xsimd.hpp>

#include "pelagic/simd/always_inline.hpp"

namespace pelagic::peers {

template <class Arch>
struct Pair {
    xsimd::batch<float, Arch> first, second;
};

#if defined(__AVX512F__)
inline __m512i lane_numbers(int first, int second) {
    // first, second, first + 1, second + 1, ...
    const __m512i counting = _mm512_set_epi32(7, 7, 6, 6, 5, 5, 4, 4, 3, 3, 2, 2, 1, 1, 0, 0);
    return _mm512_add_epi32(counting, _mm512_set_epi32(second, first, second, first, second, first, second, first,
                                                       second, first, second, first, second, first, second, first));
}
/// re 0, im 0, re 1, im 1, ...: the first W floats, and the rest.
template <class Arch>
PELAGIC_INLINE Pair<Arch> interleaved(xsimd::batch<float, Arch> re, xsimd::batch<float, Arch> im) {
    return {_mm512_permutex2var_ps(re, lane_numbers(0, 16), im), _mm512_permutex2var_ps(re, lane_numbers(8, 24), im)};
}
/// The same numbers in the opposite order.
template <class Arch>
PELAGIC_INLINE Pair<Arch> reversed(const Pair<Arch>& numbers) {
    const __m512i order = _mm512_set_epi64(0, 1, 2, 3, 4, 5, 6, 7);
    const auto turned = [&](__m512 v) { return _mm512_castpd_ps(_mm512_permutexvar_pd(order, _mm512_castps_pd(v))); };
    return {turned(numbers.second), turned(numbers.first)};
}
/// Real parts and imaginary parts of W numbers.
template <class Arch>
PELAGIC_INLINE Pair<Arch> deinterleaved(xsimd::batch<float, Arch> low, xsimd::batch<float, Arch> high) {
    const __m512i evens = _mm512_set_epi32(30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 2, 0);
    const __m512i odds = _mm512_add_epi32(evens, _mm512_set1_epi32(1));
    return {_mm512_permutex2var_ps(low, evens, high), _mm512_permutex2var_ps(low, odds, high)};
}
#elif defined(__AVX2__)
template <class Arch>
PELAGIC_INLINE Pair<Arch> interleaved(xsimd::batch<float, Arch> re, xsimd::batch<float, Arch> im) {
    const __m256 low = _mm256_unpacklo_ps(re, im), high = _mm256_unpackhi_ps(re, im);
    return {_mm256_permute2f128_ps(low, high, 0x20), _mm256_permute2f128_ps(low, high, 0x31)};
}
template <class Arch>
PELAGIC_INLINE Pair<Arch> reversed(const Pair<Arch>& numbers) {
    const auto turned = [](__m256 v) {
        return _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(v), _MM_SHUFFLE(0, 1, 2, 3)));
    };
    return {turned(numbers.second), turned(numbers.first)};
}
template <class Arch>
PELAGIC_INLINE Pair<Arch> deinterleaved(xsimd::batch<float, Arch> low, xsimd::batch<float, Arch> high) {
    const auto ordered = [](__m256 v) {
        return _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(v), _MM_SHUFFLE(3, 1, 2, 0)));
    };
    return {ordered(_mm256_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0))),
            ordered(_mm256_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1)))};
}
#elif defined(__x86_64__)
template <class Arch>
PELAGIC_INLINE Pair<Arch> interleaved(xsimd::batch<float, Arch> re, xsimd::batch<float, Arch> im) {
    return {_mm_unpacklo_ps(re, im), _mm_unpackhi_ps(re, im)};
}
template <class Arch>
PELAGIC_INLINE Pair<Arch> reversed(const Pair<Arch>& numbers) {
    const auto turned = [](__m128 v) { return _mm_shuffle_ps(v, v, _MM_SHUFFLE(1, 0, 3, 2)); };
    return {turned(numbers.second), turned(numbers.first)};
}
template <class Arch>
PELAGIC_INLINE Pair<Arch> deinterleaved(xsimd::batch<float, Arch> low, xsimd::batch<float, Arch> high) {
    return {_mm_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)), _mm_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1))};
}
#else
template <class Arch>
PELAGIC_INLINE Pair<Arch> interleaved(xsimd::batch<float, Arch> re, xsimd::batch<float, Arch> im) {
    const float32x4x2_t both = vzipq_f32(re, im);
    return {both.val[0], both.val[1]};
}
template <class Arch>
PELAGIC_INLINE Pair<Arch> reversed(const Pair<Arch>& numbers) {
    const auto turned = [](float32x4_t v) { return vextq_f32(v, v, 2); };
    return {turned(numbers.second), turned(numbers.first)};
}
template <class Arch>
PELAGIC_INLINE Pair<Arch> deinterleaved(xsimd::batch<float, Arch> low, xsimd::batch<float, Arch> high) {
    const float32x4x2_t parts = vuzpq_f32(low, high);
    return {parts.val[0], parts.val[1]};
}
#endif

}  // namespace pelagic::peers
