// Shadows of clouds on the sea, and the sun's disc behind clouds. Skies are uniform, and their maps
// of shadows are written by hand.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <vector>

#include "pelagic/gl/water/scene_block.hpp"
#include "pelagic/tests/gl_scene.hpp"

namespace pelagic {
namespace {

constexpr int shadow_side = gl::CloudShadows::side, shadow_pixels = 64;

/// Returns a sky with sunlight alone, whose map has no light west of x = 0.
gl::Sky half_shaded_sky() {
    gl::Sky sky = even_sky(0);
    sky.sun_direction = glm::normalize(glm::vec3(0.1f, 1, 0));
    sky.sun_irradiance = glm::vec3(1);
    sky.brightest_transmittance = 1;
    sky.mean_sunlight = 0;  // the air between sea and eye adds no light
    for (int i = 0; i < shadow_side * shadow_side; ++i)
        sky.cloud_shadows.texels.push_back(i % shadow_side < shadow_side / 2 ? 0 : 255);
    return sky;
}

class GlCloudShadow : public testing::Test {
   protected:
    /// Returns the mean green radiance in the west and in the east of a square of 600 m around a
    /// point, seen from above. Its middle, as wide as a texel, is left out.
    std::pair<double, double> west_and_east(double x_m, double time_s) {
        scene_.draw({.position_m = {x_m, 520, 100}, .target_m = {x_m, 0, 0}, .vertical_view_rad = 1.047}, time_s);
        const std::vector<float> rgba = scene_.target->read_radiance();
        std::pair<double, double> sums;
        constexpr int middle = shadow_pixels / 2, apart = shadow_pixels / 12;
        for (int y = 0; y < shadow_pixels; ++y)
            for (int x = 0; x < shadow_pixels; ++x) {
                const auto green = static_cast<double>(rgba[4 * static_cast<std::size_t>(y * shadow_pixels + x) + 1]);
                // The eye looks towards -z, so +x is to the right.
                if (x < middle - apart) sums.first += green;
                if (x >= middle + apart) sums.second += green;
            }
        return sums;
    }

