// Conversion of floats to halves by IEEE 754's rule, to nearest with ties to even. The floats that
// become one half lie between the midpoints to its neighbours, so midpoints in double give the
// expected half.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {

#define PELAGIC_COMPILED_ISA(isa) \
    std::uint16_t wrong_halves_##isa(std::uint32_t first, std::uint32_t last, std::uint16_t expected);
#include "pelagic/generated/compiled_isas.inc"
#undef PELAGIC_COMPILED_ISA

namespace {

constexpr std::uint32_t sign_bit = 0x80000000, infinity_bits = 0x7F800000;
constexpr int infinite_half = 0x7C00;

std::uint16_t wrong_halves(Isa isa, std::uint32_t first, std::uint32_t last, std::uint16_t expected) {
    switch (isa) {
#define PELAGIC_COMPILED_ISA(isa) \
    case Isa::isa:                \
        return wrong_halves_##isa(first, last, expected);
#include "pelagic/generated/compiled_isas.inc"
#undef PELAGIC_COMPILED_ISA
        default: break;
    }
    return 0xFFFF;
}

/// Returns the value of a positive half's bits; those of infinity give the next power of two.
double value_of(int half) {
    const int exponent = half >> 10, mantissa = half & 0x3FF;
    return exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
}

/// Returns the bits of the first float that becomes this half. A midpoint rounds to the even half;
/// it has few bits, so it is a float.
std::uint32_t first_float(int half) {
    if (half == 0) return 0;
    const auto middle = static_cast<float>((value_of(half - 1) + value_of(half)) / 2);
    return std::bit_cast<std::uint32_t>(middle) + half % 2;
}
std::uint32_t last_float(int half) { return half == infinite_half ? infinity_bits : first_float(half + 1) - 1; }

class HalvesOnEachIsa : public testing::TestWithParam<Isa> {};
INSTANTIATE_TEST_SUITE_P(Isas, HalvesOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

// SSE4.2 has no instruction for the conversion, so all magnitudes are tested: two seconds. Other
// sets are tested around the midpoints.
TEST_P(HalvesOnEachIsa, AreTheNearest) {
    constexpr std::uint32_t around = 64;
    for (int half = 0; half <= infinite_half; ++half) {
        const std::uint32_t first = first_float(half), last = last_float(half);
        const auto negative = static_cast<std::uint16_t>(half | 0x8000);
        if (GetParam() == Isa::sse4_2 && !is_sanitized) {
            ASSERT_EQ(wrong_halves(GetParam(), first, last, static_cast<std::uint16_t>(half)), 0u) << half;
        }
        const std::uint32_t begin = std::min(last, first + around),
                            end = std::max(first, last - std::min(last, around));
        ASSERT_EQ(wrong_halves(GetParam(), first, begin, static_cast<std::uint16_t>(half)), 0u) << half;
        ASSERT_EQ(wrong_halves(GetParam(), end, last, static_cast<std::uint16_t>(half)), 0u) << half;
        ASSERT_EQ(wrong_halves(GetParam(), sign_bit | first, sign_bit | begin, negative), 0u) << half;
        ASSERT_EQ(wrong_halves(GetParam(), sign_bit | end, sign_bit | last, negative), 0u) << half;
    }
}

}  // namespace
}  // namespace pelagic
