// Rendering below the surface: the floor through the water, Snell's window, the waterline across
// the lens. The light is black except for one source, so that the source of each pixel's light is
// known.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/gtc/packing.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "pelagic/gl/headless_context.hpp"
#include "pelagic/gl/water/sea_renderer.hpp"
#include "pelagic/gl/water/water_optics.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/gl_scene.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;
constexpr double water_index = 1.333;

/// Sets sunlight straight down from a black sky.
gl::Sky only_sun() {
    gl::Sky sky = even_sky(0);
    sky.sun_irradiance = glm::vec3(1);
    return sky;
}

/// Draws radiance with one sample a pixel.
class BelowScene {
   public:
    explicit BelowScene(const std::string& preset, int width = 96, int height = 64)
        : ocean_(sea_preset_named(preset)->sea, {.queries = true, .slopes = true}),
          selection_(quadtree_preset_named("low")->options(1024)),
          target_(context_.functions(), width, height, 1, gl::PixelKind::radiance),
          renderer(context_.functions(), {.resolution = ocean_.resolution(),
                                          .cascades = ocean_.cascade_count(),
                                          .writes = gl::PixelKind::radiance}) {}

    const Frame& frame_at(double time_s) { return ocean_.frame_at(time_s); }

    /// Returns the sea without wind: level, and smooth except for the minimum roughness of a
    /// mirror.
    const Frame& level_frame(double depth_m) {
        level_ = ocean_.frame_at(0);
        level_.sea.depth_m = depth_m;
        level_.statistics.roughness = 0.01;
        level_.bounds = {};
        const std::size_t n = static_cast<std::size_t>(ocean_.resolution());
        zeros_.assign(4 * n * n, 0);
        plane_.assign(n * n, 0);
        slopes_.assign(mip_offset(ocean_.resolution(), mip_levels(ocean_.resolution())), 0x80808080u);
        moments_.assign(slopes_.size(), 0x80000080u);
        cascades_.assign(level_.cascades.begin(), level_.cascades.end());
        for (Cascade& cascade : cascades_) {
            const PlaneView plane{plane_.data(), ocean_.resolution(), ocean_.resolution(), ocean_.resolution(), 0};
            cascade.dx = cascade.height = cascade.dz = plane;
            cascade.displacement_rgba16f = zeros_;
            cascade.slopes_rgba8 = slopes_;
            cascade.moments_rgba8 = moments_;
        }
        level_.cascades = cascades_;
        return level_;
    }

    /// \param water  if empty, the lens is in the air
    std::vector<float> image(const Camera& camera, const Frame& frame, std::optional<gl::CameraWaterPlane> water,
                             bool draws_sky = true) {
        const gl::Eye eye = gl::eye_of(camera, {0, 0, target_.width(), target_.height()});
        const DrawList& list = selection_.select(
            {.viewer_m = camera.position_m, .views = {&eye.clip_from_world, 1}, .bounds = frame.bounds});
        target_.clear({1000, 0, 1000});  // magenta, brighter than all light
        renderer.upload(frame);
        renderer.draw({.eyes = {&eye, 1},
                       .viewer_m = camera.position_m,
                       .list = &list,
                       .draws_sky = draws_sky,
                       .camera_water_plane = water});
        return target_.read_radiance();
    }
    double green(const std::vector<float>& pixels, int x, int y) const {
        return static_cast<double>(pixels[4 * static_cast<std::size_t>(y * target_.width() + x) + 1]);
    }
    double middle(const std::vector<float>& pixels) const { return green(pixels, width() / 2, height() / 2); }
    int width() const { return target_.width(); }
    int height() const { return target_.height(); }

    /// Returns the attenuation coefficient of green light in the default water, 1/m.
    static double attenuation() {
        return static_cast<double>(gl::water_optics(gl::default_jerlov_type).attenuation_per_m().y);
    }

   private:
    gl::HeadlessContext context_{{.debug = true}};
    Ocean ocean_;
    Selection selection_;
    gl::RenderTarget target_;
    Frame level_;
    std::vector<Cascade> cascades_;
    std::vector<std::uint16_t> zeros_;
    std::vector<float> plane_;
    std::vector<std::uint32_t> slopes_, moments_;

   public:
    gl::SeaRenderer renderer;
};

