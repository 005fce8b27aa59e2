// The exponential of negative numbers.
//
// With y = -x log2 e as an integer in units of 2^-23, e^-x is 2^floor(y), whose exponent is the
// integer's upper bits, times 2^f of the fraction f: a polynomial with the value 1 at 0, fitted at
// Chebyshev nodes. The relative error is at most 2e-7 + 1e-7 x (tests/exact_water_test.cpp).
#pragma once

#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/same_bits.kernel.hpp"

namespace pelagic::kernels {

/// Returns e^-x; for x above 60 e^-60, so that products are not denormal. \pre x >= 0
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> falling_exponential(xsimd::batch<float, Arch> x) {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;
    const I one(0x3F800000), exponent(static_cast<std::int32_t>(0xFF800000)), fraction(0x007FFFFF);

    const I y = xsimd::to_int(xsimd::min(x, V(60.f)) * V(-12102203.16f));  // -2^23 log2 e
    const V f = same_bits<V>((y & fraction) | one) - V(1.f);
    const V power =
        V(1.f) +
        f * (V(0.693147182f) +
             f * (V(0.240227208f) +
                  f * (V(0.0554960221f) + f * (V(0.0096521955f) + f * (V(0.00126921665f) + f * V(0.000208179146f))))));
    return power * same_bits<V>((y & exponent) + one);
}

}  // namespace pelagic::kernels
