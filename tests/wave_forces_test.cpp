// Forces of a sea as a sum over its waves, compared with closed forms and with a panel method.
#include "pelagic/floating/wave_forces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

#include "pelagic/simd/direction.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/potential_flow.hpp"

namespace pelagic {
namespace {

/// Forces that are known at all frequencies and headings: heave 3 + i at 1 rad/s and 5 - i at 2 rad/s; surge cos,
/// sway sin of the heading, times 10.
ForceTable smooth_table(int headings = 24) {
    ForceTable table{.omega_radps = {1, 2}, .heading_rad = {}, .forces = {}};
    for (int j = 0; j < headings; ++j) table.heading_rad.push_back(two_pi * j / headings);
    for (const std::complex<double> heave : {std::complex<double>(3, 1), std::complex<double>(5, -1)})
        for (const double heading : table.heading_rad)
            table.forces.push_back({10 * std::cos(heading), heave, 10 * std::sin(heading), 0, 0, 0});
    return table;
}

TEST(WaveForces, DirectionsAreThoseOfTheArcTangent) {
    for (int i = -400; i < 400; ++i) {
        const double angle = std::numbers::pi * (i + 0.5) / 400;
        EXPECT_NEAR(angle_of(7 * std::cos(angle), 7 * std::sin(angle)), angle, 2e-15) << angle;
    }
    EXPECT_EQ(angle_of(0, 0), 0);
    EXPECT_DOUBLE_EQ(angle_of(-1, 0), std::numbers::pi);
    EXPECT_DOUBLE_EQ(angle_of(0, -2), -std::numbers::pi / 2);
}

TEST(WaveForces, AWaveHasTheTablesForceAndItsPhase) {
    // At 1.5 rad/s heave is 4. The wave is 2 cos(kx x + kz z - omega t + phase).
    const double k = 1.5 * 1.5 / gravity_mps2;
    for (const double direction : {0.0, 0.4, 2.0, 4.0}) {
        const WaveComponent wave{2, k * std::cos(direction), k * std::sin(direction), 1.5, 0.7};
        const WaveForces forces(smooth_table(), {&wave, 1});
        for (const double heading : {0.0, 1.0, 6.5}) {
            const double x = 12, z = -5, t = 3.2;
            const double elevation = 2 * std::cos(wave.kx_radpm * x + wave.kz_radpm * z - 1.5 * t + 0.7);
            const Vector6 force = forces.force(x, z, heading, t);
            EXPECT_NEAR(force[1], 4 * elevation, 1e-5);
            EXPECT_NEAR(force[0], 10 * std::cos(direction - heading) * elevation, 0.06) << "linear in 5 degrees";
            EXPECT_NEAR(force[2], 10 * std::sin(direction - heading) * elevation, 0.06);
        }
    }
}

TEST(WaveForces, CoarseHeadingsAreInterpolatedByCubics) {
    const double k = 0.1;
    for (const double direction : {0.2, 0.39, 3.3}) {
        const WaveComponent wave{1, k * std::cos(direction), k * std::sin(direction), 1, 0};
        // 8 headings: a straight line would be wrong by 8 %.
        const WaveForces forces(smooth_table(8), {&wave, 1});
        EXPECT_NEAR(forces.force(0, 0, 0, 0)[0], 10 * std::cos(direction), 0.2);
        const WaveForces two(smooth_table(2), {&wave, 1}), one(smooth_table(1), {&wave, 1});
        EXPECT_NEAR(two.force(0, 0, 0, 0)[1], 3, 1e-5);
        EXPECT_NEAR(one.force(0, 0, 0, 0)[1], 3, 1e-5);
    }
}

TEST(WaveForces, WavesThatCarryTheShareAreKept) {
    std::vector<WaveComponent> waves;
    for (int i = 0; i < 100; ++i) waves.push_back({i < 10 ? 1.0 : 0.01, 0.1, 0, 1.2, 0.1 * i});
    const WaveForces forces(smooth_table(), waves);
    EXPECT_EQ(forces.wave_count(), 10);
    EXPECT_NEAR(forces.kept_share(), 10 / 10.009, 1e-9);
    EXPECT_EQ(WaveForces(smooth_table(), waves, 1).wave_count(), 100);
    // Waves beyond the table have no force, and the share says so.
    waves[0].omega_radps = 2.5;
    EXPECT_NEAR(WaveForces(smooth_table(), waves).kept_share(), 9 / 10.009, 1e-9);
    EXPECT_EQ(WaveForces(smooth_table(), {}).force(0, 0, 0, 0), Vector6{});
}

TEST(WaveForces, ForcesOfARandomSeaHaveTheVarianceOfTheTable) {
    // The mean square of a sum of waves is half of the sum of |a X|^2.
    const ForceTable table = read_wamit_3(text_of_source("tests/potential_flow/hemisphere.3"), {});
    std::mt19937 random(11);
    std::uniform_real_distribution<double> phase(0, two_pi);
    std::vector<WaveComponent> waves;
    double sum = 0;
    for (std::size_t i = 0; i < 20; ++i) {
        const double omega = table.omega_radps[i], k = omega * omega / gravity_mps2;
        waves.push_back({0.1, k, 0, omega, phase(random)});
        sum += std::norm(0.1 * table.forces[4 * i][1]) / 2;
    }
    const WaveForces forces(table, waves, 1);
    double square = 0;
    // all frequencies are multiples of 0.3 rad/s: one period is exact
    constexpr int steps = 400;
    for (int i = 0; i < steps; ++i) {
        const double heave = forces.force(3, 4, 0.5, two_pi / 0.3 * i / steps)[1];
        square += heave * heave / steps;
    }
    EXPECT_NEAR(square, sum, 0.01 * sum);
}

TEST(WaveForces, BadTablesAndWavesAreRejected) {
    ForceTable table = smooth_table();
    const WaveComponent wave{1, 0.1, 0, 1, 0};
    table.omega_radps[1] = 1;
    EXPECT_EQ(message_of([&] { WaveForces(table, {&wave, 1}); }),
              "omega_radps[1] is 1, expected increasing frequencies in (0, 1e4] rad/s");
    table = smooth_table();
    table.forces.pop_back();
    EXPECT_NE(WaveForces::check(table), "");
    table = smooth_table();
    table.forces[0][0] = std::nan("");
    EXPECT_NE(WaveForces::check(table), "");
    table = smooth_table();
    table.heading_rad[3] = 7;
    EXPECT_NE(WaveForces::check(table), "");
    const WaveComponent bad{-1, 0.1, 0, 1, 0};
    EXPECT_EQ(message_of([&] { WaveForces(smooth_table(), {&bad, 1}); }), "amplitude_m -1 is out of range [0, 1000] m");
    EXPECT_NE(message_of([&] { WaveForces(smooth_table(), {&wave, 1}, 2); }), "");
}

}  // namespace
}  // namespace pelagic
