// Changes of the sea scheduled while a frame is in flight: that frame does not depend on them, and
// later frames equal those of an ocean whose changes were scheduled between frames.
#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "pelagic/sim/cascades/spectrum_cache.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/each_executor.hpp"
#include "pelagic/tests/frame_bits.hpp"
#include "pelagic/tests/platform/platform.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

/// Enough texels for a frame with jobs. All of these seas have breaking waves, and no two have
/// equal foam.
SeaState windy(int number) {
    return {.cascades = 2,
            .resolution = 64,
            .wind_speed_mps = 12. + number % 7,
            .wind_direction_rad = 0.3 * (number % 11),
            .choppiness = 0.7 + 0.05 * (number % 5)};
}

/// An upper bound of the peak wavelengths of all of them.
const double largest_peak_m = WaveReach::of(windy(6)).peak_m;

struct Step {
    double time_s;
    std::vector<SeaChange> changes;  ///< scheduled while the frame is in flight, or after it
};

enum class Order { in_flight, serial };

std::vector<FrameBits> frames_of(const Forecast& forecast, const std::vector<Step>& steps, Order order,
                                 std::shared_ptr<Executor> executor) {
    Ocean ocean(forecast, {.executor = std::move(executor), .foam = true});
    std::vector<FrameBits> bits;
    for (const Step& step : steps) {
        const auto schedule_changes = [&] {
            for (const SeaChange& change : step.changes) ocean.schedule_sea(change);
        };
        ocean.schedule(step.time_s);
        if (order == Order::in_flight) schedule_changes();
        const Frame& frame = ocean.complete();
        bits.push_back(bits_of(frame));
        if (order == Order::serial) schedule_changes();
    }
    return bits;
}

void expect_same_bits(const Forecast& forecast, const std::vector<Step>& steps) {
    const auto expected = frames_of(forecast, steps, Order::serial, make_serial_executor());
    for (const ExecutorKind& kind : executor_kinds()) {
        // other executors run the same code, but take longer
        if (kind.threads != 2 && kind.name != "serial") continue;
        const auto found = frames_of(forecast, steps, Order::in_flight, kind.make(kind.threads));
        for (std::size_t i = 0; i < steps.size(); ++i)
            EXPECT_EQ(found[i], expected[i]) << kind.name << ": frame " << i << ", at " << steps[i].time_s << " s";
    }
}

/// Ticks are a tenth of a second apart: the tick of 10 s is in the first change, a frame at 10.09 s
/// in the third.
Forecast three_changes_within_a_tick() {
    return {.first = windy(0),
            .changes = {{.sea = windy(1), .from_s = 9, .over_s = 1.02},
                        {.sea = windy(2), .from_s = 10.02, .over_s = 0.03},
                        {.sea = windy(3), .from_s = 10.06, .over_s = 5},
                        {.sea = windy(4), .from_s = 18, .over_s = 2}},
            .largest_peak_m = largest_peak_m};
}

// The tick and the frame need four seas. A fifth is baked ahead and needs a place of its own.
TEST(FrameInFlight, KeepsFourSeasWhileAFifthIsBaked) {
    expect_same_bits(three_changes_within_a_tick(),
                     {{9.95, {}}, {10.09, {{.sea = windy(5), .from_s = 25, .over_s = 5}}}, {10.2, {}}, {10.31, {}}});
}

// complete() computes 29 ticks: from 7.2 s to 10 s. Later changes make the ocean discard the first
// change.
TEST(FrameInFlight, WarmUpUsesTheForecastAtScheduling) {
    std::vector<SeaChange> changes;
    for (int number = 0; number < 4; ++number) {
        expect_same_bits(three_changes_within_a_tick(), {{0, {}}, {10.09, changes}, {10.2, {}}, {10.31, {}}});
        changes.push_back({.sea = windy(5 + number), .from_s = 25. + number, .over_s = 0.5});
    }
}

