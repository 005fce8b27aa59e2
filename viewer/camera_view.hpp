// The window's camera: radiance that the sea is drawn into, its light meter, and what is shown of it.
#pragma once

#include <optional>

#include "pelagic/gl/display.hpp"
#include "pelagic/gl/light_meter.hpp"

namespace pelagic::viewer {

class CameraView {
   public:
    /// \param gl  outlives it. Throws gl::GlError.
    explicit CameraView(const gl::Functions& gl) : gl_(gl), display_(gl), meter_(gl) {}

    /// Draws go into the lower left part of it, `scale` times as wide and high as the window, cleared.
    /// \param samples  a pixel
    void begin(int window_width, int window_height, float scale, int samples);
    /// What was drawn is the image from now on, and is metered without waiting. \param luminance_of_unit  of its sky
    void end(float luminance_of_unit);

    /// Goes on with what the meter has seen meanwhile. \param unmetered_ev  while it has seen nothing yet
    void follow(const gl::CameraSettings& settings, float unmetered_ev, double passed_s);
    float ev() const { return ev_; }
    /// Into the window's framebuffer. A smaller image is enlarged after the tone curve: pixels that eyes compare are interpolated,
    /// not light, and the window's pixels cost no shader.
    void show(const gl::CameraSettings& settings, int window_width, int window_height);

    /// Of the part, in pixels.
    int width() const { return width_; }
    int height() const { return height_; }

   private:
    const gl::Functions& gl_;
    gl::Display display_;
    gl::LightMeter meter_;
    std::optional<gl::RenderTarget> target_;
    std::optional<gl::RenderTarget> small_;  ///< what is shown of a part, before it is enlarged
    int samples_ = 0, width_ = 0, height_ = 0;
    gl::TexturePart image_;
    float luminance_of_unit_ = 1, metered_luminance_of_unit_ = 1;
    bool is_metering_ = false;
    std::optional<float> metered_ev_;
    gl::FollowedExposure followed_;
    float ev_ = 15;
};

}  // namespace pelagic::viewer
