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
    static const gl::Sky& sky = []() -> const gl::Sky& {
        baker.schedule({.sun_azimuth_rad = 0.7f, .sun_elevation_rad = 0.5f});
        return baker.complete();
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
      quadtree(quadtree_preset_named(options.quality)->options(options.size_m)),
      selection(quadtree),
      samples_(options.samples),
      writes_(options.writes),
      lens_may_dip_(options.lens_may_dip) {
    resize(options.width, options.height);
    renderer.emplace(gl(), gl::RendererOptions{.patch_vertices = quadtree.vertices,
                                               .resolution = ocean.resolution(),
                                               .cascades = ocean.cascade_count(),
                                               .shading = options.shading,
                                               .writes = writes_});
    renderer->set_sky(test_sky());
}

void GlScene::resize(int width, int height, ImageRows only) {
    if (only.count == 0) only = {0, height};
    target.reset();
    target.emplace(gl(), width, only.count, samples_, writes_);
    whole_ = {0, only.first + only.count - height, width, height};
}

const gl::DrawStatistics& GlScene::draw(const Camera& camera, const Frame& frame, bool draws_sky, bool stereo,
                                        glm::vec3 clear) {
    std::vector<gl::Eye> eyes;
    if (stereo) {
        const gl::EyePair pair = gl::eyes_of(camera, whole_, 0.063);
        eyes = {pair.left, pair.right};
    } else {
        eyes = {gl::eye_of(camera, whole_)};
    }
    std::vector<glm::dmat4> views;
    for (const gl::Eye& eye : eyes) views.push_back(eye.clip_from_world);
    const DrawList& list = selection.select({.viewer_m = camera.position_m,
                                             .views = views,
                                             .bounds = frame.bounds,
                                             .sea_level_m = frame.water_frame.sea_level_m});
    target->bind();
    gl().ClearColor(clear.x, clear.y, clear.z, 1);
    gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    renderer->upload(frame);
    // Mesa's multithreaded software driver may sample mips before they are written; images must be
    // reproducible.
    gl().Finish();
    std::optional<gl::CameraWaterPlane> water;
    if (lens_may_dip_) water = gl::camera_water_plane(SurfaceQuery(frame), camera.position_m);
    return renderer->draw({.eyes = eyes,
                           .viewer_m = camera.position_m,
                           .list = &list,
                           .lod_scale = quadtree.lod_scale,
                           .draws_sky = draws_sky,
                           .camera_water_plane = water,
                           .application_scene = application_scene});
}

std::vector<float> GlScene::light_from_above(const Frame& frame, int pixels, double side_m) {
    glm::dmat4 clip(0);
    clip[0][0] = 2 / side_m;
    clip[2][1] = -2 / side_m;
    clip[1][2] = -1.0 / 2000;
    clip[3] = {0, 0, 0, 1};
    const glm::dvec3 viewer(0, 2000, 0);
    const gl::Eye eye{.clip_from_world = clip, .position_m = viewer, .viewport = {0, 0, pixels, pixels}};
    const DrawList& list =
        selection.select({.viewer_m = viewer, .views = {&eye.clip_from_world, 1}, .bounds = frame.bounds});
    resize(pixels, pixels);
    target->bind();
    gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    renderer->upload(frame);
    gl().Finish();
    renderer->draw(
        {.eyes = {&eye, 1}, .viewer_m = viewer, .list = &list, .lod_scale = quadtree.lod_scale, .draws_sky = false});
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
