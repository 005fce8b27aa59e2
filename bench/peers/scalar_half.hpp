// Conversion of float to IEEE 754 half, one number at a time, for peers without SIMD.
#pragma once

#include <bit>
#include <cstdint>

namespace pelagic::peers {

/// Rounds to nearest even; magnitudes of 65520 and more become infinity. \pre value is not NaN
inline std::uint16_t half_of(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = bits >> 16 & 0x8000;
    const std::uint32_t magnitude = bits & 0x7FFFFFFF;
    if (magnitude >= 0x477FF000) return static_cast<std::uint16_t>(sign | 0x7C00);
    if (magnitude < 0x38800000) {
        // A half below 2^-14 has steps of 2^-24, the last bit of a float in [1/2, 1), so this sum
        // rounds it.
        const float shifted = std::bit_cast<float>(magnitude) + 0.5f;
        return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(shifted) - 0x3F000000));
    }
    // The exponent's bias changes from 127 to 15. Half a step less one, plus the parity of the last
    // kept bit, carries over if the value is to be rounded up.
    const std::uint32_t parity = magnitude >> 13 & 1;
    return static_cast<std::uint16_t>(sign | (magnitude - (112u << 23) + 0xFFF + parity) >> 13);
}

}  // namespace pelagic::peers
