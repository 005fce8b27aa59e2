// A swapchain of images with one layer per eye, and their framebuffers.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "headset.hpp"
#include "pelagic/gl/functions.hpp"

namespace openxr_application {

class EyeImages {
   public:
    /// Returns true if the driver draws both layers in one pass (OVR_multiview2).
    static bool has_multiview(const pelagic::gl::Functions& gl) {
        return gl.FramebufferTextureMultiviewOVR != nullptr;
    }

    /// Creates the swapchain. \pre the headset has been started
    /// \throws XrError, std::runtime_error
    EyeImages(const Headset& headset, const pelagic::gl::Functions& gl);
    ~EyeImages();
    EyeImages(const EyeImages&) = delete;
    EyeImages& operator=(const EyeImages&) = delete;

    bool is_multiview() const { return is_multiview_; }
    int width() const { return width_; }
    int height() const { return height_; }

    /// Waits until the compositor has released the next image. Call acquire() and release() once
    /// per drawn frame.
    void acquire();
    /// Binds and clears the image's framebuffer with both eyes. \pre is_multiview()
    void bind_both() const { bind(framebuffers_[image_][0]); }
    /// Binds and clears the framebuffer of one eye. \param eye  0: left, 1: right
    void bind_eye(std::size_t eye) const { bind(framebuffers_[image_][eye]); }
    /// Reads an eye's image as RGBA in sRGB, the lower row first. Call it before release().
    std::vector<std::uint8_t> read(std::size_t eye) const;
    void release();

    /// Returns an eye's layer for XrCompositionLayerProjectionView.
    XrSwapchainSubImage sub_image(std::size_t eye) const;

   private:
    void bind(GLuint framebuffer) const;

    const pelagic::gl::Functions& gl_;
    bool is_multiview_ = false;
    int width_ = 0, height_ = 0;
    Owned<XrSwapchain, xrDestroySwapchain> swapchain_;
    std::vector<GLuint> images_;  ///< the runtime's textures, with two layers each
    GLuint depth_ = 0;            ///< depth texture of all images
    /// By image and eye. With multiview the first one holds both eyes.
    std::vector<std::array<GLuint, 2>> framebuffers_;
    std::uint32_t image_ = 0;  ///< index of the acquired image
};

}  // namespace openxr_application
