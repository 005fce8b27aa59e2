#include "pelagic/gl/water/spray_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <utility>

#include "pelagic/gl/water/spray_image.hpp"

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

/// Unit of the shreds. The sea's programs have no array texture in it.
constexpr Unit shreds_unit = caustics_unit;

Texture make_shreds(const Functions& gl) {
    const SprayImage image = make_spray_image();
    Texture texture(gl);
    gl.ActiveTexture(GL_TEXTURE0 + shreds_unit);
    gl.BindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
    gl.TexStorage3D(GL_TEXTURE_2D_ARRAY, SprayImage::levels, GL_R8, SprayImage::side, SprayImage::side,
                    SprayImage::layers);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int level = 0; level < SprayImage::levels; ++level)
        gl.TexSubImage3D(GL_TEXTURE_2D_ARRAY, level, 0, 0, 0, SprayImage::side >> level, SprayImage::side >> level,
                         SprayImage::layers, GL_RED, GL_UNSIGNED_BYTE, image.level(level));
    gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    return texture;
}

/// Returns a droplet's random number, which is constant while it flies: that of its launch.
float random_of(double launch_s) {
    const double scaled = launch_s * 977;
    return static_cast<float>(scaled - std::floor(scaled));
}

}  // namespace

ProgramFiles spray_program_files(bool multiview, bool soft) {
    std::string defines = "#define CASCADES 1\n#define SHADING 2\n#define SURFACE 0\n#define BELOW 0\n";
    if (multiview) defines += "#define MULTIVIEW\n";
    if (soft) defines += "#define SOFT\n";
    return {"spray.vert.glsl", "spray.frag.glsl", defines};
}

SprayRenderer::SprayRenderer(const Functions& gl, bool multiview)
    : gl_(gl), multiview_(multiview), array_(gl), instances_(gl), shreds_(make_shreds(gl)) {
    staged_.reserve(max_spray_droplets);
    gl.BindVertexArray(array_.name());
    gl.BindBuffer(GL_ARRAY_BUFFER, instances_.name());
    for (const GLuint attribute : {0u, 1u, 2u}) {
        gl.EnableVertexAttribArray(attribute);
        gl.VertexAttribDivisor(attribute, 1);
        gl.VertexAttribPointer(attribute, attribute < 2 ? 4 : 2, GL_FLOAT, GL_FALSE, sizeof(Instance),
                               reinterpret_cast<const void*>(attribute * sizeof(glm::vec4)));
    }
    gl.BindVertexArray(0);
}

SprayRenderer::Sprites& SprayRenderer::sprites(bool soft) {
    std::optional<Sprites>& chosen = sprites_[soft ? 1 : 0];
    if (!chosen) {
        SeaProgram program(gl_, spray_program_files(multiview_, soft));
        const GLint sample_weight = program.program.uniform("sample_weight");
        gl_.Uniform1i(program.program.uniform("shreds"), shreds_unit);
        const GLint gale = program.program.uniform("gale");
        chosen = Sprites{std::move(program), sample_weight, gale};
    }
    return *chosen;
}

void SprayRenderer::upload(std::span<const SprayDroplet> droplets, double time_s, double wind_mps,
                           const glm::dvec3& viewer_m) {
    constexpr double calm_mps = 12, gale_mps = 20.8;  // Beaufort 6 and 9
    const double rough = std::clamp((wind_mps - calm_mps) / (gale_mps - calm_mps), 0., 1.);
    gale_ = static_cast<float>(rough * rough);
    constexpr float least_opacity = 0.004f;  // a step of a screen
    // Smaller drops are less than a tenth of a pixel there.
    constexpr float drop_m = 0.05f, drops_end_m = 60;
    staged_.clear();
    for (const SprayDroplet& droplet : droplets.first(std::min(droplets.size(), max_spray_droplets))) {
        const glm::vec3 place(glm::dvec3(droplet.x_m, droplet.y_m, droplet.z_m) - viewer_m);
        if (droplet.opacity < least_opacity) continue;
        if (droplet.radius_m < drop_m && glm::length(place) > drops_end_m) continue;
        staged_.push_back({{place, droplet.radius_m},
                           {droplet.velocity_x_mps, droplet.velocity_y_mps, droplet.velocity_z_mps, droplet.opacity},
                           {droplet.age_s, random_of(time_s - static_cast<double>(droplet.age_s))}});
    }
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
    gl_.Uniform1f(chosen.gale, gale_);
    gl_.Enable(GL_BLEND);
    gl_.BlendEquationSeparate(GL_FUNC_ADD, GL_FUNC_ADD);
    gl_.BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_CONSTANT_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl_.BlendColor(0, 0, 0, sample_weight);
    gl_.DepthMask(GL_FALSE);
    gl_.ActiveTexture(GL_TEXTURE0 + shreds_unit);
    gl_.BindTexture(GL_TEXTURE_2D_ARRAY, shreds_.name());
    gl_.BindVertexArray(array_.name());
    gl_.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(staged_.size()));
    gl_.DepthMask(GL_TRUE);
}

}  // namespace pelagic::gl
