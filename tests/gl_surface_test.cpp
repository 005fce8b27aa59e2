// The sea that is drawn lies where the cascades of its frame say (gl_slice.hpp).
#include <gtest/gtest.h>

#include "pelagic/sim/surface/cascade_sum.hpp"
#include "pelagic/tests/gl_slice.hpp"

namespace pelagic {
namespace {

constexpr int side = slice_pixels;
constexpr glm::dvec2 middle(1034.7, -263.9);

/// One sheet, straight up and down.
SeaState sea_without_choppiness() {
    SeaState sea = sea_named("moderate", 128);
    sea.choppiness = 0;
    return sea;
}

TEST(GlSurface, LiesWhereTheFramesCascadesSumToAndNotBeside) {
    GlScene scene(
        {.quality = "ultra", .resolution = 128, .width = side, .height = side, .samples = 1, .size_m = 512});
    Ocean ocean(sea_without_choppiness(), {.executor = make_serial_executor()});
    const Frame& frame = ocean.frame_at(3);
    expect_slice_in_place(scene, frame, middle, displacement_of(frame, middle.x, middle.y).height,
                          [&](double x, double z) { return displacement_of(frame, x, z).height; });
}

// Small waves hardly move the sum, so each cascade is drawn without the others too, with texels of a metre: its layer, place and turn.
TEST(GlSurface, HasEachCascadeAloneInItsPlaceAndTurned) {
    GlScene scene(
        {.quality = "ultra", .resolution = 128, .width = side, .height = side, .samples = 1, .size_m = 512});
    Ocean ocean(sea_without_choppiness(), {.executor = make_serial_executor()});
    const Frame& all =
        ocean.frame_at(6);  // at 3 s the middle of cascade 0 is a trough, and the slice cuts almost all
    const std::vector<std::uint16_t> calm(all.cascades[0].displacement_rgba16f.size());
    for (std::size_t alone = 0; alone < all.cascades.size(); ++alone) {
        SCOPED_TRACE("cascade " + std::to_string(alone));
        std::vector<Cascade> cascades(all.cascades.begin(), all.cascades.end());
        for (std::size_t i = 0; i < cascades.size(); ++i) {
            cascades[i].grid.side_m = 128;
            if (i != alone) cascades[i].displacement_rgba16f = calm;
        }
        Frame frame = all;
        frame.cascades = cascades;
        const Cascade& cascade = cascades[alone];
        expect_slice_in_place(scene, frame, middle, displacement_of(cascade, middle.x, middle.y).height,
                              [&](double x, double z) { return displacement_of(cascade, x, z).height; });
    }
}

// The viewer is what positions are relative to, and nothing else: an image is that of the eye. The second copy of the
// waves, whose turn C++ and the shader both know, would be another sea from elsewhere.
TEST(GlSurface, IsTheSameWhateverItsPositionsAreRelativeTo) {
    GlScene scene({.preset = "moderate",
                   .quality = "low",
                   .resolution = 64,
                   .patch_size_m = 250,
                   .width = 160,
                   .height = 90,
                   .samples = 1});
    const Frame& frame = scene.ocean.frame_at(3);
    const Camera camera{.position_m = {0, 40, 0}, .target_m = {200, 0, 130}};
    const gl::Eye eye = gl::eye_of(camera, {0, 0, 160, 90});
    const DrawList& list = scene.selection.select({.viewer_m = camera.position_m});
    const auto image_from = [&](glm::dvec3 viewer) {
        scene.renderer->upload(frame);
        scene.gl().Finish();
        scene.gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        // So fine a mesh takes mip 0 everywhere; else the mip would follow the viewer.
        scene.renderer->draw({.eyes = {&eye, 1}, .viewer_m = viewer, .list = &list, .lod_scale = 1e9});
        return scene.target->read();
    };
    const auto here = image_from(camera.position_m), there = image_from({2000, 40, -1500});
    double difference = 0;
    for (std::size_t i = 0; i < here.size(); ++i) difference += std::abs(here[i] - there[i]);
    difference /= static_cast<double>(here.size());
    // Rounding of floats 2.5 km away makes 0.015; a turn that differs by 0.015 rad makes 0.28.
    EXPECT_LT(difference, 0.05);
}

}  // namespace
}  // namespace pelagic
