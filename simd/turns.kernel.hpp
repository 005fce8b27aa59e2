// Sine and cosine of an integer phase: 2^32 is a full turn, so integer overflow is the range
// reduction.
//
// The nearest quarter turn selects the quadrant. The remainder r is within 1/8 turn and is the
// argument of two polynomials in r^2, fitted at Chebyshev nodes. The error of both, rounding
// included, is at most 2^-23 (tests/evolve_test.cpp).
#pragma once

#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/same_bits.kernel.hpp"

namespace pelagic::kernels {

template <class Arch>
struct Rotation {
    xsimd::batch<float, Arch> sine, cosine;
};

template <class Arch>
PELAGIC_INLINE Rotation<Arch> rotation_of_turns(xsimd::batch<std::uint32_t, Arch> phase) {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;

    // The two highest bits of the phase plus 1/8 turn are the quadrant. The remainder is the lower
    // 30 bits as a signed number: two doublings drop the upper two bits and multiply it by 4.
    // Doublings are sums, because a shift of xsimd 8.1 is a call on NEON.
    const I turns = same_bits<I>(phase), doubled = turns + turns;
    const I quadrant = turns + I(0x20000000), odd_quadrant = quadrant + quadrant;  // in the sign
    const V r = xsimd::to_float(doubled + doubled) * V(0x1p-34f);
    const V z = r * r;
    const V sine = r * (V(6.2831855f) + z * (V(-41.341663f) + z * (V(81.592545f) + z * V(-75.40161f))));
    const V cosine = V(1.f) + z * (V(-19.739208f) + z * (V(64.93937f) + z * (V(-85.44882f) + z * V(59.424107f))));

    // Quadrants 1 and 3 exchange sine and cosine. The sine is negative in 2 and 3, the cosine in 1
    // and 2.
    const auto exchanged = xsimd::bool_cast(odd_quadrant < I(0));
    const I sign(static_cast<std::int32_t>(0x80000000));
    const V sine_sign = same_bits<V>(quadrant & sign);
    const V cosine_sign = same_bits<V>((quadrant ^ odd_quadrant) & sign);
    return {xsimd::select(exchanged, cosine, sine) ^ sine_sign, xsimd::select(exchanged, sine, cosine) ^ cosine_sign};
}

}  // namespace pelagic::kernels
