// Output of `pelagic quadtree`: the mesh, and a plan of the patches as SVG.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/meshes/mesh.hpp"

namespace pelagic::tools {

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
