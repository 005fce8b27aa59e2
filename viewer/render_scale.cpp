#include "pelagic/viewer/render_scale.hpp"

#include <algorithm>

namespace pelagic::viewer {
namespace {

constexpr double too_long = 1.15, fast_enough = 0.85;
/// Number of ignored frames after a step: the first frame includes the mesh change, and shaders
/// that the driver compiles late.
constexpr int settling_frames = 1;
/// Two consecutive frames longer than this multiple of the goal are no hitch and cause an immediate
/// step down.
constexpr double far_too_long = 3;
/// Number of frames in the mean, and number of frames before a step up.
constexpr int averaged_frames = 4, frames_before_step_up = 12;
/// Limit of a single frame's time relative to the mean, so that a hitch has little effect.
constexpr double max_frame_over_mean = 1.5;
constexpr int first_blocked_frames = 120, max_blocked_frames = 100'000;

}  // namespace

RenderScale::RenderScale(double goal_ms, std::optional<gl::Shading> fixed, float first_scale) : goal_ms_(goal_ms) {
    for (RenderStep step : by_time) {
        if (fixed) step.shading = *fixed;
        if (ladder_.empty() || ladder_.back() != step) ladder_.push_back(step);
    }
    while (rung_ + 1 < ladder_.size() && ladder_[rung_].scale > first_scale) ++rung_;
}

double RenderScale::work_over(std::size_t rung, std::size_t other) const {
    const auto work = [&](const RenderStep& step) {
        const auto scale = static_cast<double>(step.scale);
        return scale * scale * cost_ratio[static_cast<std::size_t>(step.shading)];
    };
    return work(ladder_[rung]) / work(ladder_[other]);
}

void RenderScale::step_to(std::size_t rung) {
    rung_ = rung;
    frames_here_ = far_too_long_ = 0;
}

void RenderScale::follow(double frame_ms) {
    ++frame_;
    if (++frames_here_ <= settling_frames) return;
    const int counted = frames_here_ - settling_frames;
    const double counted_ms = counted > 1 ? std::min(frame_ms, max_frame_over_mean * mean_ms_) : frame_ms;
    mean_ms_ += (counted_ms - mean_ms_) / std::min(counted, averaged_frames);
    far_too_long_ = frame_ms > far_too_long * goal_ms_ ? far_too_long_ + 1 : 0;
    if (counted < averaged_frames && far_too_long_ < 2) return;
    if (mean_ms_ > too_long * goal_ms_ && rung_ + 1 < ladder_.size()) {
        blocked_for_[rung_] = std::clamp(2 * blocked_for_[rung_], first_blocked_frames, max_blocked_frames);
        blocked_until_[rung_] = frame_ + blocked_for_[rung_];
        // Takes as many steps at once as the pixel times require.
        std::size_t rung = rung_ + 1;
        while (rung + 1 < ladder_.size() && mean_ms_ * work_over(rung, rung_) > goal_ms_) ++rung;
        step_to(rung);
    } else if (rung_ > 0 && counted >= frames_before_step_up && frame_ >= blocked_until_[rung_ - 1]) {
        if (mean_ms_ * work_over(rung_ - 1, rung_) < fast_enough * goal_ms_) step_to(rung_ - 1);
    }
}

}  // namespace pelagic::viewer
