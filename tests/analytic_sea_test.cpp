// Wave lists: invalid values, presets, and transitions from one list to another.
#include "pelagic/analytic/analytic_sea.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "pelagic/analytic/analytic_surface.hpp"

namespace pelagic {
namespace {

const AnalyticSea& named(std::string_view name) { return analytic_preset_named(name)->sea; }

TEST(AnalyticSea, NamesTheFirstInvalidValue) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    AnalyticSea sea;
    EXPECT_EQ(check(sea), "waves is 0, expected 1 to 64 of them");
    sea.waves.resize(65);
    EXPECT_EQ(check(sea), "waves is 65, expected 1 to 64 of them");
    sea.waves.resize(2);
    EXPECT_EQ(check(sea), "");
    sea.waves[1].wavelength_m = -1;
    EXPECT_EQ(check(sea), "waves[1].wavelength_m -1 is out of range [0.01, 1000]");
    sea.waves[1] = {.amplitude_m = nan};
    EXPECT_EQ(check(sea), "waves[1].amplitude_m nan is out of range [0, 100]");
    sea.waves[1] = {.direction_rad = 7};
    EXPECT_EQ(check(sea), "waves[1].direction_rad 7 is out of range [-2 pi, 2 pi]");
    sea.waves[1] = {.phase_rad = std::numeric_limits<double>::infinity()};
    EXPECT_EQ(check(sea), "waves[1].phase_rad inf is out of range [-2 pi, 2 pi]");
    sea.waves[1] = {};
    sea.choppiness = nan;
    EXPECT_EQ(check(sea), "choppiness nan is out of range [0, 1]");
}

TEST(PlaneWaves, NamesTheFirstInvalidValue) {
    const auto with = [](auto change) {
        PlaneWaves sea = plane_waves_of(named("analytic-calm"));
        change(sea);
        return check(sea);
    };
    EXPECT_EQ(with([](PlaneWaves&) {}), "");
    EXPECT_EQ(with([](PlaneWaves& sea) { sea.waves.clear(); }), "waves is 0, expected 1 to 64 of them");
    EXPECT_EQ(with([](PlaneWaves& sea) { sea.choppiness = 2; }), "choppiness 2 is out of range [0, 1]");
    EXPECT_EQ(with([](PlaneWaves& sea) { sea.waves[3].amplitude_m = -1; }),
              "waves[3].amplitude_m -1 is out of range [0, 100]");
    EXPECT_EQ(with([](PlaneWaves& sea) { sea.waves[1].turns_per_m_x = sea.waves[1].turns_per_m_z = 0; }),
              "waves[1].turns_per_m 0 is out of range [0.0001, 200]");
    EXPECT_EQ(with([](PlaneWaves& sea) {
                  for (PlaneWave& wave : sea.waves) wave.amplitude_m *= 10;
              }),
              "steepness is 0.48, expected at most 0.4, the sum of 2 pi amplitude_m turns_per_m");
    EXPECT_THROW(AnalyticSurface{PlaneWaves{}}, std::invalid_argument);
}

TEST(AnalyticFamily, SteepnessDoesNotDependOnTheNumberOfWaves) {
    for (const double strength : {0.0, 1.0, 2.0, 1.5}) {
        const double steepness = steepness_of(analytic_sea({.strength = strength}));
        for (const int waves : {1, 2, 15, 64}) {
            const AnalyticSea sea = analytic_sea(
                {.waves = waves, .longest_m = 40, .shortest_m = 3, .strength = strength, .direction_rad = 6});
            EXPECT_EQ(check(sea), "");
            ASSERT_EQ(sea.waves.size(), static_cast<std::size_t>(waves));
            EXPECT_EQ(sea.waves.front().wavelength_m, 40);
            if (waves > 1) {
                EXPECT_NEAR(sea.waves.back().wavelength_m, 3, 1e-12);
            }
            EXPECT_NEAR(steepness_of(sea), steepness, 1e-12) << waves;
        }
    }
}

TEST(AnalyticSea, IsNormalisedToASignificantHeight) {
    const AnalyticSea sea = with_significant_height(named("analytic-moderate"), 1.25);
    EXPECT_NEAR(significant_height_m(sea), 1.25, 1e-12);
    // Four standard deviations of heights at distant points; there are enough points for 2 %.
    const AnalyticSurface water(sea);
    std::vector<double> x, z;
    for (int i = 0; i < 40000; ++i) {
        x.push_back(i % 200 * 17.3);
        z.push_back(i / 200 * 19.1);
    }
    std::vector<float> heights(x.size());
    water.sample_undisplaced(0, {x, z}, {.height_m = heights});
    double squares = 0;
    for (const float h : heights) squares += double{h} * h;
    EXPECT_NEAR(4 * std::sqrt(squares / 40000), 1.25, 0.025);
}

TEST(AnalyticPresets, HeightAndSteepnessGrowFromCalmToIntense) {
    ASSERT_EQ(analytic_presets().size(), 3u);
    double height_m = 0, steepness = 0;
    for (const AnalyticPreset& preset : analytic_presets()) {
        EXPECT_EQ(check(preset.sea), "") << preset.name;
        EXPECT_GT(significant_height_m(preset.sea), 2 * height_m);
        EXPECT_GT(steepness_of(preset.sea), 2 * steepness);
        height_m = significant_height_m(preset.sea);
        steepness = steepness_of(preset.sea);
    }
    EXPECT_EQ(analytic_preset_named("analytic-wild"), nullptr);
}

TEST(AnalyticMorph, BeginsAndEndsAtItsTwoSeas) {
    const AnalyticSea& calm = named("analytic-calm");
    const AnalyticSea& intense = named("analytic-intense");
    for (const double u : {-1.0, 0.0, 1.0, 3.0}) {
        const AnalyticSea sea = morphed(calm, intense, u);
        const AnalyticSea& end = u > 0.5 ? intense : calm;
        ASSERT_EQ(sea.waves.size(), 16u);
        for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(sea.waves[i].amplitude_m, end.waves[i].amplitude_m);
    }
}

// At u from either end, a smoothstep has covered 3 u^2 - 2 u^3; here u = 0.01.
TEST(AnalyticMorph, StartsAndEndsWithZeroRate) {
    const AnalyticSea& calm = named("analytic-calm");
    const AnalyticSea& intense = named("analytic-intense");
    const AnalyticSea out = morphed(calm, intense, 0.01), in = morphed(calm, intense, 0.99);
    for (std::size_t i = 0; i < 16; ++i) {
        const double change_m = intense.waves[i].amplitude_m - calm.waves[i].amplitude_m;
        EXPECT_NEAR(out.waves[i].amplitude_m - calm.waves[i].amplitude_m, 2.98e-4 * change_m, 1e-9 * change_m);
        EXPECT_NEAR(intense.waves[i].amplitude_m - in.waves[i].amplitude_m, 2.98e-4 * change_m, 1e-9 * change_m);
    }
}

TEST(AnalyticMorph, HeightChangesMonotonicallyBetweenPresets) {
    double before = 0;
    for (int i = 0; i <= 100; ++i) {
        const double now =
            significant_height_m(morphed(named("analytic-calm"), named("analytic-intense"), i / 100.0));
        EXPECT_GE(now, before);
        before = now;
    }
}

// A transition that rotated or stretched waves would move them by whole wavelengths at a distance
// of 50 km. Here a step of u moves the surface only by the change of amplitudes. At any distance
// from the origin that is at most 1.5 du of the change (the steepest slope of a smoothstep).
TEST(AnalyticMorph, SurfaceChangesOnlyByAmplitudeAtAnyDistance) {
    AnalyticSea other = named("analytic-calm");
    for (AnalyticWave& wave : other.waves) wave.direction_rad += 1.5;
    const AnalyticSea& to = named("analytic-intense");
    std::vector<double> x, z;
    for (int i = 0; i < 64; ++i) {
        x.push_back(i * 1.7 + (i % 2) * 5e4);
        z.push_back(i * 2.3 - (i % 2) * 5e4);
    }
    for (const AnalyticSea& from : {named("analytic-calm"), other}) {
        const bool are_same_waves = from.waves[0].direction_rad == to.waves[0].direction_rad;
        double change_m = 0;
        for (std::size_t i = 0; i < 16; ++i)
            change_m += to.waves[i].amplitude_m + (are_same_waves ? -1 : 1) * from.waves[i].amplitude_m;
        std::vector<float> before(64), now(64);
        for (int frame = 0; frame <= 200; ++frame) {
            const AnalyticSurface water(morphed(from, to, frame / 200.0));
            EXPECT_LE(steepness_of(water.waves()), steepness_of(to));
            water.sample_undisplaced(1000, {x, z}, {.height_m = now});
            for (std::size_t i = 0; frame > 0 && i < 64; ++i)
                EXPECT_LE(std::fabs(now[i] - before[i]), 1.5 / 200 * change_m + 1e-5);
            before = now;
        }
    }
}

TEST(AnalyticMorph, KeepsTheSteepnessBoundAndRejectsTooManyWaves) {
    AnalyticSea a, b;
    for (int i = 0; i < 40; ++i) {
        a.waves.push_back({.amplitude_m = 0.0099 * (5 + i) / (2 * std::numbers::pi), .wavelength_m = 5.0 + i});
        b.waves.push_back({.amplitude_m = 0.0099 * (50 + i) / (2 * std::numbers::pi), .wavelength_m = 50.0 + i});
    }
    EXPECT_THROW(morphed(a, b, 0.5), std::invalid_argument);
    a.waves.resize(24);
    EXPECT_NEAR(steepness_of(morphed(a, b, 0.5)), (steepness_of(a) + steepness_of(b)) / 2, 1e-12);
    EXPECT_EQ(morphed(a, b, 0.5).waves.size(), 64u);
    EXPECT_THROW(morphed(a, b, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

}  // namespace
}  // namespace pelagic
