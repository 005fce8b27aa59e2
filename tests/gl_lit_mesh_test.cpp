// An application's mesh appears at its position, lit according to its orientation.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "pelagic/gl/headless_context.hpp"
#include "pelagic/gl/meshes/lit_mesh.hpp"
#include "pelagic/gl/render_target.hpp"

namespace pelagic {
namespace {

constexpr int lit_pixels = 16;

/// A square of side 2 m that faces +x, a metre above the waterline, where no paint is wet.
constexpr std::array<gl::MeshVertex, 4> lit_square = {{{{0, 1, -1}, {1, 0, 0}, {0.5f, 0.25f, 0.125f}},
                                                       {{0, 3, -1}, {1, 0, 0}, {0.5f, 0.25f, 0.125f}},
                                                       {{0, 3, 1}, {1, 0, 0}, {0.5f, 0.25f, 0.125f}},
                                                       {{0, 1, 1}, {1, 0, 0}, {0.5f, 0.25f, 0.125f}}}};
constexpr std::array<std::uint16_t, 6> lit_triangles = {0, 1, 2, 0, 2, 3};

// Lambert: albedo / pi times the irradiance, from the sky above a level horizon and from the sea
// below it, which reflects 6 % of the light.
TEST(GlLitMesh, IsLitAccordingToItsOrientation) {
    gl::HeadlessContext context({.debug = true});
    const gl::Functions& functions = context.functions();
    gl::LitMesh mesh(functions, lit_square, lit_triangles, "boat.frag.glsl");
    gl::Sky sky;
    sky.sun_direction = glm::normalize(glm::vec3(-0.3f, 0.4f, 0.8f));
    sky.sun_irradiance = glm::vec3(0.8f, 0.7f, 0.6f);
    sky.sky_irradiance = glm::vec3(0.1f, 0.15f, 0.2f);
    mesh.set_light(sky);
    const glm::dvec3 foot(300, 1, -200);
    // From straight above, through parallel rays: a square of side 8 m around its foot; x to the
    // right, z down.
    glm::dmat4 clip(0);
    clip[0][0] = 0.25;
    clip[2][1] = -0.25;
    clip[1][2] = -0.02;
    clip[3] = {-0.25 * foot.x, 0.25 * foot.z, 0, 1};
    const gl::Eye eye{.clip_from_world = clip, .position_m = foot, .viewport = {0, 0, lit_pixels, lit_pixels}};
    gl::RenderTarget target(functions, lit_pixels, lit_pixels, 0, gl::PixelKind::radiance);

    for (const double heading : {0.4, 2.0, -2.5}) {
        // The mesh is rotated by its heading, then pitched up by one radian.
        glm::dmat4 pose = glm::rotate(glm::translate(glm::dmat4(1), foot), -heading, glm::dvec3(0, 1, 0));
        pose = glm::rotate(pose, 1.0, glm::dvec3(0, 0, 1));
        const glm::dvec3 facing(std::cos(1.0) * std::cos(heading), std::sin(1.0), std::cos(1.0) * std::sin(heading));
        target.bind();
        functions.ClearColor(0, 0, 0, 0);
        functions.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        mesh.draw(eye, pose, 0);
        const std::vector<float> pixels = target.read_radiance();

        const glm::dvec3 middle = foot + 2.0 * glm::dvec3(pose[1]);
        const auto column = static_cast<std::size_t>((0.5 + 0.125 * (middle.x - foot.x)) * lit_pixels);
        const auto row = static_cast<std::size_t>((0.5 + 0.125 * (middle.z - foot.z)) * lit_pixels);
        const float sunlit = std::max(glm::dot(glm::vec3(facing), sky.sun_direction), 0.f);
        const float* const seen = &pixels[4 * (row * lit_pixels + column)];
        for (int i = 0; i < 3; ++i) {
            // The mesh uses the sky of a boat on an even keel, in the mesh's axes.
            const float light = sky.sun_irradiance[i] * sunlit + sky.sky_irradiance[i] * 0.53f;
            EXPECT_NEAR(seen[i], lit_square[0].paint[i] / std::numbers::pi_v<float> * light, 2e-4)
                << heading << ", channel " << i;
        }
        EXPECT_EQ(pixels[0], 0);
    }
    EXPECT_TRUE(context.messages().empty());
}

}  // namespace
}  // namespace pelagic
