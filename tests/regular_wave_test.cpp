// A regular wave: against Airy's and Stokes' theory.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/oracle/sea_oracle.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;

SeaState regular_sea(double height_m, double period_s) {
    return {.waves = WaveModel::regular, .regular_height_m = height_m, .regular_period_s = period_s};
}

Ocean queried(const SeaState& sea) {
    return Ocean(sea, {.executor = make_serial_executor(), .queries = true, .velocities = Velocities::drawn});
}

double height_at(Ocean& ocean, double time_s, double x_m, double z_m) {
    const std::vector<double> x = {x_m}, z = {z_m};
    std::vector<float> height(1);
    SurfaceQuery(ocean.frame_at(time_s), {.interpolation = Interpolation::cubic})
        .sample({x, z}, {.height_m = height});
    return static_cast<double>(height[0]);
}

// Cubic interpolation of 64 texels in a wave is within 1e-5 of the amplitude.
TEST(RegularSea, IsAirysWithoutChoppiness) {
    for (const double depth_m : {4000.0, 6.0}) {
        for (const double direction_rad : {0.0, pi / 6, -2.1}) {
            SeaState sea = regular_sea(0.5, 8);
            sea.depth_m = depth_m;
            sea.wind_direction_rad = direction_rad;
            sea.choppiness = 0;
            ASSERT_EQ(check(sea), "");
            Ocean ocean = queried(sea);
            const double omega = 2 * pi / 8, k = oracle::wave_number_at(omega, depth_m);
            for (int i = 0; i < 40; ++i) {
                const double t = 1.37 * i, x = 311.5 * std::sin(1.0 + i), z = 987.25 * std::cos(3.0 * i);
                const double along_m = x * std::cos(direction_rad) + z * std::sin(direction_rad);
                EXPECT_NEAR(height_at(ocean, t, x, z), 0.25 * std::cos(k * along_m - omega * t), 0.25e-4)
                    << depth_m << ' ' << direction_rad << ' ' << t;
            }
        }
    }
}

// With choppiness 1 in deep water particles move in circles of the wave's amplitude (Gerstner 1802).
TEST(RegularSea, MovesParticlesInCircles) {
    SeaState sea = regular_sea(3, 7);
    sea.loop_period_s = 196;
    sea.choppiness = 1;
    sea.wind_direction_rad = 0.7;
    Ocean ocean = queried(sea);
    for (int i = 0; i < 9; ++i) {
        const Cascade& cascade = ocean.frame_at(0.9 * i).cascades[0];
        const double dx = cascade.dx.at(3, 5), dz = cascade.dz.at(3, 5);
        const double h = static_cast<double>(cascade.height.at(3, 5)) - static_cast<double>(cascade.level_m);
        EXPECT_NEAR(std::sqrt(dx * dx + dz * dz + h * h), 1.5, 1e-5);
        EXPECT_NEAR(dz * std::cos(0.7) - dx * std::sin(0.7), 0, 1e-5);
    }
}

/// Height of the crest and of the trough above the mean level.
struct SecondOrder {
    double depth_m, height_m, crest_m, trough_m;
};
// raschii 2.0.0 (pypi.org/project/raschii): get_wave_model('Stokes') with N=2, g=9.80665, the length
// of a linear wave of 8 s in this depth, and surface_elevation at 0 and at half the length. k d is
// 1.05, 1.5, 2.5 and 5; k a is 0.05, 0.15 and 0.3.
constexpr SecondOrder second_order[] = {
    {13.050568, 1.242911, 0.660288, -0.582623}, {13.050568, 3.728734, 2.213862, -1.514872},
    {13.050568, 7.457467, 5.126714, -2.330754}, {21.584992, 1.438999, 0.745947, -0.693053},
    {21.584992, 4.316998, 2.396523, -1.920475}, {21.584992, 8.633997, 5.269095, -3.364901},
    {39.212843, 1.568514, 0.804944, -0.763570}, {39.212843, 4.705541, 2.538951, -2.166590},
    {39.212843, 9.411082, 5.450265, -3.960818}, {79.482494, 1.589650, 0.814703, -0.774947},
    {79.482494, 4.768950, 2.563375, -2.205574}, {79.482494, 9.537899, 5.484552, -4.053347},
};

TEST(RegularSea, OfOrder2HasStokesCrestsAndTroughs) {
    for (const SecondOrder& expected : second_order) {
        for (const double choppiness : {0.0, 0.8, 1.0}) {
            SeaState sea = regular_sea(expected.height_m, 8);
            sea.order = 2;
            sea.depth_m = expected.depth_m;
            sea.choppiness = choppiness;
            sea.wind_direction_rad = 0.5;
            ASSERT_EQ(check(sea), "");
            Ocean ocean = queried(sea);
            const std::string which = std::to_string(expected.depth_m) + " m, " + std::to_string(expected.height_m) +
                                      " m, choppiness " + std::to_string(choppiness);
            EXPECT_NEAR(height_at(ocean, 8, 0, 0) / expected.crest_m, 1, 0.01) << which;
            EXPECT_NEAR(height_at(ocean, 4, 0, 0) / expected.trough_m, 1, 0.01) << which;
        }
    }
}

// The bound harmonic travels with the wave: the shape at a place one period later is the same.
TEST(RegularSea, OfOrder2KeepsItsShape) {
    SeaState sea = regular_sea(6, 8);
    sea.order = 2;
    sea.depth_m = 15;
    Ocean ocean = queried(sea);
    const double speed_mps = 2 * pi / 8 / oracle::wave_number_at(2 * pi / 8, 15);
    for (int i = 0; i < 16; ++i)
        EXPECT_NEAR(height_at(ocean, 0.7 * i, speed_mps * 0.7 * i + 5, 12), height_at(ocean, 0, 5, 12), 2e-3) << i;
}

