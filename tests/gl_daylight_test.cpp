// A sea by day has the brightness of day, and a moonlit sea that of night, in every view direction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "pelagic/gl/display.hpp"
#include "pelagic/gl/light_meter.hpp"
#include "pelagic/gl/sky/light_presets.hpp"
#include "pelagic/tests/gl_scene.hpp"
#include "pelagic/tests/sweep.hpp"

namespace pelagic {
namespace {

constexpr int daylight_width = 96, daylight_height = 54;

class GlDaylight : public testing::Test {
   protected:
    void set_sky(const gl::SkyOptions& options) {
        baker_.schedule(options);
        const gl::Sky& sky = baker_.complete();
        luminance_of_unit_ = sky.luminance_of_unit();
        scene_.renderer->set_sky(sky);
    }
    /// Returns the luminances that `pelagic render` shows, in [0, 1], sorted.
    std::vector<float> shown(const Camera& camera, double time_s) {
        scene_.draw(camera, time_s);
        const gl::TexturePart radiance = scene_.target->resolved();
        const float ev = gl::metered_ev(meter_.measure(radiance), luminance_of_unit_);
        screen_.bind();
        display_.show(
            radiance,
            {.exposure = gl::exposure_of_ev(ev, luminance_of_unit_), .luminance_of_unit = luminance_of_unit_},
            {0, 0, daylight_width, daylight_height});
        const auto rgba = screen_.read();
        std::vector<float> luminances;
        for (std::size_t i = 0; i < rgba.size(); i += 4)
            luminances.push_back(0.2126f * linear_of(rgba[i]) + 0.7152f * linear_of(rgba[i + 1]) +
                                 0.0722f * linear_of(rgba[i + 2]));
        std::sort(luminances.begin(), luminances.end());
        return luminances;
    }

    GlScene scene_{{.quality = "low",
                    .resolution = 64,
                    .width = daylight_width,
                    .height = daylight_height,
                    .samples = 0,
                    .writes = gl::PixelKind::radiance}};
    gl::Display display_{scene_.gl()};
    gl::LightMeter meter_{scene_.gl()};
    gl::RenderTarget screen_{scene_.gl(), daylight_width, daylight_height, 0};
    gl::SkyBaker baker_{make_default_executor(), 32};
    float luminance_of_unit_ = 1;
};

/// Views from just above the crests to 1500 m, in all directions except straight down and up.
Camera somewhere(std::minstd_rand& random) {
    const double metres = 4 + 1500 * std::pow(uniform(random), 5);
    const glm::dvec3 at(3000 * uniform(random), metres, 3000 * uniform(random));
    const double azimuth = 6.283 * uniform(random), down = (uniform(random) - 0.3) * 1.4;
    return {.position_m = at,
            .target_m = at + 50.0 * glm::dvec3(std::cos(azimuth) * std::cos(down), -std::sin(down),
                                               std::sin(azimuth) * std::cos(down)),
            .vertical_view_rad = 0.5 + uniform(random)};
}

// 20 views in the quick run, 200 at night; four views share a sky.
TEST_F(GlDaylight, NothingIsBlack) {
    std::minstd_rand random(7);
    for (int i = 0; i < of_sweep(20, 200); ++i) {
        if (i % 4 == 0)
            set_sky({.sun_azimuth_rad = static_cast<float>(6.283 * uniform(random)),
                     .sun_elevation_rad = static_cast<float>(0.1 + 1.3 * uniform(random)),
                     .cloud_cover = static_cast<float>(uniform(random)),
                     .visibility_m = static_cast<float>(5e3 + 60e3 * uniform(random))});
        const std::vector<float> luminances = shown(somewhere(random), i);
        EXPECT_GE(luminances[luminances.size() / 2], 0.05f) << "view " << i;
        // The image is not overexposed either: at most a tenth of it may be white.
        EXPECT_LE(luminances[luminances.size() * 9 / 10], 0.98f) << "view " << i;
    }
}

// The image is dark but not black, and the moon's glint path is bright.
TEST_F(GlDaylight, MoonlitSeaIsDarkWithABrightPath) {
    set_sky(gl::light_preset_named("moonlight")->sky);
    const std::vector<float> luminances = shown({.position_m = {0, 8, 0}, .target_m = {60, 0, 60}}, 0);
    EXPECT_GE(luminances[luminances.size() / 2], 0.005f);
    EXPECT_LE(luminances[luminances.size() / 2], 0.06f);
    EXPECT_GE(luminances[luminances.size() * 98 / 100], 0.2f);
}

TEST_F(GlDaylight, SeaIsVisibleUnderStarsAlone) {
    set_sky({.sun_elevation_rad = -1, .cloud_cover = 0, .places_moon = true, .moon_elevation_rad = -1});
    const std::vector<float> luminances = shown({.position_m = {0, 8, 0}, .target_m = {60, 0, 60}}, 0);
    EXPECT_GE(luminances[luminances.size() / 20], 0.001f);  // three steps of 8 bits
}

}  // namespace
}  // namespace pelagic
