// What the eyes see: a swapchain of images with a layer for each eye, and framebuffers to draw into them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "headset.hpp"
#include "pelagic/gl/functions.hpp"

namespace openxr_application {

class EyeImages {
   public:
    /// The driver draws both layers in one pass (OVR_multiview2).
    static bool has_multiview(const pelagic::gl::Functions& gl) {
        return gl.FramebufferTextureMultiviewOVR != nullptr;
    }

    /// Of a headset that has been started. Throws XrError, std::runtime_error.
    EyeImages(const Headset& headset, const pelagic::gl::Functions& gl);
    ~EyeImages();
    EyeImages(const EyeImages&) = delete;
    EyeImages& operator=(const EyeImages&) = delete;

    bool is_multiview() const { return is_multiview_; }
    int width() const { return width_; }
    int height() const { return height_; }

    /// Waits until the compositor is done with the next image. One acquire() and one release() a frame that draws.
    void acquire();
    /// Both eyes at once, where is_multiview(): the image's framebuffer, cleared.
    void bind_both() const { bind(framebuffers_[image_][0]); }
    /// One of them: 0 is the left one.
    void bind_eye(std::size_t eye) const { bind(framebuffers_[image_][eye]); }
    /// RGBA, the lower row first, before release(); bytes are sRGB's.
    std::vector<std::uint8_t> read(std::size_t eye) const;
    void release();

    /// That eye's layer, for XrCompositionLayerProjectionView.
    XrSwapchainSubImage sub_image(std::size_t eye) const;

   private:
    void bind(GLuint framebuffer) const;

    const pelagic::gl::Functions& gl_;
    bool is_multiview_ = false;
    int width_ = 0, height_ = 0;
    Owned<XrSwapchain, xrDestroySwapchain> swapchain_;
    std::vector<GLuint> images_;                       ///< textures of two layers, the runtime's
    GLuint depth_ = 0;                                 ///< one for all of them
    std::vector<std::array<GLuint, 2>> framebuffers_;  ///< by image and eye; with multiview the first one holds both
    std::uint32_t image_ = 0;                          ///< the acquired one
};

}  // namespace openxr_application