// Total internal reflection begins at asin(1 / n) = 48.6 degrees at any depth.
TEST(UnderWater, SnellsWindowHasTheCriticalAngleAndNoSkyIsOutsideIt) {
    constexpr double view_rad = 2.3, inner = (48.6 - 1.5) * pi / 180, outer = (48.6 + 1.5) * pi / 180, depth_m = 5;
    BelowScene scene("calm", 240, 240);
    scene.renderer.set_sky(even_sky(100));
    const Frame& frame = scene.level_frame(4000);
    const auto pixels = scene.image({{0, -depth_m, 0}, {0, 0, 0}, view_rad}, frame, gl::CameraWaterPlane{});
    const double k = BelowScene::attenuation();
    int within = 0, beside = 0;
    for (int y = 0; y < scene.height(); ++y)
        for (int x = 0; x < scene.width(); ++x) {
            const double scale = std::tan(view_rad / 2) / (scene.height() / 2.0);
            const double angle =
                std::atan(std::hypot(x + 0.5 - scene.width() / 2.0, y + 0.5 - scene.height() / 2.0) * scale);
            const double light = scene.green(pixels, x, y);
            if (angle < inner) {
                // Light through the surface is scaled by n^2 and attenuated by the water. The bound
                // is the fraction at 47 degrees, where 0.65 is transmitted.
                EXPECT_GT(light, 0.5 * 100 * water_index * water_index * std::exp(-k * depth_m / std::cos(angle)))
                    << x << ", " << y;
                ++within;
            } else if (angle > outer) {
                EXPECT_LT(light, 0.01) << x << ", " << y;
                ++beside;
            }
        }
    EXPECT_GT(within, 500);
    EXPECT_GT(beside, 500);
    const double straight_up = 100 * water_index * water_index * (1 - 0.0204) * std::exp(-k * depth_m);
    // Half floats of radiance and of the sky have a precision of 1e-3.
    EXPECT_NEAR(scene.middle(pixels), straight_up, 0.005 * straight_up);
}

/// Greens of an image, and of one with more pixels a side that is averaged to the same size.
struct Supersampled {
    int width = 0, height = 0;
    std::vector<double> once, often;
};

Supersampled window_of(const std::string& preset, const Camera& camera, double time_s, int times) {
    Supersampled pair{96, 72, {}, {}};
    for (const int scale : {1, times}) {
        BelowScene scene(preset, pair.width * scale, pair.height * scale);
        scene.renderer.set_sky(even_sky(1));
        const Frame& frame = scene.frame_at(time_s);
        const auto pixels = scene.image(camera, frame, gl::CameraWaterPlane{});
        std::vector<double>& means = scale == 1 ? pair.once : pair.often;
        means.assign(static_cast<std::size_t>(pair.width * pair.height), 0);
        for (int y = 0; y < scene.height(); ++y)
            for (int x = 0; x < scene.width(); ++x)
                means[static_cast<std::size_t>(y / scale * pair.width + x / scale)] +=
                    scene.green(pixels, x, y) / (scale * scale);
    }
    return pair;
}

// The edge of Snell's window is sharp, and waves bend it. An image with one sample a pixel is as
// smooth as the mean of 16 samples a pixel: it has no steps of a few brightnesses and no squares of
// 2 x 2 pixels, as derivatives between pixels would draw.
TEST(UnderWater, SnellsWindowHasSmoothEdges) {
    for (const char* preset : {"calm", "moderate"}) {
        const Supersampled window = window_of(preset, {{0, -4, 0}, {4, -0.6, 3}, 1.2}, 3, 4);
        double difference = 0, mean = 0, jumps = 0, expected_jumps = 0;
        std::array<double, 2> by_parity{};
        for (int y = 0; y < window.height; ++y)
            for (int x = 0; x + 1 < window.width; ++x) {
                const auto i = static_cast<std::size_t>(y * window.width + x);
                const double jump = std::abs(window.once[i + 1] - window.once[i]);
                jumps += jump;
                by_parity[static_cast<std::size_t>(x % 2)] += jump;
                expected_jumps += std::abs(window.often[i + 1] - window.often[i]);
                difference += std::abs(window.once[i] - window.often[i]);
                mean += window.often[i];
            }
        std::printf("%s: differs by %.3f of the mean, jumps %.2f of those of 16 samples, between squares %.2f\n",
                    preset, difference / mean, jumps / expected_jumps, by_parity[1] / by_parity[0]);
        // Samples of the transmittance at three facets of a pixel differ by 0.06 of the mean.
        EXPECT_LT(difference, 0.05 * mean) << preset;
        EXPECT_LT(jumps, 1.3 * expected_jumps) << preset;
        EXPECT_GT(jumps, 0.7 * expected_jumps) << preset << ": blurred";
        EXPECT_NEAR(by_parity[1] / by_parity[0], 1, 0.08) << preset;
    }
}

