// The sea that is drawn lies where queries say: seen from straight above through a near plane that cuts the crests off,
// holes are where the height is above that plane.
#include <gtest/gtest.h>

#include "pelagic/sim/surface/tile_sum.hpp"
#include "pelagic/tests/gl_scene.hpp"

namespace pelagic {
namespace {

constexpr int side = 160;      // pixels
constexpr double half_m = 20;  // of the square that is seen
constexpr glm::dvec2 middle(1034.7, -263.9);

/// From above, x to the right and z down; what is higher than `top_m` lies before the near plane.
glm::dmat4 slice(double top_m) {
    glm::dmat4 m(0);
    m[0][0] = 1 / half_m;
    m[2][1] = -1 / half_m;
    m[1][2] = -1.0 / 25;
    m[3] = {-middle.x / half_m, middle.y / half_m, top_m / 25 - 1, 1};
    return m;
}

std::vector<std::uint8_t> picture_of_slice(GlScene& scene, const Frame& frame, double top_m) {
    const glm::dvec3 viewer(middle.x, 1, middle.y);
    const gl::Eye eye{
        .clip_from_world = slice(top_m), .position_m = {middle.x, 30, middle.y}, .viewport = {0, 0, side, side}};
    const DrawList& list = scene.selection.select({.viewer_m = viewer});
    scene.target->bind();
    scene.gl().ClearColor(1, 0, 1, 1);
    scene.gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    scene.renderer->upload(frame);
    scene.renderer->draw({.eyes = {&eye, 1},
                          .viewer_m = viewer,
                          .list = &list,
                          .lod_scale = scene.quadtree.lod_scale,
                          .draws_sky = false});
    return scene.target->read();
}

/// Checks a slice at a height that `heights` has in the middle of its range: the sea is drawn where it lies, and not half a
/// metre, which is the vertices' spacing and half a texel, beside.
template <class Height>
void expect_slice_in_place(GlScene& scene, const Frame& frame, double top_m, const Height& height) {
    const std::vector<std::uint8_t> pixels = picture_of_slice(scene, frame, top_m);
    const auto is_cut = [&](int x, int y) {
        const std::uint8_t* rgb = &pixels[4 * static_cast<std::size_t>(y * side + x)];
        return rgb[0] == 255 && rgb[1] == 0 && rgb[2] == 255;
    };
    const auto wrong_pixels = [&](double shift_m) {
        int wrong = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const double world_x = middle.x + ((x + 0.5) / side * 2 - 1) * half_m + shift_m,
                             world_z = middle.y + ((y + 0.5) / side * 2 - 1) * half_m + shift_m;
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

/// One sheet, straight up and down.
SeaState sea_without_choppiness() {
    SeaState sea = sea_named("moderate", 128);
    sea.choppiness = 0;
    return sea;
}

TEST(GlSurface, LiesWhereTheFramesTilesSumToAndNotBeside) {
    GlScene scene(
        {.quality = "ultra", .resolution = 128, .width = side, .height = side, .samples = 1, .size_m = 512});
    Ocean ocean(sea_without_choppiness(), {.executor = make_serial_executor()});
    const Frame& frame = ocean.frame_at(3);
    expect_slice_in_place(scene, frame, displacement_of(frame, middle.x, middle.y).height,
                          [&](double x, double z) { return displacement_of(frame, x, z).height; });
}

// Small waves hardly move the sum, so each tile is drawn without the others too, with texels of a metre: its layer, place and turn.
TEST(GlSurface, HasEachTileAloneInItsPlaceAndTurned) {
    GlScene scene(
        {.quality = "ultra", .resolution = 128, .width = side, .height = side, .samples = 1, .size_m = 512});
    Ocean ocean(sea_without_choppiness(), {.executor = make_serial_executor()});
    const Frame& all = ocean.frame_at(3);
    const std::vector<std::uint16_t> calm(all.tiles[0].displacement_rgba16f.size());
    for (std::size_t alone = 0; alone < all.tiles.size(); ++alone) {
        SCOPED_TRACE("tile " + std::to_string(alone));
        std::vector<Tile> tiles(all.tiles.begin(), all.tiles.end());
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            tiles[i].lattice.side_m = 128;
            if (i != alone) tiles[i].displacement_rgba16f = calm;
        }
        Frame frame = all;
        frame.tiles = tiles;
        const Tile& tile = tiles[alone];
        expect_slice_in_place(scene, frame, displacement_of(tile, middle.x, middle.y).height,
                              [&](double x, double z) { return displacement_of(tile, x, z).height; });
    }
}

// The viewer is what positions are relative to, and nothing else: a picture is that of the eye. The second copy of the
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
    const auto picture_from = [&](glm::dvec3 viewer) {
        scene.renderer->upload(frame);
        scene.gl().Finish();
        scene.gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        // So fine a mesh takes mip 0 everywhere; else the mip would follow the viewer.
        scene.renderer->draw({.eyes = {&eye, 1}, .viewer_m = viewer, .list = &list, .lod_scale = 1e9});
        return scene.target->read();
    };
    const auto here = picture_from(camera.position_m), there = picture_from({2000, 40, -1500});
    double difference = 0;
    for (std::size_t i = 0; i < here.size(); ++i) difference += std::abs(here[i] - there[i]);
    difference /= static_cast<double>(here.size());
    // Rounding of floats 2.5 km away makes 0.015; a turn that differs by 0.015 rad makes 0.28.
    EXPECT_LT(difference, 0.05);
}

}  // namespace
}  // namespace pelagic
