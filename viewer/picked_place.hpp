// What lies under a pixel of the window.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "pelagic/quadtree/camera.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic::viewer {

/// Where the water is that the camera sees in a pixel, x and z; none in the sky or further away than `reach_m`.
/// \param pixel, window  from the upper left corner, in the same unit
std::optional<glm::dvec2> picked_place(const SurfaceQuery& query, const Camera& camera, glm::dvec2 pixel,
                                       glm::dvec2 window, double reach_m);

}  // namespace pelagic::viewer
