// Multiplication of a register by one of four floats in memory. SSE4.2 has no broadcast load, but a
// shuffle with a memory operand. NEON multiplies by a lane of another register.
#pragma once

#include <xsimd/xsimd.hpp>

#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/lanes.kernel.hpp"

namespace pelagic::kernels {

/// Returns v times four[lane]. \pre `four` is aligned to 16 bytes
template <int lane, class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> times_lane(xsimd::batch<float, Arch> v, const float* four) {
    using V = xsimd::batch<float, Arch>;
#if defined(__aarch64__)
    return V(vmulq_laneq_f32(v, vld1q_f32(four), lane));
#else
    if constexpr (HasLanes<Arch, 4>) {
        const __m128i all = _mm_load_si128(reinterpret_cast<const __m128i*>(four));
        return v * V(_mm_castsi128_ps(_mm_shuffle_epi32(all, lane * 0x55)));
    } else {
        return v * V(four[lane]);
    }
#endif
}

}  // namespace pelagic::kernels
