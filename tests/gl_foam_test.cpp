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

/// A square of sea under the white sky.
class FoamScene : public GlScene {
   public:
    explicit FoamScene(std::string_view preset)
        : GlScene({.preset = preset,
                   .quality = "low",
                   .width = 16,
                   .height = 16,
                   .samples = 1,
                   .writes = gl::PixelKind::radiance}) {
        renderer->set_sky(white_sky());
    }
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
    const std::vector<float> thick = rough.light_from_above(3, pixels, 60, nearly_all);
    std::printf("thick foam: %.3f, the brightest pixel %.3f\n", brighter_than(thick, 0.05), brighter_than(thick, 0));
    EXPECT_GT(brighter_than(thick, 0.05), 0.5);
    EXPECT_LE(brighter_than(thick, 0), 0.72);

    FoamScene hurricane("beaufort-12");
    const float none = Tile::no_whitecaps;  // thin streaks are left
    const std::vector<float> thin = hurricane.light_from_above(3, pixels, 60, none);
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
            return mean(scene.light_from_above(3, pixels, side_m)) -
                   mean(scene.light_from_above(3, pixels, side_m, none));
        };
        const double near = foam(1024, 500), far = foam(256, 2000);
        std::printf("%s: foam adds %.4f to the mean radiance in pixels of half a metre, %.4f in pixels of 8 m\n",
                    preset, near, far);
        EXPECT_GT(near, 0.001);
        // Measured 0.63 and 1.10; before each scale kept the mean, 0.53 and 0.52. The near square holds some dozens of breakers.
        EXPECT_NEAR(far / near, 1, 0.42) << preset;
    }
}

}  // namespace
}  // namespace pelagic
