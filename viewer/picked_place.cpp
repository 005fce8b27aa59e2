#include "pelagic/viewer/picked_place.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pelagic/sim/surface_ray.hpp"

namespace pelagic::viewer {

std::optional<glm::dvec2> picked_place(const SurfaceQuery& query, const Camera& camera, glm::dvec2 pixel,
                                       glm::dvec2 window, double reach_m) {
    const glm::dvec3 ahead = glm::normalize(camera.target_m - camera.position_m), right = camera.right();
    const glm::dvec3 up = glm::cross(right, ahead);
    const double half = std::tan(0.5 * camera.vertical_view_rad);
    const glm::dvec2 from_middle = (2.0 * pixel - window) / window.y * half;
    const glm::dvec3 along = glm::normalize(ahead + from_middle.x * right - from_middle.y * up);
    const SurfaceRay ray{.origin_m = {camera.position_m.x, camera.position_m.y, camera.position_m.z},
                         .direction = {along.x, along.y, along.z},
                         .reach_m = reach_m};
    if (!check(ray, query.frame()).empty()) return {};
    const std::optional<SurfaceHit> hit = first_hit(query, ray);
    if (!hit) return {};
    return glm::dvec2(hit->position_m[0], hit->position_m[2]);
}

}  // namespace pelagic::viewer
