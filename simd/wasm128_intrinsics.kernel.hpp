// SSE4.2's intrinsics in WebAssembly, included before all else in its kernels (cmake/isa.cmake).
//
// Emscripten 3.1.6 has most of them as one instruction. Those that it puts together lane by lane are replaced here, with the same
// results for every number: conversions of floats within the range of int32, and minima and maxima, where `pmin(b, a)` is
// a < b ? a : b as SSE has it, zeros and NaN included.
#pragma once

#include <nmmintrin.h>
#include <wasm_simd128.h>

#include "pelagic/simd/always_inline.hpp"

namespace pelagic::kernels {

/// \pre within (-2^31, 2^31)
PELAGIC_INLINE __m128i wasm_truncated(__m128 v) { return static_cast<__m128i>(wasm_i32x4_trunc_sat_f32x4(v)); }

/// To nearest even.
/// \pre within (-2^31, 2^31)
PELAGIC_INLINE __m128i wasm_rounded(__m128 v) { return wasm_truncated(static_cast<__m128>(wasm_f32x4_nearest(v))); }

PELAGIC_INLINE __m128 wasm_min(__m128 a, __m128 b) { return static_cast<__m128>(wasm_f32x4_pmin(b, a)); }
PELAGIC_INLINE __m128 wasm_max(__m128 a, __m128 b) { return static_cast<__m128>(wasm_f32x4_pmax(b, a)); }

}  // namespace pelagic::kernels

#define _mm_cvttps_epi32(v) ::pelagic::kernels::wasm_truncated(v)
#define _mm_cvtps_epi32(v) ::pelagic::kernels::wasm_rounded(v)
#define _mm_min_ps(a, b) ::pelagic::kernels::wasm_min(a, b)
#define _mm_max_ps(a, b) ::pelagic::kernels::wasm_max(a, b)
