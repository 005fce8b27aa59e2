// A box in the application's scene is reflected at the position that a level mirror gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "pelagic/gl/gl_state_guard.hpp"
#include "pelagic/tests/gl_scene.hpp"

namespace pelagic {
namespace {

constexpr int image_width = 200, image_height = 150;
using std::numbers::pi;

struct RedBox {
    glm::dvec3 min, max;

    /// Returns the distance in metres along a unit ray to its entry point; infinity if the ray
    /// misses.
    double met(glm::dvec3 from, glm::dvec3 along) const {
        double enters = 0, leaves = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const double a = (min[axis] - from[axis]) / along[axis], b = (max[axis] - from[axis]) / along[axis];
            enters = std::max(enters, std::min(a, b));
            leaves = std::min(leaves, std::max(a, b));
        }
        return enters < leaves ? enters : std::numeric_limits<double>::infinity();
    }
};

const Camera box_camera{.position_m = {0, 3, 0}, .target_m = {30, -2, 0}, .vertical_view_rad = 50 * pi / 180};

gl::Eye test_eye() { return gl::eye_of(box_camera, {0, 0, image_width, image_height}); }

/// Returns the position of a point in the image, in pixels from its lower left corner.
glm::dvec2 pixel_of(glm::dvec3 place) {
    const glm::dvec4 clip = test_eye().clip_from_world * glm::dvec4(place, 1);
    return (0.5 + 0.5 * glm::dvec2(clip) / clip.w) * glm::dvec2(image_width, image_height);
}

/// Returns the ray through a pixel's centre.
glm::dvec3 ray_through(int x, int y) {
    const glm::dvec4 on_near(2 * (x + 0.5) / image_width - 1, 2 * (y + 0.5) / image_height - 1, -1, 1);
    const glm::dvec4 at = glm::inverse(test_eye().clip_from_world) * on_near;
    return glm::normalize(glm::dvec3(at) / at.w - box_camera.position_m);
}

/// Draws a red box by ray casting, as an application would.
struct ApplicationImage {
    ApplicationImage(const gl::Functions& gl, const RedBox& box) : radiance(gl), depth(gl) {
        const gl::GlStateGuard keep(gl);
        std::vector<float> colours, depths;
        for (int y = 0; y < image_height; ++y)
            for (int x = 0; x < image_width; ++x) {
                const glm::dvec3 ray = ray_through(x, y);
                const double way = box.met(box_camera.position_m, ray);
                const bool stands = std::isfinite(way);
                colours.insert(colours.end(), {stands ? 40.f : 0, 0, 0, stands ? 1.f : 0});
                const glm::dvec4 clip =
                    test_eye().clip_from_world * glm::dvec4(box_camera.position_m + (stands ? way : 1) * ray, 1);
                depths.push_back(stands ? static_cast<float>(0.5 + 0.5 * clip.z / clip.w) : 1);
            }
        gl.BindTexture(GL_TEXTURE_2D, radiance.name());
        gl.TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA16F, image_width, image_height);
        gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image_width, image_height, GL_RGBA, GL_FLOAT, colours.data());
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        gl.BindTexture(GL_TEXTURE_2D, depth.name());
        gl.TexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32F, image_width, image_height);
        gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, image_width, image_height, GL_DEPTH_COMPONENT, GL_FLOAT,
                         depths.data());
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    gl::ApplicationScene scene() const { return {radiance.name(), depth.name()}; }

    gl::Texture radiance, depth;
};

class GlApplicationScene : public testing::Test {
   protected:
    /// Returns how much more red each pixel of the sea has with the box than without it, the lower
    /// row first.
    std::vector<float> added_red(const RedBox& box) {
        const Frame& frame = scene_.ocean.frame_at(0);
        const auto drawn = [&] {
            scene_.draw(box_camera, frame);
            return scene_.target->read_radiance();
        };
        const std::vector<float> without = drawn();
        const ApplicationImage image(scene_.gl(), box);
        scene_.application_scene = image.scene();
        const std::vector<float> with = drawn();
        scene_.application_scene.reset();
        EXPECT_EQ(drawn(), without);
        std::vector<float> added;
        for (int y = 0; y < image_height; ++y)
            for (int x = 0; x < image_width; ++x) {
                const std::size_t i =
                    4 * (static_cast<std::size_t>(image_height - 1 - y) * image_width + static_cast<std::size_t>(x));
                added.push_back(with[i] - without[i]);
            }
        return added;
    }
    static float at(const std::vector<float>& image, int x, int y) {
        return image[static_cast<std::size_t>(y) * image_width + static_cast<std::size_t>(x)];
    }

