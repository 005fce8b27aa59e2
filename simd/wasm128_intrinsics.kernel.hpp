// SSE4.2 intrinsics for WebAssembly. WebAssembly kernels include this header first
// (cmake/isa.cmake).
//
// Emscripten 3.1.6 compiles most intrinsics to one instruction. This header replaces those that
// Emscripten emulates lane by lane. Results are identical: conversions of floats within the range
// of int32; minima and maxima, where `pmin(b, a)` is a < b ? a : b as in SSE, zeros and NaN
// included.
#pragma once

#include <nmmintrin.h>
#include <wasm_simd128.h>

#include "pelagic/simd/always_inline.hpp"

namespace pelagic::kernels {

/// Converts to integers, truncating. \pre v is within (-2^31, 2^31)
PELAGIC_INLINE __m128i wasm_truncated(__m128 v) { return static_cast<__m128i>(wasm_i32x4_trunc_sat_f32x4(v)); }

/// Converts to integers, rounding to nearest even. \pre v is within (-2^31, 2^31)
PELAGIC_INLINE __m128i wasm_rounded(__m128 v) { return wasm_truncated(static_cast<__m128>(wasm_f32x4_nearest(v))); }

PELAGIC_INLINE __m128 wasm_min(__m128 a, __m128 b) { return static_cast<__m128>(wasm_f32x4_pmin(b, a)); }
PELAGIC_INLINE __m128 wasm_max(__m128 a, __m128 b) { return static_cast<__m128>(wasm_f32x4_pmax(b, a)); }

}  // namespace pelagic::kernels

#define _mm_cvttps_epi32(v) ::pelagic::kernels::wasm_truncated(v)
#define _mm_cvtps_epi32(v) ::pelagic::kernels::wasm_rounded(v)
#define _mm_min_ps(a, b) ::pelagic::kernels::wasm_min(a, b)
#define _mm_max_ps(a, b) ::pelagic::kernels::wasm_max(a, b)
