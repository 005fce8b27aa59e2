// Foam is independent of the first frame, of loops and of how the sea is changed; its drift.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "pelagic/sim/foam/drift.hpp"
#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/sim/foam_report.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

OceanOptions with_foam(Isa isa = choose_isa()) {
    return {.executor = make_serial_executor(), .isa = isa, .foam = true};
}

/// A gale on a small sea, with a large whitecap cover.
const SeaState gale_of_two_cascades{
    .cascades = 2, .resolution = 32, .wind_speed_mps = 20, .wind_direction_rad = 0.7, .loop_period_s = 20};
const SeaState gale_on_one_cascade{
    .resolution = 32, .patch_size_m = 60, .wind_speed_mps = 20, .wind_direction_rad = 2.5};

// Foam depends on the time only, not on the first frame or on earlier frames.
TEST(FoamTicks, DoesNotDependOnTheFirstFrame) {
    const SeaState sea{.cascades = 1, .resolution = 16, .wind_speed_mps = 20, .loop_period_s = 30};
    Ocean in_order(sea, with_foam());
    const TickClock clock(sea.loop_period_s);
    std::vector<std::uint64_t> expected;
    for (int tick = 0; tick < clock.ticks_per_loop(); ++tick)
        expected.push_back(foam_hash_of(in_order.frame_at(clock.time_in_loop_s(tick))));
    std::mt19937 random(5);
    Ocean ocean(sea, with_foam());
    for (int start = 0; start < (is_sanitized ? 100 : 1000); ++start) {
        int tick = static_cast<int>(random() % expected.size());
        for (int step = 0; step < 3; ++step) {
            const double loops = static_cast<int>(random() % 7) - 3;
            const double time = clock.time_in_loop_s(tick) + loops * sea.loop_period_s;
            ASSERT_EQ(foam_hash_of(ocean.frame_at(time)), expected[static_cast<std::size_t>(tick)]) << time;
            tick = (tick + static_cast<int>(random() % 4)) % clock.ticks_per_loop();
        }
    }
}

TEST(FoamTicks, DoesNotChangeTheRestOfTheFrame) {
    for (const SeaState& sea : {gale_of_two_cascades, gale_on_one_cascade}) {
        Ocean with(sea, with_foam()), without(sea, {.executor = make_serial_executor()});
        for (const double time : {0.0, 0.05, 3.0, -2.0})
            EXPECT_EQ(hash_of(with.frame_at(time)), hash_of(without.frame_at(time)));
        EXPECT_TRUE(without.frame_at(0).cascades[0].snapshots_rgba8[0].empty());
    }
}

/// A sea whose wind increases and then changes direction.
Forecast rising() {
    SeaState calm = gale_of_two_cascades, turned = gale_of_two_cascades;
    calm.wind_speed_mps = 6;
    turned.wind_direction_rad = -0.9;
    return {.first = calm,
            .changes = {{.sea = gale_of_two_cascades, .from_s = 10, .over_s = 8},
                        {.sea = turned, .from_s = 19, .over_s = 4}}};
}

// Frames within a change, at its ends and between two changes, after any earlier time, including
// the end of the loop (20 s).
TEST(FoamTicks, OfAForecastDoesNotDependOnTheOrderOfFrames) {
    Ocean in_order(rising(), with_foam());
    const TickClock clock(gale_of_two_cascades.loop_period_s);
    std::vector<std::uint64_t> expected;
    for (int tick = 0; tick < 150; ++tick) expected.push_back(foam_hash_of(in_order.frame_at(clock.time_s(tick))));
    EXPECT_NE(expected[10], expected[10 + static_cast<std::size_t>(clock.ticks_per_loop())])
        << "a whole loop later the weather is another";
    std::mt19937 random(6);
    Ocean ocean(rising(), with_foam());
    for (int start = 0; start < 60; ++start) {
        std::size_t tick = random() % expected.size();
        for (int step = 0; step < 3 && tick < expected.size(); ++step, tick += random() % 5)
            ASSERT_EQ(foam_hash_of(ocean.frame_at(clock.time_s(static_cast<std::int64_t>(tick)))), expected[tick])
                << tick;
    }
}

// Changes scheduled on a running ocean give frames equal to those of a forecast, foam included.
TEST(FoamTicks, OfALiveChangeEqualsThatOfAForecast) {
    const Forecast forecast = rising();
    const TickClock clock(gale_of_two_cascades.loop_period_s);
    Ocean live(
        Forecast{.first = forecast.first, .largest_peak_m = Ocean(forecast, with_foam()).forecast().largest_peak_m},
        with_foam());
    const auto expect_equal_foam = [&](int from, int to, const Forecast& whole) {
        Ocean expected(whole, with_foam());
        for (int tick = from; tick < to; tick += 3)
            ASSERT_EQ(foam_hash_of(live.frame_at(clock.time_s(tick))),
                      foam_hash_of(expected.frame_at(clock.time_s(tick))))
                << tick;
    };
    Forecast whole = live.forecast();
    const auto tick_at = [&](double time_s) { return static_cast<int>(time_s / clock.tick_s()); };
    expect_equal_foam(0, tick_at(9), whole);
    for (const SeaChange& change : forecast.changes) {
        // A change in the future, and one that has already begun.
        live.schedule_sea(change);
        whole.changes.push_back(change);
        expect_equal_foam(tick_at(change.from_s) - 3, tick_at(change.end_s()) + 5, whole);
    }
}

