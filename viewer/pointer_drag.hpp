// How far the pointer moved with the left button down, event by event: a frame may last longer than a click.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

namespace pelagic::viewer {

/// Takes the window's events in the order in which they arrive. Movement before a press or after a release does not count.
class PointerDrag {
   public:
    /// \param place_px  of the pointer in the window
    void move_to(glm::dvec2 place_px) {
        if (is_down_ && place_px_) moved_px_ += place_px - *place_px_;
        place_px_ = place_px;
    }
    void set_button(bool is_down) { is_down_ = is_down; }
    /// Starts a new frame's sum.
    void clear() { moved_px_ = {}; }
    /// Pixels to the right and down since clear().
    glm::dvec2 moved_px() const { return moved_px_; }

   private:
    std::optional<glm::dvec2> place_px_;  ///< unknown before the first event
    glm::dvec2 moved_px_{};
    bool is_down_ = false;
};

}  // namespace pelagic::viewer
