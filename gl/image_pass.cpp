#include "pelagic/gl/image_pass.hpp"

#include <string>

#include "pelagic/gl/errors.hpp"

namespace pelagic::gl {

ImagePass::ImagePass(const Functions& gl, std::string_view fragment_file)
    : gl_(gl), program_(gl, "screen.vert.glsl", fragment_file) {
    use();
}

void ImagePass::read(const char* name, GLint unit, const TexturePart& image) const {
    gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl_.BindTexture(GL_TEXTURE_2D, image.texture);
    gl_.Uniform1i(program_.uniform(name), unit);
    const auto width = static_cast<float>(image.texture_width), height = static_cast<float>(image.texture_height);
    set((std::string(name) + "_used").c_str(), static_cast<float>(image.width) / width,
        static_cast<float>(image.height) / height, 1 / width, 1 / height);
}

RadianceTexture::RadianceTexture(const Functions& gl, int of_width, int of_height)
    : texture(gl), framebuffer(gl), width(of_width), height(of_height) {
    gl.BindTexture(GL_TEXTURE_2D, texture.name());
    gl.TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA16F, width, height);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.name(), 0);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw GlError("the driver can't draw half floats, or is out of memory");
}

}  // namespace pelagic::gl