// After schedule_sea() foam is that of the new sea only.
TEST(FoamTicks, IsReplacedWithTheSea) {
    SeaState other = gale_of_two_cascades;
    other.wind_speed_mps = 9;
    Ocean ocean(gale_of_two_cascades, with_foam()), expected(other, with_foam());
    ocean.frame_at(5);
    ocean.schedule_sea(other);
    ocean.complete_sea();
    EXPECT_EQ(foam_hash_of(ocean.frame_at(5)), foam_hash_of(expected.frame_at(5)));
}

// 2 % of the wind speed plus the waves' Stokes drift: 2 omega k E, integrated numerically over
// directions.
TEST(FoamDrift, MatchesWindAndStokesDriftOverALoop) {
    for (const double direction : {0.0, 2.0, -1.0}) {
        SeaState sea{.wind_speed_mps = 12, .wind_direction_rad = direction};
        Ocean ocean(sea, {.executor = make_serial_executor()});
        const Frame& frame = ocean.frame_at(0);
        const TickClock clock(sea.loop_period_s);
        const double drift_x = frame.statistics.foam_drift_x_mps, drift_z = frame.statistics.foam_drift_z_mps;
        // Along the wind: 2 % of its speed plus Stokes drift, which is 1 to 2 % of the wind speed
        // in a wind sea (Kenyon 1969).
        const double along = drift_x * std::cos(direction) + drift_z * std::sin(direction);
        EXPECT_GT(along / sea.wind_speed_mps, 0.03);
        EXPECT_LT(along / sea.wind_speed_mps, 0.04);
        EXPECT_NEAR(drift_z * std::cos(direction) - drift_x * std::sin(direction), 0, 0.02 * along);
        for (const Cascade& cascade : frame.cascades) {
            const DriftTexels loop = drift_per_loop(frame.statistics, cascade.grid, cascade.resolution(), clock);
            const CascadeGrid::Vector moved =
                cascade.grid.in_world(loop.x * cascade.texel_m(), loop.z * cascade.texel_m());
            // Rounded to whole texels along each of two axes.
            const double bound = std::sqrt(0.5) * cascade.texel_m() / sea.loop_period_s * (1 + 1e-9);
            const double error_x = moved.along / sea.loop_period_s - drift_x;
            const double error_z = moved.across / sea.loop_period_s - drift_z;
            EXPECT_LE(std::hypot(error_x, error_z), bound);
        }
    }
}

// Seas of every kind: spectra, analytic waves and ponds.
TEST(FoamDrift, IsReportedForEveryPreset) {
    for (const SeaPreset& preset : sea_presets()) {
        Ocean ocean(preset.sea, {.executor = make_serial_executor()});
        const Frame& frame = ocean.frame_at(0);
        const FoamReport report = report_on_foam(frame);
        EXPECT_GE(report.drift_mps, 0.01 * preset.sea.wind_speed_mps) << preset.name;
        EXPECT_LE(report.drift_mps, 0.5 + 0.05 * preset.sea.wind_speed_mps) << preset.name;
        bool is_white = false;
        for (const CascadeFoam& cascade : report.cascades) is_white |= cascade.makes_whitecaps;
        EXPECT_EQ(report.whitecap_cover > 0, is_white) << preset.name;
    }
}

TEST(TickClock, LoopsHaveWholeTicksThatCanBeFoundByTime) {
    for (const double period : {0.1, 0.149, 1.0, 7.3, 200.0, 86400.0}) {
        const TickClock clock(period);
        EXPECT_EQ(clock.ticks_per_loop() % 16, 0);
        if (period >= 16 * 0.185) {
            EXPECT_GE(clock.tick_s(), 0.185);
            EXPECT_LT(clock.tick_s(), period < 30 ? 2 * 0.185 : 0.206);
        } else {
            EXPECT_EQ(clock.ticks_per_loop(), 16);
        }
        std::mt19937 random(1);
        for (int i = 0; i < 2000; ++i) {
            const auto number = static_cast<std::int64_t>(random() % 4000000) - 2000000;
            const double time = static_cast<double>(number) * period / clock.ticks_per_loop();
            // A tick's time may not be representable as a double, and rounds by at most 2^-30 of a
            // loop to either side.
            const TickTime place = clock.at(time + period * 0x1p-30);
            ASSERT_EQ(place.number, number) << period;
            ASSERT_LE(place.fraction, 0x1p32 * clock.ticks_per_loop() * 0x1p-29) << period;
            ASSERT_EQ(clock.at(clock.time_in_loop_s(number)).number, clock.in_loop(number));
        }
        EXPECT_EQ(clock.at(1e300).number % clock.ticks_per_loop(), clock.at(std::fmod(1e300, period)).number);
    }
}

}  // namespace
}  // namespace pelagic
