// A camera as people describe it, and its matrix.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace pelagic {

struct Camera {
    glm::dvec3 position_m{0, 4, 0};
    glm::dvec3 target_m{100, 2, 0};  ///< elsewhere than the position
    double vertical_view_rad = 0.8;

    /// A unit vector. A camera that looks straight up or down has +x at the top of its image.
    glm::dvec3 right() const;
    /// The same camera, `metres` to the right.
    Camera moved_right(double metres) const;
    /// OpenGL's convention; what is nearer than 0.1 m is not drawn, and there is no far plane, which would cut the sea
    /// before the horizon. \param aspect  width over height
    glm::dmat4 clip_from_world(double aspect) const;
};

}  // namespace pelagic
