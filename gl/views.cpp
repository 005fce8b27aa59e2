#include "pelagic/gl/views.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace pelagic::gl {
namespace {

/// What is nearer is not drawn. With 24 bits of depth waves are then told apart by 0.1 m at 400 m, 2.5 m at 2 km.
constexpr double near_m = 0.1;

glm::dvec3 right_of(const Camera& camera) {
    const glm::dvec3 forward = glm::normalize(camera.target_m - camera.position_m);
    const glm::dvec3 level = glm::cross(forward, glm::dvec3(0, 1, 0));
    // Straight down or up +x is at the top.
    if (glm::length(level) < 1e-9) return {0, 0, forward.y < 0 ? 1 : -1};
    return glm::normalize(level);
}

}  // namespace

Eye eye_of(const Camera& camera, const Viewport& viewport) {
    const double aspect = static_cast<double>(viewport.width) / viewport.height;
    const glm::dvec3 up = glm::cross(right_of(camera), glm::normalize(camera.target_m - camera.position_m));
    return {glm::infinitePerspective(camera.vertical_view_rad, aspect, near_m) *
                glm::lookAt(camera.position_m, camera.target_m, up),
            camera.position_m, viewport};
}

EyePair eyes_of(const Camera& camera, const Viewport& both, double apart_m) {
    const glm::dvec3 half = right_of(camera) * (apart_m / 2);
    const Viewport left{both.x, both.y, both.width / 2, both.height};
    const Viewport right{both.x + both.width / 2, both.y, both.width - both.width / 2, both.height};
    Camera left_camera = camera, right_camera = camera;
    left_camera.position_m -= half;
    left_camera.target_m -= half;
    right_camera.position_m += half;
    right_camera.target_m += half;
    return {eye_of(left_camera, left), eye_of(right_camera, right)};
}

}  // namespace pelagic::gl
