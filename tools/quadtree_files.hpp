// What `pelagic quadtree` writes: the mesh as Wavefront OBJ, the plan as SVG.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/displacement_sampler.hpp"

namespace pelagic::tools {

/// The displaced and morphed patches; vertices that patches share are written once. Metres, y up.
std::string mesh_as_obj(const DrawList& list, const DisplacementSampler& sea);

/// The grid from above, x to the right and z down: patches coloured by level, drawn ones full and culled ones pale;
/// what each view sees of the rest level; the viewer.
///
/// \param drawn  the list in question
/// \param all    the same selection without views
std::string plan_as_svg(const DrawList& drawn, const DrawList& all, std::span<const Frustum> views,
                        glm::dvec3 viewer_m);

}  // namespace pelagic::tools
