// Gather loads, one index per lane, which xsimd 8.1 lacks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/lanes.kernel.hpp"

namespace pelagic::kernels {

/// Loads plane[places[0]] ... plane[places[3]] into one register.
#if defined(__SSE4_2__)
PELAGIC_INLINE __m128 four_loaded(const float* plane, const std::uint32_t* places) {
    const __m128 a = _mm_insert_ps(_mm_load_ss(plane + places[0]), _mm_load_ss(plane + places[1]), 0x10);
    const __m128 b = _mm_insert_ps(_mm_load_ss(plane + places[2]), _mm_load_ss(plane + places[3]), 0x10);
    return _mm_movelh_ps(a, b);
}
#else
PELAGIC_INLINE float32x4_t four_loaded(const float* plane, const std::uint32_t* places) {
    float32x4_t lanes = vdupq_n_f32(plane[places[0]]);
    lanes = vld1q_lane_f32(plane + places[1], lanes, 1);
    lanes = vld1q_lane_f32(plane + places[2], lanes, 2);
    return vld1q_lane_f32(plane + places[3], lanes, 3);
}
#endif

/// W indices into planes of floats. The indices are stored in memory, so that each load is one
/// short instruction for every plane. AVX2's gather instruction is not used: it is microcode on Zen
/// 3, and single loads give 20 % more queries per second.
template <class Arch>
class Gather {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    PELAGIC_INLINE explicit Gather(I places) { places.store_aligned(reinterpret_cast<std::int32_t*>(places_)); }

    /// Loads plane[index of lane l] into lane l.
    PELAGIC_INLINE V from(const float* plane) const {
#if defined(__AVX512F__)
        if constexpr (HasLanes<Arch, 16>)
            return _mm512_i32gather_ps(_mm512_load_si512(places_), plane, sizeof(float));
#endif
#if defined(__AVX2__)
        if constexpr (HasLanes<Arch, 8>)
            return _mm256_insertf128_ps(_mm256_castps128_ps256(four_loaded(plane, places_)),
                                        four_loaded(plane, places_ + 4), 1);
#endif
        if constexpr (HasLanes<Arch, 4>) return four_loaded(plane, places_);
    }

   private:
    alignas(64) std::uint32_t places_[V::size];  // unsigned, so that no index needs sign extension
};

}  // namespace pelagic::kernels
