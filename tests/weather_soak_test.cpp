// A day of foam and weather, tick by tick, compared with oceans that compute single moments.
#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/sweep.hpp"

namespace pelagic {
namespace {

/// Returns winds that rise and fall for `seconds`, one change after the other, with calm between
/// some of them.
Forecast restless(double seconds) {
    Forecast forecast{.first = {.cascades = 1, .resolution = 16, .wind_speed_mps = 8, .loop_period_s = 60}};
    std::mt19937 random(12);
    double time = 5;
    while (time < seconds) {
        SeaState sea = forecast.first;
        sea.wind_speed_mps = 3 + static_cast<double>(random() % 20);
        sea.wind_direction_rad = 0.1 * static_cast<double>(random() % 60);
        sea.choppiness = 0.5 + 0.1 * static_cast<double>(random() % 6);
        const double over = 10 + static_cast<double>(random() % 50);
        forecast.changes.push_back({.sea = sea, .from_s = time, .over_s = over});
        time += over + (random() % 2 == 0 ? 0 : static_cast<double>(random() % 100));
    }
    return forecast;
}

TEST(WeatherSoak, EveryTickMatchesAReplayOfItsPast) {
    const std::int64_t ticks = of_sweep<std::int64_t>(50000, 1000000);
    const Forecast forecast = restless(static_cast<double>(ticks) / 10);
    const TickClock clock(forecast.first.loop_period_s);
    const OceanOptions options{.executor = make_serial_executor(), .foam = true};
    struct Hashes {
        std::uint64_t sea, foam;
        bool operator==(const Hashes&) const = default;
    };
    const auto hashes_at = [&](Ocean& ocean, std::int64_t tick) {
        const Frame& frame = ocean.frame_at(clock.time_s(tick));
        return Hashes{hash_of(frame), foam_hash_of(frame)};
    };
    std::mt19937 random(13);
    std::vector<std::pair<std::int64_t, Hashes>> looks;
    Ocean awake(forecast, options);
    for (std::int64_t tick = 0; tick < ticks; ++tick) {
        const Frame& frame = awake.frame_at(clock.time_s(tick));
        if (random() % 100 == 0) looks.push_back({tick, {hash_of(frame), foam_hash_of(frame)}});
    }
    ASSERT_GT(looks.size(), static_cast<std::size_t>(ticks / 200));
    // From the last to the first, so that no moment is the next tick of the previous one.
    Ocean asleep(forecast, options);
    for (auto look = looks.rbegin(); look != looks.rend(); ++look)
        ASSERT_EQ(hashes_at(asleep, look->first), look->second) << "tick " << look->first;
}

}  // namespace
}  // namespace pelagic
