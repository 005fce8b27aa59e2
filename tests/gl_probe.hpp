// Evaluates functions of gl/shaders/ at the positions of a square, without the rest of the sea.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <vector>

#include "pelagic/gl/headless_context.hpp"
#include "pelagic/gl/program.hpp"
#include "pelagic/gl/render_target.hpp"
#include "pelagic/gl/water/scene_block.hpp"

namespace pelagic {

class GlProbe {
   public:
    static constexpr int side = 128;  ///< pixels a side, one position each

    /// \param files  names in gl/shaders/, included after scene.glsl
    /// \param body  code that sets the vec4 `result`
    GlProbe(gl::Surface surface, std::initializer_list<const char*> files, const std::string& body)
        : gl_(context_.functions()) {
        const std::string defines =
            "precision highp float;\nprecision highp int;\nprecision highp sampler2DArray;\n"
            "#define CASCADES 1\n#define SHADING 2\n#define BELOW 0\n#define SURFACE " +
            std::to_string(static_cast<int>(surface)) + "\n";
        std::string fragment = gl::shader_source("scene.glsl", defines);
        fragment += "const float pi = 3.14159265;\n";
        for (const char* file : files) fragment += gl::shader_text(file);
        fragment += "out vec4 result;\nvoid main() {\n" + body + "\n}\n";
        program_ = gl_.CreateProgram();
        add(GL_VERTEX_SHADER,
            "#version 300 es\nvoid main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, "
            "0.0, 1.0); }\n");
        add(GL_FRAGMENT_SHADER, fragment);
        gl_.LinkProgram(program_);
        gl_.UseProgram(program_);
        gl_.UniformBlockBinding(program_, gl_.GetUniformBlockIndex(program_, "Scene"), 0);
        target_.bind();
    }
    ~GlProbe() { gl_.DeleteProgram(program_); }

    const gl::Functions& gl() const { return gl_; }
    /// Returns the RGBA of all positions in rows, the upper row first.
    std::vector<float> ask(const gl::SceneBlock& block) {
        const gl::Buffer scene(gl_);
        gl_.BindBuffer(GL_UNIFORM_BUFFER, scene.name());
        gl_.BufferData(GL_UNIFORM_BUFFER, sizeof block, &block, GL_STREAM_DRAW);
        gl_.BindBufferBase(GL_UNIFORM_BUFFER, 0, scene.name());
        target_.bind();
        gl_.UseProgram(program_);
        gl_.Viewport(0, 0, side, side);
        gl_.DrawArrays(GL_TRIANGLES, 0, 3);
        EXPECT_EQ(gl_.GetError(), static_cast<GLenum>(GL_NO_ERROR));
        return target_.read_radiance();
    }

   private:
    void add(GLenum kind, const std::string& text) {
        const GLuint shader = gl_.CreateShader(kind);
        const char* start = text.c_str();
        gl_.ShaderSource(shader, 1, &start, nullptr);
        gl_.CompileShader(shader);
        char log[2000] = "";
        gl_.GetShaderInfoLog(shader, sizeof log, nullptr, log);
        EXPECT_STREQ(log, "");
        gl_.AttachShader(program_, shader);
        gl_.DeleteShader(shader);
    }

    gl::HeadlessContext context_{{.debug = true}};
    const gl::Functions& gl_;
    GLuint program_ = 0;
    gl::RenderTarget target_{gl_, side, side, 1, gl::PixelKind::radiance};
};

}  // namespace pelagic
