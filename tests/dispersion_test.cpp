// Dispersion relation, and frequencies rounded to the loop.
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/simd/constants.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace pelagic {
namespace {

TEST(Dispersion, DeepWaterFollowsEquation15) {
    for (const double k : {0.01, 0.1, 1.0, 30.0})
        EXPECT_NEAR(angular_frequency(k, 4000), std::sqrt(gravity_mps2 * k), 1e-14 * std::sqrt(gravity_mps2 * k));
}

TEST(Dispersion, ShallowWaterSpeedIsTheSquareRootOfGravityTimesDepth) {
    constexpr double depth = 2, k = 1e-4;
    const double speed = std::sqrt(gravity_mps2 * depth);
    // The relative error of the limit: tanh(kd)/(kd) = 1 - (kd)^2/3, here 1.3e-8.
    EXPECT_NEAR(angular_frequency(k, depth) / k, speed, 1e-7 * speed);
    EXPECT_NEAR(group_velocity(k, depth), speed, 1e-7 * speed);
}

/// Without surface tension the water is its depth.
TEST(Dispersion, GroupVelocityIsTheDerivativeOfFrequency) {
    const auto expect_derivative = [](double k, const auto& water) {
        const double step = 1e-5 * k;
        const double slope = (angular_frequency(k + step, water) - angular_frequency(k - step, water)) / (2 * step);
        EXPECT_NEAR(group_velocity(k, water), slope, 1e-8 * slope) << k;
    };
    for (const double depth : {0.02, 1.0, 10.0, 4000.0}) {
        SCOPED_TRACE(std::to_string(depth) + " m");
        if (depth >= 1)
            for (const double k : {0.01, 0.3, 5.0}) expect_derivative(k, depth);
        for (const double k : {0.3, 30.0, 300.0, 3000.0})
            expect_derivative(k, Water{depth, sea_surface_tension_m3ps2});
    }
}

// Lamb 1932, article 267: in fresh water the slowest waves are 1.73 cm long and have a phase speed
// of 23.2 cm/s. Sea water is 2.5 % denser.
TEST(Dispersion, SlowestRipplesMatchLamb) {
    const Water water{4000, sea_surface_tension_m3ps2};
    double slowest = 1e9, at = 0;
    for (double k = 10; k < 5000; k *= 1.001)
        if (const double speed = angular_frequency(k, water) / k; speed < slowest) slowest = speed, at = k;
    EXPECT_NEAR(slowest, 0.232, 0.002);
    EXPECT_NEAR(two_pi / at, 0.0173, 0.0003);
    // At the slowest wave phase and group velocity are equal; at higher k the group is faster.
    EXPECT_NEAR(group_velocity(at, water), slowest, 1e-3 * slowest);
    EXPECT_NEAR(group_velocity(1e5, water) / (angular_frequency(1e5, water) / 1e5), 1.5, 1e-3);
}

TEST(Dispersion, WaveNumberInvertsTheDispersionRelation) {
    for (const double depth : {0.01, 0.5, 10.0, 4000.0})
        for (double k = 1e-5; k < 1e5; k *= 3.7)
            EXPECT_NEAR(wave_number(angular_frequency(k, depth), depth) / k, 1, 1e-12) << k << " at " << depth;
}

// Errata, equation 16: rounding is within half a harmonic; truncation is up to a whole harmonic too
// low.
TEST(Loop, HarmonicsAreRoundedToTheNearestInteger) {
    for (double omega = 0.05; omega < 20; omega *= 1.013) {
        const double harmonic = loop_harmonic(omega, 200);
        EXPECT_LE(std::fabs(harmonic - omega * 200 / two_pi), 0.5 + 1e-12);
    }
}

TEST(Loop, HarmonicsAreAtLeastOne) { EXPECT_EQ(loop_harmonic(0.01, 2), 1u); }

TEST(Loop, FractionsOfThePeriodAreExact) {
    for (std::uint32_t fraction = 0; fraction < 64; ++fraction)
        EXPECT_EQ(loop_fraction(fraction * 200.0 / 64, 200).turns, fraction << 26);
}

TEST(Loop, WholePeriodsGiveFractionZeroAtAnyTime) {
    for (const double period : {200.0, 8.0, 12.8, 0.1, 7.3, 86400.0}) {
        for (const double periods : {1.0, 2.0, 1000.0, -1.0, 4294967296.0})
            EXPECT_EQ(loop_fraction(periods * period, period).turns, 0u) << periods << " periods of " << period;
        EXPECT_EQ(loop_fraction(-1e-300, period).turns, 0u);
    }
    EXPECT_EQ(loop_fraction(36000 + 50, 200).turns, std::uint32_t{1} << 30);
    EXPECT_EQ(loop_fraction(-50, 200).turns, std::uint32_t{3} << 30);
}

}  // namespace
}  // namespace pelagic
