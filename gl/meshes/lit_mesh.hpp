// A mesh lit by a sky. It is drawn before the sea, and its image is passed to the sea renderer for
// reflections. An application draws its own scene in the same order.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>

#include "pelagic/gl/application_scene.hpp"
#include "pelagic/gl/objects.hpp"
#include "pelagic/gl/program.hpp"
#include "pelagic/gl/sky/sky_baker.hpp"
#include "pelagic/gl/views.hpp"

namespace pelagic::gl {

struct MeshVertex {
    glm::vec3 position, outwards;  ///< outwards: unit normal
    glm::vec3 paint{};             ///< albedo, if the shader uses it
};

class LitMesh {
   public:
    /// \param indices  three for each triangle
    /// \param fragment_file  fragment shader in gl/shaders/, used with mesh.vert.glsl
    /// \throws GlError if the driver rejects the shader
    LitMesh(const Functions& gl, std::span<const MeshVertex> vertices, std::span<const std::uint16_t> indices,
            std::string_view fragment_file);

    /// \param sunlit  SeaRenderer::sunlit_at() the place of the mesh
    void set_light(const Sky& sky, float sunlit = 1);
    /// Draws linear radiance into the bound framebuffer, which needs a depth buffer.
    /// \param world_from_mesh  rotation and translation only
    /// \param weighing_exposure  the exposure if the sea is drawn with DrawInput::weighs_samples,
    /// else 0
    void draw(const Eye& eye, const glm::dmat4& world_from_mesh, float weighing_exposure);
    /// Draws the mesh without the sea into textures, which the next call overwrites.
    /// \throws GlError if the driver cannot render to half floats
    ApplicationScene image(const Eye& eye, const glm::dmat4& world_from_mesh);

   private:
    void make_image(int width, int height);

    const Functions& gl_;
    Program program_;
    Buffer vertices_, indices_, light_;
    GLsizei count_;  ///< number of indices
    VertexArray array_;
    glm::vec3 sun_direction_{0, 1, 0}, sun_irradiance_{1}, sky_irradiance_{1};
    Texture radiance_, depth_;
    Framebuffer framebuffer_;
    int width_ = 0, height_ = 0;  ///< size of the textures
};

}  // namespace pelagic::gl
