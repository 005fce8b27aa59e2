// A square of a frame's sea as a mesh, and the normals of meshes of the sea.
#pragma once

#include <glm/geometric.hpp>
#include <span>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/meshes/mesh.hpp"

namespace pelagic::tools {

/// From the origin along +x and +z.
struct SeaPatch {
    double side_m = 0;
    int steps = 0;  ///< a side, so that (steps + 1)^2 points rest on it; the last row and column lie on its far edges
    std::size_t cascades = 1;  ///< that move it, from the coarsest on
};

/// How many cascades have waves that a mesh with such steps can show: the coarsest, and those whose shortest waves, three texels, have
/// two steps or more. The waves of others would not be seen as waves but as noise.
std::size_t cascades_shown_by(double step_m, std::span<const CascadePlan> plans);

/// Vertex i + j (steps + 1) rests at i steps along x and j along z, and is drawn where the patch's cascades move it, bilinear between
/// their texels. Normals are those of that surface; foam, if the frame has any, is that of all cascades. Faces are squares.
Mesh mesh_of(const Frame& frame, const SeaPatch& patch);

/// Texture coordinates as Mesh has them of what rests there.
glm::vec2 texture_coordinates_of(const Cascade& coarsest, glm::dvec2 rest);

/// The largest of the cascades' foam at a rest place, as a query has it, 0 to 1. \pre the frame has foam
double foam_of(const Frame& frame, glm::dvec2 rest);

/// The unit normal of what rests at `rest`, from the differences of the neighbours on both sides, `reach_m` away (VR Ocean, equations
/// 45 to 47). `drawn` maps a rest place to where it is drawn. Water that is crushed to a point has none and gets (0, 1, 0).
template <class Drawn>
glm::dvec3 normal_at(glm::dvec2 rest, double reach_m, const Drawn& drawn) {
    const glm::dvec2 east(reach_m, 0), south(0, reach_m);
    const glm::dvec3 along_x = drawn(rest + east) - drawn(rest - east);
    const glm::dvec3 along_z = drawn(rest + south) - drawn(rest - south);
    const glm::dvec3 up = glm::cross(along_z, along_x);
    const double length = glm::length(up);
    return length > 0 ? up / length : glm::dvec3(0, 1, 0);
}

}  // namespace pelagic::tools
