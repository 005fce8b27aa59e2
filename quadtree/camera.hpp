// Perspective cameras and their view-projection matrix.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace pelagic {

struct Camera {
    glm::dvec3 position_m{0, 4, 0};
    glm::dvec3 target_m{100, 2, 0};  ///< must differ from the position
    double vertical_view_rad = 0.8;  ///< vertical field of view

    bool operator==(const Camera&) const = default;

    /// Returns the unit vector to the right of the image. If the camera looks straight up or down,
    /// +x is at the top of the image.
    glm::dvec3 right() const;
    /// Returns this camera, moved to the right by `metres`.
    Camera moved_right(double metres) const;
    /// Returns the view-projection matrix in OpenGL's convention. The near plane is at 0.1 m; the
    /// far plane is at infinity, so that the sea reaches the horizon. \param aspect  width over
    /// height
    glm::dmat4 clip_from_world(double aspect) const;
};

}  // namespace pelagic
