// The native image of a scene of view_test.mjs, drawn with EGL, for comparison with SeaView.
//   usage: view_image SCENE.json IMAGE
// Writes RGBA, the upper row first. Prints the frame's hash and the heights at the scene's points.
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "pelagic/gl/headless_context.hpp"
#include "pelagic/gl/sky/light_presets.hpp"
#include "pelagic/gl/water/sea_pass.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"

using namespace pelagic;

namespace {

glm::dvec3 vector_in(const nlohmann::json& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

void draw(const nlohmann::json& scene, const char* image) {
    const int width = scene["width"], height = scene["height"];
    const std::string sea_name = scene["preset"], light_name = scene["light"], quality = scene["quality"],
                      shading = scene["shading"];
    SeaState sea = sea_preset_named(sea_name)->sea;
    sea.resolution = scene["resolution"];
    Ocean ocean(sea, {.queries = true, .slopes = true, .foam = true});
    const Frame& frame = ocean.frame_at(scene["timeS"]);
    std::printf("%016" PRIx64 "\n", hash_of(frame));
    for (const nlohmann::json& point : scene["points"]) {
        const double x = point[0], z = point[1];
        float height_m = 0;
        SurfaceQuery(frame).sample({{&x, 1}, {&z, 1}}, {.height_m = {&height_m, 1}});
        std::printf("%.9g\n", static_cast<double>(height_m));
    }

    const gl::HeadlessContext context;
    const gl::Functions& gl = context.functions();
    gl::RenderTarget target(gl, width, height, 4);
    gl::SeaPass pass(gl,
                     {.resolution = ocean.resolution(),
                      .cascades = ocean.cascade_count(),
                      .shading = *value_named<gl::Shading>(shading)},
                     quadtree_preset_named(quality)->options(4096));
    const gl::LightPreset& light = *gl::light_preset_named(light_name);
    gl::SkyBaker baker(make_default_executor(), scene["skyFaceSize"]);
    baker.schedule(light.sky);
    const gl::Sky& sky = baker.complete();
    pass.renderer().set_sky(sky);
    pass.upload(frame);

    const nlohmann::json& from = scene["camera"];
    const Camera camera{.position_m = vector_in(from["position"]),
                        .target_m = vector_in(from["target"]),
                        .vertical_view_rad = from["verticalViewRad"]};
    std::vector<gl::Eye> eyes = {gl::eye_of(camera, {0, 0, width, height})};
    if (const double apart_m = scene["eyesApartM"]; apart_m > 0)
        eyes = gl::eyes_of(camera, {0, 0, width, height}, apart_m);
    target.clear();
    pass.draw({.eyes = eyes, .exposure = sky.exposure * std::exp2(light.bias_stops)});
    const std::vector<std::uint8_t> pixels = target.read();
    std::ofstream(image, std::ios::binary)
        .write(reinterpret_cast<const char*>(pixels.data()), static_cast<std::streamsize>(pixels.size()));
}

}  // namespace

int main(int count, char** arguments) try {
    if (count != 3) {
        std::fputs("usage: view_image SCENE.json IMAGE\n", stderr);
        return 1;
    }
    std::ifstream file(arguments[1]);
    draw(nlohmann::json::parse(file), arguments[2]);
} catch (const std::exception& error) {
    std::fprintf(stderr, "view_image: %s\n", error.what());
    return 1;
}
