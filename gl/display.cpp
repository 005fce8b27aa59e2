#include "pelagic/gl/display.hpp"

#include <algorithm>
#include <vector>

#include "pelagic/gl/errors.hpp"
#include "pelagic/gl/gl_state_guard.hpp"
#include "pelagic/gl/image_pass.hpp"

namespace pelagic::gl {
namespace {

/// Maximum number of bloom levels. Each level has half the sides of the previous one. The coarsest
/// level spreads light over a fifth of the image's height.
constexpr int max_levels = 6;
constexpr int min_side = 4;

TexturePart used_region(const RadianceTexture& level, const TexturePart& image, int halvings) {
    const auto halved = [&](int side) { return std::max(1, (side + (1 << halvings) - 1) >> halvings); };
    return {level.texture.name(), halved(image.width), halved(image.height), level.width, level.height};
}

}  // namespace

struct Display::State {
    explicit State(const Functions& functions)
        : gl(functions),
          down(functions, "bloom_down.frag.glsl"),
          up(functions, "bloom_up.frag.glsl"),
          film(functions, "display.frag.glsl"),
          empty(functions) {}

    void fit(const TexturePart& image) {
        if (image.texture_width == width && image.texture_height == height) return;
        width = image.texture_width;
        height = image.texture_height;
        fine.clear();
        spread.clear();
        for (int i = 1; i <= max_levels && (std::min(width, height) >> i) >= min_side; ++i) {
            // Rounded up, so that a smaller image in the texture fits at every level.
            const int w = (width + (1 << i) - 1) >> i, h = (height + (1 << i) - 1) >> i;
            fine.emplace_back(gl, w, h);
            spread.emplace_back(gl, w, h);
        }
    }

    void draw_into(const RadianceTexture& target, const TexturePart& region, const ImagePass& pass) {
        gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.name());
        gl.Viewport(0, 0, region.width, region.height);
        pass.draw();
    }

    /// Returns the spread light of the image: the mean of all levels.
    TexturePart bloom(const TexturePart& image) {
        std::vector<TexturePart> regions;
        TexturePart finer = image;
        down.use();
        for (std::size_t i = 0; i < fine.size(); ++i) {
            regions.push_back(used_region(fine[i], image, static_cast<int>(i) + 1));
            down.read("finer", 0, finer);
            draw_into(fine[i], regions[i], down);
            finer = regions[i];
        }
        up.use();
        TexturePart coarser = regions.back();
        for (std::size_t i = fine.size() - 1; i-- > 0;) {
            up.read("level", 0, regions[i]);
            up.read("coarser", 1, coarser);
            const auto levels_below = static_cast<float>(fine.size() - 1 - i);
            up.set("coarser_weight", levels_below / (levels_below + 1));
            coarser = used_region(spread[i], image, static_cast<int>(i) + 1);
            draw_into(spread[i], coarser, up);
        }
        return coarser;
    }

    const Functions& gl;
    ImagePass down, up, film;
    VertexArray empty;
    int width = 0, height = 0;
    std::vector<RadianceTexture> fine, spread;
};

Display::Display(const Functions& gl) {
    if (!gl.renders_to_half_floats)
        throw GlError("the driver can't draw radiance: it has no EXT_color_buffer_half_float");
    const GlStateGuard keep(gl);
    state_ = std::make_unique<State>(gl);
}
Display::~Display() = default;

void Display::show(const TexturePart& radiance, const Look& look, const Viewport& to) {
    State& s = *state_;
    const GlStateGuard keep(s.gl);
    const GlTargetsGuard targets(s.gl);
    s.gl.BindVertexArray(s.empty.name());
    // Without bloom the shader does not sample this texture.
    TexturePart spread = radiance;
    float bloom = 0;
    if (look.bloom > 0) {
        s.gl.ActiveTexture(GL_TEXTURE0);
        s.fit(radiance);
        if (!s.fine.empty()) {
            spread = s.bloom(radiance);
            bloom = look.bloom;
        }
    }
    targets.bind_drawn();
    s.gl.Viewport(to.x, to.y, to.width, to.height);
    s.film.use();
    s.film.read("radiance", 0, radiance);
    s.film.read("spread", 1, spread);
    s.film.set("look", look.exposure, look.luminance_of_unit, bloom, look.framebuffer_is_srgb ? 0.f : 1.f);
    s.film.draw();
}

}  // namespace pelagic::gl
