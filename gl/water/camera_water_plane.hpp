// The surface around a lens that stands near the water, from a query: a plane is enough for the few centimetres of a near plane.
//
//   const SurfaceQuery query(frame);                      // of an ocean built with OceanOptions::queries
//   input.camera_water_plane = camera_water_plane(query, viewer_m);
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "pelagic/sim/surface_query.hpp"

namespace pelagic::gl {

/// The plane height_m + dot(slope, xz - viewer's xz), above rest.
struct CameraWaterPlane {
    double height_m = 0;
    glm::dvec2 slope{};
};

/// Exact at the viewer's place; its slope is that between places `apart_m` before and behind, along x and z.
CameraWaterPlane camera_water_plane(const SurfaceQuery& query, glm::dvec3 viewer_m, double apart_m = 0.4);

}  // namespace pelagic::gl
