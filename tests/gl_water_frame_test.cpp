// Sea level and current in images: the sea is drawn at its height and place in the world, and
// equals the sea that a camera in the water's frame sees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pelagic/sim/surface/cascade_sum.hpp"
#include "pelagic/tests/gl_slice.hpp"

namespace pelagic {
namespace {

TEST(GlWaterFrame, SeaIsDrawnAtItsHeightAndPlace) {
    GlScene scene({.quality = "ultra",
                   .resolution = 128,
                   .width = slice_pixels,
                   .height = slice_pixels,
                   .samples = 1,
                   .size_m = 512});
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

// The drift of 1024 m is a step of the grid and a multiple of the period of the sand, so the meshes
// of both images are equal.
TEST(GlWaterFrame, ImageIsThatOfACameraInTheWatersFrame) {
    for (const double depth_m : {0.0, 6.0}) {
        GlScene scene(
            {.resolution = 64, .width = 240, .height = 160, .depth_m = depth_m, .foam = true, .lens_may_dip = true});
        constexpr double time_s = 128;
        const WaterFrame water{.sea_level_m = 3, .current_x_mps = 8, .current_z_mps = -8};
        for (const double above_m : {6.0, 0.0, -2.0}) {
            const Camera in_water{.position_m = {10, above_m, -4}, .target_m = {60, above_m - 4, 40}};
            Camera in_world = in_water;
            for (glm::dvec3* const point : {&in_world.position_m, &in_world.target_m})
                *point += glm::dvec3(8 * time_s, 3, -8 * time_s);
            scene.ocean.set_water_frame({});
            const std::vector<std::uint8_t> expected = scene.image(in_water, time_s);
            scene.ocean.set_water_frame(water);
            const std::vector<std::uint8_t> found = scene.image(in_world, time_s);
            const std::vector<std::uint8_t> elsewhere = scene.image(in_water, time_s);
            const auto different = [&](const std::vector<std::uint8_t>& image) {
                std::size_t pixels = 0;
                for (std::size_t i = 0; i < image.size(); i += 4)
                    pixels += std::abs(image[i] - expected[i]) > 2 || std::abs(image[i + 2] - expected[i + 2]) > 2;
                return static_cast<double>(pixels) / (240. * 160.);
            };
            // Floats round differently by the viewer's position, which moves edges of crests.
            EXPECT_LT(different(found), 0.002) << depth_m << " " << above_m;
            EXPECT_GT(different(elsewhere), 0.1) << depth_m << " " << above_m;
        }
    }
}

}  // namespace
}  // namespace pelagic
