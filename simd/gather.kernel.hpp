// Loads from scattered places, one a lane, which xsimd 8.1 lacks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "simd/always_inline.hpp"

namespace pelagic::kernels {

/// Lane l of the result is from[index lane l].
#if defined(__AVX512F__)
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> gathered(const float* from, xsimd::batch<std::int32_t, Arch> index) {
    return _mm512_i32gather_ps(index, from, sizeof(float));
}
#elif defined(__AVX2__)
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> gathered(const float* from, xsimd::batch<std::int32_t, Arch> index) {
    return _mm256_i32gather_ps(from, index, sizeof(float));
}
#elif defined(__x86_64__)
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> gathered(const float* from, xsimd::batch<std::int32_t, Arch> index) {
    const __m128i i = index;
    return _mm_setr_ps(from[_mm_extract_epi32(i, 0)], from[_mm_extract_epi32(i, 1)], from[_mm_extract_epi32(i, 2)],
                       from[_mm_extract_epi32(i, 3)]);
}
#else
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> gathered(const float* from, xsimd::batch<std::int32_t, Arch> index) {
    const int32x4_t i = index;
    float32x4_t lanes = vdupq_n_f32(from[vgetq_lane_s32(i, 0)]);
    lanes = vsetq_lane_f32(from[vgetq_lane_s32(i, 1)], lanes, 1);
    lanes = vsetq_lane_f32(from[vgetq_lane_s32(i, 2)], lanes, 2);
    return vsetq_lane_f32(from[vgetq_lane_s32(i, 3)], lanes, 3);
}
#endif

}  // namespace pelagic::kernels
