// The library's elementary functions, compared with libm in long double.
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/det_math_batch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace pelagic {
namespace {

constexpr int samples_per_range = 200000;

double relative_error(double value, long double truth) {
    return static_cast<double>(std::fabs((static_cast<long double>(value) - truth) / truth));
}

// The bounds are those of the header: a few rounding errors of 1.1e-16 each.
TEST(DetMath, LogIsWithinFewUlps) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> exponent(-300, 300), near_one(-1e-3, 1e-3);
    for (int i = 0; i < samples_per_range; ++i) {
        const double far = std::exp(exponent(random));
        EXPECT_LT(relative_error(det::log(far), std::log(static_cast<long double>(far))), 4e-16) << far;
        const double near = 1 + near_one(random);
        if (near != 1) {
            EXPECT_LT(relative_error(det::log(near), std::log(static_cast<long double>(near))), 4e-16) << near;
        }
    }
    EXPECT_EQ(det::log(1.0), 0.0);
}

TEST(DetMath, ExpIsWithinFewUlps) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> any(-707, 709);
    for (int i = 0; i < samples_per_range; ++i) {
        const double x = any(random);
        EXPECT_LT(relative_error(det::exp(x), std::exp(static_cast<long double>(x))), 4e-16) << x;
    }
    EXPECT_EQ(det::exp(0.0), 1.0);
    EXPECT_EQ(det::exp(-1e300), 0.0);
    EXPECT_EQ(det::exp(-std::numeric_limits<double>::infinity()), 0.0);
    EXPECT_EQ(det::exp(1000), std::numeric_limits<double>::infinity());
}

TEST(DetMath, PowErrorGrowsOnlyWithTheResultsLogarithm) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> base(1e-6, 1e6), power(-8, 8);
    for (int i = 0; i < samples_per_range; ++i) {
        const double x = base(random), y = power(random);
        const double bound = 4e-16 * (1 + std::fabs(y * std::log(x)));
        EXPECT_LT(relative_error(det::pow(x, y), std::pow(static_cast<long double>(x), static_cast<long double>(y))),
                  bound)
            << x << "^" << y;
    }
}

TEST(DetMath, TanhIsWithinFewUlpsFromShallowToDeep) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> exponent(-12, 4);
    for (int i = 0; i < samples_per_range; ++i) {
        const double x = std::exp(exponent(random));
        EXPECT_LT(relative_error(det::tanh(x), std::tanh(static_cast<long double>(x))), 1e-14) << x;
    }
    EXPECT_EQ(det::tanh(0.0), 0.0);
    EXPECT_EQ(det::tanh(25.0), 1.0);
}

// Values of one batch on both sides of the bounds of the series, which are 0.05 and 20.
TEST(DetMath, TanhOfABatchHasTheBitsOfSingleValues) {
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> exponent(-12, 4);
    for (std::size_t i = 0; i < samples_per_range; ++i) {
        std::array<double, det::batch_size> values;
        for (double& x : values) x = std::exp(exponent(random));
        values[i % det::batch_size] = std::array{0.0, 0.05, 20.0, 25.0}[i % 4];
        std::array<double, det::batch_size> batch = values;
        det::tanh(batch);
        for (std::size_t lane = 0; lane < values.size(); ++lane)
            EXPECT_EQ(std::bit_cast<std::uint64_t>(batch[lane]), std::bit_cast<std::uint64_t>(det::tanh(values[lane])))
                << values[lane];
    }
}

TEST(DetMath, SineAndCosineOfTurnsAreWithinFewUlpsOfOne) {
    constexpr long double two_pi = 6.283185307179586476925286766559L;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(-3, 3);
    for (int i = 0; i < samples_per_range; ++i) {
        const double turns = any(random);
        const auto got = det::sine_cosine_of_turns(turns);
        EXPECT_NEAR(got.sine, static_cast<double>(std::sin(two_pi * turns)), 4e-16) << turns;
        EXPECT_NEAR(got.cosine, static_cast<double>(std::cos(two_pi * turns)), 4e-16) << turns;
    }
}

TEST(DetMath, QuarterTurnsAreExact) {
    const double expected_sine[] = {0, 1, 0, -1};
    for (int quarter = -8; quarter <= 8; ++quarter) {
        const auto got = det::sine_cosine_of_turns(quarter / 4.0);
        EXPECT_EQ(got.sine, expected_sine[quarter & 3]);
        EXPECT_EQ(got.cosine, expected_sine[(quarter + 1) & 3]);
    }
    // whole turns beyond the integers
    for (const double turns : {0x1p62, -0x1p62, 0x1p70, -0x1p1000}) {
        EXPECT_EQ(det::sine_cosine_of_turns(turns).sine, 0) << turns;
        EXPECT_EQ(det::sine_cosine_of_turns(turns).cosine, 1) << turns;
    }
}

}  // namespace
}  // namespace pelagic
