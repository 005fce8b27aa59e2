// The window's camera: a radiance target, a light meter, automatic exposure and the display pass.
#pragma once

#include <optional>

#include "pelagic/gl/display.hpp"
#include "pelagic/gl/light_meter.hpp"

namespace pelagic::viewer {

class CameraView {
   public:
    /// \param gl  must outlive this object
    /// \throws gl::GlError if the driver rejects a shader or cannot render to half floats
    explicit CameraView(const gl::Functions& gl) : gl_(gl), display_(gl), meter_(gl) {}

    /// Binds and clears the radiance target. The image occupies its lower left corner.
    /// \param scale  width and height of the image relative to the window's
    /// \param samples  samples per pixel
    void begin(int window_width, int window_height, float scale, int samples);
    /// Completes the image and starts metering it without waiting.
    /// \param luminance_of_unit  Sky::luminance_of_unit() of the image's sky, cd/m^2
    void end(float luminance_of_unit);

    /// Updates the exposure value from the light meter.
    /// \param unmetered_ev  exposure value until the first measurement is available
    /// \param passed_s  time since the last call, s
    void follow(const gl::CameraSettings& settings, float unmetered_ev, double passed_s);
    /// Returns the current exposure value.
    float ev() const { return ev_; }
    /// Draws the image into the window's framebuffer. A smaller image is enlarged after the tone
    /// curve. The interpolation is then perceptually more uniform, and no shader runs for the
    /// window's pixels.
    void show(const gl::CameraSettings& settings, int window_width, int window_height);

    /// Width of the image, pixels.
    int width() const { return width_; }
    /// Height of the image, pixels.
    int height() const { return height_; }

   private:
    const gl::Functions& gl_;
    gl::Display display_;
    gl::LightMeter meter_;
    std::optional<gl::RenderTarget> target_;
    std::optional<gl::RenderTarget> small_;  ///< smaller display image, before it is enlarged
    int samples_ = 0, width_ = 0, height_ = 0;
    gl::TexturePart image_;
    float luminance_of_unit_ = 1, metered_luminance_of_unit_ = 1;
    bool is_metering_ = false;
    std::optional<float> metered_ev_;
    gl::FollowedExposure followed_;
    float ev_ = 15;
};

}  // namespace pelagic::viewer
