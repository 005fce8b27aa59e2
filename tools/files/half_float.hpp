// Floats as IEEE 754 binary16.
#pragma once

#include <bit>
#include <cstdint>

namespace pelagic::tools {

/// Below it floats round to a half; from it on they would round to infinity.
inline constexpr float first_beyond_halves = 65520;

/// The nearest half, of two equally near ones the even one; +-65504, the largest, for what is beyond. \pre not NaN
constexpr std::uint16_t half_of(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = bits >> 16 & 0x8000, magnitude = bits & 0x7FFFFFFF;
    constexpr std::uint32_t largest = 0x7BFF, first_normal = 0x38800000;  // 65504, 2^-14
    if (magnitude >= std::bit_cast<std::uint32_t>(first_beyond_halves))
        return static_cast<std::uint16_t>(sign | largest);
    // Below the least normal half, halves are multiples of 2^-24. The float whose last place that is, 1/2, rounds for us.
    if (magnitude < first_normal)
        return static_cast<std::uint16_t>(
            sign | (std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + 0.5f) - 0x3F000000));
    // 13 bits of the mantissa go, and the exponent counts from -15 instead of -127.
    const std::uint32_t is_odd = magnitude >> 13 & 1;
    return static_cast<std::uint16_t>(sign | (((magnitude + 0xFFF + is_odd) >> 13) - (112 << 10)));
}

/// The value of a half, exactly.
constexpr float float_of_half(std::uint16_t half) {
    const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000) << 16;
    const std::uint32_t exponent = half >> 10 & 0x1F, mantissa = half & 0x3FF;
    if (exponent == 0)  // multiples of 2^-24
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(static_cast<float>(mantissa) * 0x1p-24f) | sign);
    const std::uint32_t exponent_of_float = exponent == 0x1F ? 0xFF : exponent + 112;  // infinity and NaN stay so
    return std::bit_cast<float>(sign | exponent_of_float << 23 | mantissa << 13);
}

}  // namespace pelagic::tools