    GlScene scene_{{.preset = "beaufort-0",
                    .quality = "low",
                    .resolution = 32,
                    .width = image_width,
                    .height = image_height,
                    .samples = 0,
                    .size_m = 1024,
                    .writes = gl::PixelKind::radiance}};
};

// The threshold is half of the light of a box 40 times as bright as the sky's unit, at the minimum
// reflectance of water, 2 %.
constexpr float is_red = 0.4f;

TEST_F(GlApplicationScene, IsReflectedWhereALevelMirrorShowsIt) {
    const RedBox box{{20, -2, -3}, {22, 2.5, 2}};
    const std::vector<float> added = added_red(box);
    // The reflection is upside down and extends as far below the waterline as the box is high. The
    // nearer face hides the other one.
    const glm::dvec2 foot = pixel_of({20, 0, -3}), head = pixel_of({20, -2.5, -3}), other = pixel_of({20, -2.5, 2});
    ASSERT_GT(std::abs(foot.y - head.y), 15);
    const int middle = static_cast<int>(0.5 * (head.x + other.x));
    int lowest = image_height, leftmost = image_width, rightmost = 0;
    const int row = static_cast<int>(0.5 * (foot.y + head.y));
    for (int y = 0; y < static_cast<int>(foot.y); ++y)
        if (at(added, middle, y) > is_red) lowest = std::min(lowest, y);
    for (int x = 0; x < image_width; ++x)
        if (at(added, x, row) > is_red) {
            leftmost = std::min(leftmost, x);
            rightmost = std::max(rightmost, x + 1);
        }
    // The reflection may miss the last ray step of the box's top, about 4 pixels here. Ripples move
    // the image by about as much.
    EXPECT_NEAR(lowest, head.y, 4);
    EXPECT_NEAR(leftmost, std::min(pixel_of({20, -1.25, -3}).x, pixel_of({20, -1.25, 2}).x), 2);
    EXPECT_NEAR(rightmost, std::max(pixel_of({20, -1.25, -3}).x, pixel_of({20, -1.25, 2}).x), 2);
    for (int y = lowest + 4; y < static_cast<int>(foot.y) - 1; ++y) EXPECT_GT(at(added, middle, y), is_red) << y;
    // Nothing is reflected beside the box.
    for (int y = 0; y < image_height; ++y)
        for (int x = 0; x < image_width; ++x)
            if (y < head.y - 4 || x < leftmost - 3 || x > rightmost + 3) {
                EXPECT_EQ(at(added, x, y), 0) << x << ", " << y;
            }
}

// A tower extends above the image: its part beyond the upper edge is not reflected; the sky is
// reflected instead.
TEST_F(GlApplicationScene, ReflectionIsTheSkyWhereTheRayLeavesTheImage) {
    const std::vector<float> added = added_red({{20, -2, -3}, {22, 60, 2}});
    int inside = 0, outside = 0;
    for (int y = 0; y < image_height; ++y) {
        const glm::dvec3 ray = ray_through(image_width / 2, y);
        const double way = box_camera.position_m.y / -ray.y;
        if (ray.y >= 0 || way * ray.x > 19) continue;
        const glm::dvec3 water = box_camera.position_m + way * ray;
        const double risen = -ray.y / ray.x * (20 - water.x);
        const double seen_at = pixel_of({20, risen, water.z}).y / image_height;
        // The fade at the edge; ripples deflect rays by up to a tenth of the image.
        if (seen_at < 0.9) {
            EXPECT_GT(at(added, image_width / 2, y), is_red) << y;
            ++inside;
        } else if (seen_at > 1.08) {
            EXPECT_EQ(at(added, image_width / 2, y), 0) << y;
            ++outside;
        }
    }
    EXPECT_GT(inside, 10);
    EXPECT_GT(outside, 5);
}

}  // namespace
}  // namespace pelagic
