// Statistics of a frame: the height of the waves, and the compression at which they break.
#include "pelagic/sim/foam/accumulation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"

namespace pelagic {
namespace {

TEST(Whitecaps, MatchThePublishedCover) {
    // Monahan and O'Muircheartaigh 1980, equation 5: about 1 % at 10 m/s.
    EXPECT_NEAR(whitecap_cover(10), 3.84e-6 * std::pow(10, 3.41), 1e-12);
    EXPECT_NEAR(whitecap_cover(10), 0.0099, 1e-4);
    EXPECT_EQ(whitecap_cover(60), 0.4);
    EXPECT_GT(whitecap_cover(1e-300), 0);
}

TEST(Whitecaps, DoNotOccurWithoutFolds) {
    const SeaState flat{.resolution = 32, .patch_size_m = 250, .wind_speed_mps = 1e-3};
    Ocean ocean(flat, {.executor = make_serial_executor()});
    EXPECT_FALSE(ocean.frame_at(0).cascades[0].makes_whitecaps());
    const SeaState height_field{.resolution = 32, .patch_size_m = 250, .choppiness = 0};
    Ocean unfolded(height_field, {.executor = make_serial_executor()});
    EXPECT_FALSE(unfolded.frame_at(0).cascades[0].makes_whitecaps());
}

TEST(FrameStatistics, MatchTheSeaOnEveryInstructionSetAndAfterEveryChange) {
    const SeaState calm{.resolution = 64, .patch_size_m = 50, .wind_speed_mps = 3};
    const SeaState storm{.resolution = 64, .patch_size_m = 800, .wind_speed_mps = 20};
    double calm_height_m = 0, storm_height_m = 0;
    double calm_level = 0, storm_level = 0;
    for (const Isa isa : isas_here()) {
        Ocean ocean(calm, {.executor = make_serial_executor(), .isa = isa});
        const Frame& last_calm = ocean.frame_at(1);
        ocean.schedule_sea(storm);
        ocean.complete_sea();
        ocean.schedule(2);
        EXPECT_EQ(last_calm.sea.patch_size_m, 50);
        EXPECT_EQ(last_calm.time_s, 1);
        EXPECT_EQ(last_calm.isa, isa);
        EXPECT_NEAR(last_calm.statistics.significant_wave_height_m / expected_waves(calm).significant_wave_height_m,
                    1, 1e-12);
        const double height_before_m = last_calm.statistics.significant_wave_height_m;
        const double level_before = last_calm.statistics.foam_level;
        const Frame& first_storm = ocean.complete();
        EXPECT_EQ(first_storm.sea.patch_size_m, 800);
        EXPECT_NEAR(
            first_storm.statistics.significant_wave_height_m / expected_waves(storm).significant_wave_height_m, 1,
            1e-12);
        if (isa == isas_here().front()) {
            calm_height_m = height_before_m;
            calm_level = level_before;
            storm_height_m = first_storm.statistics.significant_wave_height_m;
            storm_level = first_storm.statistics.foam_level;
        }
        EXPECT_EQ(height_before_m, calm_height_m);
        EXPECT_EQ(level_before, calm_level);
        EXPECT_EQ(first_storm.statistics.significant_wave_height_m, storm_height_m);
        EXPECT_EQ(first_storm.statistics.foam_level, storm_level);
    }
}

}  // namespace
}  // namespace pelagic