// Sunlight is attenuated by exp(-k d) on its path down and again on its path up. The difference
// between a white and a black floor contains only light from the floor. Without waves caustics are
// uniform.
TEST(UnderWater, FloorIsAttenuatedOnThePathDownAndUp) {
    BelowScene scene("calm", 32, 32);
    scene.renderer.set_sky(only_sun());
    const double k = BelowScene::attenuation();
    gl::CausticsBaker baker(make_serial_executor());
    std::vector<double> let_in;
    for (const double depth_m : {2.0, 5.0, 15.0}) {
        const Frame& frame = scene.level_frame(depth_m);
        baker.schedule(frame, {});
        scene.renderer.set_caustics(baker.complete());
        const auto floor_of = [&](const Camera& camera, std::optional<gl::CameraWaterPlane> water) {
            std::array<double, 2> light{};
            for (const float albedo : {0.f, 1.f}) {
                scene.renderer.set_floor({.is_sand = false, .albedo = glm::vec3(albedo)});
                light[albedo > 0] = scene.middle(scene.image(camera, frame, water));
            }
            return light[1] - light[0];
        };
        // From a metre below the surface. The surface transmits Fresnel's 0.98 of the sun's 1.
        const double from_water = floor_of({{0, -1, 0}, {0, -9, 0}, 0.3}, gl::CameraWaterPlane{});
        const double below = 0.98 / pi * std::exp(-k * (depth_m + depth_m - 1));
        EXPECT_NEAR(from_water, below, 0.01 * below) << depth_m;
        // From the air, beside the sun's mirror image, at a slant: at 40 degrees from the vertical
        // the refracted path is 1 / cos(28.8 degrees) as long.
        for (const double angle : {10 * pi / 180, 40 * pi / 180}) {
            const double from_air = floor_of({{0, 5, 0}, {5 * std::tan(angle), 0, 0}, 0.3}, std::nullopt);
            const double in_water = std::asin(std::sin(angle) / water_index);
            const double through = std::exp(-k * depth_m * (1 + 1 / std::cos(in_water)));
            let_in.push_back(from_air / through);
        }
    }
    // The surface's transmittance depends on the angle alone: 0.98 / n^2 of 0.98 / pi; the slanted
    // ray loses 2.6 %.
    for (std::size_t i = 0; i < let_in.size(); i += 2) {
        EXPECT_NEAR(let_in[i], 0.98 * 0.98 / (water_index * water_index * pi), 0.01 * let_in[0]) << i;
        EXPECT_NEAR(let_in[i + 1], let_in[i], 0.02 * let_in[0]) << i;
    }
}

/// Returns the caustics on a level floor, relative to their mean, as seen straight down from high
/// above through level water. Pixels are `pixel_m` wide.
std::vector<double> light_on_floor(BelowScene& scene, const gl::Caustics& caustics, double pixel_m) {
    const double height_m = 600, half_m = 0.5 * pixel_m * scene.width();
    const Frame& frame = scene.level_frame(caustics.options.depth_m);
    gl::CausticsBaker baker(make_serial_executor());
    baker.schedule(frame, caustics.options);
    const gl::Caustics uniform = baker.complete();
    std::array<std::vector<double>, 3> images;
    for (std::size_t i = 0; i < images.size(); ++i) {
        scene.renderer.set_floor({.is_sand = false, .albedo = glm::vec3(i == 0 ? 0 : 1)});
        scene.renderer.set_caustics(i == 2 ? caustics : uniform);
        const auto pixels =
            scene.image({{0, height_m, 0}, {0, 0, 0}, 2 * std::atan(half_m / height_m)}, frame, std::nullopt, false);
        for (int y = 0; y < scene.height(); ++y)
            for (int x = 0; x < scene.width(); ++x) images[i].push_back(scene.green(pixels, x, y));
    }
    std::vector<double> light;
    for (std::size_t i = 0; i < images[0].size(); ++i)
        light.push_back((images[2][i] - images[0][i]) / (images[1][i] - images[0][i]));
    return light;
}

