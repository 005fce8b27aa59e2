// The camera of the window: round a point, or free.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "pelagic/gl/views.hpp"

namespace pelagic::viewer {

class ViewCamera {
   public:
    explicit ViewCamera(const Camera& start);

    enum class Mode { orbit, fly };
    Mode mode() const { return mode_; }
    /// The image stays what it is.
    void set_mode(Mode mode) { mode_ = mode; }

    /// A drag of the mouse, radians to the right and down: round the target, or of the head.
    void turn(glm::dvec2 radians);
    /// Nearer (below 1) or further (above): the distance to the target when orbiting, a step ahead when flying.
    void zoom(double factor);
    /// Right, up, ahead, in metres.
    void move(glm::dvec3 metres);
    /// Turns to a place, at 1 to 3000 m, which it goes round from now on.
    void look_at(glm::dvec3 place_m);
    /// As far along x and z as what it follows has gone.
    void go_along(glm::dvec2 metres) { eye_ += glm::dvec3(metres.x, 0, metres.y); }

    Camera camera() const;

   private:
    glm::dvec3 ahead() const;

    Mode mode_ = Mode::orbit;
    glm::dvec3 eye_;
    double heading_, pitch_, distance_, vertical_view_rad_;
};

}  // namespace pelagic::viewer
