#include "pelagic/gl/render_target.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

#include "pelagic/gl/errors.hpp"
#include "pelagic/message/number_text.hpp"

namespace pelagic::gl {
namespace {

Renderbuffer make_renderbuffer(const Functions& gl, GLenum format, int width, int height, int samples) {
    Renderbuffer buffer(gl);
    gl.BindRenderbuffer(GL_RENDERBUFFER, buffer.name());
    gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
    return buffer;
}

}  // namespace

RenderTarget::RenderTarget(const Functions& gl, int width, int height, int samples, PixelKind kind)
    : gl_(gl), width_(width), height_(height) {
    if (kind == PixelKind::radiance && !gl.renders_to_half_floats)
        throw GlError("the driver can't draw radiance: it has no EXT_color_buffer_half_float");
    if (kind == PixelKind::data && !gl.renders_to_floats)
        throw GlError("the driver can't draw surface data: it has no EXT_color_buffer_float");
    const GLenum format = kind == PixelKind::data       ? GL_RGBA32F
                          : kind == PixelKind::radiance ? GL_RGBA16F
                                                        : GL_RGBA8;
    GLint max_side = 0, max_samples = 0;
    gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &max_side);
    gl.GetIntegerv(GL_MAX_SAMPLES, &max_samples);
    if (width > max_side || height > max_side)
        throw GlError("an image of " + number_text(width) + "x" + number_text(height) +
                      " is too large for the driver, at most " + number_text(max_side) + " pixels a side");
    samples = std::min(samples, static_cast<int>(max_samples));
    colour_ = make_renderbuffer(gl, format, width, height, samples);
    depth_ = make_renderbuffer(gl, GL_DEPTH_COMPONENT24, width, height, samples);
    resolved_colour_ = Texture(gl);
    gl.BindTexture(GL_TEXTURE_2D, resolved_colour_.name());
    gl.TexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    framebuffer_ = Framebuffer(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.name());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
    const bool is_whole = gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    resolved_ = Framebuffer(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, resolved_colour_.name(), 0);
    if (!is_whole || gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw GlError("the driver can't make an image of " + number_text(width) + "x" + number_text(height) +
                      "; is it out of memory?");
    bind();
}

void RenderTarget::bind() {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl_.Viewport(0, 0, width_, height_);
}

void RenderTarget::clear(const glm::vec3& colour) {
    bind();
    gl_.ClearColor(colour.x, colour.y, colour.z, 1);
    gl_.ClearDepthf(1);
    gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

TexturePart RenderTarget::resolved(int width, int height) {
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.name());
    gl_.BlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    bind();
    return {resolved_colour_.name(), width, height, width_, height_};
}

void RenderTarget::show(int width, int height, int window_width, int window_height) {
    resolved(width, height);
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.name());
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    const bool is_same_size = width == window_width && height == window_height;
    gl_.BlitFramebuffer(0, 0, width, height, 0, 0, window_width, window_height, GL_COLOR_BUFFER_BIT,
                        is_same_size ? GL_NEAREST : GL_LINEAR);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

void RenderTarget::read_rows(GLenum type, void* pixels, std::size_t bytes_per_row) {
    resolved();
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.name());
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, type, pixels);
    auto* const rows = static_cast<std::byte*>(pixels);
    for (int y = 0; y < height_ / 2; ++y)
        std::swap_ranges(rows + bytes_per_row * y, rows + bytes_per_row * (y + 1),
                         rows + bytes_per_row * (height_ - 1 - y));
    check_context(gl_);
    bind();
}

std::vector<std::uint8_t> RenderTarget::read() {
    std::vector<std::uint8_t> pixels(std::size_t{4} * width_ * height_);
    read_rows(GL_UNSIGNED_BYTE, pixels.data(), std::size_t{4} * width_);
    return pixels;
}

std::vector<float> RenderTarget::read_radiance() {
    std::vector<float> pixels(std::size_t{4} * width_ * height_);
    read_rows(GL_FLOAT, pixels.data(), 4 * sizeof(float) * width_);
    return pixels;
}

}  // namespace pelagic::gl
