// Caustics, compared with the geometric optics of lenses, and the heights of the sea floor. No
// OpenGL driver is needed.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numbers>
#include <vector>

#include "pelagic/gl/water/caustics.hpp"
#include "pelagic/sim/ocean.hpp"

namespace pelagic {
namespace {

constexpr double pi = std::numbers::pi, water_index = 1.333;

/// A cascade whose height is a function of x, both in metres.
struct HandMadeSea {
    template <class Height>
    HandMadeSea(int n, double side_m, Height height_of)
        : resolution(n), flat(std::size_t(n) * n), height(flat.size()) {
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                height[std::size_t(j) * n + i] = static_cast<float>(height_of(i * side_m / n));
        cascade.grid.side_m = side_m;
        cascade.dx = cascade.dz = plane(flat);
        cascade.height = plane(height);
        frame.cascades = {&cascade, 1};
    }
    PlaneView plane(const std::vector<float>& texels) const {
        return {texels.data(), resolution, resolution, resolution, 0};
    }
    int resolution;
    std::vector<float> flat, height;
    Cascade cascade;
    Frame frame;
};

/// Light intensity at the texels of the finest level.
std::vector<double> baked(const Frame& frame, double depth_m, glm::vec3 sun = {0, 1, 0}) {
    gl::CausticsBaker baker(make_serial_executor());
    baker.schedule(frame, {.depth_m = depth_m, .sun = sun});
    std::vector<double> light;
    for (const std::uint16_t half : baker.complete().halves) light.push_back(glm::unpackHalf1x16(half));
    return light;
}

TEST(Caustics, FlatWaterGivesUniformLight) {
    const HandMadeSea sea(64, 20, [](double) { return 0.0; });
    for (const glm::vec3 sun : {glm::vec3(0, 1, 0), glm::normalize(glm::vec3(0.6f, 0.5f, -0.2f)), glm::vec3(1, 0, 0)})
        for (const double light : baked(sea.frame, 7, sun)) ASSERT_EQ(light, 1);
}

// A wave a cos(k x) acts as a lens of radius 1 / (a k^2) at its crest: parallel light focuses
// n / ((n - 1) a k^2) below. At a fraction p of that depth, the intensity is 1 / (1 - p) below
// crests and 1 / (1 + p) below troughs.
TEST(Caustics, AWaveFocusesLightLikeALens) {
    constexpr int n = 128;
    // slopes up to 0.016: rays are paraxial
    constexpr double side_m = 16, a = 0.02, k = 2 * pi / 8;
    const double focus_m = water_index / ((water_index - 1) * a * k * k);
    const HandMadeSea sea(n, side_m, [&](double x) { return a * std::cos(k * x); });
    // The root mean square of a sine is 1/sqrt(2) of its maximum; differences over a texel lose
    // 0.05 %.
    EXPECT_NEAR(gl::focus_of(sea.cascade), focus_m * std::sqrt(2) / 1.5, 0.005 * focus_m);

    constexpr int side = gl::Caustics::side;
    const auto below_crest = [&](const std::vector<double>& light) { return light[side / 2]; };
    // The mean of seven texels: where light is spread out, its discrete pieces cause noise of 3 %.
    const auto below_trough = [&](const std::vector<double>& light) {
        double sum = 0;
        for (int i = -3; i <= 3; ++i) sum += light[static_cast<std::size_t>(side / 4 + i)];
        return sum / 7;
    };
    for (const double fraction : {0.25, 0.5, 0.75}) {
        const std::vector<double> light = baked(sea.frame, fraction * focus_m);
        // A texel is a 128th of the wave: the light is constant over it.
        EXPECT_NEAR(below_crest(light), 1 / (1 - fraction), 0.03 / (1 - fraction)) << fraction;
        EXPECT_NEAR(below_trough(light), 1 / (1 + fraction), 0.01) << fraction;
    }
    // The brightest line over all depths. Beyond the focus the line splits into two, which are a
    // texel apart at 1.12 of the focal depth.
    double brightest = 0, at = 0;
    for (double fraction = 0.6; fraction < 1.6; fraction += 0.05) {
        const double light = below_crest(baked(sea.frame, fraction * focus_m));
        if (light > brightest) {
            brightest = light;
            at = fraction;
        }
    }
    EXPECT_GE(at, 0.95);
    EXPECT_LE(at, 1.15);
    EXPECT_GT(brightest, 8);
}

TEST(Caustics, ARealSeaConservesLight) {
    Ocean ocean(sea_preset_named("moderate")->sea, {.executor = make_serial_executor(), .slopes = true});
    const Frame& frame = ocean.frame_at(3);
    for (const double depth_m : {1.0, 5.0, 30.0}) {
        gl::CausticsBaker baker(make_serial_executor());
        baker.schedule(frame, {.depth_m = depth_m, .sun = glm::normalize(glm::vec3(0.4f, 0.8f, 0.3f))});
        const gl::Caustics& caustics = baker.complete();
        // Total light before and after: the surface's cells, projected along the sun's direction,
        // sum to the cascade's area.
        EXPECT_NEAR(caustics.light, 1, 0.005) << depth_m;
        double sum = 0, squares = 0;
        constexpr std::size_t texels = std::size_t{gl::Caustics::side} * gl::Caustics::side;
        for (std::size_t i = 0; i < texels; ++i) {
            const double light = glm::unpackHalf1x16(caustics.halves[i]);
            ASSERT_TRUE(std::isfinite(light) && light >= 0);
            sum += light;
            squares += light * light;
        }
        // Halves round to even, within 2e-4 of each value; the error of the mean is smaller.
        EXPECT_NEAR(sum / texels, 1, 5e-4) << depth_m;
        EXPECT_GT(squares / texels, 1.02) << "no pattern at " << depth_m << " m";
        EXPECT_NEAR(glm::unpackHalf1x16(caustics.halves.back()), 1, 1e-3) << depth_m;
    }
}

TEST(Caustics, ResultsDoNotDependOnTheNumberOfThreads) {
    Ocean ocean(sea_preset_named("rough")->sea, {.executor = make_serial_executor(), .slopes = true});
    const Frame& frame = ocean.frame_at(1);
    std::vector<std::uint16_t> first;
    for (const int threads : {1, 2, 5}) {
        gl::CausticsBaker baker(make_thread_executor(threads));
        baker.schedule(frame, {.depth_m = 5});
        const gl::Caustics& caustics = baker.complete();
        if (first.empty()) first = caustics.halves;
        EXPECT_EQ(caustics.halves, first) << threads;
    }
}

TEST(Caustics, TheCascadeIsSelectedByFocalDepth) {
    Ocean ocean(sea_preset_named("moderate")->sea, {.executor = make_serial_executor(), .slopes = true});
    const Frame& frame = ocean.frame_at(0);
    gl::CausticsBaker baker(make_serial_executor());
    double side_before_m = 0;
    for (const double depth_m : {0.5, 5.0, 60.0}) {
        baker.schedule(frame, {.depth_m = depth_m});
        const double side_m = baker.complete().grid.side_m;
        EXPECT_GE(side_m, side_before_m) << "deeper water needs longer waves";
        side_before_m = side_m;
    }
    EXPECT_GT(side_before_m, frame.cascades.back().grid.side_m);
    EXPECT_THROW(baker.schedule(frame, {.depth_m = 0}), std::invalid_argument);
    EXPECT_EQ(gl::check(gl::CausticsOptions{.depth_m = -1}), "depth_m -1 is out of range [0.001, 1000]");
}

TEST(SeaFloor, InvalidValuesAreNamed) {
    EXPECT_EQ(gl::check(gl::SeaFloor{}), "");
    EXPECT_EQ(gl::check(gl::SeaFloor{.columns = 1, .rows = 2}),
              "columns is 1, expected 2 to 4096, or 0 for an even floor");
    EXPECT_EQ(gl::check(gl::SeaFloor{.columns = 2, .rows = 2, .heights_m = {1, 2, 3}}),
              "heights_m.size() is 3, expected columns * rows");
    EXPECT_EQ(gl::check(gl::SeaFloor{.columns = 2, .rows = 2, .heights_m = {1, 2, 3, 1e5f}}),
              "heights_m 100000 is out of range [-11000, 9000]");
}

TEST(SeaFloor, MipsAverageToTheMeanAndHeightsAreInterpolated) {
    gl::SeaFloor floor{.columns = 4, .rows = 2, .corner_m = {10, 20}, .metres_per_texel = 5};
    floor.heights_m = {-8, -4, 0, 4, -6, -2, 2, 6};
    const gl::FloorTexels texels = gl::texels_of(floor);
    ASSERT_EQ(texels.levels, 3);
    ASSERT_EQ(texels.halves.size(), 8u + 2 + 1);
    EXPECT_EQ(glm::unpackHalf1x16(texels.halves[8]), -5);
    EXPECT_EQ(glm::unpackHalf1x16(texels.halves[9]), 3);
    EXPECT_EQ(glm::unpackHalf1x16(texels.halves[10]), -1);
    EXPECT_DOUBLE_EQ(floor.height_at(12.5, 20), -6);
    EXPECT_DOUBLE_EQ(floor.height_at(10, 22.5), -7);
    EXPECT_DOUBLE_EQ(floor.height_at(-100, 0), -8) << "as high as the edge beyond it";
}

}  // namespace
}  // namespace pelagic