// The texture of the caustics has the period of a cascade. A floor of ten periods shows no period,
// and its light has the mean and the variance of the texture.
TEST(UnderWater, CausticsOnAFloorDoNotRepeat) {
    constexpr int pixels = 160, per_period = 16;
    BelowScene scene("moderate", pixels, pixels);
    scene.renderer.set_sky(only_sun());
    gl::CausticsBaker baker(make_default_executor());
    baker.schedule(scene.frame_at(0), {.depth_m = 5});
    const gl::Caustics caustics = baker.complete();
    const std::vector<double> light = light_on_floor(scene, caustics, caustics.grid.side_m / per_period);

    double mean = 0, variance = 0;
    for (const double value : light) mean += value / static_cast<double>(light.size());
    for (const double value : light) variance += (value - mean) * (value - mean) / static_cast<double>(light.size());
    // Variance of level 4 of the texture, 16 x 16 texels, interpolated between texels.
    std::size_t first = 0;
    for (int level = 0; level < 4; ++level)
        first += std::size_t(gl::Caustics::side >> level) * (gl::Caustics::side >> level);
    const auto texel = [&](int i, int j) {
        return static_cast<double>(
                   glm::unpackHalf1x16(caustics.halves[first + static_cast<std::size_t>(j % 16 * 16 + i % 16)])) -
               1;
    };
    double expected = 0;
    constexpr int steps = 8;
    for (int j = 0; j < 16 * steps; ++j)
        for (int i = 0; i < 16 * steps; ++i) {
            const int x = i / steps, y = j / steps;
            const double u = i % steps / double{steps}, v = j % steps / double{steps};
            expected += std::pow(std::lerp(std::lerp(texel(x, y), texel(x + 1, y), u),
                                           std::lerp(texel(x, y + 1), texel(x + 1, y + 1), u), v),
                                 2);
        }
    expected /= std::pow(16 * steps, 2);

    double highest = 0;
    for (int j = 0; j <= per_period * 3 / 2; ++j)
        for (int i = -per_period * 3 / 2; i <= per_period * 3 / 2; ++i) {
            const double periods = std::hypot(i, j) / per_period;
            if (periods < 0.8 || periods > 1.45) continue;
            double sum = 0;
            int count = 0;
            for (int y = 0; y + j < pixels; ++y)
                for (int x = std::max(0, -i); x < pixels - std::max(0, i); ++x, ++count)
                    sum += (light[static_cast<std::size_t>(y * pixels + x)] - mean) *
                           (light[static_cast<std::size_t>((y + j) * pixels + x + i)] - mean);
            highest = std::max(highest, sum / count / variance);
        }
    std::printf("mean %.4f, variance %.4f of %.4f, highest autocorrelation about a period %.3f\n", mean, variance,
                expected, highest);
    EXPECT_NEAR(mean, 1, 0.02);
    // The roughness of the surface widens the pixel, which lowers the variance to 0.65. So it does
    // for a single copy.
    EXPECT_GT(variance, 0.5 * expected);
    EXPECT_LT(variance, 1.25 * expected);
    EXPECT_LT(highest, 0.3);
}

// From below, a level surface reflects totally at a slant, so all light there comes from the water
// and decreases with depth.
TEST(UnderWater, RadianceFallsWithDepthAndRisesUpwards) {
    BelowScene scene("calm", 32, 32);
    scene.renderer.set_sky(only_sun());
    const Frame& frame = scene.level_frame(4000);
    const double k = BelowScene::attenuation();
    gl::CausticsBaker baker(make_serial_executor());
    baker.schedule(frame, {});
    scene.renderer.set_caustics(baker.complete());
    const auto seen = [&](double depth_m, glm::dvec3 ahead) {
        const glm::dvec3 at(0, -depth_m, 0);
        return scene.middle(scene.image({at, at + ahead, 0.2}, frame, gl::CameraWaterPlane{}));
    };
    // Straight down and level, all light comes from the same water, which gets thicker.
    for (const glm::dvec3 ahead : {glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0)})
        EXPECT_NEAR(seen(20, ahead) / seen(5, ahead), std::exp(-k * 15), 0.02 * std::exp(-k * 15));
    EXPECT_GT(seen(20, {1, 0.5, 0}), 1.5 * seen(20, {1, 0, 0}));
    EXPECT_GT(seen(20, {1, 0, 0}), 1.5 * seen(20, {0, -1, 0}));
}

