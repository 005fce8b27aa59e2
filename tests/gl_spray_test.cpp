// Spray in images: the light of a sprite equals closed forms, surfaces hide it, and a depth texture
// makes it fade.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "pelagic/tests/gl_scene.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;
constexpr int spray_pixels = 128;
/// Looks up, past the sea, which is then not in the image.
const Camera upwards{.position_m = {3, 20, -5}, .target_m = {8, 120, -5}};

glm::dvec3 ahead_of(const Camera& camera, double distance_m) {
    return camera.position_m + distance_m * glm::normalize(camera.target_m - camera.position_m);
}

SprayDroplet droplet_at(const glm::dvec3& place, double radius_m, float opacity) {
    return {
        .x_m = place.x, .y_m = place.y, .z_m = place.z, .radius_m = static_cast<float>(radius_m), .opacity = opacity};
}

/// Radiance of a droplet in front of black, without a sea in the image.
class Sky {
   public:
    std::vector<float> image(const SprayDroplet& droplet, GLuint depth = 0, bool weighs = false) {
        scene_.spray = {.droplets = {&droplet, 1}, .scene_depth = depth};
        scene_.draw(upwards, frame_, false);
        if (!weighs) return scene_.target->read_radiance();
        const gl::Eye eye = gl::eye_of(upwards, {0, 0, spray_pixels, spray_pixels});
        scene_.target->clear();
        scene_.renderer->draw({.eyes = {&eye, 1},
                               .list = &scene_.pass->selection().list(),
                               .draws_sky = false,
                               .exposure = 2,
                               .weighs_samples = true,
                               .spray = scene_.spray});
        return scene_.target->read_radiance();
    }
    GlScene& scene() { return scene_; }

   private:
    GlScene scene_{{.preset = "calm",
                    .quality = "low",
                    .resolution = 64,
                    .width = spray_pixels,
                    .height = spray_pixels,
                    .samples = 0,
                    .writes = gl::PixelKind::radiance}};
    const Frame& frame_ = scene_.ocean.frame_at(0);
};

/// Pixels per metre at a distance.
double pixels_per_metre(double distance_m) {
    return 0.5 * spray_pixels / std::tan(0.5 * upwards.vertical_view_rad) / distance_m;
}

struct Green {
    double sum = 0, max = 0;
};
Green green_of(const std::vector<float>& image) {
    Green green;
    for (std::size_t i = 1; i < image.size(); i += 4) {
        green.sum += static_cast<double>(image[i]);
        green.max = std::max(green.max, static_cast<double>(image[i]));
    }
    return green;
}

/// Radiance of an opaque droplet: 35 % of sunlight by the phase function of Cornette and Shanks
/// 1992 with g = 0.76, 65 % equally in all directions, and skylight from the upper half and a tenth
/// of it from the sea. Air adds nothing over some metres.
double closed_form() {
    const gl::Sky& sky = test_sky();
    const glm::dvec3 ray = glm::normalize(upwards.target_m - upwards.position_m);
    const double cosine = glm::dot(ray, glm::dvec3(sky.sun_direction)), g = 0.76;
    const double phase = 3 / (8 * pi) * (1 - g * g) * (1 + cosine * cosine) /
                         ((2 + g * g) * std::pow(1 + g * g - 2 * g * cosine, 1.5));
    return static_cast<double>(sky.sun_irradiance.y) * (0.35 * phase + 0.65 / (4 * pi)) +
           static_cast<double>(sky.sky_irradiance.y) * 0.55 / pi;
}

// The opacity is (1 - q)^2 of that at the middle, q = (r / radius)^2, with the integral pi / 3
// radius^2. Pixels sample it to 1 % over a radius of 20 pixels; haze over 12 m and the nearest
// pixel's distance to the middle change it by less than 1 %.
TEST(GlSpray, HasTheLightOfTheClosedForm) {
    Sky sky;
    constexpr double distance_m = 12;
    const double radius_m = 20 / pixels_per_metre(distance_m);
    const Green green = green_of(sky.image(droplet_at(ahead_of(upwards, distance_m), radius_m, 0.5f)));
    EXPECT_NEAR(green.max, 0.5 * closed_form(), 0.02 * 0.5 * closed_form());
    EXPECT_NEAR(green.sum, pi / 3 * 20 * 20 * 0.5 * closed_form(), 0.03 * pi / 3 * 20 * 20 * 0.5 * closed_form());
}

// Motion blur spreads a droplet along its path of 1/40 s and conserves its light.
TEST(GlSpray, IsBlurredAlongItsMotion) {
    Sky sky;
    constexpr double distance_m = 12;
    const double radius_m = 8 / pixels_per_metre(distance_m);
    SprayDroplet droplet = droplet_at(ahead_of(upwards, distance_m), radius_m, 0.5f);
    const Green still = green_of(sky.image(droplet));
    droplet.velocity_z_mps = static_cast<float>(2 * radius_m * 40);  // a path of two radii
    const Green moving = green_of(sky.image(droplet));
    EXPECT_NEAR(moving.sum, still.sum, 0.03 * still.sum);
    EXPECT_NEAR(moving.max, still.max / 2, 0.03 * still.max);
}

