#include "pelagic/tests/gl_scene.hpp"

#include <cmath>

#include "pelagic/gl/whitecaps.hpp"
#include "pelagic/sim/statistics.hpp"

namespace pelagic {
namespace {

/// Baked once for all tests of a process: the sky is the same in each.
const gl::Sky& test_sky() {
    static gl::SkyBaker baker(make_default_executor(), 64);
    static const gl::Sky& sky = []() -> const gl::Sky& {
        baker.schedule({.sun_azimuth_rad = 0.7f, .sun_elevation_rad = 0.5f});
        return baker.complete();
    }();
    return sky;
}

}  // namespace

SeaState sea_named(std::string_view name, int resolution) {
    for (const SeaPreset& preset : sea_presets())
        if (preset.name == name) {
            SeaState sea = preset.sea;
            if (resolution > 0) sea.resolution = resolution;
            return sea;
        }
    return {};
}

GlScene::GlScene(const Options& options)
    : ocean(sea_named(options.preset, options.resolution)),
      quadtree(quadtree_preset_named(options.quality)->options(options.size_m)),
      selection(quadtree),
      samples_(options.samples),
      wave_height_m_(expected_waves(ocean.sea()).significant_wave_height_m),
      whitecap_jacobian_(gl::whitecap_jacobian(ocean.frame_at(0), ocean.sea().wind_speed_mps)) {
    resize(options.width, options.height);
    renderer.emplace(gl(),
                     gl::RendererOptions{.patch_vertices = quadtree.vertices, .resolution = ocean.sea().resolution});
    renderer->set_sky(test_sky());
}

void GlScene::resize(int width, int height) {
    target.reset();
    target.emplace(gl(), width, height, samples_);
}

const gl::DrawFigures& GlScene::draw(const gl::Camera& camera, double time_s, bool draws_sky, bool stereo,
                                     glm::vec3 clear) {
    const Frame& frame = ocean.frame_at(time_s);
    const gl::Viewport whole{0, 0, target->width(), target->height()};
    std::vector<gl::Eye> eyes;
    if (stereo) {
        const gl::EyePair pair = gl::eyes_of(camera, whole, 0.063);
        eyes = {pair.left, pair.right};
    } else {
        eyes = {gl::eye_of(camera, whole)};
    }
    std::vector<glm::dmat4> views;
    for (const gl::Eye& eye : eyes) views.push_back(eye.clip_from_world);
    const FrameBounds& b = frame.bounds;
    const DrawList& list =
        selection.select({.viewer_m = camera.position_m,
                          .views = views,
                          .bounds = {b.height_min_m, b.height_max_m, b.sideways_x_max_m, b.sideways_z_max_m}});
    target->bind();
    gl().ClearColor(clear.x, clear.y, clear.z, 1);
    gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    renderer->upload(frame);
    return renderer->draw({.eyes = eyes,
                           .viewer_m = camera.position_m,
                           .list = &list,
                           .lod_scale = quadtree.lod_scale,
                           .sea = &ocean.sea(),
                           .significant_wave_height_m = wave_height_m_,
                           .whitecap_jacobian = whitecap_jacobian_,
                           .time_s = time_s,
                           .draws_sky = draws_sky});
}

float linear_of(std::uint8_t srgb) {
    const float v = static_cast<float>(srgb) / 255;
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

}  // namespace pelagic
