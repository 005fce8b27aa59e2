// Sea level and current in images: the sea is drawn at its height and place in the world, and
// equals the sea that a camera in the water's frame sees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/tests/gl_slice.hpp"

namespace pelagic {
namespace {

TEST(GlWaterFrame, SeaIsDrawnAtItsHeightAndPlace) {
    GlScene scene(slice_scene());
    SeaState sea = sea_named("moderate", 128);
    sea.choppiness = 0;
    Ocean ocean(sea, {.executor = make_serial_executor()});
    ocean.set_water_frame({.sea_level_m = 3, .current_x_mps = 4, .current_z_mps = -2.5});
    constexpr double time_s = 3;
    constexpr glm::dvec2 drift = time_s * glm::dvec2(4, -2.5), middle = glm::dvec2(1034.7, -263.9) + drift;
    const Frame& frame = ocean.frame_at(time_s);
    const auto height = [&](double x, double z) {
        return 3 + displacement_of(frame, x - drift.x, z - drift.y).height;
    };
    expect_slice_in_place(scene, frame, middle, height(middle.x, middle.y), height);
}

/// A beach with its corner at a point, and heights above a level. Half floats hold the heights.
gl::SeaFloor tide_beach(glm::dvec2 corner_m, float level_m) {
    gl::SeaFloor floor{.columns = 32, .rows = 32};
    for (int i = 0; i < floor.columns * floor.rows; ++i)
        floor.heights_m.push_back(level_m + static_cast<float>(i % floor.columns) * 0.25f - 6);
    floor.corner_m = corner_m;
    floor.metres_per_texel = 4;
    return floor;
}

/// Checks that an image is the expected one, and that one from another place is not. Floats round
/// differently by the viewer's position, which moves edges of crests; a double of 1e7 m has steps of
/// 2e-9 m, which a matrix multiplies.
void expect_equal(const std::vector<std::uint8_t>& found, const std::vector<std::uint8_t>& expected,
                  const std::vector<std::uint8_t>& elsewhere, double above_m) {
    const auto different = [&](const std::vector<std::uint8_t>& image) {
        std::size_t pixels = 0;
        for (std::size_t i = 0; i < image.size(); i += 4)
            pixels += std::abs(image[i] - expected[i]) > 2 || std::abs(image[i + 2] - expected[i + 2]) > 2;
        return 4 * static_cast<double>(pixels) / static_cast<double>(image.size());
    };
    std::printf("%g m above: %.5f of the pixels differ, elsewhere %.3f\n", above_m, different(found),
                different(elsewhere));
    EXPECT_LT(different(found), 0.002);
    EXPECT_GT(different(elsewhere), 0.1);
}

// The drift of 1024 m is a step of the grid and a multiple of the period of the sand, so the meshes
// of both images are equal. The floor stays in the world, so it is moved for the second image.
TEST(GlWaterFrame, ImageIsThatOfACameraInTheWatersFrame) {
    GlScene scene({.resolution = 64,
                   .width = 160,
                   .height = 100,
                   .shading = gl::Shading::medium,
                   .foam = true,
                   .lens_may_dip = true});
    constexpr double time_s = 128;
    constexpr glm::dvec2 corner(0, -20), drift(8 * time_s, -8 * time_s);
    for (const double above_m : {6.0, -2.0}) {
        const Camera in_water{.position_m = {10, above_m, -4}, .target_m = {60, above_m - 4, 40}};
        Camera in_world = in_water;
        for (glm::dvec3* const point : {&in_world.position_m, &in_world.target_m})
            *point += glm::dvec3(drift.x, 3, drift.y);
        scene.ocean.set_water_frame({});
        scene.renderer->set_floor(tide_beach(corner, 0));
        const std::vector<std::uint8_t> expected = scene.image(in_water, time_s);
        scene.ocean.set_water_frame({.sea_level_m = 3, .current_x_mps = 8, .current_z_mps = -8});
        scene.renderer->set_floor(tide_beach(corner + drift, 3));
        const std::vector<std::uint8_t> found = scene.image(in_world, time_s);
        const std::vector<std::uint8_t> elsewhere = scene.image(in_water, time_s);
        expect_equal(found, expected, elsewhere, above_m);
    }
}

// The shift is a multiple of a quarter of the mesh's side, so that vertices stay. The floor moves with
// the water.
TEST(GlWaterFrame, ImageIsThatBeforeAShiftOfTheOrigin) {
    GlScene scene({.resolution = 64,
                   .width = 160,
                   .height = 100,
                   .shading = gl::Shading::medium,
                   .foam = true,
                   .lens_may_dip = true});
    constexpr double time_s = 7;
    const glm::dvec3 origin(1024 * 9766, 0, -1024 * 4883);  // 1e7 m
    scene.renderer->set_floor(tide_beach({0, -20}, 0));
    for (const double above_m : {6.0, -2.0}) {
        const Camera before{.position_m = {10, above_m, -4}, .target_m = {60, above_m - 4, 40}};
        Camera after = before;
        for (glm::dvec3* const point : {&after.position_m, &after.target_m}) *point -= origin;
        scene.ocean.set_origin(0, 0);
        const std::vector<std::uint8_t> expected = scene.image(before, time_s);
        scene.ocean.set_origin(origin.x, origin.z);
        const std::vector<std::uint8_t> found = scene.image(after, time_s);
        const std::vector<std::uint8_t> elsewhere = scene.image(before, time_s);
        expect_equal(found, expected, elsewhere, above_m);
    }
}

}  // namespace
}  // namespace pelagic
