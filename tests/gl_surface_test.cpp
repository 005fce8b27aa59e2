// The drawn sea has the positions that its frame's cascades give (gl_slice.hpp).
#include <gtest/gtest.h>

#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/tests/gl_slice.hpp"

namespace pelagic {
namespace {

constexpr glm::dvec2 slice_middle(1034.7, -263.9);

/// A cascade without horizontal displacement.
SeaState sea_without_choppiness() {
    SeaState sea = sea_named("moderate", 128);
    sea.choppiness = 0;
    return sea;
}

TEST(GlSurface, HasThePositionsOfTheCascadesSum) {
    GlScene scene(slice_scene());
    Ocean ocean(sea_without_choppiness(), {.executor = make_serial_executor()});
    const Frame& frame = ocean.frame_at(3);
    expect_slice_in_place(scene, frame, slice_middle, displacement_of(frame, slice_middle.x, slice_middle.y).height,
                          [&](double x, double z) { return displacement_of(frame, x, z).height; });
}

// Small waves hardly change the sum, so each cascade is also drawn alone, with texels of a metre:
// its layer, position and rotation.
TEST(GlSurface, HasEachCascadeAtItsPositionAndRotation) {
    GlScene scene(slice_scene());
    Ocean ocean(sea_without_choppiness(), {.executor = make_serial_executor()});
    const Frame& all =
        // at 3 s the middle of cascade 0 is a trough, and the slice clips almost everything
        ocean.frame_at(6);
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
        expect_slice_in_place(scene, frame, slice_middle,
                              displacement_of(cascade, slice_middle.x, slice_middle.y).height,
                              [&](double x, double z) { return displacement_of(cascade, x, z).height; });
    }
}

// The viewer's position is only the origin of coordinates; the image depends on the eye alone. A
// rotation that differed between C++ and the shader would show here.
TEST(GlSurface, DoesNotDependOnTheOriginOfPositions) {
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
    DrawList list = scene.selection.select({.viewer_m = camera.position_m});
    list.lod_scale = 1e9;  // so fine a mesh samples mip 0 everywhere; else the mip depends on the viewer
    const auto image_from = [&](glm::dvec3 viewer) {
        scene.renderer->upload(frame);
        scene.gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        scene.renderer->draw({.eyes = {&eye, 1}, .viewer_m = viewer, .list = &list});
        return scene.target->read();
    };
    const auto here = image_from(camera.position_m), there = image_from({2000, 40, -1500});
    double difference = 0;
    for (std::size_t i = 0; i < here.size(); ++i) difference += std::abs(here[i] - there[i]);
    difference /= static_cast<double>(here.size());
    // Rounding of floats at 2.5 km gives 0.015; a rotation error of 0.015 rad gives 0.28.
    EXPECT_LT(difference, 0.05);
}

}  // namespace
}  // namespace pelagic
