#include "pelagic/gl/light_meter.hpp"

#include "pelagic/gl/gl_state_guard.hpp"
#include "pelagic/gl/image_pass.hpp"

namespace pelagic::gl {
namespace {

constexpr std::size_t meter_cells = std::size_t{LightMeter::columns} * LightMeter::rows;
constexpr std::size_t meter_bytes = meter_cells * 4 * sizeof(float);

std::vector<MeteredCell> cells_of(const float* rgba) {
    std::vector<MeteredCell> all(meter_cells);
    for (std::size_t i = 0; i < meter_cells; ++i) all[i] = {rgba[4 * i], rgba[4 * i + 1]};
    return all;
}

}  // namespace

struct LightMeter::State {
    explicit State(const Functions& functions)
        : gl(functions),
          pass(functions, "meter.frag.glsl"),
          empty(functions),
          target(functions, columns, rows),
          pixels(functions) {
        gl.BindBuffer(GL_PIXEL_PACK_BUFFER, pixels.name());
        gl.BufferData(GL_PIXEL_PACK_BUFFER, meter_bytes, nullptr, GL_STREAM_READ);
    }
    ~State() {
        if (fence) gl.DeleteSync(fence);
    }

    /// Draws the cells into the target and leaves its framebuffer bound.
    void draw(const TexturePart& radiance) {
        gl.BindVertexArray(empty.name());
        gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer.name());
        gl.Viewport(0, 0, columns, rows);
        pass.use();
        pass.read("radiance", 0, radiance);
        pass.set("cells", columns, rows, 1.f / columns, 1.f / rows);
        pass.draw();
    }

    const Functions& gl;
    ImagePass pass;
    VertexArray empty;
    RadianceTexture target;
    Buffer pixels;
    GLsync fence = nullptr;
};

LightMeter::LightMeter(const Functions& gl) {
    const GlStateGuard keep(gl);
    const GlTargetsGuard targets(gl);
    state_ = std::make_unique<State>(gl);
}
LightMeter::~LightMeter() = default;

std::vector<MeteredCell> LightMeter::measure(const TexturePart& radiance) {
    const Functions& gl = state_->gl;
    const GlStateGuard keep(gl);
    const GlTargetsGuard targets(gl);
    state_->draw(radiance);
    std::vector<float> rgba(4 * meter_cells);
    gl.ReadPixels(0, 0, columns, rows, GL_RGBA, GL_FLOAT, rgba.data());
    return cells_of(rgba.data());
}

void LightMeter::start(const TexturePart& radiance) {
    if (state_->fence) return;
    const Functions& gl = state_->gl;
    const GlStateGuard keep(gl);
    const GlTargetsGuard targets(gl);
    state_->draw(radiance);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, state_->pixels.name());
    gl.ReadPixels(0, 0, columns, rows, GL_RGBA, GL_FLOAT, nullptr);
    state_->fence = gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

std::optional<std::vector<MeteredCell>> LightMeter::finished() {
    const Functions& gl = state_->gl;
    if (!state_->fence) return {};
    const GLenum met = gl.ClientWaitSync(state_->fence, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
    if (met != GL_ALREADY_SIGNALED && met != GL_CONDITION_SATISFIED) return {};
    gl.DeleteSync(state_->fence);
    state_->fence = nullptr;
    const GlTargetsGuard targets(gl);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, state_->pixels.name());
    std::optional<std::vector<MeteredCell>> seen;
    if (const void* rgba = gl.MapBufferRange(GL_PIXEL_PACK_BUFFER, 0, meter_bytes, GL_MAP_READ_BIT))
        seen = cells_of(static_cast<const float*>(rgba));
    gl.UnmapBuffer(GL_PIXEL_PACK_BUFFER);
    return seen;
}

}  // namespace pelagic::gl
