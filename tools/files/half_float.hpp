// Floats as IEEE 754 binary16.
#pragma once

#include <bit>
#include <cstdint>

namespace pelagic::tools {

/// The nearest half, of two equally near ones the even one; infinity from 65520 on. \pre not NaN
constexpr std::uint16_t half_of(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = bits >> 16 & 0x8000, magnitude = bits & 0x7FFFFFFF;
    constexpr std::uint32_t infinity = 0x7C00, first_infinite = 0x477FF000,
                            first_normal = 0x38800000;  // 65520, 2^-14
    if (magnitude >= first_infinite) return static_cast<std::uint16_t>(sign | infinity);
    // Below the least normal half, halves are multiples of 2^-24. The float whose last place that is, 1/2, rounds for us.
    if (magnitude < first_normal)
        return static_cast<std::uint16_t>(
            sign | (std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + 0.5f) - 0x3F000000));
    // 13 bits of the mantissa go, and the exponent counts from -15 instead of -127.
    const std::uint32_t is_odd = magnitude >> 13 & 1;
    return static_cast<std::uint16_t>(sign | (((magnitude + 0xFFF + is_odd) >> 13) - (112 << 10)));
}

}  // namespace pelagic::tools
