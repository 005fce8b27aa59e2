// Picking: the position of the water surface under a pixel of the window.
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "pelagic/quadtree/camera.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic::viewer {

/// Returns x and z of the water surface that the camera sees in a pixel. Returns nothing for the
/// sky and beyond `reach_m`.
/// \param pixel  position in the window from its upper left corner
/// \param window  size of the window, in the unit of `pixel`
std::optional<glm::dvec2> picked_place(const SurfaceQuery& query, const Camera& camera, glm::dvec2 pixel,
                                       glm::dvec2 window, double reach_m);

}  // namespace pelagic::viewer