TEST(FrameInFlight, LaterChangesDoNotAffectItsTicks) {
    const Forecast steady{.first = windy(6), .largest_peak_m = largest_peak_m};
    expect_same_bits(steady, {{0, {}}, {10.09, {{.sea = windy(0), .from_s = 6, .over_s = 2}}}, {10.2, {}}});
}

TEST(FrameInFlight, RandomChangesEqualTheSerialOrder) {
    std::mt19937 random(31);
    const auto uniform = [&](double min, double max) {
        return min + (max - min) * static_cast<double>(random()) * 0x1p-32;
    };
    for (int run = 0; run < (is_sanitized ? 1 : 2); ++run) {
        const Forecast forecast{.first = windy(run), .largest_peak_m = largest_peak_m};
        std::vector<Step> steps;
        double time_s = 0, over_s = 0;  // end time of the last change
        for (int number = 0; number < (is_sanitized ? 12 : 25); ++number) {
            Step step{time_s, {}};
            for (std::size_t more = random() % 3; more > 0; --more) {
                SeaChange change{.sea = windy(static_cast<int>(random() % 77)),
                                 .from_s = std::max(over_s, time_s) + uniform(0, 0.1),
                                 .over_s = uniform(0.01, random() % 4 == 0 ? 2 : 0.1)};
                over_s = change.end_s();
                step.changes.push_back(change);
            }
            steps.push_back(step);
            // Most frames are at most a tick apart; some jump to the time of the changes.
            time_s = random() % 5 == 0 ? over_s + uniform(-1, 0.1) : time_s + uniform(0, 0.15);
        }
        expect_same_bits(forecast, steps);
    }
}

// Engines call from fibers, with stacks of 64 KiB.
TEST(FrameOnAFiber, FramesAndQueriesFitIntoASmallStack) {
    if (is_sanitized) GTEST_SKIP() << "sanitizers do not know the fiber";
    SeaState sea = windy(0), later = windy(3);
    sea.resolution = later.resolution = 128;
    const Forecast forecast{.first = sea, .largest_peak_m = largest_peak_m};
    for (const auto& executor : {make_serial_executor(), make_default_executor(2)}) {
        std::vector<FrameBits> bits;
        std::vector<float> heights(2000), foam(2000);
        const auto make_frames = [&] {
            Ocean ocean(forecast,
                        {.executor = executor, .queries = true, .velocities = Velocities::drawn, .slopes = true,
                         .foam = true});
            ocean.schedule_sea({.sea = later, .from_s = 0.1, .over_s = 0.1});
            for (const double time_s : {0., 0.15}) {
                const Frame& frame = ocean.frame_at(time_s);
                bits.push_back(bits_of(frame));
                std::vector<double> x(heights.size()), z(heights.size());
                for (std::size_t i = 0; i < x.size(); ++i) x[i] = 0.7 * static_cast<double>(i);
                SurfaceQuery(frame, {.interpolation = Interpolation::cubic})
                    .sample({x, z}, {.height_m = heights, .foam = foam});
            }
        };
        make_frames();
        if (!run_on_a_fiber(64 * 1024, make_frames)) GTEST_SKIP() << "no fibers on this system";
        EXPECT_EQ(bits[0], bits[2]);
        EXPECT_EQ(bits[1], bits[3]);
    }
}

TEST(SpectrumCache, HoldsTheSpectraOfBothPassesAndOneMore) {
    SpectrumCache cache;
    for (const std::size_t number : {0, 1, 2, 3}) cache.put(number);
    cache.need(Pass::tick, 0, 1);
    cache.need(Pass::frame, 2, 3);
    for (std::size_t number = 4; number < 10; ++number) {
        cache.put(number);
        EXPECT_TRUE(cache.holds(number));
        for (const std::size_t needed : {0, 1, 2, 3}) EXPECT_TRUE(cache.holds(needed)) << number;
    }
}

}  // namespace
}  // namespace pelagic
