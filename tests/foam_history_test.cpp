// Foam of a single cascade, compared with a direct replay of its rule; foam is independent of the
// first frame and of loops; its drift.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "pelagic/sim/foam/drift.hpp"
#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/sim/foam_report.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/tests/each_isa.hpp"
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

std::vector<int> foam_of(const Cascade& cascade) {
    const auto texels = cascade.level_of(cascade.foam_r8, 0);
    return {texels.begin(), texels.end()};
}

/// Foam in the half floats, in units of 1/255.
std::vector<int> foam_in_halves(const Cascade& cascade) {
    std::vector<int> foam;
    for (std::size_t i = 3; i < cascade.displacement_rgba16f.size(); i += 4) {
        const std::uint16_t bits = cascade.displacement_rgba16f[i];
        const int exponent = bits >> 10, mantissa = bits & 0x3FF;
        const double value = exponent == 0 ? mantissa * 0x1p-24 : std::ldexp(1024 + mantissa, exponent - 25);
        foam.push_back(static_cast<int>(std::nearbyint(255 * value)));
    }
    return foam;
}

/// The foam of a tick, computed by the rule from frames without history.
std::vector<int> replayed(const SeaState& sea, std::int64_t tick) {
    Ocean without_history(sea, {.executor = make_serial_executor()});
    const TickClock clock(sea.loop_period_s);
    std::vector<int> foam;
    for (std::int64_t number = tick - 40; number <= tick; ++number) {
        const Frame& frame = without_history.frame_at(clock.time_in_loop_s(number));
        const Cascade& cascade = frame.cascades[0];
        const int n = cascade.resolution();
        const DriftTexels drift = drift_of(frame.statistics, cascade.grid, n, clock, number);
        const std::vector<int> before = foam;
        foam = foam_in_halves(cascade);
        if (before.empty()) continue;
        for (int z = 0; z < n; ++z) {
            for (int x = 0; x < n; ++x) {
                const int from_x = ((x - drift.x) % n + n) % n, from_z = ((z - drift.z) % n + n) % n;
                int& here = foam[static_cast<std::size_t>(z * n + x)];
                here = std::max(here, before[static_cast<std::size_t>(from_z * n + from_x)] - FoamTickJob::fade);
            }
        }
    }
    return foam;
}

