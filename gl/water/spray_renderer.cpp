#include "pelagic/gl/water/spray_renderer.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace pelagic::gl {
namespace {

/// Restores the application's blending.
class BlendGuard {
   public:
    explicit BlendGuard(const Functions& gl) : gl_(gl) {
        for (std::size_t i = 0; i < factors.size(); ++i) gl.GetIntegerv(factors[i], &factors_[i]);
        for (std::size_t i = 0; i < equations.size(); ++i) gl.GetIntegerv(equations[i], &equations_[i]);
        gl.GetFloatv(GL_BLEND_COLOR, colour_.data());
    }
    ~BlendGuard() {
        const auto value = [](GLint found) { return static_cast<GLenum>(found); };
        gl_.BlendFuncSeparate(value(factors_[0]), value(factors_[1]), value(factors_[2]), value(factors_[3]));
        gl_.BlendEquationSeparate(value(equations_[0]), value(equations_[1]));
        gl_.BlendColor(colour_[0], colour_[1], colour_[2], colour_[3]);
        gl_.Disable(GL_BLEND);
    }
    BlendGuard(const BlendGuard&) = delete;
    BlendGuard& operator=(const BlendGuard&) = delete;

   private:
    static constexpr std::array<GLenum, 4> factors = {GL_BLEND_SRC_RGB, GL_BLEND_DST_RGB, GL_BLEND_SRC_ALPHA,
                                                      GL_BLEND_DST_ALPHA};
    static constexpr std::array<GLenum, 2> equations = {GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA};
    const Functions& gl_;
    std::array<GLint, 4> factors_{};
    std::array<GLint, 2> equations_{};
    std::array<GLfloat, 4> colour_{};
};

}  // namespace

ProgramFiles spray_program_files(bool multiview, bool soft) {
    std::string defines = "#define CASCADES 1\n#define SHADING 2\n#define SURFACE 0\n#define BELOW 0\n";
    if (multiview) defines += "#define MULTIVIEW\n";
    if (soft) defines += "#define SOFT\n";
    return {"spray.vert.glsl", "spray.frag.glsl", defines};
}

SprayRenderer::SprayRenderer(const Functions& gl, bool multiview)
    : gl_(gl), multiview_(multiview), array_(gl), instances_(gl) {
    staged_.reserve(max_spray_droplets);
    gl.BindVertexArray(array_.name());
    gl.BindBuffer(GL_ARRAY_BUFFER, instances_.name());
    for (const GLuint attribute : {0u, 1u}) {
        gl.EnableVertexAttribArray(attribute);
        gl.VertexAttribDivisor(attribute, 1);
        gl.VertexAttribPointer(attribute, 4, GL_FLOAT, GL_FALSE, sizeof(Instance),
                               reinterpret_cast<const void*>(attribute * sizeof(glm::vec4)));
    }
    gl.BindVertexArray(0);
}

SprayRenderer::Sprites& SprayRenderer::sprites(bool soft) {
    std::optional<Sprites>& chosen = sprites_[soft ? 1 : 0];
    if (!chosen) {
        SeaProgram program(gl_, spray_program_files(multiview_, soft));
        const GLint sample_weight = program.program.uniform("sample_weight");
        chosen = Sprites{std::move(program), sample_weight};
    }
    return *chosen;
}

void SprayRenderer::upload(std::span<const SprayDroplet> droplets, const glm::dvec3& viewer_m) {
    staged_.clear();
    for (const SprayDroplet& droplet : droplets.first(std::min(droplets.size(), max_spray_droplets)))
        staged_.push_back(
            {{glm::vec3(glm::dvec3(droplet.x_m, droplet.y_m, droplet.z_m) - viewer_m), droplet.radius_m},
             {droplet.velocity_x_mps, droplet.velocity_y_mps, droplet.velocity_z_mps, droplet.opacity}});
    gl_.BindBuffer(GL_ARRAY_BUFFER, instances_.name());
    // New storage on each upload; the driver keeps the old storage until its draws are complete.
    gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(staged_.size() * sizeof(Instance)), staged_.data(),
                   GL_STREAM_DRAW);
}

void SprayRenderer::draw(int eye, bool soft, float sample_weight) {
    if (staged_.empty()) return;
    const BlendGuard keep(gl_);
    const Sprites& chosen = sprites(soft);
    chosen.program.use(gl_, eye);
    gl_.Uniform1f(chosen.sample_weight, sample_weight);
    gl_.Enable(GL_BLEND);
    gl_.BlendEquationSeparate(GL_FUNC_ADD, GL_FUNC_ADD);
    gl_.BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_CONSTANT_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl_.BlendColor(0, 0, 0, sample_weight);
    gl_.DepthMask(GL_FALSE);
    gl_.BindVertexArray(array_.name());
    gl_.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(staged_.size()));
    gl_.DepthMask(GL_TRUE);
}

}  // namespace pelagic::gl
