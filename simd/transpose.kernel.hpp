// A 4 x 4 transpose of floats, which xsimd 8.1 lacks: the same shuffles on every instruction set of a processor family.
#pragma once

#include <cstddef>

#if defined(__x86_64__)
#include <xmmintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

namespace pelagic::kernels {

/// to[r * to_stride + c] = from[c * from_stride + r] for r, c in [0, 4). All eight rows are aligned to 16 bytes.
/// `Arch` only keeps the copies of different instruction sets apart for the linker.
template <class Arch>
inline void transpose_4x4(const float* from, std::size_t from_stride, float* to, std::size_t to_stride) {
#if defined(__x86_64__)
    __m128 a = _mm_load_ps(from);
    __m128 b = _mm_load_ps(from + from_stride);
    __m128 c = _mm_load_ps(from + 2 * from_stride);
    __m128 d = _mm_load_ps(from + 3 * from_stride);
    _MM_TRANSPOSE4_PS(a, b, c, d);
    _mm_store_ps(to, a);
    _mm_store_ps(to + to_stride, b);
    _mm_store_ps(to + 2 * to_stride, c);
    _mm_store_ps(to + 3 * to_stride, d);
#elif defined(__aarch64__)
    const float32x4x2_t ab = vtrnq_f32(vld1q_f32(from), vld1q_f32(from + from_stride));
    const float32x4x2_t cd = vtrnq_f32(vld1q_f32(from + 2 * from_stride), vld1q_f32(from + 3 * from_stride));
    vst1q_f32(to, vcombine_f32(vget_low_f32(ab.val[0]), vget_low_f32(cd.val[0])));
    vst1q_f32(to + to_stride, vcombine_f32(vget_low_f32(ab.val[1]), vget_low_f32(cd.val[1])));
    vst1q_f32(to + 2 * to_stride, vcombine_f32(vget_high_f32(ab.val[0]), vget_high_f32(cd.val[0])));
    vst1q_f32(to + 3 * to_stride, vcombine_f32(vget_high_f32(ab.val[1]), vget_high_f32(cd.val[1])));
#endif
}

}  // namespace pelagic::kernels
