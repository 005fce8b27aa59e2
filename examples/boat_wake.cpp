// Dynamic waves without a window: renders the wake of a boat and the ripples of stones, and writes
// the image to wake.ppm or to the file of the first argument.
//
// The boat is a pressure source with a velocity. A stone is one impulse. The dynamic-wave grid
// follows the boat. The boat's own position is queried in the wind waves only, because the
// depression under it is its own displacement.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/gl/display.hpp"
#include "pelagic/gl/headless_context.hpp"
#include "pelagic/gl/meshes/boat.hpp"
#include "pelagic/gl/render_target.hpp"
#include "pelagic/gl/water/sea_pass.hpp"
#include "pelagic/sim/ocean.hpp"

namespace {

using namespace pelagic;

constexpr int width = 960, height = 540, samples = 4;
constexpr double frame_s = 1.0 / 60, voyage_s = 22;

/// The boat's course: a straight line, then a turn to starboard.
struct Course {
    static constexpr double speed_mps = 4.6, straight_s = 15, radius_m = 24;

    glm::dvec2 place{0, 0};
    double heading_rad = 0;

    void go(double passed_s, double time_s) {
        if (time_s > straight_s) heading_rad += passed_s * speed_mps / radius_m;
        place += passed_s * speed_mps * ahead();
    }
    glm::dvec2 ahead() const { return {std::cos(heading_rad), std::sin(heading_rad)}; }
};

Disturbance hull_on(const Course& course) {
    return {.shape = Disturbance::Shape::hull,
            .x_m = course.place.x,
            .z_m = course.place.y,
            .radius_m = gl::Boat::beam_m / 2,
            .length_m = gl::Boat::length_m / 2,
            .heading_rad = course.heading_rad,
            .height_m = -0.5,
            .velocity_x_mps = course.ahead().x * Course::speed_mps,
            .velocity_z_mps = course.ahead().y * Course::speed_mps};
}

Disturbance stone_at(double x_m, double z_m) {
    return {.mode = Disturbance::Mode::impulse, .x_m = x_m, .z_m = z_m, .radius_m = 0.8, .height_m = 0.7};
}

/// Returns the boat's pose on the wind waves, from their heights at its bow, stern and sides.
glm::dmat4 boat_on(const Frame& frame, const Course& course) {
    Frame of_wind = frame;
    of_wind.dynamic_waves = {};
    const glm::dvec2 ahead = 2.5 * course.ahead(), starboard = glm::dvec2(-ahead.y, ahead.x) * 0.4;
    const glm::dvec2 places[] = {course.place + ahead, course.place - ahead, course.place + starboard,
                                 course.place - starboard};
    double x[4], z[4];
    float heights[4];
    for (int i = 0; i < 4; ++i) {
        x[i] = places[i].x;
        z[i] = places[i].y;
    }
    SurfaceQuery(of_wind).sample({x, z}, {.height_m = heights});
    const auto at = [&](int i) { return glm::dvec3(x[i], static_cast<double>(heights[i]), z[i]); };
    const glm::dvec3 forward = glm::normalize(at(0) - at(1));
    const glm::dvec3 up = glm::normalize(glm::cross(at(2) - at(3), forward));
    return {glm::dvec4(forward, 0), glm::dvec4(up, 0), glm::dvec4(glm::cross(forward, up), 0),
            glm::dvec4(0.25 * (at(0) + at(1) + at(2) + at(3)), 1)};
}

void write_image(const char* name, const std::vector<std::uint8_t>& rgba) {
    std::FILE* file = std::fopen(name, "wb");
    if (!file) throw std::runtime_error(std::string("can't write ") + name);
    std::fprintf(file, "P6\n%d %d\n255\n", width, height);
    for (std::size_t i = 0; i < rgba.size(); i += 4) std::fwrite(&rgba[i], 1, 3, file);
    std::fclose(file);
}

void draw_voyage(const char* name) {
    Ocean ocean(sea_preset_named("beaufort-1")->sea,
                {.queries = true,
                 .slopes = true,
                 .foam = true,
                 .dynamic_waves = DynamicWavesOptions{.resolution = 512, .side_m = 160, .border_m = 16}});
    Course course;
    const std::uint32_t boat = ocean.dynamic_waves().add_source(hull_on(course));
    double time_s = 0;
    for (; time_s < voyage_s; time_s += frame_s) {
        ocean.frame_at(time_s);
        course.go(frame_s, time_s);
        ocean.dynamic_waves().set_source(boat, hull_on(course));
        ocean.dynamic_waves().set_center(course.place.x, course.place.y);
        // Impulses at fixed times before the image.
        const auto passes = [&](double moment_s) { return time_s < moment_s && time_s + frame_s >= moment_s; };
        if (passes(voyage_s - 3)) ocean.dynamic_waves().add_impulse(stone_at(66, 24));
        if (passes(voyage_s - 2)) ocean.dynamic_waves().add_impulse(stone_at(72, 31));
        if (passes(voyage_s - 0.8)) ocean.dynamic_waves().add_impulse(stone_at(63, 33));
    }
    const Frame& frame = ocean.frame_at(time_s);

    gl::HeadlessContext context;
    const gl::Functions& functions = context.functions();
    gl::SeaPass pass(functions,
                     {.resolution = ocean.resolution(),
                      .cascades = ocean.cascade_count(),
                      .writes = gl::PixelKind::radiance,
                      .dynamic_waves = true},
                     quadtree_preset_named("ultra")->options(2048));
    gl::SkyBaker baker(make_default_executor(), 256);
    baker.schedule({.sun_azimuth_rad = 0.35f, .sun_elevation_rad = 0.42f, .cloud_cover = 0.12f});
    const gl::Sky& sky = baker.complete();
    pass.renderer().set_sky(sky);
    gl::Boat model(functions);

    const Camera camera{.position_m = {56, 9, 44}, .target_m = {78, 0, 10}, .vertical_view_rad = 0.85};
    const gl::Eye eye = gl::eye_of(camera, {0, 0, width, height});
    gl::RenderTarget target(functions, width, height, samples, gl::PixelKind::radiance);
    target.clear();
    pass.upload(frame);
    const glm::dmat4 pose = boat_on(frame, course);
    const float exposure = gl::exposure_of_ev(13.4f, sky.luminance_of_unit());
    model.set_light(sky, pass.renderer().sunlit_at({pose[3].x, pose[3].z}));
    model.draw(eye, pose, exposure);
    pass.draw({.eyes = {&eye, 1},
               .exposure = exposure,
               .weighs_samples = true,
               .application_scene = model.image(eye, pose)});
    gl::Display display(functions);
    gl::RenderTarget screen(functions, width, height, 0);
    const gl::TexturePart radiance = target.resolved();
    screen.bind();
    display.show(radiance, {.exposure = exposure, .luminance_of_unit = sky.luminance_of_unit(), .bloom = 0.04f},
                 {0, 0, width, height});
    write_image(name, screen.read());
}

}  // namespace

int main(int count, char** arguments) {
    try {
        draw_voyage(count > 1 ? arguments[1] : "wake.ppm");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "boat_wake: %s\n", error.what());
        return 1;
    }
}
