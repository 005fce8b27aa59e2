// Accumulates pointer movement with the left button held, for each event, because a frame may last
// longer than a click.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

namespace pelagic::viewer {

/// Processes the window's events in order of arrival. Movement before a press or after a release is
/// ignored.
class PointerDrag {
   public:
    /// Handles a movement event. \param place_px  position of the pointer in the window, pixels
    void move_to(glm::dvec2 place_px) {
        if (is_down_ && place_px_) moved_px_ += place_px - *place_px_;
        place_px_ = place_px;
    }
    /// Handles an event of the left button.
    void set_button(bool is_down) { is_down_ = is_down; }
    /// Resets the accumulated movement at the start of a frame.
    void clear() { moved_px_ = {}; }
    /// Returns the movement to the right and down since clear(), pixels.
    glm::dvec2 moved_px() const { return moved_px_; }

   private:
    std::optional<glm::dvec2> place_px_;  ///< unknown before the first event
    glm::dvec2 moved_px_{};
    bool is_down_ = false;
};

}  // namespace pelagic::viewer
