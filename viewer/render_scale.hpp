// Chooses the size at which the image is drawn before it is enlarged to the window, and the
// shading, for a target frame time.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "pelagic/gl/water/shading.hpp"

namespace pelagic::viewer {

/// A step of the quality ladder.
struct RenderStep {
    float scale;  ///< width and height of the image relative to the window's
    gl::Shading shading;

    bool operator==(const RenderStep&) const = default;
};

/// Steps down a ladder of sizes and shadings when frames take too long, and up again when the frame
/// time allows it.
///
/// The hysteresis prevents oscillation. A step down needs a frame time above 1.15 times the goal. A
/// step up needs a predicted frame time below 0.85 times the goal; the prediction assumes that the
/// whole frame time is spent on pixels, which is the worst case. If a step costs more than its
/// pixels, for example because of a finer mesh, it is tried and abandoned. It is then blocked for
/// a time that doubles with each such attempt.
///
/// The ladder first reduces the sides to one half. After that, simpler shading gives a better image
/// than fewer pixels.
class RenderScale {
   public:
    /// Time for a pixel with headset, medium and high shading relative to high shading, on software
    /// drivers: 0.69, 1.05 and 1.62 s of CPU time (llvmpipe, 640 x 360, a moderate sea from 7 m).
    static constexpr std::array cost_ratio = {0.42, 0.65, 1.0};
    static constexpr std::array by_time = {
        RenderStep{1, gl::Shading::high},        RenderStep{0.84f, gl::Shading::high},
        RenderStep{0.7f, gl::Shading::high},     RenderStep{0.6f, gl::Shading::high},
        RenderStep{0.5f, gl::Shading::high},     RenderStep{0.5f, gl::Shading::medium},
        RenderStep{0.42f, gl::Shading::medium},  RenderStep{0.42f, gl::Shading::headset},
        RenderStep{0.35f, gl::Shading::headset}, RenderStep{0.3f, gl::Shading::headset},
        RenderStep{0.25f, gl::Shading::headset}};

    /// \param goal_ms  target frame time, ms
    /// \param fixed  if set, the shading of all steps, which then differ only in scale
    /// \param first_scale  upper limit of the first step's scale
    explicit RenderScale(double goal_ms, std::optional<gl::Shading> fixed = {}, float first_scale = 1);

    /// Updates the step from the time of a frame that was drawn with step(), ms.
    void follow(double frame_ms);
    RenderStep step() const { return ladder_[rung_]; }

   private:
    void step_to(std::size_t rung);
    /// Returns the ratio of the pixel times of two steps.
    double work_over(std::size_t rung, std::size_t other) const;

    double goal_ms_;
    std::vector<RenderStep> ladder_;
    std::size_t rung_ = 0;
    int frames_here_ = 0, far_too_long_ = 0;
    double mean_ms_ = 0;  ///< mean time of the last frames in this step
    long long frame_ = 0;
    std::array<long long, by_time.size()> blocked_until_{};  ///< frame at which a block ends
    std::array<int, by_time.size()> blocked_for_{};          ///< duration of the last block, frames
};

}  // namespace pelagic::viewer