// The sky is bright and the water has no light. Pixels of the lens below the queried water plane
// are black, and pixels above it are not. The view is level, where the surface seen from below
// reflects totally.
TEST(UnderWater, WaterlineOnTheLensMatchesTheQueryWithoutHoles) {
    BelowScene scene("calm", 120, 80);
    scene.renderer.set_sky(even_sky(100));
    for (int i = 0; i < 4; ++i) {
        const Frame& frame = scene.frame_at(2.0 * i);
        glm::dvec3 at(17.0 * i, 0, -9.0 * i);
        const SurfaceQuery query(frame);
        at.y = gl::camera_water_plane(query, at).height_m + 0.004 * (i - 1.5);
        const gl::CameraWaterPlane water = gl::camera_water_plane(query, at);
        const Camera camera{at, at + glm::dvec3(std::cos(i), 0, std::sin(i)), 1.0};
        const auto pixels = scene.image(camera, frame, water, i % 2 == 0);
        const glm::dmat4 world_from_clip = glm::inverse(camera.clip_from_world(1.5));
        int wet = 0, dry = 0, wrong = 0, holes = 0;
        for (int y = 0; y < scene.height(); ++y)
            for (int x = 0; x < scene.width(); ++x) {
                const glm::dvec4 point = world_from_clip * glm::dvec4((x + 0.5) / scene.width() * 2 - 1,
                                                                      1 - (y + 0.5) / scene.height() * 2, -1, 1);
                const glm::dvec3 on_lens = glm::dvec3(point) / point.w;
                const double above = on_lens.y - water.height_m - water.slope.x * (on_lens.x - at.x) -
                                     water.slope.y * (on_lens.z - at.z);
                const double light = scene.green(pixels, x, y);
                const float* rgba = &pixels[4 * static_cast<std::size_t>(y * scene.width() + x)];
                if (i % 2 == 0 || above < 0) holes += rgba[0] >= 999;
                // The meniscus is a darker rim of 3 mm; holes where the application draws the sky
                // count as neither.
                if (std::abs(above) < 0.003 || rgba[0] >= 999) continue;
                (above < 0 ? wet : dry) += 1;
                wrong += (above < 0) != (light < 0.3);
            }
        EXPECT_EQ(holes, 0) << i;
        EXPECT_GT(wet, 500) << i;
        EXPECT_GE(dry, i % 2 == 0 ? 500 : 0) << i;
        // A near wave shows its steep side to both.
        EXPECT_LE(wrong, (wet + dry) / 50) << i << ": of " << wet << " wet and " << dry << " dry";
    }
}

// Within Snell's window the view up shows only the sky; a seam between patches would show black
// water.
TEST(UnderWater, SurfaceHasNoHolesFromBelow) {
    BelowScene scene("moderate", 160, 120);
    scene.renderer.set_sky(even_sky(1000));
    for (int i = 0; i < (is_sanitized ? 2 : 5); ++i) {
        const glm::dvec3 at(130.7 * i, -2 - 20 * i, -71.3 * i);
        const auto pixels =
            scene.image({at, at + glm::dvec3(0.02, 1, 0), 0.6}, scene.frame_at(i), gl::CameraWaterPlane{});
        int holes = 0;
        for (int y = 0; y < scene.height(); ++y)
            for (int x = 0; x < scene.width(); ++x) holes += !(scene.green(pixels, x, y) > 0.02);
        EXPECT_EQ(holes, 0) << at.y;
    }
}

