// Radiance is finite and not negative from any position, under any sky and in any depth of water.
// The images of two eyes agree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "pelagic/tests/gl_scene.hpp"
#include "pelagic/tests/sweep.hpp"

namespace pelagic {
namespace {

/// Positions from 30 m deep to 3 km high, half of them within 3 m of the surface. Directions are
/// random; some are exactly down, up, level or along an axis.
Camera anywhere(std::minstd_rand& random, int i) {
    const double metres =
        i % 2 == 0 ? 3 - 6 * uniform(random) : 3000 * std::pow(uniform(random), 4) - 30 * uniform(random);
    const double away = i % 10 == 9 ? 1e6 : 3000;
    const glm::dvec3 at(away * (uniform(random) - 0.5), metres, away * (uniform(random) - 0.5));
    const double azimuth = 6.283 * uniform(random), up = 3.14159 * (uniform(random) - 0.5);
    glm::dvec3 forward(std::cos(azimuth) * std::cos(up), std::sin(up), std::sin(azimuth) * std::cos(up));
    if (i % 7 == 0) forward = {0, i % 2 == 0 ? -1 : 1, 0};
    if (i % 7 == 1) forward = {1, 0, 0};
    return {.position_m = at, .target_m = at + 50.0 * forward, .vertical_view_rad = 0.3 + 2 * uniform(random)};
}

class GlAnyView : public testing::TestWithParam<gl::Shading> {};
INSTANTIATE_TEST_SUITE_P(Tiers, GlAnyView,
                         testing::Values(gl::Shading::headset, gl::Shading::medium, gl::Shading::high),
                         [](const auto& test) { return std::string(name_of(test.param)); });

// 30 views a tier in the quick run, 500 at night; five views share a sky, ten share a sea.
TEST_P(GlAnyView, RadianceIsFiniteAndNotNegative) {
    constexpr int width = 48, height = 32;
    std::minstd_rand random(5);
    gl::SkyBaker baker(make_default_executor(), 16);
    std::optional<GlScene> scene;
    for (int i = 0; i < of_sweep(30, 500); ++i) {
        if (i % 10 == 0) {
            const char* const presets[] = {"calm", "moderate", "storm"};
            scene.emplace(GlScene::Options{.preset = presets[i / 10 % 3],
                                           .quality = "low",
                                           .resolution = 32,
                                           .width = width,
                                           .height = height,
                                           .samples = 0,
                                           .writes = gl::PixelKind::radiance,
                                           .shading = GetParam(),
                                           .depth_m = i % 20 == 0 ? 0 : 0.5 + 40 * std::pow(uniform(random), 2),
                                           .lens_may_dip = true});
        }
        if (i % 5 == 0) {
            baker.schedule(
                {.sun_azimuth_rad = static_cast<float>(6.283 * uniform(random)),
                 .sun_elevation_rad = i % 15 == 0 ? 1.5707963f : static_cast<float>(3.1 * (uniform(random) - 0.5)),
                 .cloud_cover = static_cast<float>(uniform(random)),
                 .visibility_m = static_cast<float>(500 + 100e3 * std::pow(uniform(random), 2))});
            scene->renderer->set_sky(baker.complete());
        }
        const Camera camera = anywhere(random, i);
        scene->draw(camera, 40 * uniform(random), true, i % 6 == 5);
        const std::vector<float> radiance = scene->target->read_radiance();
        int wrong = 0;
        for (const float value : radiance) wrong += !(value >= 0 && value <= 65504);
        ASSERT_EQ(wrong, 0) << "view " << i << " from " << camera.position_m.y << " m";
    }
}

// The eyes look in parallel, so infinitely distant points have the same position in both images.
// The sea's radiance there is also the same.
TEST(GlEyes, ImagesAgreeToAPixelAtInfinity) {
    constexpr int width = 240, height = 60;
    GlScene scene(
        {.quality = "low", .resolution = 64, .width = width, .height = height, .writes = gl::PixelKind::radiance});
    scene.draw({.position_m = {0, 30, 0}, .target_m = {100, 30, 20}, .vertical_view_rad = 0.6}, 3, true, true);
    const std::vector<float> rgba = scene.target->read_radiance();
    const auto luminance = [&](int x, int y) {
        const float* p = &rgba[4 * static_cast<std::size_t>(y * width + x)];
        return 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
    };
    // The sky, and a row of sea just below the horizon, kilometres away.
    double difference = 0, sum = 0;
    for (int y = 0; y < height / 2 + 1; ++y)
        for (int x = 0; x < width / 2; ++x) {
            difference += std::abs(luminance(x, y) - luminance(x + width / 2, y));
            sum += luminance(x, y);
        }
    // 63 mm at a distance of one kilometre are a hundredth of a pixel here.
    EXPECT_LT(difference, 0.005 * sum);
    // Check that the test can fail: a shift of one pixel gives another image.
    double beside = 0;
    for (int y = 0; y < height / 2 + 1; ++y)
        for (int x = 0; x < width / 2 - 1; ++x) beside += std::abs(luminance(x, y) - luminance(x + 1 + width / 2, y));
    EXPECT_GT(beside, 2 * difference);
}

}  // namespace
}  // namespace pelagic
