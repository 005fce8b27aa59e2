// Floats as IEEE 754 binary16, one at a time.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace pelagic {

/// Rounds to the nearest half, ties to even, and returns its bits. Values beyond the range, and
/// NaN, become the largest half, 65504. All choices are masks, so that compilers vectorise loops
/// over it.
constexpr std::uint32_t half_of(float value) {
    constexpr auto largest = std::bit_cast<std::uint32_t>(65504.f),
                   normal_from = std::bit_cast<std::uint32_t>(0x1p-14f);
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t size = std::min(bits & 0x7fffffff, largest);
    const std::uint32_t normal = (size - (112u << 23) + 0xfff + (size >> 13 & 1)) >> 13;
    // The last bit of the float 0.5 is worth 2^-24, like that of a subnormal half. Adding 0.5
    // therefore rounds to a subnormal half.
    const std::uint32_t tiny =
        std::bit_cast<std::uint32_t>(std::bit_cast<float>(size) + 0.5f) - std::bit_cast<std::uint32_t>(0.5f);
    const std::uint32_t is_tiny = 0u - static_cast<std::uint32_t>(size < normal_from);
    return (bits >> 16 & 0x8000) | (tiny & is_tiny) | (normal & ~is_tiny);
}

/// Converts the bits of a half to a float, exactly.
constexpr float float_of_half(std::uint16_t half) {
    const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000) << 16;
    const std::uint32_t exponent = half >> 10 & 0x1F, mantissa = half & 0x3FF;
    if (exponent == 0)  // zero and subnormals: multiples of 2^-24
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(static_cast<float>(mantissa) * 0x1p-24f) | sign);
    // infinity and NaN are preserved
    const std::uint32_t exponent_of_float = exponent == 0x1F ? 0xFF : exponent + 112;
    return std::bit_cast<float>(sign | exponent_of_float << 23 | mantissa << 13);
}

}  // namespace pelagic