// A droplet of a tenth of a pixel is drawn as 0.75 pixels wide with the same light. The mean over
// places within a pixel is exact, except for the few places that are drawn here.
TEST(GlSpray, KeepsItsLightWhereItIsSmallerThanAPixel) {
    Sky sky;
    constexpr double distance_m = 40;
    const double pixel_m = 1 / pixels_per_metre(distance_m), expected = pi / 3 * 0.1 * 0.1 * closed_form();
    const glm::dvec3 middle = ahead_of(upwards, distance_m), across(0, 0, pixel_m);
    const glm::dvec3 along = glm::cross(glm::normalize(upwards.target_m - upwards.position_m), across);
    double sum = 0;
    constexpr int places = 5;  // along both axes of a pixel
    for (int i = 0; i < places * places; ++i) {
        const glm::dvec3 place = middle + (i % places + 0.3) / places * across + (i / places + 0.3) / places * along;
        sum += green_of(sky.image(droplet_at(place, 0.1 * pixel_m, 1))).sum / (places * places);
    }
    EXPECT_NEAR(sum, expected, 0.1 * expected);
}

// With weighted samples a pixel's colour is its sum divided by the sum of the weights, which
// remains in alpha. An opaque middle is that of the droplet alone.
TEST(GlSpray, IsEqualWithWeightedSamples) {
    Sky sky;
    const double radius_m = 20 / pixels_per_metre(12);
    const std::vector<float> image = sky.image(droplet_at(ahead_of(upwards, 12), radius_m, 1), 0, true);
    const std::size_t middle = (std::size_t{spray_pixels} * spray_pixels / 2 + spray_pixels / 2) * 4;
    ASSERT_GT(image[middle + 3], 0);
    EXPECT_LT(image[middle + 3], 1);
    EXPECT_NEAR(image[middle + 1] / image[middle + 3], closed_form(), 0.02 * closed_form());
}

TEST(GlSpray, IsHiddenBelowTheWater) {
    GlScene scene({.preset = "calm",
                   .quality = "low",
                   .resolution = 64,
                   .width = spray_pixels,
                   .height = spray_pixels,
                   .samples = 0});
    const Camera camera{.position_m = {0, 6, 0}, .target_m = {10, 0, 0}};
    const Frame& frame = scene.ocean.frame_at(0);
    const std::vector<std::uint8_t> without = scene.image(camera, frame);
    const auto with = [&](double y_m) {
        const SprayDroplet droplet = droplet_at({10, y_m, 0}, 0.5, 0.8f);
        scene.spray.droplets = {&droplet, 1};
        return scene.image(camera, frame);
    };
    EXPECT_EQ(with(-3), without);
    EXPECT_NE(with(1), without);
}

/// A depth texture that shows a plane at a distance from the eye.
class Plane {
   public:
    Plane(const gl::Functions& gl, const gl::Eye& eye, const glm::dvec3& place) : texture(gl) {
        const glm::dvec4 clip = eye.clip_from_world * glm::dvec4(place, 1);
        const auto depth = static_cast<std::uint32_t>((0.5 + 0.5 * clip.z / clip.w) * 4294967295.0);
        const std::array<std::uint32_t, 4> texels = {depth, depth, depth, depth};
        gl.BindTexture(GL_TEXTURE_2D, texture.name());
        gl.TexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT24, 2, 2);
        gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 2, 2, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, texels.data());
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    gl::Texture texture;
};

// A droplet whose middle is in a surface shows half of its light, and one that is a radius in front
// of it shows all. Depths of 24 bits resolve 1e-3 m at 12 m, where the radius is about 2 m.
TEST(GlSpray, FadesAtTheSurfacesOfADepthTexture) {
    Sky sky;
    const gl::Eye eye = gl::eye_of(upwards, {0, 0, spray_pixels, spray_pixels});
    const double radius_m = 20 / pixels_per_metre(12);
    const SprayDroplet droplet = droplet_at(ahead_of(upwards, 12), radius_m, 0.5f);
    const double all = green_of(sky.image(droplet)).sum;
    const auto light_before = [&](double surface_m) {
        const Plane plane(sky.scene().gl(), eye, ahead_of(upwards, surface_m));
        return green_of(sky.image(droplet, plane.texture.name())).sum / all;
    };
    EXPECT_NEAR(light_before(12 + 1.05 * radius_m), 1, 0.01);
    EXPECT_NEAR(light_before(12), 0.5, 0.01);
    EXPECT_NEAR(light_before(12 - 1.05 * radius_m), 0, 0.01);
}

}  // namespace
}  // namespace pelagic
