// Conversion between floats and IEEE 754 binary16 (half).
#pragma once

#include <bit>
#include <cstdint>

namespace pelagic::tools {

/// Smallest float that would round to infinity; smaller ones round to a finite half.
inline constexpr float first_beyond_halves = 65520;

/// Rounds to the nearest half, ties to even. Clamps values beyond the range to +-65504, the largest
/// half.
/// \pre not NaN
constexpr std::uint16_t half_of(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = bits >> 16 & 0x8000, magnitude = bits & 0x7FFFFFFF;
    constexpr std::uint32_t largest = 0x7BFF, first_normal = 0x38800000;  // 65504, 2^-14
    if (magnitude >= std::bit_cast<std::uint32_t>(first_beyond_halves))
        return static_cast<std::uint16_t>(sign | largest);
    // Below the smallest normal half, halves are multiples of 2^-24. Adding 1/2, a float whose last
    // place is 2^-24, rounds to them.
    if (magnitude < first_normal)
        return static_cast<std::uint16_t>(
            sign | (std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + 0.5f) - 0x3F000000));
    // Drop 13 bits of the mantissa; change the exponent bias from 127 to 15.
    const std::uint32_t is_odd = magnitude >> 13 & 1;
    return static_cast<std::uint16_t>(sign | (((magnitude + 0xFFF + is_odd) >> 13) - (112 << 10)));
}

/// Converts a half to a float, exactly.
constexpr float float_of_half(std::uint16_t half) {
    const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000) << 16;
    const std::uint32_t exponent = half >> 10 & 0x1F, mantissa = half & 0x3FF;
    if (exponent == 0)  // zero and subnormals: multiples of 2^-24
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(static_cast<float>(mantissa) * 0x1p-24f) | sign);
    // infinity and NaN are preserved
    const std::uint32_t exponent_of_float = exponent == 0x1F ? 0xFF : exponent + 112;
    return std::bit_cast<float>(sign | exponent_of_float << 23 | mantissa << 13);
}

}  // namespace pelagic::tools
