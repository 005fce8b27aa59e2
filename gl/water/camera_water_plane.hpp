// Plane that approximates the water surface at the camera, computed from a surface query. A plane
// is accurate enough over the few centimetres that a near plane covers.
//
//   const SurfaceQuery query(frame);  // needs OceanOptions::queries
//   input.camera_water_plane = camera_water_plane(query, viewer_m);
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "pelagic/sim/surface_query.hpp"

namespace pelagic::gl {

/// Plane height_m + dot(slope, xz - viewer_xz), in metres; heights are in the world.
struct CameraWaterPlane {
    double height_m = 0;
    glm::dvec2 slope{};
};

/// Samples the surface around the viewer. The height is exact at the viewer's x and z.
/// \param apart_m  distance between the two samples of each central difference (along x and along
///     z), metres, above 0
CameraWaterPlane camera_water_plane(const SurfaceQuery& query, glm::dvec3 viewer_m, double apart_m = 0.4);

}  // namespace pelagic::gl
