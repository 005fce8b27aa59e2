// Division and square root, correctly rounded (IEEE 754) on every instruction set.
//
// xsimd 8.1 is exact on x86 but refines estimates for floats on 64-bit Arm, which has exact
// instructions too. Kernels use only these two functions, so that results are bit-identical.
#pragma once

#include <xsimd/xsimd.hpp>

#include "pelagic/simd/strict_floats.hpp"

namespace pelagic::kernels {

template <class Arch>
inline xsimd::batch<float, Arch> divided(xsimd::batch<float, Arch> a, xsimd::batch<float, Arch> b) {
#if defined(__aarch64__)
    return xsimd::batch<float, Arch>(vdivq_f32(a, b));
#else
    return a / b;
#endif
}

template <class Arch>
inline xsimd::batch<float, Arch> square_root(xsimd::batch<float, Arch> a) {
#if defined(__aarch64__)
    return xsimd::batch<float, Arch>(vsqrtq_f32(a));
#else
    return xsimd::sqrt(a);
#endif
}

}  // namespace pelagic::kernels
