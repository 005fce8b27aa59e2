#include "pelagic/tests/gl_scene.hpp"

#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numbers>

namespace pelagic {
namespace {

SeaState sea_of(const GlScene::Options& options) {
    SeaState sea = sea_named(options.preset, options.resolution);
    sea.cascades = options.cascades;
    sea.patch_size_m = options.patch_size_m;
    if (options.depth_m > 0) sea.depth_m = options.depth_m;
    if (options.wind_speed_mps > 0) sea.wind_speed_mps = options.wind_speed_mps;
    return sea;
}

}  // namespace

const gl::Sky& test_sky() {
    static gl::SkyBaker baker(make_default_executor(), 64);
    // Without shadows of clouds, which move in the world over time, unlike the water.
    static const gl::Sky sky = [] {
        baker.schedule({.sun_azimuth_rad = 0.7f, .sun_elevation_rad = 0.5f});
        gl::Sky baked = baker.complete();
        baked.cloud_shadows = {};
        baked.brightest_transmittance = 0;
        baked.mean_sunlight = 1;
        return baked;
    }();
    return sky;
}

SeaState sea_named(std::string_view name, int resolution) {
    SeaState sea = sea_preset_named(name)->sea;
    if (resolution > 0) sea.resolution = resolution;
    return sea;
}

GlScene::GlScene(const Options& options)
    : ocean(sea_of(options), {.queries = options.lens_may_dip, .slopes = true, .foam = options.foam}),
      selection(quadtree_preset_named(options.quality)->options(options.size_m)),
      samples_(options.samples),
      writes_(options.writes) {
    resize(options.width, options.height);
    pass.emplace(gl(),
                 gl::RendererOptions{.resolution = ocean.resolution(),
                                     .cascades = ocean.cascade_count(),
                                     .shading = options.shading,
                                     .writes = writes_},
                 selection.options());
    renderer = &pass->renderer();
    renderer->set_sky(test_sky());
}

void GlScene::resize(int width, int height, ImageRows only) {
    if (only.count == 0) only = {0, height};
    target.reset();
    target.emplace(gl(), width, only.count, samples_, writes_);
    whole_ = {0, only.first + only.count - height, width, height};
}

gl::DrawStatistics GlScene::draw(const Camera& camera, const Frame& frame, bool draws_sky, bool stereo,
                                 glm::vec3 clear) {
    const std::vector<gl::Eye> eyes =
        stereo ? gl::eyes_of(camera, whole_, eye_distance_m) : std::vector<gl::Eye>{gl::eye_of(camera, whole_)};
    target->clear(clear);
    pass->upload(frame);
    return pass->draw({.eyes = eyes, .draws_sky = draws_sky, .application_scene = application_scene, .spray = spray});
}

std::vector<float> GlScene::light_from_above(const Frame& frame, int pixels, double side_m) {
    glm::dmat4 clip(0);
    clip[0][0] = 2 / side_m;
    clip[2][1] = -2 / side_m;
    clip[1][2] = -1.0 / 2000;
    clip[3] = {0, 0, 0, 1};
    const glm::dvec3 viewer(0, 2000, 0);
    const gl::Eye eye{.clip_from_world = clip, .position_m = viewer, .viewport = {0, 0, pixels, pixels}};
    resize(pixels, pixels);
    target->clear();
    pass->upload(frame);
    pass->draw({.eyes = {&eye, 1}, .draws_sky = false});
    const std::vector<float> read = target->read_radiance();
    std::vector<float> green;
    for (std::size_t i = 0; i < read.size(); i += 4) green.push_back(read[i + 1]);
    return green;
}

float linear_of(std::uint8_t srgb) {
    const float v = static_cast<float>(srgb) / 255;
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

gl::Sky even_sky(float radiance) {
    gl::Sky sky;
    sky.face_size = 16;
    sky.levels = gl::sky_levels(16);
    for (int level = 0; level < sky.levels; ++level)
        for (int i = 0; i < 6 * (16 >> level) * (16 >> level); ++i)
            for (const float channel : {radiance, radiance, radiance, 1.f})
                sky.texels.push_back(glm::packHalf1x16(channel));
    return sky;
}

gl::Sky white_sky() {
    gl::Sky sky = even_sky(1);
    sky.sky_irradiance = glm::vec3(std::numbers::pi_v<float>);
    sky.sun_direction = {0.6f, 0.8f, 0};  // no light, but a direction is required
    return sky;
}

}  // namespace pelagic
