#include "pelagic/simd/det_math.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math_batch.hpp"

namespace pelagic::det {
namespace {

// ln 2 = ln2_high + ln2_low. ln2_high has 33 bits, so that its product with an exponent is exact.
constexpr double ln2_high = 6.93147180369123816490e-01;
constexpr double ln2_low = 1.90821492927058770002e-10;
constexpr double log2_e = 1.44269504088896338700;

// tanh is a series below the first value, and 1 above the second.
constexpr double max_tanh_series = 0.05, min_tanh_1 = 20;

constexpr int exponent_bias = 1023;
constexpr int mantissa_bits = 52;

double two_to_the(int exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + exponent_bias) << mantissa_bits);
}

}  // namespace

// x = 2^e m with m in [sqrt(1/2), sqrt(2)); log m = 2 artanh(s), s = (m - 1)/(m + 1), |s| < 0.172,
// as a series in s^2: eleven terms have an error of 2e-18.
double log(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    int exponent = static_cast<int>(bits >> mantissa_bits) - exponent_bias;
    double m = std::bit_cast<double>((bits & 0x000FFFFFFFFFFFFFu) | 0x3FF0000000000000u);
    if (m > 1.4142135623730951) {
        m *= 0.5;
        ++exponent;
    }
    const double s = (m - 1) / (m + 1);
    const double z = s * s;
    double series = 1.0 / 23;
    for (int odd = 21; odd >= 3; odd -= 2) series = series * z + 1.0 / odd;
    const double tail = 2 * s * (z * series) + exponent * ln2_low;
    return exponent * ln2_high + (2 * s + tail);
}

// x = k ln 2 + r with |r| <= ln 2 / 2; e^r as a Taylor series: fourteen terms have an error of
// 4e-18.
double exp(double x) {
    if (x > 709.78) return std::numeric_limits<double>::infinity();
    if (!(x > -708)) return 0;
    const double k = std::floor(x * log2_e + 0.5);
    const double r = (x - k * ln2_high) - k * ln2_low;
    double series = 1;
    for (int term = 14; term >= 2; --term) series = 1 + series * r / term;
    const double e_r = 1 + r * series;
    // 2^1024 is not a double, so the scale is applied in two factors.
    const int half = static_cast<int>(k) / 2;
    return e_r * two_to_the(half) * two_to_the(static_cast<int>(k) - half);
}

// e^0 is 1 exactly.
double pow(double x, double y) { return y == 0 ? 1 : exp(y * log(x)); }

// tanh x = (1 - e)/(1 + e), e = exp(-2x). The odd Taylor series replaces it for small x, where it
// cancels.
double tanh(double x) {
    if (x < max_tanh_series) {
        const double z = x * x;
        return x *
               (1 + z * (-1.0 / 3 + z * (2.0 / 15 + z * (-17.0 / 315 + z * (62.0 / 2835 + z * (-1382.0 / 155925))))));
    }
    if (x > min_tanh_1) return 1;  // exact: e is less than half a unit in the last place
    const double e = exp(-2 * x);
    return (1 - e) / (1 + e);
}

// The steps of exp() and tanh() in the same order, without branches, so that the compiler uses
// vectors. -2 x is at least -40, so that e^r 2^k is a normal number.
void tanh(std::array<double, batch_size>& values) {
    constexpr double to_integer = 0x1.8p52;                 // the sum is rounded to an integer
    constexpr double to_exponent = 0x1p52 + exponent_bias;  // the sum ends in the exponent's bits
    std::array<double, batch_size> results, k, r, series;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const double x = -2 * std::min(std::max(values[i], max_tanh_series), min_tanh_1);
        const double at = x * log2_e + 0.5, nearest = (at + to_integer) - to_integer;
        k[i] = nearest > at ? nearest - 1 : nearest;
        r[i] = (x - k[i] * ln2_high) - k[i] * ln2_low;
        series[i] = 1;
    }
    const auto add = [&](double term) {
        for (std::size_t i = 0; i < batch_size; ++i) series[i] = 1 + series[i] * r[i] / term;
    };
    add(14), add(13), add(12), add(11), add(10), add(9), add(8), add(7), add(6), add(5), add(4), add(3), add(2);
    for (std::size_t i = 0; i < batch_size; ++i) {
        const auto bits = std::bit_cast<std::uint64_t>(k[i] + to_exponent) << mantissa_bits;
        const double e = (1 + r[i] * series[i]) * std::bit_cast<double>(bits);
        results[i] = (1 - e) / (1 + e);
    }
    for (std::size_t i = 0; i < batch_size; ++i)
        values[i] = values[i] < max_tanh_series || values[i] > min_tanh_1 ? tanh(values[i]) : results[i];
}

// Subtracts the nearest quarter turn exactly. The remainder is at most pi/4: Taylor series up to
// its 17th power.
SineCosine sine_cosine_of_turns(double turns) {
    const double quarters = std::floor(4 * turns + 0.5);
    const double angle = (turns - quarters * 0.25) * two_pi;
    const double z = angle * angle;
    double sine = 1, cosine = 1;
    for (int term = 16; term >= 2; term -= 2) {
        sine = 1 - sine * z / (term * (term + 1));
        cosine = 1 - cosine * z / (term * (term - 1));
    }
    sine *= angle;
    switch (static_cast<int>(quarters - 4 * std::floor(quarters / 4))) {
        case 0: return {sine, cosine};
        case 1: return {cosine, -sine};
        case 2: return {-sine, -cosine};
        default: return {-cosine, sine};
    }
}

}  // namespace pelagic::det
