// How large the window's image is drawn before it is enlarged to the window, and in which shading: as frames of the wanted length
// allow.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "pelagic/gl/water/shading.hpp"

namespace pelagic::viewer {

/// What a step of the ladder draws.
struct RenderStep {
    float scale;  ///< of width and of height
    gl::Shading shading;

    bool operator==(const RenderStep&) const = default;
};

/// Steps down a ladder of sizes and shadings when frames take too long, and up again when they leave room.
///
/// It does not swing: between too long (1.15 of the goal) and room for the next size (at most 0.85 of it, if all of a frame's time
/// were for pixels, which is the worst that more pixels can do) lies more than what one step changes. Where a step costs more than
/// its pixels say, a finer mesh for one, it is tried, found too slow, and left alone for a time that doubles.
///
/// Down to half the sides pixels go; then it is better to have them shaded more simply than to have fewer.
class RenderScale {
   public:
    /// Software drivers take so much of high shading's time for a pixel in headset, medium and high: 0.69, 1.05 and 1.62 s of processor
    /// time for 640 x 360 (llvmpipe, a moderate sea from 7 m).
    static constexpr std::array part_of_high = {0.42, 0.65, 1.0};
    static constexpr std::array by_time = {
        RenderStep{1, gl::Shading::high},        RenderStep{0.84f, gl::Shading::high},
        RenderStep{0.7f, gl::Shading::high},     RenderStep{0.6f, gl::Shading::high},
        RenderStep{0.5f, gl::Shading::high},     RenderStep{0.5f, gl::Shading::medium},
        RenderStep{0.42f, gl::Shading::medium},  RenderStep{0.42f, gl::Shading::headset},
        RenderStep{0.35f, gl::Shading::headset}, RenderStep{0.3f, gl::Shading::headset},
        RenderStep{0.25f, gl::Shading::headset}};

    /// \param goal_ms  of a frame
    /// \param fixed  the shading of all steps, which then differ by their scales alone
    /// \param first_scale  it begins at the largest that is no larger
    explicit RenderScale(double goal_ms, std::optional<gl::Shading> fixed = {}, float first_scale = 1);

    /// After each frame that was drawn in this step: how long it took.
    void follow(double frame_ms);
    RenderStep step() const { return ladder_[rung_]; }

   private:
    void step_to(std::size_t rung);
    /// Time for pixels of one step over that of another.
    double work_over(std::size_t rung, std::size_t other) const;

    double goal_ms_;
    std::vector<RenderStep> ladder_;
    std::size_t rung_ = 0;
    int frames_here_ = 0, far_too_long_ = 0;
    double mean_ms_ = 0;  ///< of the last frames in this step
    long long frame_ = 0;
    std::array<long long, by_time.size()> closed_until_{};  ///< frame before which a step is not tried again
    std::array<int, by_time.size()> closed_for_{};
};

}  // namespace pelagic::viewer