TEST(UnderWater, EveryPixelIsFiniteAndNotNegative) {
    BelowScene scene("rough", 64, 48);
    gl::SkyBaker skies(make_default_executor(), 16);
    gl::CausticsBaker baker(make_default_executor());
    std::minstd_rand random(5);
    const auto uniform = [&] { return static_cast<double>(random()) / 2147483647.0; };
    for (int i = 0; i < (is_sanitized ? 8 : 24); ++i) {
        const gl::SkyOptions options{.sun_azimuth_rad = static_cast<float>(6 * uniform()),
                                     .sun_elevation_rad = static_cast<float>(uniform() * 2.2 - 0.6)};
        skies.schedule(options);
        scene.renderer.set_sky(skies.complete());
        Frame frame = scene.frame_at(i);
        frame.sea.depth_m = i % 3 == 0 ? 4000 : 1 + 20 * uniform();
        baker.schedule(frame, {.depth_m = 0.5 + 20 * uniform(), .sun = gl::sun_direction(options)});
        if (i > 3)
            scene.renderer.set_caustics(baker.complete());
        else
            baker.complete();
        glm::dvec3 at(300 * uniform(), 0, 300 * uniform());
        const SurfaceQuery query(frame);
        at.y = gl::camera_water_plane(query, at).height_m + (i % 2 == 0 ? 0.1 * (uniform() - 0.5) : -30 * uniform());
        const double azimuth = 6.3 * uniform(), up = 3 * (uniform() - 0.5);
        const glm::dvec3 ahead(std::cos(azimuth) * std::cos(up), std::sin(up), std::sin(azimuth) * std::cos(up));
        const auto pixels =
            scene.image({at, at + ahead, 0.3 + 1.6 * uniform()}, frame, gl::camera_water_plane(query, at));
        int bad = 0;
        for (const float value : pixels) bad += !(value >= 0 && value <= 65504);
        EXPECT_EQ(bad, 0) << "camera " << i;
    }
}

// An island away from the origin, longer on one axis. Where its heights are above the rest level,
// pixels show its sand. A shift by half a sample would fail.
TEST(SeaFloor, LiesAtThePositionsOfItsHeights) {
    constexpr double half_m = 60;
    BelowScene scene("calm", 160, 160);
    gl::Sky sky = even_sky(0);
    sky.sky_irradiance = glm::vec3(1);
    scene.renderer.set_sky(sky);
    gl::SeaFloor floor{.columns = 40,
                       .rows = 30,
                       .corner_m = {-47, -31},
                       .metres_per_texel = 3,
                       .is_sand = false,
                       .albedo = glm::vec3(1)};
    for (int j = 0; j < floor.rows; ++j)
        for (int i = 0; i < floor.columns; ++i) {
            const double x = floor.corner_m.x + 3 * i, z = floor.corner_m.y + 3 * j;
            floor.heights_m.push_back(static_cast<float>(3 - 0.25 * std::hypot(x - 10, 2 * (z + 5))));
        }
    scene.renderer.set_floor(floor);
    const double height_m = 300;
    const auto pixels = scene.image({{0, height_m, 0}, {0, 0, 0}, 2 * std::atan(half_m / height_m)},
                                    scene.level_frame(30), std::nullopt);
    // The air attenuates and adds equally everywhere. The threshold is the middle between the
    // brightest pixel, which is land, and the darkest.
    double max = 0, min = 1e9;
    for (int y = 0; y < scene.height(); ++y)
        for (int x = 0; x < scene.width(); ++x) {
            max = std::max(max, scene.green(pixels, x, y));
            min = std::min(min, scene.green(pixels, x, y));
        }
    // The highest water is 0.53 as bright as dry land. The soft shore is 0.3 m deep and reaches the
    // middle brightness at half of that depth.
    const auto wrong_pixels = [&](double shift_m) {
        int wrong = 0;
        for (int y = 0; y < scene.height(); ++y)
            for (int x = 0; x < scene.width(); ++x) {
                // Straight down, the image's top is +x.
                const double across = ((x + 0.5) / scene.width() * 2 - 1) * half_m,
                             up = (1 - (y + 0.5) / scene.height() * 2) * half_m;
                const bool is_land = floor.height_at(up + shift_m, across + shift_m) > -0.15;
                wrong += is_land != (scene.green(pixels, x, y) > min + 0.77 * (max - min));
            }
        return wrong;
    };
    std::printf("pixels on the wrong side of the shore: %d in place, %d and %d half a sample beside\n",
                wrong_pixels(0), wrong_pixels(-1.5), wrong_pixels(1.5));
    EXPECT_LT(2 * wrong_pixels(0), wrong_pixels(-1.5));
    EXPECT_LT(2 * wrong_pixels(0), wrong_pixels(1.5));
}

}  // namespace
}  // namespace pelagic
