// 128-bit vectors of WebAssembly without its SIMD instructions, to measure what these gain
// (web/bench/). Kernels of that build include this header first (web/CMakeLists.txt).
//
// Emscripten's intrinsics are vectors of clang, which the compiler divides into scalars where the
// target has no SIMD, and builtins that need SIMD. This header replaces the builtins, and empties
// the attribute by which intrinsics demand the instructions. Results are identical.
#pragma once

#include "pelagic/simd/always_inline.hpp"

#define __target__(features)

namespace pelagic::kernels::scalar {

using F4 = float __attribute__((vector_size(16)));
using I4 = int __attribute__((vector_size(16)));
using I8 = short __attribute__((vector_size(16)));
using B16 = signed char __attribute__((vector_size(16)));
using U16 = unsigned char __attribute__((vector_size(16)));

/// Returns a vector of `of(lane)`.
template <class Vector, class Of>
PELAGIC_INLINE Vector each(Of of) {
    Vector result{};
#pragma clang loop unroll(full)
    for (int i = 0; i < static_cast<int>(sizeof(Vector) / sizeof(result[0])); ++i)
        result[i] = static_cast<__typeof__(result[0] + 0)>(of(i));
    return result;
}

PELAGIC_INLINE int clamped(int value, int min, int max) { return value < min ? min : value > max ? max : value; }

PELAGIC_INLINE F4 square_root(F4 v) {
    return each<F4>([&](int i) { return __builtin_sqrtf(v[i]); });
}
PELAGIC_INLINE F4 nearest(F4 v) {
    return each<F4>([&](int i) { return __builtin_rintf(v[i]); });
}
/// \pre v is within (-2^31, 2^31)
PELAGIC_INLINE I4 truncated(F4 v) { return __builtin_convertvector(v, I4); }
PELAGIC_INLINE F4 pmin(F4 a, F4 b) {
    return each<F4>([&](int i) { return b[i] < a[i] ? b[i] : a[i]; });
}
PELAGIC_INLINE F4 pmax(F4 a, F4 b) {
    return each<F4>([&](int i) { return a[i] < b[i] ? b[i] : a[i]; });
}
template <class Vector>
PELAGIC_INLINE Vector least(Vector a, Vector b) {
    return each<Vector>([&](int i) { return b[i] < a[i] ? b[i] : a[i]; });
}
template <class Vector>
PELAGIC_INLINE Vector greatest(Vector a, Vector b) {
    return each<Vector>([&](int i) { return a[i] < b[i] ? b[i] : a[i]; });
}
template <class Narrow, class Wide>
PELAGIC_INLINE Narrow narrowed(Wide a, Wide b, int min, int max) {
    constexpr int half = sizeof(Wide) / sizeof(a[0]);
    return each<Narrow>([&](int i) { return clamped(i < half ? a[i] : b[i - half], min, max); });
}
PELAGIC_INLINE I4 dot(I8 a, I8 b) {
    return each<I4>([&](int i) { return a[2 * i] * b[2 * i] + a[2 * i + 1] * b[2 * i + 1]; });
}
PELAGIC_INLINE B16 swizzled(B16 a, B16 from) {
    return each<B16>([&](int i) {
        const int lane = static_cast<unsigned char>(from[i]);
        return lane < 16 ? a[lane] : 0;
    });
}
template <class Vector>
PELAGIC_INLINE int sign_bits(Vector v) {
    int bits = 0;
#pragma clang loop unroll(full)
    for (int i = 0; i < static_cast<int>(sizeof(Vector) / sizeof(v[0])); ++i) bits |= (v[i] < 0 ? 1 : 0) << i;
    return bits;
}
/// Shuffles bytes. Whole words are moved as words: divided into bytes they take ten times as long.
template <int... from>
PELAGIC_INLINE B16 shuffled(B16 a, B16 b) {
    constexpr int byte[] = {from...};
    constexpr auto is_word = [](int i) {
        return byte[i] % 4 == 0 && byte[i + 1] == byte[i] + 1 && byte[i + 2] == byte[i] + 2 &&
               byte[i + 3] == byte[i] + 3;
    };
    if constexpr (is_word(0) && is_word(4) && is_word(8) && is_word(12))
        return (B16)__builtin_shufflevector((I4)a, (I4)b, byte[0] / 4, byte[4] / 4, byte[8] / 4, byte[12] / 4);
    else
        return __builtin_shufflevector(a, b, from...);
}
PELAGIC_INLINE I4 selected(I4 a, I4 b, I4 mask) { return (a & mask) | (b & ~mask); }

}  // namespace pelagic::kernels::scalar

#define __builtin_wasm_shuffle_i8x16(a, b, ...) \
    pelagic::kernels::scalar::shuffled<__VA_ARGS__>((pelagic::kernels::scalar::B16)(a), \
                                                    (pelagic::kernels::scalar::B16)(b))
#define __builtin_wasm_sqrt_f32x4 pelagic::kernels::scalar::square_root
#define __builtin_wasm_nearest_f32x4 pelagic::kernels::scalar::nearest
#define __builtin_wasm_trunc_saturate_s_i32x4_f32x4 pelagic::kernels::scalar::truncated
#define __builtin_wasm_pmin_f32x4 pelagic::kernels::scalar::pmin
#define __builtin_wasm_pmax_f32x4 pelagic::kernels::scalar::pmax
#define __builtin_wasm_min_s_i32x4 pelagic::kernels::scalar::least
#define __builtin_wasm_max_s_i32x4 pelagic::kernels::scalar::greatest
#define __builtin_wasm_min_s_i16x8 pelagic::kernels::scalar::least
#define __builtin_wasm_max_u_i8x16 pelagic::kernels::scalar::greatest
#define __builtin_wasm_narrow_s_i8x16_i16x8(a, b) \
    pelagic::kernels::scalar::narrowed<pelagic::kernels::scalar::B16>(a, b, -128, 127)
#define __builtin_wasm_narrow_u_i8x16_i16x8(a, b) \
    pelagic::kernels::scalar::narrowed<pelagic::kernels::scalar::U16>(a, b, 0, 255)
#define __builtin_wasm_narrow_s_i16x8_i32x4(a, b) \
    pelagic::kernels::scalar::narrowed<pelagic::kernels::scalar::I8>(a, b, -32768, 32767)
#define __builtin_wasm_dot_s_i32x4_i16x8 pelagic::kernels::scalar::dot
#define __builtin_wasm_swizzle_i8x16 pelagic::kernels::scalar::swizzled
#define __builtin_wasm_bitmask_i8x16 pelagic::kernels::scalar::sign_bits
#define __builtin_wasm_bitmask_i32x4 pelagic::kernels::scalar::sign_bits
#define __builtin_wasm_bitselect pelagic::kernels::scalar::selected

#include "pelagic/simd/wasm128_intrinsics.kernel.hpp"
