// Meshes of a frame's sea: of a square, and of a quadtree's patches with their plan as SVG; and normals
// of sea meshes.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/meshes/mesh.hpp"

namespace pelagic::tools {

/// A square from the origin along +x and +z.
struct SeaPatch {
    double side_m = 0;
    int steps = 0;             ///< steps per side; the patch has (steps + 1)^2 vertices
    std::size_t cascades = 1;  ///< number of cascades that displace it, from the coarsest on
};

/// Returns the number of cascades that a mesh with this step resolves: the coarsest, and those
/// whose shortest waves, three texels, are at least two steps long. The waves of other cascades
/// would appear as noise.
std::size_t cascades_shown_by(double step_m, std::span<const CascadePlan> plans);

/// Returns the mesh of a patch. Vertex i + j (steps + 1) has its reference position i steps along x
/// and j along z. The patch's cascades displace it, interpolated bilinearly. Normals are those of
/// that surface. Foam, if the frame has foam, is that of all cascades. Faces are squares.
Mesh mesh_of(const Frame& frame, const SeaPatch& patch);

/// Returns the texture coordinates (see Mesh) of a reference position.
glm::vec2 texture_coordinates_of(const Cascade& coarsest, glm::dvec2 rest);

/// Returns the unit normal at a reference position from central differences (VR Ocean, equations 45
/// to 47). Returns (0, 1, 0) where the surface is compressed to a point.
/// \param reach_m  distance of the neighbours
/// \param drawn    function from a reference position to the displaced position
template <class Drawn>
glm::dvec3 normal_at(glm::dvec2 rest, double reach_m, const Drawn& drawn) {
    const glm::dvec2 east(reach_m, 0), south(0, reach_m);
    const glm::dvec3 along_x = drawn(rest + east) - drawn(rest - east);
    const glm::dvec3 along_z = drawn(rest + south) - drawn(rest - south);
    const glm::dvec3 up = glm::cross(along_z, along_x);
    const double length = glm::length(up);
    return length > 0 ? up / length : glm::dvec3(0, 1, 0);
}

/// Returns the displaced and morphed patches. Patches do not share vertices, so that cracks of the
/// rendered mesh appear in the file. Normals are those of the sea at the reference position,
/// independent of the patch's level. Displacement, normals and foam fade out towards the border.
Mesh mesh_of(const DrawList& list, const Frame& frame);

/// Returns a plan of the grid from above, x to the right and z down. Patches are coloured by level,
/// culled patches are pale. The plan also shows the area at y = 0 that each view sees, and the
/// viewer.
///
/// \param drawn  the draw list
/// \param all    the draw list of an equal selection without views
std::string plan_as_svg(const DrawList& drawn, const DrawList& all, std::span<const Frustum> views,
                        glm::dvec3 viewer_m);

}  // namespace pelagic::tools
