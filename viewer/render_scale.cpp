#include "pelagic/viewer/render_scale.hpp"

#include <algorithm>

namespace pelagic::viewer {
namespace {

constexpr double too_long = 1.15, with_room = 0.85;
/// A step's first frame pays for its mesh, and for shaders that a driver compiles when it first draws.
constexpr int settling_frames = 1;
/// Two frames of this length in a row are no hitch, and nobody wants to see more of them.
constexpr double far_too_long = 3;
/// How many frames count, and how many it takes to see that there is room.
constexpr int looked_at = 4, convinced_after = 12;
/// No single frame counts for more than this, over the mean: hitches are not slowness.
constexpr double one_frame_says = 1.5;
constexpr int first_closed_frames = 120, max_closed_frames = 100'000;

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
        return scale * scale * part_of_high[static_cast<std::size_t>(step.shading)];
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
    const double counted_ms = counted > 1 ? std::min(frame_ms, one_frame_says * mean_ms_) : frame_ms;
    mean_ms_ += (counted_ms - mean_ms_) / std::min(counted, looked_at);
    far_too_long_ = frame_ms > far_too_long * goal_ms_ ? far_too_long_ + 1 : 0;
    if (counted < looked_at && far_too_long_ < 2) return;
    if (mean_ms_ > too_long * goal_ms_ && rung_ + 1 < ladder_.size()) {
        closed_for_[rung_] = std::clamp(2 * closed_for_[rung_], first_closed_frames, max_closed_frames);
        closed_until_[rung_] = frame_ + closed_for_[rung_];
        // As many steps at once as pixels alone call for.
        std::size_t rung = rung_ + 1;
        while (rung + 1 < ladder_.size() && mean_ms_ * work_over(rung, rung_) > goal_ms_) ++rung;
        step_to(rung);
    } else if (rung_ > 0 && counted >= convinced_after && frame_ >= closed_until_[rung_ - 1]) {
        if (mean_ms_ * work_over(rung_ - 1, rung_) < with_room * goal_ms_) step_to(rung_ - 1);
    }
}

}  // namespace pelagic::viewer
