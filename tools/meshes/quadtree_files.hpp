// What `pelagic quadtree` writes: the mesh, the plan as SVG.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/meshes/mesh.hpp"

namespace pelagic::tools {

/// The displaced and morphed patches, each with vertices of its own: what is a crack on the GPU is one here. Normals are those of
/// the sea at the rest place, whatever the patch's level; displacement, normals and foam fade out towards the border.
Mesh mesh_of(const DrawList& list, const Frame& frame);

/// The grid from above, x to the right and z down: patches coloured by level, drawn ones full and culled ones pale;
/// what each view sees of the rest level; the viewer.
///
/// \param drawn  the list in question
/// \param all    the same selection without views
std::string plan_as_svg(const DrawList& drawn, const DrawList& all, std::span<const Frustum> views,
                        glm::dvec3 viewer_m);

}  // namespace pelagic::tools
