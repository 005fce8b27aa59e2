// Checks that the drawn sea has the heights of the queries. The sea is seen from straight above,
// and a near plane clips the crests; holes in the image are where the height is above that plane.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>

#include "pelagic/tests/gl_scene.hpp"

namespace pelagic {

constexpr int slice_pixels = 160;    // per side; the scene's target has this size
constexpr double slice_half_m = 20;  // half the side of the visible square

/// The scene of slices, of the finest mesh, for frames of 128 x 128 texels a cascade.
inline GlScene::Options slice_scene() {
    return {.quality = "ultra",
            .resolution = 128,
            .width = slice_pixels,
            .height = slice_pixels,
            .samples = 1,
            .size_m = 512};
}

/// View from above, x to the right and z down; points higher than `top_m` are before the near
/// plane.
inline glm::dmat4 slice(glm::dvec2 middle, double top_m) {
    glm::dmat4 m(0);
    m[0][0] = 1 / slice_half_m;
    m[2][1] = -1 / slice_half_m;
    m[1][2] = -1.0 / 25;
    m[3] = {-middle.x / slice_half_m, middle.y / slice_half_m, top_m / 25 - 1, 1};
    return m;
}

inline std::vector<std::uint8_t> image_of_slice(GlScene& scene, const Frame& frame, glm::dvec2 middle, double top_m) {
    const glm::dvec3 viewer(middle.x, 1, middle.y);
    const gl::Eye eye{.clip_from_world = slice(middle, top_m),
                      .position_m = {middle.x, 30, middle.y},
                      .viewport = {0, 0, slice_pixels, slice_pixels}};
    scene.target->clear({1, 0, 1});
    scene.renderer->upload(frame);
    scene.renderer->draw({.eyes = {&eye, 1},
                          .viewer_m = viewer,
                          .list = &scene.selection.select({.viewer_m = viewer}),
                          .draws_sky = false});
    return scene.target->read();
}

/// Checks a slice at the middle of the range of `height`: the sea is drawn at its position. A shift
/// of half a metre, which is the spacing of vertices and half a texel, would fail.
template <class Height>
void expect_slice_in_place(GlScene& scene, const Frame& frame, glm::dvec2 middle, double top_m,
                           const Height& height) {
    constexpr int side = slice_pixels;
    const std::vector<std::uint8_t> pixels = image_of_slice(scene, frame, middle, top_m);
    const auto is_cut = [&](int x, int y) {
        const std::uint8_t* rgb = &pixels[4 * static_cast<std::size_t>(y * side + x)];
        return rgb[0] == 255 && rgb[1] == 0 && rgb[2] == 255;
    };
    const auto wrong_pixels = [&](double shift_m) {
        int wrong = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const double world_x = middle.x + ((x + 0.5) / side * 2 - 1) * slice_half_m + shift_m,
                             world_z = middle.y + ((y + 0.5) / side * 2 - 1) * slice_half_m + shift_m;
                wrong += is_cut(x, y) != (height(world_x, world_z) > top_m);
            }
        return wrong;
    };
    int cut = 0;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) cut += is_cut(x, y);
    ASSERT_GT(cut, side * side / 10);
    ASSERT_LT(cut, side * side * 9 / 10);
    std::printf("pixels on the wrong side: %d in place, %d and %d half a texel beside\n", wrong_pixels(0),
                wrong_pixels(-0.5), wrong_pixels(0.5));
    EXPECT_LT(3 * wrong_pixels(0), wrong_pixels(-0.5));
    EXPECT_LT(3 * wrong_pixels(0), wrong_pixels(0.5));
}

}  // namespace pelagic
