#include "pelagic/gl/meshes/lit_mesh.hpp"

#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>

#include "pelagic/gl/errors.hpp"
#include "pelagic/gl/gl_state_guard.hpp"

namespace pelagic::gl {
namespace {

/// Uniform block of shaders/mesh_light.glsl.
struct MeshLight {
    glm::mat4 clip_from_mesh;
    glm::vec4 sun, sun_irradiance, sky_irradiance;
};

}  // namespace

LitMesh::LitMesh(const Functions& gl, std::span<const MeshVertex> vertices, std::span<const std::uint16_t> indices,
                 std::string_view fragment_file)
    : gl_(gl), count_(static_cast<GLsizei>(indices.size())) {
    const GlStateGuard keep(gl);
    program_ = Program(gl, "mesh.vert.glsl", fragment_file);
    gl.UniformBlockBinding(program_.name(), gl.GetUniformBlockIndex(program_.name(), "MeshLight"), 0);
    array_ = VertexArray(gl);
    gl.BindVertexArray(array_.name());
    vertices_ = Buffer(gl);
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size_bytes()), vertices.data(), GL_STATIC_DRAW);
    for (GLuint location = 0; location < 3; ++location) {
        gl.EnableVertexAttribArray(location);
        gl.VertexAttribPointer(location, 3, GL_FLOAT, GL_FALSE, sizeof(MeshVertex),
                               reinterpret_cast<const void*>(location * sizeof(glm::vec3)));
    }
    indices_ = Buffer(gl);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
    gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size_bytes()), indices.data(),
                  GL_STATIC_DRAW);
    light_ = Buffer(gl);
}

void LitMesh::set_light(const Sky& sky, float sunlit) {
    sun_direction_ = sky.sun_direction;
    sun_irradiance_ = sunlit * sky.sun_irradiance;
    sky_irradiance_ = sky.sky_irradiance;
}

void LitMesh::draw(const Eye& eye, const glm::dmat4& world_from_mesh, float weighing_exposure) {
    const GlStateGuard keep(gl_);
    const glm::vec3 sun = glm::transpose(glm::mat3(world_from_mesh)) * sun_direction_;
    const MeshLight light{glm::mat4(eye.clip_from_world * world_from_mesh), glm::vec4(sun, 0),
                          glm::vec4(sun_irradiance_, weighing_exposure), glm::vec4(sky_irradiance_, 0)};
    gl_.BindBuffer(GL_UNIFORM_BUFFER, light_.name());
    gl_.BufferData(GL_UNIFORM_BUFFER, sizeof(light), &light, GL_STREAM_DRAW);
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, 0, light_.name());
    gl_.UseProgram(program_.name());
    gl_.BindVertexArray(array_.name());
    gl_.Viewport(eye.viewport.x, eye.viewport.y, eye.viewport.width, eye.viewport.height);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DrawElementsInstanced(GL_TRIANGLES, count_, GL_UNSIGNED_SHORT, nullptr, 1);
}

void LitMesh::make_image(int width, int height) {
    radiance_ = Texture(gl_);
    gl_.BindTexture(GL_TEXTURE_2D, radiance_.name());
    int levels = 1;
    while (std::max(width, height) >> levels > 0) ++levels;
    gl_.TexStorage2D(GL_TEXTURE_2D, levels, GL_RGBA16F, width, height);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    depth_ = Texture(gl_);
    gl_.BindTexture(GL_TEXTURE_2D, depth_.name());
    gl_.TexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT24, width, height);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    for (const GLuint texture : {radiance_.name(), depth_.name()}) {
        gl_.BindTexture(GL_TEXTURE_2D, texture);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    framebuffer_ = Framebuffer(gl_);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, radiance_.name(), 0);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw GlError("the driver can't draw half floats, or is out of memory");
    width_ = width;
    height_ = height;
}

ApplicationScene LitMesh::image(const Eye& eye, const glm::dmat4& world_from_mesh) {
    const GlStateGuard keep(gl_);
    const GlTargetsGuard targets(gl_);
    const int width = eye.viewport.width, height = eye.viewport.height;
    if (width != width_ || height != height_) make_image(width, height);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    std::array<GLfloat, 4> clear{};
    GLfloat clear_depth = 1;
    gl_.GetFloatv(GL_COLOR_CLEAR_VALUE, clear.data());
    gl_.GetFloatv(GL_DEPTH_CLEAR_VALUE, &clear_depth);
    gl_.ClearColor(0, 0, 0, 0);
    gl_.ClearDepthf(1);
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl_.ClearColor(clear[0], clear[1], clear[2], clear[3]);
    gl_.ClearDepthf(clear_depth);
    Eye whole = eye;
    whole.viewport = {0, 0, width, height};
    draw(whole, world_from_mesh, 0);
    gl_.BindTexture(GL_TEXTURE_2D, radiance_.name());
    gl_.GenerateMipmap(GL_TEXTURE_2D);
    return {radiance_.name(), depth_.name()};
}

}  // namespace pelagic::gl
