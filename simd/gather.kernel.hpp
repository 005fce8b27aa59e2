// Gather loads, one index per lane, which xsimd 8.1 lacks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/lanes.kernel.hpp"

namespace pelagic::kernels {

/// Four indices, in registers that the loads of several planes share.
struct FourPlaces {
    std::size_t a, b, c, d;
    PELAGIC_INLINE explicit FourPlaces(const std::uint32_t* places)
        : a(places[0]), b(places[1]), c(places[2]), d(places[3]) {}
};

/// Loads plane[at.a] ... plane[at.d] into one register.
#if defined(__SSE4_2__)
PELAGIC_INLINE __m128 four_loaded(const float* plane, const FourPlaces& at) {
    const __m128 ab = _mm_insert_ps(_mm_load_ss(plane + at.a), _mm_load_ss(plane + at.b), 0x10);
    const __m128 cd = _mm_insert_ps(_mm_load_ss(plane + at.c), _mm_load_ss(plane + at.d), 0x10);
    return _mm_movelh_ps(ab, cd);
}
#else
PELAGIC_INLINE float32x4_t four_loaded(const float* plane, const FourPlaces& at) {
    float32x4_t lanes = vdupq_n_f32(plane[at.a]);
    lanes = vld1q_lane_f32(plane + at.b, lanes, 1);
    lanes = vld1q_lane_f32(plane + at.c, lanes, 2);
    return vld1q_lane_f32(plane + at.d, lanes, 3);
}
#endif

/// Keeps indices in memory. g++ otherwise extracts each from the register that was stored, which
/// takes two micro-operations.
template <class Places>
PELAGIC_INLINE void keep_in_memory(Places& places) {
    asm("" : "+m"(places));
}

/// W indices into planes of floats. The indices are stored in memory, so that each load is one
/// short instruction for every plane. AVX2's gather instruction is not used: it is microcode on Zen
/// 3, and single loads give 20 % more queries per second.
template <class Arch>
class Gather {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;

   public:
    PELAGIC_INLINE explicit Gather(I places) {
        places.store_aligned(reinterpret_cast<std::int32_t*>(places_));
        keep_in_memory(places_);
    }

    /// Loads plane[index of lane l] into lane l, for each plane.
    template <std::size_t Planes>
    PELAGIC_INLINE void from(const float* const (&planes)[Planes], V (&values)[Planes]) const {
#if defined(__AVX512F__)
        if constexpr (HasLanes<Arch, 16>)
            for (std::size_t p = 0; p < Planes; ++p)
                values[p] = _mm512_i32gather_ps(_mm512_load_si512(places_), planes[p], sizeof(float));
#endif
#if defined(__AVX2__)
        if constexpr (HasLanes<Arch, 8>) {
            const FourPlaces low(places_);
            __m128 lows[Planes];
            for (std::size_t p = 0; p < Planes; ++p) lows[p] = four_loaded(planes[p], low);
            const FourPlaces high(places_ + 4);
            for (std::size_t p = 0; p < Planes; ++p)
                values[p] = _mm256_insertf128_ps(_mm256_castps128_ps256(lows[p]), four_loaded(planes[p], high), 1);
        }
#endif
        if constexpr (HasLanes<Arch, 4>) {
            const FourPlaces four(places_);
            for (std::size_t p = 0; p < Planes; ++p) values[p] = four_loaded(planes[p], four);
        }
    }

    PELAGIC_INLINE V from(const float* plane) const {
        V values[1];
        from({plane}, values);
        return values[0];
    }

   private:
    alignas(64) std::uint32_t places_[V::size];  // unsigned, so that no index needs sign extension
};

}  // namespace pelagic::kernels
