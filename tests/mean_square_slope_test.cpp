// How steep the sea is, beside what was measured.
#include "pelagic/sim/spectrum/mean_square_slope.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace pelagic {
namespace {

using std::numbers::pi;

// Cox and Munk 1954: they fitted the sum by itself, 0.003 + 0.00512 U, so the parts' coefficients add up but for rounding.
TEST(MeanSquareSlope, IsThatOfCoxAndMunk) {
    for (const double wind : {1.0, 5.0, 10.0, 14.0}) {
        EXPECT_NEAR(measured_slopes(wind).total(), 0.003 + 0.00512 * wind, 0.041e-3 * wind) << wind;
        EXPECT_NEAR(measured_slopes(wind).upwind, 0.00316 * wind, 1e-15);
        EXPECT_NEAR(measured_slopes(wind).crosswind, 0.003 + 0.00192 * wind, 1e-15);
    }
}

// Of one wave a cos(k.x) the slope's mean square is (a k)^2 / 2, all of it along k.
TEST(MeanSquareSlope, OfOneWaveLiesAlongIt) {
    const double k = 0.7, mean_square = 0.08, direction = 1.1;
    SlopeMoments moments;
    moments.add_wave(mean_square, k * std::cos(direction), k * std::sin(direction));
    EXPECT_NEAR(moments.around(direction).upwind, mean_square * k * k, 1e-15);
    EXPECT_NEAR(moments.around(direction).crosswind, 0, 1e-15);
    EXPECT_NEAR(moments.around(direction + pi / 2).crosswind, mean_square * k * k, 1e-15);
    EXPECT_NEAR(moments.around(direction + pi / 4).upwind, mean_square * k * k / 2, 1e-15);
}

// The sums in the wind's own axes, wave by wave.
TEST(MeanSquareSlope, OfManyWavesTurnsWithTheWind) {
    std::mt19937 random(3);
    const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    for (const double wind : {0.0, 0.4, -2.0, 6.2}) {
        SlopeMoments first, second;
        double up = 0, cross = 0;
        for (int i = 0; i < 50; ++i) {
            const double square = number() + 0.5, x = number(), z = number();
            (i < 20 ? first : second).add_wave(square, x, z);
            up += square * std::pow(x * std::cos(wind) + z * std::sin(wind), 2);
            cross += square * std::pow(z * std::cos(wind) - x * std::sin(wind), 2);
        }
        first += second;
        EXPECT_NEAR(first.around(wind).upwind, up, 1e-12);
        EXPECT_NEAR(first.around(wind).crosswind, cross, 1e-12);
    }
}

TEST(MeanSquareSlope, WhatIsLeftIsNeverNegative) {
    const SlopeVariance all = measured_slopes(10);
    EXPECT_EQ(unresolved_slopes({}, 10).total(), all.total());
    EXPECT_NEAR(unresolved_slopes({0.01, 0.02}, 10).upwind, all.upwind - 0.01, 1e-15);
    EXPECT_NEAR(unresolved_slopes({0.01, 0.02}, 10).crosswind, all.crosswind - 0.02, 1e-15);
    EXPECT_EQ(unresolved_slopes({0.5, 0.01}, 10).upwind, 0);
    EXPECT_EQ(unresolved_slopes({0.01, 0.5}, 10).crosswind, 0);
}

}  // namespace
}  // namespace pelagic
