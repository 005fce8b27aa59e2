#include "pelagic/analytic/wave_phase.hpp"

#include <cmath>

#include "pelagic/simd/strict_floats.hpp"

namespace pelagic {
namespace {

__extension__ using Product = unsigned __int128;

/// |value| = mantissa x 2^exponent
struct FloatSplit {
    std::uint64_t mantissa;
    int exponent;
};

FloatSplit float_split(double value) {
    int exponent = 0;
    const double mantissa = std::frexp(std::fabs(value), &exponent);
    return {static_cast<std::uint64_t>(mantissa * 0x1p53), exponent - 53};
}

}  // namespace

std::uint64_t turned(double frequency_hz, double time_s) {
    const FloatSplit f = float_split(frequency_hz), t = float_split(time_s);
    const Product product = Product{f.mantissa} * t.mantissa;
    const int shift = f.exponent + t.exponent + 64;
    std::uint64_t turns = 0;
    if (shift >= 0)
        turns = shift < 64 ? static_cast<std::uint64_t>(product) << shift : 0;
    else if (shift > -128)
        turns = static_cast<std::uint64_t>(product >> -shift);
    return std::signbit(frequency_hz) != std::signbit(time_s) ? 0 - turns : turns;
}

double turns_at_origin(double phase_turns, double frequency_hz, double time_s) {
    const std::uint64_t now = turned(1, phase_turns) - turned(frequency_hz, time_s);
    return static_cast<double>(static_cast<std::int64_t>(now)) * 0x1p-64;
}

}  // namespace pelagic
