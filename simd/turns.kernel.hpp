// Sine and cosine of an integer phase: 2^32 is a full turn, so wrapping is the range reduction.
//
// The nearest quarter turn goes into the quadrant, the rest r is within 1/8 turn and feeds two polynomials in r^2,
// fitted at Chebyshev nodes; with all rounding both are within 2^-23 of the truth (tests/evolve_test.cpp).
#pragma once

#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/simd/always_inline.hpp"

namespace pelagic::kernels {

template <class Arch>
struct Rotation {
    xsimd::batch<float, Arch> sine, cosine;
};

template <class Arch>
PELAGIC_INLINE Rotation<Arch> rotation_of_turns(xsimd::batch<std::uint32_t, Arch> phase) {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;

    const I rounded = xsimd::bitwise_cast<I>(phase) + I(0x20000000);
    const I quadrant = rounded >> 30;  // its two low bits; the sign comes along and is masked away below
    const I rest = (rounded & I(0x3FFFFFFF)) - I(0x20000000);

    const V r = xsimd::to_float(rest) * V(0x1p-32f);
    const V z = r * r;
    const V sine = r * (V(6.2831855f) + z * (V(-41.341663f) + z * (V(81.592545f) + z * V(-75.40161f))));
    const V cosine = V(1.f) + z * (V(-19.739208f) + z * (V(64.93937f) + z * (V(-85.44882f) + z * V(59.424107f))));

    // Quadrants 1 and 3 exchange the two; the sine is negative in 2 and 3, the cosine in 1 and 2.
    const V odd = xsimd::bitwise_cast<V>(I(0) - (quadrant & I(1)));
    const V sine_sign = xsimd::bitwise_cast<V>((quadrant & I(2)) << 30);
    const V cosine_sign = xsimd::bitwise_cast<V>(((quadrant + I(1)) & I(2)) << 30);
    const V exchange = (sine ^ cosine) & odd;
    return {(sine ^ exchange) ^ sine_sign, (cosine ^ exchange) ^ cosine_sign};
}

}  // namespace pelagic::kernels