    GlScene scene_{{.quality = "low",
                    .resolution = 64,
                    .width = shadow_pixels,
                    .height = shadow_pixels,
                    .samples = 0,
                    .writes = gl::PixelKind::radiance,
                    .wind_speed_mps = 8}};
};

// Water without sunlight is black here, and the renderer's value for meshes agrees with the sea.
TEST_F(GlCloudShadow, WaterIsDarkWhereTheMapIsDark) {
    scene_.renderer->set_sky(half_shaded_sky());
    const auto [west, east] = west_and_east(0, 0);
    EXPECT_GT(east, 0);
    EXPECT_LT(west, 1e-3 * east);
    EXPECT_EQ(scene_.renderer->sunlit_at({-200, 0}), 0);
    EXPECT_EQ(scene_.renderer->sunlit_at({200, 0}), 1);
    EXPECT_NEAR(scene_.renderer->sunlit_at({0, 0}), 0.5f, 1e-6f);
}

// A sky of an application may have no map: then its sunlight is everywhere.
TEST_F(GlCloudShadow, SkyWithoutAMapShinesEverywhere) {
    gl::Sky sky = half_shaded_sky();
    sky.cloud_shadows.texels.clear();
    sky.brightest_transmittance = 0;
    scene_.renderer->set_sky(sky);
    const auto [west, east] = west_and_east(0, 0);
    EXPECT_GT(west, 0.5 * east);
    EXPECT_EQ(scene_.renderer->sunlit_at({-200, 0}), 1);
}

// At 8 m/s towards +x the edge of the shadow moves 10 m/s: it is at x = 1000 m after 100 s. The
// bound is the width of the middle that is left out, 50 m to each side.
TEST_F(GlCloudShadow, MovesWithTheWind) {
    scene_.renderer->set_sky(half_shaded_sky());
    const double moved = gl::cloud_drift(scene_.ocean.frame_at(0).sea, 100).x;
    EXPECT_NEAR(moved / (8 * 100), 1.2, 0.3);  // whole periods in a loop of an hour
    const auto [west, east] = west_and_east(moved, 100);
    EXPECT_GT(east, 0);
    EXPECT_LT(west, 1e-3 * east);
    EXPECT_EQ(scene_.renderer->sunlit_at({moved - 200, 0}), 0);
}

// A shift of the world's origin by 3 km moves the edge of the shadow with the water.
TEST_F(GlCloudShadow, KeepsItsPlaceWhenTheOriginShifts) {
    scene_.renderer->set_sky(half_shaded_sky());
    scene_.ocean.set_origin(3000, -1e6);
    const auto [west, east] = west_and_east(-3000, 0);
    EXPECT_GT(east, 0);
    EXPECT_LT(west, 1e-3 * east);
    EXPECT_EQ(scene_.renderer->sunlit_at({-3200, 0}), 0);
    EXPECT_EQ(scene_.renderer->sunlit_at({-2800, 0}), 1);
}

// Light that water scatters comes from near the viewer, so all pixels have that of a sky without a map, if
// the viewer is in sunlight, also where surface, floor and background behind the water are in shadow.
TEST(GlCloudShadowUnderWater, WaterIsLitAsTheSeaAtTheViewer) {
    GlScene scene({.quality = "low",
                   .resolution = 64,
                   .width = shadow_pixels,
                   .height = shadow_pixels,
                   .samples = 0,
                   .writes = gl::PixelKind::radiance,
                   .wind_speed_mps = 8,
                   .lens_may_dip = true});
    const auto towards_shadow = [&](const gl::Sky& sky) {
        scene.renderer->set_sky(sky);
        scene.draw({.position_m = {200, -20, 0}, .target_m = {0, -70, 0}, .vertical_view_rad = 1.047}, 0);
        return scene.target->read_radiance();
    };
    gl::Sky sky = half_shaded_sky();
    const std::vector<float> shaded = towards_shadow(sky);
    sky.cloud_shadows.texels.clear();
    sky.brightest_transmittance = 0;
    const std::vector<float> sunny = towards_shadow(sky);
    for (std::size_t i = 1; i < sunny.size(); i += 4) {
        ASSERT_GT(sunny[i], 0);
        ASSERT_NEAR(shaded[i] / sunny[i], 1, 0.01) << "pixel " << i / 4;
    }
}

// The disc is as bright as the clouds in front of it let through, relative to the brightest place.
TEST_F(GlCloudShadow, DiscLiesBehindClouds) {
    gl::Sky sky = half_shaded_sky();
    sky.sun_direction = glm::normalize(glm::vec3(1, 0.5f, 0));
    const auto disc = [&](float transmittance, float brightest) {
        sky.brightest_transmittance = brightest;
        for (std::size_t i = 3; i < sky.texels.size(); i += 4) sky.texels[i] = glm::packHalf1x16(transmittance);
        scene_.renderer->set_sky(sky);
        scene_.draw({.position_m = {0, 10, 0},
                     .target_m = glm::dvec3(0, 10, 0) + 100.0 * glm::dvec3(sky.sun_direction),
                     .vertical_view_rad = 0.01},
                    0);
        return scene_.target->read_radiance()[4 * (shadow_pixels / 2 * shadow_pixels + shadow_pixels / 2) + 1];
    };
    const float clear = disc(1, 1);
    EXPECT_GT(clear, 1e3f);  // irradiance 1 over a solid angle of 6.8e-5
    EXPECT_EQ(disc(0, 1), 0);
    EXPECT_NEAR(disc(0.25f, 1) / clear, 0.25f, 1e-3f);
    EXPECT_NEAR(disc(0.25f, 0.5f) / clear, 0.5f, 1e-3f);
}

}  // namespace
}  // namespace pelagic
