#include "pelagic/gl/rock.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "pelagic/gl/errors.hpp"
#include "pelagic/gl/kept_state.hpp"

namespace pelagic::gl {
namespace {

constexpr int around = 192, down = 96;
constexpr float pi = 3.14159265f;

/// The block of shaders/rock_light.glsl.
struct RockLight {
    glm::mat4 clip_from_rock;
    glm::vec4 sun, sun_irradiance, sky_irradiance;
};

/// [-1, 1], the same for a corner of the lattice each time.
float value_at(glm::ivec3 corner) {
    std::uint32_t h = static_cast<std::uint32_t>(corner.x) * 0x8da6b343u ^
                      static_cast<std::uint32_t>(corner.y) * 0xd8163841u ^
                      static_cast<std::uint32_t>(corner.z) * 0xcb1ab31fu;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return static_cast<float>(h >> 8) / 8388608.f - 1;
}

/// Value noise.
float noise(glm::vec3 at) {
    const glm::vec3 corner = glm::floor(at);
    const glm::vec3 t = at - corner, w = t * t * (3.f - 2.f * t);
    float sum = 0;
    for (int i = 0; i < 8; ++i) {
        const glm::ivec3 step(i & 1, i >> 1 & 1, i >> 2);
        const glm::vec3 part = glm::mix(1.f - w, w, glm::vec3(step));
        sum += part.x * part.y * part.z * value_at(glm::ivec3(corner) + step);
    }
    return sum;
}

/// A cone with a round top, broken by ridges at five scales.
glm::vec3 on_rock(float u, float v) {
    const glm::vec3 direction(std::sin(v) * std::cos(u), std::cos(v), std::sin(v) * std::sin(u));
    float radius = 1, height = 0.3f;
    glm::vec3 at = 1.3f * direction + glm::vec3(3.7f, 1.1f, 8.2f);
    for (int octave = 0; octave < 5; ++octave, height *= 0.5f, at = 2.03f * at) {
        radius += height * (0.6f - 1.6f * std::abs(noise(at)));
    }
    // Its foot lies deep.
    return radius * direction * glm::vec3(6, direction.y > 0 ? 6 : 4, 5);
}

struct Vertex {
    glm::vec3 position, outwards;
};

std::vector<Vertex> rock_vertices() {
    std::vector<Vertex> all;
    for (int j = 0; j <= down; ++j)
        for (int i = 0; i <= around; ++i) {
            const float u = 2 * pi * static_cast<float>(i) / around;
            // The poles have no direction around.
            const float v = std::clamp(pi * static_cast<float>(j) / down, 1e-3f, pi - 1e-3f);
            const float step = 0.5f * pi / down;
            const glm::vec3 along = on_rock(u + step, v) - on_rock(u - step, v),
                            below = on_rock(u, v + step) - on_rock(u, v - step);
            all.push_back({on_rock(u, v), glm::normalize(glm::cross(along, below))});
        }
    return all;
}

std::vector<std::uint16_t> rock_indices() {
    std::vector<std::uint16_t> all;
    for (int j = 0; j < down; ++j)
        for (int i = 0; i < around; ++i) {
            const int corner = j * (around + 1) + i;
            for (const int index :
                 {corner, corner + 1, corner + around + 1, corner + 1, corner + around + 2, corner + around + 1})
                all.push_back(static_cast<std::uint16_t>(index));
        }
    return all;
}

}  // namespace

Rock::Rock(const Functions& gl, glm::dvec3 foot_m) : gl_(gl), foot_m_(foot_m) {
    const KeptState keep(gl);
    program_ = Program(gl, "rock.vert.glsl", "rock.frag.glsl");
    gl.UniformBlockBinding(program_.name(), gl.GetUniformBlockIndex(program_.name(), "RockLight"), 0);
    array_ = VertexArray(gl);
    gl.BindVertexArray(array_.name());
    const std::vector<Vertex> vertices = rock_vertices();
    vertices_ = Buffer(gl);
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
                  GL_STATIC_DRAW);
    for (GLuint location = 0; location < 2; ++location) {
        gl.EnableVertexAttribArray(location);
        gl.VertexAttribPointer(location, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                               reinterpret_cast<const void*>(location * sizeof(glm::vec3)));
    }
    const std::vector<std::uint16_t> indices = rock_indices();
    indices_ = Buffer(gl);
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
    gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint16_t)),
                  indices.data(), GL_STATIC_DRAW);
    light_ = Buffer(gl);
}

void Rock::set_light(const Sky& sky) {
    sun_direction_ = sky.sun_direction;
    sun_irradiance_ = sky.sun_irradiance;
    sky_irradiance_ = sky.sky_irradiance;
}

void Rock::draw(const Eye& eye, float weighing_exposure) {
    const KeptState keep(gl_);
    const RockLight light{glm::mat4(glm::translate(eye.clip_from_world, foot_m_)), glm::vec4(sun_direction_, 0),
                          glm::vec4(sun_irradiance_, weighing_exposure), glm::vec4(sky_irradiance_, 0)};
    gl_.BindBuffer(GL_UNIFORM_BUFFER, light_.name());
    gl_.BufferData(GL_UNIFORM_BUFFER, sizeof(light), &light, GL_STREAM_DRAW);
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, 0, light_.name());
    gl_.UseProgram(program_.name());
    gl_.BindVertexArray(array_.name());
    gl_.Viewport(eye.viewport.x, eye.viewport.y, eye.viewport.width, eye.viewport.height);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DrawElementsInstanced(GL_TRIANGLES, around * down * 6, GL_UNSIGNED_SHORT, nullptr, 1);
}

HostScene Rock::picture(const Eye& eye) {
    const KeptState keep(gl_);
    const KeptTargets targets(gl_);
    const int width = eye.viewport.width, height = eye.viewport.height;
    if (width != width_ || height != height_) {
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
    draw(whole, 0);
    gl_.BindTexture(GL_TEXTURE_2D, radiance_.name());
    gl_.GenerateMipmap(GL_TEXTURE_2D);
    return {radiance_.name(), depth_.name()};
}

}  // namespace pelagic::gl
