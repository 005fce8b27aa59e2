// How large the window's picture is drawn before it is enlarged to the window: as large as frames of the wanted length allow.
#pragma once

#include <array>
#include <cstddef>

namespace pelagic::viewer {

/// Steps down a ladder of sizes when frames take too long, and up again when they leave room.
///
/// It does not swing: between too long (1.15 of the goal) and room for the next size (at most 0.85 of it, if all of a frame's time
/// were for pixels, which is the worst that more pixels can do) lies more than what one step changes. Where a size costs more than
/// its pixels say, a finer mesh for one, it is tried, found too slow, and left alone for a time that doubles.
class RenderScale {
   public:
    static constexpr std::array scales = {1.f, 0.84f, 0.7f, 0.6f, 0.5f, 0.42f, 0.35f, 0.3f, 0.25f};

    /// \param goal_ms  of a frame
    /// \param first  where it begins, in `scales`
    explicit RenderScale(double goal_ms, std::size_t first = 0) : goal_ms_(goal_ms), rung_(first) {}

    /// After each frame that was drawn in this scale: how long it took.
    void follow(double frame_ms);
    /// Of width and of height.
    float scale() const { return scales[rung_]; }

   private:
    void step_to(std::size_t rung);

    double goal_ms_;
    std::size_t rung_;
    int frames_here_ = 0, far_too_long_ = 0;
    double mean_ms_ = 0;  ///< of the last frames in this scale
    long long frame_ = 0;
    std::array<long long, scales.size()> closed_until_{};  ///< frame before which a size is not tried again
    std::array<int, scales.size()> closed_for_{};
};

}  // namespace pelagic::viewer
