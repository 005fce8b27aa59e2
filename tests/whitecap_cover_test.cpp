// Foam covers the measured fraction of the sea.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/sim/foam/accumulation.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/sanitized.hpp"
#include "pelagic/tests/sweep.hpp"

namespace pelagic {
namespace {

/// Foam persists for three seconds; frames are mostly between ticks.
constexpr double seconds_between = 0.57;

/// Returns the mean foam of the sea's area over seeds, frames of each seed, and points.
double mean_cover(SeaState sea, int seeds, int frames) {
    // Points that fill a square evenly (Roberts 2018), different in each frame.
    constexpr int places = 10'000;
    constexpr double square_m = 20'000;
    const auto part_of = [](double turns) { return turns - std::floor(turns); };
    double sum = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        sea.seed = static_cast<std::uint32_t>(seed);
        Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .foam = true});
        std::vector<double> x_m(places), z_m(places);
        std::vector<float> foam(places);
        for (int number = 0; number < frames; ++number) {
            for (int point = 0; point < places; ++point) {
                const int place = number * places + point;
                x_m[static_cast<std::size_t>(point)] = square_m * part_of(place * 0.7548776662466927);
                z_m[static_cast<std::size_t>(point)] = square_m * part_of(place * 0.5698402909980532);
            }
            SurfaceQuery(ocean.frame_at(number * seconds_between)).sample({x_m, z_m}, {.foam = foam});
            for (const float each : foam) sum += double{each};
        }
    }
    return sum / (static_cast<double>(places) * frames * seeds);
}

/// Returns a sea whose cascade has a fixed side if `cascades` is 0.
SeaState windy_sea(int cascades, double wind_speed_mps) {
    return {.cascades = cascades, .patch_size_m = cascades == 0 ? 250.0 : 0.0, .wind_speed_mps = wind_speed_mps};
}

double cover_over_measured_at_sea(const SeaState& sea, int seeds, int frames) {
    return mean_cover(sea, seeds, frames) / whitecap_cover(sea.wind_speed_mps);
}

// Measured with many seeds: 1.00 to 1.03 for four cascades, 0.97 to 1.04 for one. All bounds are
// less than the scatter of the measurements at sea.
TEST(WhitecapCover, IsThatOfMeasurementsAtSea) {
    if (is_sanitized) {  // pairs of eight seeds give 1.04 to 1.06 in so few frames
        EXPECT_NEAR(cover_over_measured_at_sea(windy_sea(4, 25), 2, 10), 1, 0.08);
        return;
    }
    const int more = of_sweep(1, 4);
    for (const double wind_speed_mps : of_sweep(std::vector<double>{11, 26}, {7, 11, 14, 19, 26})) {
        std::printf("%2g m/s:", wind_speed_mps);
        for (const int cascades : of_sweep(std::vector<int>{1, 4}, {0, 1, 2, 3, 4})) {
            // Breaking crests are rarer in light winds: 48 seeds of 40 frames give 1.08 for one cascade.
            const bool is_light = wind_speed_mps < 8;
            const double part = cover_over_measured_at_sea(windy_sea(cascades, wind_speed_mps),
                                                           more * (is_light ? 12 : 4), is_light ? 240 : 40);
            std::printf(" %.2f", part);
            const double bound = cascades == 2 || cascades == 3 ? 0.1 : 0.04;
            EXPECT_NEAR(part, 1, bound) << wind_speed_mps << " m/s, cascades " << cascades;
        }
        std::printf("\n");
    }
}

// 18 seeds give 1.02 and 1.03 with a deviation of 0.01 a seed.
TEST(WhitecapCover, DependsNeitherOnChoppinessNorOnTheWindDirection) {
    if (is_sanitized) return;
    for (const double choppiness : {0.3, 1.0}) {
        SeaState sea = windy_sea(1, 15);
        sea.choppiness = choppiness;
        sea.wind_direction_rad = 0.7;
        EXPECT_NEAR(cover_over_measured_at_sea(sea, 3, 40), 1, 0.05) << choppiness;
    }
}

// Long waves contract the water more in shallow water, and the thresholds follow. 18 seeds give 1.04
// with a deviation of 0.06 a seed, because few waves of the grid form the swell: 0.04 for three.
TEST(WhitecapCover, HoldsInShallowWater) {
    if (is_sanitized) return;
    SeaState sea = windy_sea(1, 12);
    sea.depth_m = 8;
    sea.swell_height_m = 2.5;
    EXPECT_NEAR(cover_over_measured_at_sea(sea, 3, 40), 1, 0.08);
}

}  // namespace
}  // namespace pelagic
