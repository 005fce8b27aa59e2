// What `pelagic quadtree` writes: the mesh as Wavefront OBJ, the plan as SVG.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic::tools {

/// The displaced and morphed patches, each with vertices of its own, every digit of them: what is a crack on the GPU is
/// one here. Metres, y up. Texture coordinates take an export's maps of the same sea, u = x/L + 0.5/N and
/// v = 1 - z/L - 0.5/N at the rest place; normals are those of the sea there, whatever the patch's level.
std::string mesh_as_obj(const DrawList& list, const Frame& frame);

/// The grid from above, x to the right and z down: patches coloured by level, drawn ones full and culled ones pale;
/// what each view sees of the rest level; the viewer.
///
/// \param drawn  the list in question
/// \param all    the same selection without views
std::string plan_as_svg(const DrawList& drawn, const DrawList& all, std::span<const Frustum> views,
                        glm::dvec3 viewer_m);

}  // namespace pelagic::tools
