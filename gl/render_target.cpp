#include "pelagic/gl/render_target.hpp"

#include <algorithm>
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

RenderTarget::RenderTarget(const Functions& gl, int width, int height, int samples)
    : gl_(gl), width_(width), height_(height) {
    GLint most_side = 0, most_samples = 0;
    gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most_side);
    gl.GetIntegerv(GL_MAX_SAMPLES, &most_samples);
    if (width > most_side || height > most_side)
        throw GlError("a picture of " + number_text(width) + "x" + number_text(height) +
                      " is too large for the driver, at most " + number_text(most_side) + " pixels a side");
    samples = std::min(samples, static_cast<int>(most_samples));
    colour_ = make_renderbuffer(gl, GL_RGBA8, width, height, samples);
    depth_ = make_renderbuffer(gl, GL_DEPTH_COMPONENT24, width, height, samples);
    resolved_colour_ = make_renderbuffer(gl, GL_RGBA8, width, height, 0);
    framebuffer_ = Framebuffer(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.name());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
    const bool is_whole = gl.CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    resolved_ = Framebuffer(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
    gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, resolved_colour_.name());
    if (!is_whole || gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw GlError("the driver can't make a picture of " + number_text(width) + "x" + number_text(height) +
                      "; is it out of memory?");
    bind();
}

void RenderTarget::bind() {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    gl_.Viewport(0, 0, width_, height_);
}

std::vector<std::uint8_t> RenderTarget::read() {
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.name());
    gl_.BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_.name());
    const std::size_t row = std::size_t{4} * width_;
    std::vector<std::uint8_t> pixels(row * height_);
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
    gl_.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    for (int y = 0; y < height_ / 2; ++y)
        std::swap_ranges(pixels.begin() + static_cast<std::ptrdiff_t>(row * y),
                         pixels.begin() + static_cast<std::ptrdiff_t>(row * (y + 1)),
                         pixels.begin() + static_cast<std::ptrdiff_t>(row * (height_ - 1 - y)));
    check_context(gl_);
    bind();
    return pixels;
}

}  // namespace pelagic::gl
