// Foam in pictures: as bright as foam is, and as much of it from near and far.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "pelagic/tests/gl_scene.hpp"

namespace pelagic {
namespace {

/// The same radiance from everywhere, and no sun: what shines back is what reflects.
gl::Sky white_sky() {
    gl::Sky sky;
    sky.face_size = 16;
    sky.levels = gl::sky_levels(sky.face_size);
    std::size_t texels = 0;
    for (int level = 0; level < sky.levels; ++level) texels += std::size_t{6} * (16u >> level) * (16u >> level);
    sky.texels.assign(4 * texels, glm::packHalf1x16(1));
    sky.sky_irradiance = glm::vec3(3.14159265f);
    sky.sun_direction = {0.6f, 0.8f, 0};  // of no light, but there
    return sky;
}

class FoamScene {
   public:
    explicit FoamScene(std::string_view preset)
        : scene_({.preset = preset, .quality = "low", .width = 16, .height = 16, .samples = 1}) {
        scene_.renderer.emplace(scene_.gl(), gl::RendererOptions{.patch_vertices = scene_.quadtree.vertices,
                                                                 .resolution = scene_.ocean.resolution(),
                                                                 .tiles = scene_.ocean.tile_count(),
                                                                 .writes = gl::PixelKind::radiance});
        scene_.renderer->set_sky(white_sky());
    }

    /// Green of a square of sea straight from above, through parallel rays. `whitecap_jacobian` of all tiles, if it is given.
    std::vector<float> from_above(int pixels, double side_m, const float* whitecap_jacobian = nullptr) {
        Frame frame = scene_.ocean.frame_at(3);
        std::vector<Tile> tiles(frame.tiles.begin(), frame.tiles.end());
        if (whitecap_jacobian)
            for (Tile& tile : tiles) tile.whitecap_jacobian = *whitecap_jacobian;
        frame.tiles = tiles;
        glm::dmat4 clip(0);
        clip[0][0] = 2 / side_m;
        clip[2][1] = -2 / side_m;
        clip[1][2] = -1.0 / 2000;
        clip[3] = {0, 0, 0, 1};
        const glm::dvec3 viewer(0, 2000, 0);
        const gl::Eye eye{.clip_from_world = clip, .position_m = viewer, .viewport = {0, 0, pixels, pixels}};
        const DrawList& list = scene_.selection.select({.viewer_m = viewer});
        gl::RenderTarget target(scene_.gl(), pixels, pixels, 1, gl::PixelKind::radiance);
        target.bind();
        scene_.gl().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        scene_.renderer->upload(frame);
        scene_.gl().Finish();
        scene_.renderer->draw({.eyes = {&eye, 1},
                               .viewer_m = viewer,
                               .list = &list,
                               .lod_scale = scene_.quadtree.lod_scale,
                               .draws_sky = false});
        const std::vector<float> read = target.read_radiance();
        std::vector<float> green;
        for (std::size_t i = 0; i < read.size(); i += 4) green.push_back(read[i + 1]);
        return green;
    }

   private:
    GlScene scene_;
};

double mean(const std::vector<float>& light) {
    double sum = 0;
    for (const float each : light) sum += each;
    return sum / static_cast<double>(light.size());
}

/// What this part of all pixels is brighter than.
float brighter_than(std::vector<float> light, double part) {
    std::sort(light.begin(), light.end());
    return light[static_cast<std::size_t>((1 - part) * static_cast<double>(light.size() - 1))];
}

// Fresh thick foam reflects at most 0.7 of white light (Whitlock et al. 1982), a film of old bubbles 0.2 and what the bubbles
// below it send up. Under a sky of radiance 1 these are radiances.
TEST(GlFoam, IsAsBrightAsFoamUnderAWhiteSky) {
    constexpr int pixels = 256;
    FoamScene rough("rough");
    const float nearly_all = 0.95f;  // of the crests, so that there are wide fields of fresh foam
    const std::vector<float> thick = rough.from_above(pixels, 60, &nearly_all);
    std::printf("thick foam: %.3f, the brightest pixel %.3f\n", brighter_than(thick, 0.05), brighter_than(thick, 0));
    EXPECT_GT(brighter_than(thick, 0.05), 0.5);
    EXPECT_LE(brighter_than(thick, 0), 0.72);

    FoamScene hurricane("beaufort-12");
    const float none = Tile::no_whitecaps;  // thin streaks are left
    const std::vector<float> thin = hurricane.from_above(pixels, 60, &none);
    std::printf("thin foam: %.3f, water %.3f\n", brighter_than(thin, 0.05), brighter_than(thin, 0.95));
    EXPECT_GT(brighter_than(thin, 0.05), 0.2);
    EXPECT_LT(brighter_than(thin, 0.05), 0.5);
    EXPECT_LT(brighter_than(thin, 0.95), 0.15);
}

// Each scale of foam hands its amount on unchanged, and far away only the amount is left.
TEST(GlFoam, IsAsMuchFromNearAndFar) {
    for (const char* preset : {"rough", "storm"}) {
        FoamScene scene(preset);
        const float none = Tile::no_whitecaps;
        const auto foam = [&](int pixels, double side_m) {
            return mean(scene.from_above(pixels, side_m)) - mean(scene.from_above(pixels, side_m, &none));
        };
        const double near = foam(1024, 500), far = foam(256, 2000);
        std::printf("%s: foam adds %.4f to the mean radiance in pixels of half a metre, %.4f in pixels of 8 m\n",
                    preset, near, far);
        EXPECT_GT(near, 0.001);
        // Measured 0.64 and 0.94; before each scale kept the mean, 0.53 and 0.52. The near square holds some dozens of breakers.
        EXPECT_NEAR(far / near, 1, 0.42) << preset;
    }
}

}  // namespace
}  // namespace pelagic
