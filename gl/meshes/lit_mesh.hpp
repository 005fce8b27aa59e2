// A mesh in the light of a sky, drawn before the sea and handed in to be mirrored, as an application would do it with its own.
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
    glm::vec3 position, outwards;
    glm::vec3 paint{};  ///< albedo, if the shader takes it
};

class LitMesh {
   public:
    /// \param indices  of triangles
    /// \param fragment_file  of gl/shaders/, after mesh.vert.glsl. Throws GlError.
    LitMesh(const Functions& gl, std::span<const MeshVertex> vertices, std::span<const std::uint16_t> indices,
            std::string_view fragment_file);

    void set_light(const Sky& sky);
    /// As linear radiance, into the bound framebuffer, which has depth.
    /// \param world_from_mesh  turns and moves, nothing else
    /// \param weighing_exposure  as the sea is drawn with DrawInput::weighs_samples: the exposure; 0 without
    void draw(const Eye& eye, const glm::dmat4& world_from_mesh, float weighing_exposure);
    /// What the eye sees of it without the sea, in textures that the next call overwrites. Throws GlError where the driver
    /// can't draw half floats.
    ApplicationScene image(const Eye& eye, const glm::dmat4& world_from_mesh);

   private:
    void make_image(int width, int height);

    const Functions& gl_;
    Program program_;
    Buffer vertices_, indices_, light_;
    GLsizei count_;  ///< of indices
    VertexArray array_;
    glm::vec3 sun_direction_{0, 1, 0}, sun_irradiance_{1}, sky_irradiance_{1};
    Texture radiance_, depth_;
    Framebuffer framebuffer_;
    int width_ = 0, height_ = 0;  ///< of the textures
};

}  // namespace pelagic::gl
