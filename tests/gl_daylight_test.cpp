// A sea by day has the brightness of day, and a moonlit sea that of night, in every view direction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
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

/// A gale from 6 m under a light preset, as `pelagic render` shows it, with the surface of each pixel.
class GlGale : public testing::Test {
   protected:
    static constexpr int width = 480, height = 270;
    struct Pixel {
        double shown = 0;         ///< luminance of the image as an sRGB value, [0, 255]
        bool is_clipped = false;  ///< a channel is at least 250 of 255
        double luminance = 0;     ///< of the radiance
        double distance_m = 0, foam = 0;
        glm::dvec2 place_m{}, slopes{};  ///< slopes of the unit normal; the sky has the distance 0
        glm::dvec3 ray{};
    };
    /// \param azimuth_rad  direction of the view
    std::vector<Pixel> view(const gl::LightPreset& preset, double azimuth_rad) {
        gl::SkyBaker baker(make_default_executor(), 128);
        baker.schedule(preset.sky);
        const gl::Sky& sky = baker.complete();
        scene_.renderer->set_sky(sky);
        const Camera camera{.position_m = {0, 6, 0},
                            .target_m = {60 * std::cos(azimuth_rad), 0, 60 * std::sin(azimuth_rad)}};
        const gl::Eye eye = gl::eye_of(camera, {0, 0, width, height});
        const Frame frame = scene_.ocean.frame_at(0);
        data_.clear();
        scene_.pass->upload(frame);
        scene_.pass->draw({.eyes = {&eye, 1}, .mode = gl::DrawMode::surface_data});
        const std::vector<float> data = data_.read_radiance();
        scene_.draw(camera, frame);
        const std::vector<float> radiance = scene_.target->read_radiance();
        const gl::TexturePart image = scene_.target->resolved();
        const float unit = sky.luminance_of_unit();
        const float ev = gl::metered_ev(meter_.measure(image), unit) - preset.bias_stops;
        screen_.bind();
        display_.show(image, {.exposure = gl::exposure_of_ev(ev, unit), .luminance_of_unit = unit},
                      {0, 0, width, height});
        const std::vector<std::uint8_t> shown = screen_.read();
        const glm::dmat4 world_from_clip = glm::inverse(eye.clip_from_world);
        std::vector<Pixel> pixels;
        for (std::size_t i = 0; i < shown.size() / 4; ++i) {
            const auto rgb = [&](const auto& texels) {
                return glm::dot(glm::dvec3(texels[4 * i], texels[4 * i + 1], texels[4 * i + 2]),
                                glm::dvec3(0.2126, 0.7152, 0.0722));
            };
            const double x = (static_cast<double>(i % width) + 0.5) / width;
            const double y = (static_cast<double>(i / width) + 0.5) / height;
            const glm::dvec4 point = world_from_clip * glm::dvec4(2 * x - 1, 1 - 2 * y, 0.5, 1);
            const glm::dvec3 ray = glm::normalize(glm::dvec3(point) / point.w - camera.position_m);
            const double distance_m = data[4 * i];
            pixels.push_back({.shown = rgb(shown),
                              .is_clipped = std::max({shown[4 * i], shown[4 * i + 1], shown[4 * i + 2]}) >= 250,
                              .luminance = rgb(radiance),
                              .distance_m = distance_m,
                              .foam = data[4 * i + 3],
                              .place_m = distance_m * glm::dvec2(ray.x, ray.z),
                              .slopes = {data[4 * i + 1], data[4 * i + 2]},
                              .ray = ray});
        }
        return pixels;
    }

    GlScene scene_{{.preset = "beaufort-8",
                    .quality = "medium",
                    .width = width,
                    .height = height,
                    .samples = 0,
                    .writes = gl::PixelKind::radiance,
                    .foam = true}};
    gl::RenderTarget data_{scene_.gl(), width, height, 0, gl::PixelKind::data};
    gl::Display display_{scene_.gl()};
    gl::LightMeter meter_{scene_.gl()};
    gl::RenderTarget screen_{scene_.gl(), width, height, 0};
};