TEST(RegularSea, HasWholeWavelengthsAndPeriods) {
    for (const double patch_size_m : {0.0, 350.0}) {
        SeaState sea = regular_sea(1, 8);
        sea.patch_size_m = patch_size_m;
        sea.wind_direction_rad = 1.1;
        const std::vector<CascadePlan> plan = plan_cascades(sea);
        ASSERT_EQ(plan.size(), 1u);
        const double waves = plan[0].grid.side_m * oracle::wave_number_at(2 * pi / 8, sea.depth_m) / (2 * pi);
        EXPECT_NEAR(waves, 4, 1e-9);
        EXPECT_NEAR(plan[0].grid.cosine, std::cos(1.1), 1e-12);
        EXPECT_NEAR(plan[0].grid.sine, std::sin(1.1), 1e-12);
        Ocean ocean = queried(sea);
        EXPECT_EQ(hash_of(ocean.frame_at(3.25)), hash_of(Ocean(sea).frame_at(3.25 + sea.loop_period_s)));
    }
    SeaState sea = regular_sea(1, 8);
    sea.patch_size_m = 550;  // of 100 m waves
    EXPECT_NEAR(plan_cascades(sea)[0].grid.side_m * oracle::wave_number_at(2 * pi / 8, 4000) / (2 * pi), 6, 1e-9);
}

TEST(RegularSea, IsBitIdenticalOnEachInstructionSet) {
    SeaState sea = regular_sea(3, 8);
    sea.order = 2;
    sea.depth_m = 20;
    sea.wind_direction_rad = 0.4;
    std::set<std::uint64_t> hashes;
    std::set<double> heights;
    for (const Isa isa : isas_here()) {
        Ocean ocean(sea, {.executor = make_serial_executor(), .isa = isa, .queries = true,
                          .velocities = Velocities::drawn});
        heights.insert(height_at(ocean, 3.25, 17, -40));
        hashes.insert(hash_of(ocean.frame_at(3.25)));
    }
    EXPECT_EQ(hashes.size(), 1u);
    EXPECT_EQ(heights.size(), 1u);
}

TEST(RegularSea, HasTheStatisticsOfASine) {
    const SeaReport report = report_on(regular_sea(2, 8));
    EXPECT_NEAR(report.expected.significant_wave_height_m, 4 * std::sqrt(0.5), 1e-9);
    EXPECT_NEAR(report.expected.peak_period_s, 8, 1e-9);
    EXPECT_NEAR(report.realised_periods.tm02_s, 8, 1e-9);
    EXPECT_NEAR(report.expected_directions.spread_rad, 0, 1e-6);
    EXPECT_TRUE(report.warnings.empty());
}

TEST(RegularSea, BadOptionsAreNamed) {
    const auto message = [](auto change) {
        SeaState sea = regular_sea(2, 8);
        change(sea);
        return check(sea);
    };
    EXPECT_EQ(message([](SeaState& sea) { sea.regular_period_s = 7; }),
              "loop_period_s is 3600, expected a whole number of regular_period_s, such as 3598");
    EXPECT_EQ(message([](SeaState& sea) { sea.regular_height_m = 20; }),
              "regular_height_m is 20, expected at most 14.18 for a wave of 99.89 m at order 1");
    EXPECT_EQ(message([](SeaState& sea) { sea.order = 2, sea.depth_m = 3, sea.regular_height_m = 1.5; }),
              "regular_height_m is 1.5, expected at most 0.7056 for a wave of 42.02 m at order 2");
    EXPECT_EQ(message([](SeaState& sea) { sea.cascades = 2; }), "cascades is 2, expected 1 where waves is regular");
    EXPECT_EQ(message([](SeaState& sea) { sea.patch_size_m = 1e5; }),
              "patch_size_m is 100000, expected at most 3196.47: 8 texels in each wave");
    EXPECT_EQ(message([](SeaState& sea) { sea.order = 3; }), "order is 3, expected 1 or 2");
    EXPECT_EQ(message([](SeaState& sea) { sea.swell_height_m = 1; }),
              "swell_height_m is 1, expected 0 where waves is regular");
    const Forecast changing{.first = regular_sea(2, 8),
                            .changes = {{.sea = regular_sea(1, 8), .from_s = 10, .over_s = 10}}};
    EXPECT_EQ(check(changing),
              "change 1: waves is regular, expected spectrum or analytic: a regular wave does not change");
    EXPECT_EQ(check(bay(), regular_sea(2, 8)),
              "waves is regular, expected spectrum or analytic where there is a shore");
}

TEST(RegularSea, ReplacesNoSeaOfAnotherModel) {
    Ocean ocean({.resolution = 256, .patch_size_m = 250}, {.executor = make_serial_executor(), .queries = true});
    EXPECT_THROW(ocean.schedule_sea(regular_sea(2, 8)), std::invalid_argument);
    Ocean regular = queried(regular_sea(2, 8));
    SeaState turned = regular_sea(1, 8);
    turned.wind_direction_rad = 2;
    regular.schedule_sea(turned);
    regular.complete_sea();
    EXPECT_NEAR(height_at(regular, 0, 0, 0), 0.5, 0.01);
}

}  // namespace
}  // namespace pelagic
