// The camera of the window: orbits a target, or flies freely.
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
    /// Sets the mode without moving the camera.
    void set_mode(Mode mode) { mode_ = mode; }

    /// Rotates the camera, around the target when orbiting, else around its own position.
    /// \param radians  angles to the right and down, rad
    void turn(glm::dvec2 radians);
    /// Scales the distance to the target when orbiting; moves ahead or back when flying.
    /// \param factor  less than 1: nearer; greater than 1: further away
    void zoom(double factor);
    /// Moves the camera. \param metres  distances to the right, up and ahead, m
    void move(glm::dvec3 metres);
    /// Turns the camera to a new orbit target. The orbit's radius is limited to [1, 3000] m.
    void look_at(glm::dvec3 place_m);
    /// Moves the camera along x and z by the displacement of a followed object, m.
    void go_along(glm::dvec2 metres) { eye_ += glm::dvec3(metres.x, 0, metres.y); }

    Camera camera() const;

   private:
    glm::dvec3 ahead() const;

    Mode mode_ = Mode::orbit;
    glm::dvec3 eye_;
    double heading_, pitch_, distance_, vertical_view_rad_;
};

}  // namespace pelagic::viewer