double quantile(std::vector<double> values, double fraction) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1))];
}

// Bounds of a look-development review: in the storm the brightest tenth of closed foam is above sRGB
// 200.
TEST_F(GlGale, FoamOfAStormIsWhite) {
    std::vector<double> foam;
    for (const Pixel& pixel : view(*gl::light_preset_named("storm"), 0.785))
        if (pixel.foam > 0.9 && pixel.distance_m > 5 && pixel.distance_m < 150) foam.push_back(pixel.shown);
    ASSERT_GT(foam.size(), 1000u);
    std::printf("foam of a storm: sRGB %.0f, brightest tenth from %.0f\n", quantile(foam, 0.5), quantile(foam, 0.9));
    EXPECT_GT(quantile(foam, 0.9), 200);
}

// With the sun in the image, at most 3 % of the sky is white, a bound of the same review. The disc
// and its rim, two radii wide, are left out.
TEST_F(GlGale, SkyAroundTheSunIsNotClipped) {
    const gl::LightPreset& preset = *gl::light_preset_named("golden-hour");
    const glm::dvec3 sun(gl::sun_direction(preset.sky));
    double clipped = 0, sky = 0;
    for (const Pixel& pixel : view(preset, preset.sky.sun_azimuth_rad)) {
        if (pixel.distance_m > 0 || glm::dot(pixel.ray, sun) > std::cos(2 * 0.00465)) continue;
        clipped += pixel.is_clipped;
        ++sky;
    }
    std::printf("sky around the sun: %.2f %% clipped\n", 100 * clipped / sky);
    ASSERT_GT(sky, 20000);
    EXPECT_LT(clipped / sky, 0.03);
}

// Sides of waves of 30 m and more towards the light and away from it differ by at least half a stop,
// a bound of the same review: from 6 m the shape of waves must be visible. The slopes are means over
// 15 m, half of the shortest of these waves. Without sunlight on the water they differ by 0.47 stops.
TEST_F(GlGale, SidesOfLongWavesDiffer) {
    const gl::LightPreset& preset = *gl::light_preset_named("storm");
    const double azimuth = preset.sky.sun_azimuth_rad;
    const std::vector<Pixel> pixels = view(preset, azimuth);
    constexpr double cell_m = 5;
    const auto is_near = [](const Pixel& pixel) { return pixel.distance_m > 12 && pixel.distance_m < 200; };
    const auto cell_of = [](const Pixel& pixel) { return glm::ivec2(glm::floor(pixel.place_m / cell_m)); };
    struct Sum {
        glm::dvec2 slopes{};
        double weight = 0;
    };
    std::map<std::pair<int, int>, Sum> cells;
    for (const Pixel& pixel : pixels) {
        if (!is_near(pixel)) continue;
        // A pixel's area on the level sea.
        const double weight = std::pow(pixel.distance_m, 3);
        const glm::ivec2 cell = cell_of(pixel);
        for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j) {
                Sum& sum = cells[{cell.x + i, cell.y + j}];
                sum.slopes += weight * pixel.slopes;
                sum.weight += weight;
            }
    }
    double towards = 0, away = 0;
    int towards_count = 0, away_count = 0;
    for (const Pixel& pixel : pixels) {
        if (!is_near(pixel) || pixel.foam > 0.05) continue;
        const glm::ivec2 cell = cell_of(pixel);
        const Sum& sum = cells[{cell.x, cell.y}];
        const double slope = glm::dot(sum.slopes / sum.weight, glm::dvec2(std::cos(azimuth), std::sin(azimuth)));
        if (slope > 0.03) towards += pixel.luminance, ++towards_count;
        if (slope < -0.03) away += pixel.luminance, ++away_count;
    }
    ASSERT_GT(std::min(towards_count, away_count), 500);
    const double stops = std::log2(towards / towards_count / (away / away_count));
    std::printf("sides of long waves: %.2f stops towards the light\n", stops);
    EXPECT_GT(std::abs(stops), 0.5);
}

}  // namespace
}  // namespace pelagic
