#include "eye_images.hpp"

#include <algorithm>

namespace openxr_application {
namespace {

/// Chooses the format of the swapchain. Compositors interpret formats without sRGB in their name as
/// linear light, so Pelagic writes linear light to all formats
/// (RendererOptions::framebuffer_is_srgb). Eight bits of linear light cause banding in dark areas.
std::int64_t choose_format(XrSession session) {
    std::uint32_t count = 0;
    check("xrEnumerateSwapchainFormats", xrEnumerateSwapchainFormats(session, 0, &count, nullptr));
    std::vector<std::int64_t> formats(count);
    check("xrEnumerateSwapchainFormats", xrEnumerateSwapchainFormats(session, count, &count, formats.data()));
    for (const std::int64_t wanted : {GL_SRGB8_ALPHA8, GL_RGBA16F, GL_RGBA8})
        if (std::find(formats.begin(), formats.end(), wanted) != formats.end()) return wanted;
    throw std::runtime_error("the headset's runtime takes images neither as SRGB8_ALPHA8 nor as RGBA16F or RGBA8");
}

std::vector<GLuint> images_of(XrSwapchain swapchain) {
    std::uint32_t count = 0;
    check("xrEnumerateSwapchainImages", xrEnumerateSwapchainImages(swapchain, 0, &count, nullptr));
    std::vector<XrSwapchainImageOpenGLESKHR> images(count, {.type = XR_TYPE_SWAPCHAIN_IMAGE_OPENGL_ES_KHR});
    check("xrEnumerateSwapchainImages",
          xrEnumerateSwapchainImages(swapchain, count, &count,
                                     reinterpret_cast<XrSwapchainImageBaseHeader*>(images.data())));
    std::vector<GLuint> names;
    for (const XrSwapchainImageOpenGLESKHR& image : images) names.push_back(image.image);
    return names;
}

}  // namespace

EyeImages::EyeImages(const Headset& headset, const pelagic::gl::Functions& gl)
    : gl_(gl),
      is_multiview_(has_multiview(gl)),
      width_(headset.eye_size().width),
      height_(headset.eye_size().height) {
    const XrSwapchainCreateInfo info{
        .type = XR_TYPE_SWAPCHAIN_CREATE_INFO,
        .usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT | XR_SWAPCHAIN_USAGE_SAMPLED_BIT,
        .format = choose_format(headset.session()),
        .sampleCount = 1,
        .width = static_cast<std::uint32_t>(width_),
        .height = static_cast<std::uint32_t>(height_),
        .faceCount = 1,
        .arraySize = 2,
        .mipCount = 1};
    check("xrCreateSwapchain", xrCreateSwapchain(headset.session(), &info, swapchain_.receive()));
    images_ = images_of(swapchain_);

    glGenTextures(1, &depth_);
    glBindTexture(GL_TEXTURE_2D_ARRAY, depth_);
    glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, GL_DEPTH_COMPONENT24, width_, height_, 2);
    framebuffers_.resize(images_.size());
    for (std::size_t image = 0; image < images_.size(); ++image) {
        glGenFramebuffers(2, framebuffers_[image].data());
        for (GLint eye = 0; eye < 2; ++eye) {
            glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[image][static_cast<std::size_t>(eye)]);
            const auto attach = [&](GLenum where, GLuint texture) {
                if (is_multiview_ && eye == 0)
                    gl_.FramebufferTextureMultiviewOVR(GL_FRAMEBUFFER, where, texture, 0, 0, 2);
                else
                    glFramebufferTextureLayer(GL_FRAMEBUFFER, where, texture, 0, eye);
            };
            attach(GL_COLOR_ATTACHMENT0, images_[image]);
            attach(GL_DEPTH_ATTACHMENT, depth_);
            if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
                throw std::runtime_error("the driver can't draw into the headset's images");
        }
    }
}

EyeImages::~EyeImages() {
    for (const std::array<GLuint, 2>& both : framebuffers_) glDeleteFramebuffers(2, both.data());
    glDeleteTextures(1, &depth_);
}

void EyeImages::acquire() {
    check("xrAcquireSwapchainImage", xrAcquireSwapchainImage(swapchain_, nullptr, &image_));
    const XrSwapchainImageWaitInfo info{.type = XR_TYPE_SWAPCHAIN_IMAGE_WAIT_INFO, .timeout = XR_INFINITE_DURATION};
    check("xrWaitSwapchainImage", xrWaitSwapchainImage(swapchain_, &info));
}

void EyeImages::bind(GLuint framebuffer) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

std::vector<std::uint8_t> EyeImages::read(std::size_t eye) const {
    GLuint framebuffer = 0;  // a separate one, because multiview framebuffers cannot be read
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glFramebufferTextureLayer(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, images_[image_], 0, static_cast<GLint>(eye));
    std::vector<std::uint8_t> pixels(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    glDeleteFramebuffers(1, &framebuffer);
    return pixels;
}

void EyeImages::release() { check("xrReleaseSwapchainImage", xrReleaseSwapchainImage(swapchain_, nullptr)); }

XrSwapchainSubImage EyeImages::sub_image(std::size_t eye) const {
    return {.swapchain = swapchain_,
            .imageRect = {.extent = {width_, height_}},
            .imageArrayIndex = static_cast<std::uint32_t>(eye)};
}

}  // namespace openxr_application
