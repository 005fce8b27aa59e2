#include "pelagic/viewer/camera_view.hpp"

#include <algorithm>
#include <cmath>

namespace pelagic::viewer {

void CameraView::begin(int window_width, int window_height, float scale, int samples) {
    if (!target_ || target_->width() != window_width || target_->height() != window_height || samples_ != samples) {
        target_.reset();
        target_.emplace(gl_, window_width, window_height, samples, gl::PixelKind::radiance);
        samples_ = samples;
    }
    const auto scaled = [&](int side) {
        return std::max(1, static_cast<int>(std::lround(static_cast<float>(side) * scale)));
    };
    width_ = scaled(window_width);
    height_ = scaled(window_height);
    target_->clear();
}

void CameraView::end(float luminance_of_unit) {
    image_ = target_->resolved(width_, height_);
    luminance_of_unit_ = luminance_of_unit;
    if (is_metering_) return;
    meter_.start(image_);
    is_metering_ = true;
    metered_luminance_of_unit_ = luminance_of_unit;
}

void CameraView::follow(const gl::CameraSettings& settings, float unmetered_ev, double passed_s) {
    if (const auto cells = meter_.finished()) {
        metered_ev_ = gl::metered_ev(*cells, metered_luminance_of_unit_);
        is_metering_ = false;
    }
    if (metered_ev_) followed_.follow(*metered_ev_, passed_s);
    if (settings.fixed_ev)
        ev_ = *settings.fixed_ev;
    else
        ev_ = (followed_.has_ev() ? followed_.ev() : unmetered_ev) - settings.bias_stops;
}

void CameraView::show(const gl::CameraSettings& settings, int window_width, int window_height) {
    const gl::Look look{.exposure = gl::exposure_of_ev(ev_, luminance_of_unit_),
                        .luminance_of_unit = luminance_of_unit_,
                        .bloom = settings.bloom};
    const bool is_small = width_ < window_width || height_ < window_height;
    if (is_small && (!small_ || small_->width() != width_ || small_->height() != height_)) {
        small_.reset();
        small_.emplace(gl_, width_, height_, 0);
    }
    if (is_small)
        small_->bind();
    else
        gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
    display_.show(image_, look, {0, 0, width_, height_});
    if (is_small) small_->show(width_, height_, window_width, window_height);
}

}  // namespace pelagic::viewer
