// Float to IEEE 754 half, round to nearest even, in integer operations that every instruction set has.
//
// The hardware conversions (F16C, NEON) give the same bits for every number; SSE4.2 has none. Magnitudes above 65504
// plus half a step become infinity. NaN does not occur in a sea.
#pragma once

#include <cstdint>
#include <xsimd/xsimd.hpp>

namespace pelagic::kernels {

/// The half's 16 bits in the low half of each lane, the high half zero.
template <class Arch>
inline xsimd::batch<std::int32_t, Arch> half_bits(xsimd::batch<float, Arch> value) {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;

    const I bits = xsimd::bitwise_cast<I>(value);
    const I magnitude = bits & I(0x7FFFFFFF);
    const I sign = (bits >> 16) & I(0x8000);

    // Normal: move the exponent's bias from 127 to 15, add half a step less the parity of the kept mantissa, cut.
    // Carries run into the exponent as they should; above the largest half they reach infinity's pattern or beyond.
    const I parity = (magnitude >> 13) & I(1);
    const I rounded = (magnitude + I(((15 - 127) << 23) + 0xFFF) + parity) >> 13;
    const I normal = xsimd::min(rounded, I(0x7C00));

    // Below 2^-14: adding 1/2 leaves the half's mantissa, rounded by the hardware, in the lowest bits of the sum.
    const I subnormal = xsimd::bitwise_cast<I>(xsimd::bitwise_cast<V>(magnitude) + V(0.5f)) - I(0x3F000000);

    return xsimd::select(magnitude < I(113 << 23), subnormal, normal) | sign;
}

}  // namespace pelagic::kernels