class FoamHistoryOnEachIsa : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(Isas, FoamHistoryOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

TEST_P(FoamHistoryOnEachIsa, MatchesItsRule) {
    const SeaState& sea = gale_on_one_cascade;
    const std::int64_t tick = 57;
    Ocean ocean(sea, with_foam(GetParam()));
    const Frame& frame = ocean.frame_at(TickClock(sea.loop_period_s).time_in_loop_s(tick));
    const std::vector<int> expected = replayed(sea, tick), foam = foam_of(frame.cascades[0]);
    EXPECT_EQ(foam, foam_in_halves(frame.cascades[0]));
    int max = 0;
    for (std::size_t i = 0; i < foam.size(); ++i) {
        // A tick sums J in another order than a frame, so a value between two bytes may round to
        // either.
        ASSERT_NEAR(foam[i], expected[i], 1) << "texel " << i;
        max = std::max(max, foam[i]);
    }
    EXPECT_GT(max, 127) << "nothing breaks here";
}

TEST(FoamHistory, DecaysBetweenTicksAndBreaksAtAnyTime) {
    const SeaState& sea = gale_on_one_cascade;
    Ocean ocean(sea, with_foam()), without_history(sea, {.executor = make_serial_executor()});
    const TickClock clock(sea.loop_period_s);
    const double tick = clock.time_in_loop_s(33);
    const std::vector<int> at_tick = foam_of(ocean.frame_at(tick).cascades[0]);
    for (const double fraction : {0.1, 0.5, 0.99}) {
        const double time = tick + fraction * clock.tick_s();
        const std::vector<int> foam = foam_of(ocean.frame_at(time).cascades[0]);
        const std::vector<int> breaking = foam_in_halves(without_history.frame_at(time).cascades[0]);
        const int faded = static_cast<int>(FoamTickJob::fade * fraction);
        for (std::size_t i = 0; i < foam.size(); ++i) ASSERT_EQ(foam[i], std::max(at_tick[i] - faded, breaking[i]));
    }
}

// Foam depends on the time only, not on the first frame or on earlier frames.
TEST(FoamHistory, DoesNotDependOnTheFirstFrame) {
    const SeaState sea{.cascades = 1, .resolution = 16, .wind_speed_mps = 20, .loop_period_s = 30};
    Ocean in_order(sea, with_foam());
    const TickClock clock(sea.loop_period_s);
    std::vector<std::uint64_t> expected;
    for (int tick = 0; tick < clock.ticks_a_loop(); ++tick)
        expected.push_back(foam_hash_of(in_order.frame_at(clock.time_in_loop_s(tick))));
    std::mt19937 random(5);
    Ocean ocean(sea, with_foam());
    for (int start = 0; start < (is_sanitized ? 100 : 1000); ++start) {
        int tick = static_cast<int>(random() % expected.size());
        for (int step = 0; step < 3; ++step) {
            const double loops = static_cast<int>(random() % 7) - 3;
            const double time = clock.time_in_loop_s(tick) + loops * sea.loop_period_s;
            ASSERT_EQ(foam_hash_of(ocean.frame_at(time)), expected[static_cast<std::size_t>(tick)]) << time;
            tick = (tick + static_cast<int>(random() % 4)) % clock.ticks_a_loop();
        }
    }
}

TEST(FoamHistory, DoesNotChangeTheRestOfTheFrame) {
    for (const SeaState& sea : {gale_of_two_cascades, gale_on_one_cascade}) {
        Ocean with(sea, with_foam()), without(sea, {.executor = make_serial_executor()});
        for (const double time : {0.0, 0.05, 3.0, -2.0})
            EXPECT_EQ(hash_of(with.frame_at(time)), hash_of(without.frame_at(time)));
        EXPECT_TRUE(without.frame_at(0).cascades[0].foam_r8.empty());
    }
}

// The foam of several cascades is that of their sum.
TEST(FoamHistory, IsOfOneCascadeOnly) {
    Ocean ocean(gale_of_two_cascades, with_foam());
    for (const Cascade& cascade : ocean.frame_at(3).cascades) {
        EXPECT_TRUE(cascade.foam_r8.empty());
        EXPECT_EQ(foam_in_halves(cascade), std::vector<int>(32 * 32));
        EXPECT_EQ(cascade.whitecap_jacobian, Cascade::no_whitecaps);
        EXPECT_TRUE(cascade.makes_whitecaps());
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
TEST(FoamHistory, OfAForecastDoesNotDependOnTheOrderOfFrames) {
    Ocean in_order(rising(), with_foam());
    const TickClock clock(gale_of_two_cascades.loop_period_s);
    std::vector<std::uint64_t> expected;
    for (int tick = 0; tick < 150; ++tick) expected.push_back(foam_hash_of(in_order.frame_at(clock.time_s(tick))));
    EXPECT_NE(expected[10], expected[10 + static_cast<std::size_t>(clock.ticks_a_loop())])
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
TEST(FoamHistory, OfALiveChangeEqualsThatOfAForecast) {
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

TEST(FoamHistory, LevelsAreTheMeansOfFourTexels) {
    Ocean ocean(gale_on_one_cascade, with_foam());
    const Cascade& cascade = ocean.frame_at(3).cascades[0];
    for (int level = 1; level < mip_levels(cascade.resolution()); ++level) {
        const auto finer = cascade.level_of(cascade.foam_r8, level - 1),
                   coarser = cascade.level_of(cascade.foam_r8, level);
        const std::size_t side = static_cast<std::size_t>(cascade.resolution()) >> level;
        for (std::size_t i = 0; i < coarser.size(); ++i) {
            const std::size_t from = 2 * (i / side) * 2 * side + 2 * (i % side);
            const int sum = finer[from] + finer[from + 1] + finer[from + 2 * side] + finer[from + 2 * side + 1];
            ASSERT_EQ(coarser[i], (sum + 2) / 4);
        }
    }
}

// After schedule_sea() foam is that of the new sea only.
TEST(FoamHistory, IsReplacedWithTheSea) {
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
TEST(FoamDrift, MatchesWindAndStokesDriftOverAThousandTicks) {
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
        std::size_t fine_cascades = 0;
        for (const Cascade& cascade : frame.cascades) {
            if (cascade.texel_m() > 0.25) continue;
            ++fine_cascades;
            double texels_x = 0, texels_z = 0;
            for (int tick = 501; tick <= 1500; ++tick) {
                const DriftTexels step = drift_of(frame.statistics, cascade.grid, cascade.resolution(), clock, tick);
                texels_x += step.x;
                texels_z += step.z;
            }
            const CascadeGrid::Place moved =
                cascade.grid.in_world(texels_x * cascade.texel_m(), texels_z * cascade.texel_m());
            const double seconds = 1000 * clock.tick_s(), speed = std::hypot(drift_x, drift_z);
            EXPECT_NEAR(moved.along / seconds, drift_x, 0.02 * speed);
            EXPECT_NEAR(moved.across / seconds, drift_z, 0.02 * speed);
        }
        EXPECT_GE(fine_cascades, 2u);
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

TEST(FoamDrift, IsAWholeNumberOfTexelsPerLoop) {
    SeaStatistics statistics;
    statistics.foam_drift_x_mps = 0.37;
    statistics.foam_drift_z_mps = -0.21;
    const CascadeGrid grid{.side_m = 10, .cosine = 0.6, .sine = 0.8};
    for (const double period : {0.1, 7.3, 200.0}) {
        const TickClock clock(period);
        const DriftTexels loop = drift_a_loop(statistics, grid, 64, clock);
        int x = 0, z = 0;
        for (int tick = -5; tick < clock.ticks_a_loop() - 5; ++tick) {
            const DriftTexels step = drift_of(statistics, grid, 64, clock, tick);
            x += step.x;
            z += step.z;
        }
        EXPECT_EQ(x, loop.x);
        EXPECT_EQ(z, loop.z);
    }
}

/// Still water with one texel of foam, advanced by one tick.
TEST_P(FoamHistoryOnEachIsa, ATickMovesFoamAndDecaysIt) {
    for (const int n : {16, 64}) {
        const std::size_t side = static_cast<std::size_t>(n), lanes = kernels().lanes;
        const AlignedBuffer<float> still(column_blocks(n, lanes) * column_block_floats(n, lanes));
        AlignedBuffer<std::uint8_t> before(side * side), after(side * side);
        before[3 * side + 14] = 200;
        before[0] = 5;
        kernels().foam_tick({.surface = still.data(),
                             .resolution = side,
                             .block_stride = column_block_floats(n, lanes),
                             .cosine = 1,
                             .sine = 0,
                             .difference_factor = 1,
                             .source = {.offset = -10, .scale = 255},
                             .before = before.data(),
                             .shift_x = 5,
                             .shift_z = side - 4,
                             .first_row = 0,
                             .rows = side,
                             .after = after.data()});
        const std::size_t to = (side - 1) * side + (14 + 5) % side;
        for (std::size_t i = 0; i < after.size(); ++i) ASSERT_EQ(after[i], i == to ? 200 - 17 : 0) << i;
    }
}

TEST(TickClock, LoopsHaveWholeTicksThatCanBeFoundByTime) {
    for (const double period : {0.1, 0.149, 1.0, 7.3, 200.0, 86400.0}) {
        const TickClock clock(period);
        EXPECT_EQ(clock.ticks_a_loop() % 16, 0);
        if (period >= 16 * 0.185) {
            EXPECT_GE(clock.tick_s(), 0.185);
            EXPECT_LT(clock.tick_s(), period < 30 ? 2 * 0.185 : 0.206);
        } else {
            EXPECT_EQ(clock.ticks_a_loop(), 16);
        }
        std::mt19937 random(1);
        for (int i = 0; i < 2000; ++i) {
            const auto number = static_cast<std::int64_t>(random() % 4000000) - 2000000;
            const double time = static_cast<double>(number) * period / clock.ticks_a_loop();
            // A tick's time may not be representable as a double, and rounds by at most 2^-30 of a
            // loop to either side.
            const TickPlace place = clock.at(time + period * 0x1p-30);
            ASSERT_EQ(place.number, number) << period;
            ASSERT_LE(place.fraction, 0x1p32 * clock.ticks_a_loop() * 0x1p-29) << period;
            ASSERT_EQ(clock.at(clock.time_in_loop_s(number)).number, clock.in_loop(number));
        }
        EXPECT_EQ(clock.at(1e300).number % clock.ticks_a_loop(), clock.at(std::fmod(1e300, period)).number);
    }
}

}  // namespace
}  // namespace pelagic
