// Conversion of floats to IEEE 754 halves, round to nearest even. F16C, AVX-512 and NEON convert in
// hardware, with identical results. SSE4.2 and WebAssembly have no such instruction and use integer
// operations. Magnitudes above 65504 plus half a step become infinity. Inputs are never NaN.
#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/lanes.kernel.hpp"

namespace pelagic::kernels {

#if defined(__AVX512F__)

/// Stores four interleaved halves per lane: a, b, c, d of lane 0, then of lane 1, ...
/// \param out  aligned to 64 bytes; receives 4 W halves
template <HasLanes<16> Arch>
PELAGIC_INLINE void store_halves(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b,
                                 xsimd::batch<float, Arch> c, xsimd::batch<float, Arch> d, std::uint16_t* out) {
    // Packs a and b, and c and d, into one 32-bit word per lane, then interleaves the words.
    const auto words = [](__m512 low, __m512 high) {
        const __m512i low_bits = _mm512_cvtepu16_epi32(_mm512_cvtps_ph(low, _MM_FROUND_TO_NEAREST_INT));
        const __m512i high_bits = _mm512_cvtepu16_epi32(_mm512_cvtps_ph(high, _MM_FROUND_TO_NEAREST_INT));
        return _mm512_or_si512(low_bits, _mm512_slli_epi32(high_bits, 16));
    };
    const __m512i ab = words(a, b), cd = words(c, d);
    const __m512i first = _mm512_set_epi32(23, 7, 22, 6, 21, 5, 20, 4, 19, 3, 18, 2, 17, 1, 16, 0);
    const __m512i second = _mm512_set_epi32(31, 15, 30, 14, 29, 13, 28, 12, 27, 11, 26, 10, 25, 9, 24, 8);
    _mm512_store_si512(out, _mm512_permutex2var_epi32(ab, first, cd));
    _mm512_store_si512(out + 32, _mm512_permutex2var_epi32(ab, second, cd));
}

#endif
#if defined(__AVX2__) && defined(__F16C__)

template <HasLanes<8> Arch>
PELAGIC_INLINE void store_halves(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b,
                                 xsimd::batch<float, Arch> c, xsimd::batch<float, Arch> d, std::uint16_t* out) {
    const auto halves = [](__m256 v) { return _mm256_cvtps_ph(v, _MM_FROUND_TO_NEAREST_INT); };
    const __m128i a_halves = halves(a), b_halves = halves(b), c_halves = halves(c), d_halves = halves(d);
    const __m128i ab[2] = {_mm_unpacklo_epi16(a_halves, b_halves), _mm_unpackhi_epi16(a_halves, b_halves)};
    const __m128i cd[2] = {_mm_unpacklo_epi16(c_halves, d_halves), _mm_unpackhi_epi16(c_halves, d_halves)};
    __m128i* to = reinterpret_cast<__m128i*>(out);
    for (int i = 0; i < 2; ++i) {
        _mm_store_si128(to + 2 * i, _mm_unpacklo_epi32(ab[i], cd[i]));
        _mm_store_si128(to + 2 * i + 1, _mm_unpackhi_epi32(ab[i], cd[i]));
    }
}

#endif
#if defined(__SSE4_2__)

/// Returns the magnitude of a float as the bits of a half. The result exceeds infinity's bits if
/// the float is too large for a half.
///
/// Adds 2^13 times the float's power of two, which is raised to 2^-14 for smaller floats. The sum
/// holds the hidden bit and ten mantissa bits, rounded by the hardware, below the exponent. A
/// half's bits are the mantissa with its hidden bit plus 2^10 times the exponent from 2^-14 up. The
/// result therefore is the sum's low 16 bits plus 2^3 times its high 16 bits less a constant.
template <HasLanes<4> Arch>
PELAGIC_INLINE __m128i half_magnitude(__m128i bits) {
    const __m128i magnitude = _mm_and_si128(bits, _mm_set1_epi32(0x7FFFFFFF));
    const __m128i exponent =
        _mm_max_epi32(_mm_and_si128(bits, _mm_set1_epi32(0x7F800000)), _mm_set1_epi32(113 << 23));
    const __m128i power = _mm_add_epi32(exponent, _mm_set1_epi32(13 << 23));
    const __m128i sum = _mm_castps_si128(_mm_add_ps(_mm_castsi128_ps(magnitude), _mm_castsi128_ps(power)));
    return _mm_sub_epi32(_mm_madd_epi16(sum, _mm_set1_epi32((8 << 16) | 1)), _mm_set1_epi32((113 + 13) << 10));
}

/// Returns the halves of a, then of b. The saturating packs clamp large magnitudes and keep the
/// sign bit.
template <HasLanes<4> Arch>
PELAGIC_INLINE __m128i halves_of(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b) {
    const __m128i a_bits = _mm_castps_si128(a), b_bits = _mm_castps_si128(b);
    const __m128i magnitude = _mm_packs_epi32(half_magnitude<Arch>(a_bits), half_magnitude<Arch>(b_bits));
    const __m128i sign = _mm_and_si128(_mm_packs_epi32(a_bits, b_bits), _mm_set1_epi16(-0x8000));
    return _mm_or_si128(_mm_min_epi16(magnitude, _mm_set1_epi16(0x7C00)), sign);
}

template <HasLanes<4> Arch>
PELAGIC_INLINE void store_halves(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b,
                                 xsimd::batch<float, Arch> c, xsimd::batch<float, Arch> d, std::uint16_t* out) {
    const __m128i ac = halves_of<Arch>(a, c), bd = halves_of<Arch>(b, d);
    const __m128i ab = _mm_unpacklo_epi16(ac, bd), cd = _mm_unpackhi_epi16(ac, bd);
    __m128i* to = reinterpret_cast<__m128i*>(out);
    _mm_store_si128(to, _mm_unpacklo_epi32(ab, cd));
    _mm_store_si128(to + 1, _mm_unpackhi_epi32(ab, cd));
}

#else

template <class Arch>
PELAGIC_INLINE void store_halves(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b,
                                 xsimd::batch<float, Arch> c, xsimd::batch<float, Arch> d, std::uint16_t* out) {
    const auto halves = [](float32x4_t v) { return vreinterpret_u16_f16(vcvt_f16_f32(v)); };
    // A named variable, because clang's vst4_u16 is a macro and would split the initializer at its
    // commas.
    const uint16x4x4_t texels = {{halves(a), halves(b), halves(c), halves(d)}};
    vst4_u16(out, texels);
}

#endif

}  // namespace pelagic::kernels
