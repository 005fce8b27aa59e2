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

// A swell of 11 s runs at 17 m/s, faster than 1.2 times the wind of 12 m/s.
TEST(Whitecaps, OccurWhereTheWindRaisesWaves) {
    const auto cover = [](const WaveSystem& system) {
        return whitecap_cover(SeaState{.spectrum = SpectrumModel::none, .wind_speed_mps = 12, .systems = {system}});
    };
    const double of_wind = whitecap_cover(12);
    EXPECT_EQ(cover({.height_m = 2, .peak_period_s = 11}), 0);
    EXPECT_EQ(cover({.height_m = 2, .peak_period_s = 9}), of_wind);
    EXPECT_EQ(cover({.height_m = 2, .peak_period_s = 9, .direction_rad = 2}), 0) << "against the wind";
    EXPECT_EQ(cover({.height_m = 2}), of_wind);
    EXPECT_EQ(cover({.wind_speed_mps = 9}), of_wind);
    EXPECT_EQ(whitecap_cover(SeaState{.wind_speed_mps = 12, .systems = {{.peak_period_s = 20}}}), of_wind);
    SeaState swell{.spectrum = SpectrumModel::none, .wind_speed_mps = 12, .swell_height_m = 3, .swell_period_s = 5};
    EXPECT_EQ(whitecap_cover(swell), 0) << "waves of another wind";
}

// From a swell without whitecaps to a wind sea, foam needs a lower level in each frame.
TEST(Whitecaps, AppearSteadilyAsAWindSeaReplacesASwell) {
    const SeaState swell{.spectrum = SpectrumModel::none,
                         .resolution = 32,
                         .systems = {{.height_m = 2, .peak_period_s = 14, .spread_rad = 0.3}}};
    Ocean ocean(swell, {.executor = make_serial_executor()});
    EXPECT_FALSE(ocean.frame_at(0).cascades[0].makes_whitecaps());
    SeaState wind = swell;
    wind.spectrum = SpectrumModel::jonswap;
    ocean.schedule_sea(wind, 1, 20);
    ocean.complete_sea();
    double level = SeaStatistics::no_foam_level;
    for (double time_s = 1.25; time_s <= 21; time_s += 0.25) {
        const SeaStatistics& now = ocean.frame_at(time_s).statistics;
        EXPECT_LT(now.foam_level, level) << time_s;
        if (time_s > 2) {
            EXPECT_GT(now.foam_level, level - 0.2) << time_s;
        }
        level = now.foam_level;
    }
    EXPECT_NEAR(level, Ocean(wind, {.executor = make_serial_executor()}).frame_at(0).statistics.foam_level, 1e-9);
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
