#include "pelagic/quadtree/camera.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace pelagic {
namespace {

/// With a 24-bit depth buffer the depth resolution is 0.1 m at 400 m and 2.5 m at 2 km.
constexpr double near_m = 0.1;

}  // namespace

glm::dvec3 Camera::right() const {
    const glm::dvec3 forward = glm::normalize(target_m - position_m);
    const glm::dvec3 level = glm::cross(forward, glm::dvec3(0, 1, 0));
    // For a view straight down or up, +x is at the top of the image.
    if (glm::length(level) < 1e-9) return {0, 0, forward.y < 0 ? 1 : -1};
    return glm::normalize(level);
}

Camera Camera::moved_right(double metres) const {
    Camera moved = *this;
    moved.position_m += metres * right();
    moved.target_m += metres * right();
    return moved;
}

glm::dmat4 Camera::clip_from_world(double aspect) const {
    const glm::dvec3 up = glm::cross(right(), glm::normalize(target_m - position_m));
    return glm::infinitePerspective(vertical_view_rad, aspect, near_m) * glm::lookAt(position_m, target_m, up);
}

}  // namespace pelagic
