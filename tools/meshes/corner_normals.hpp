// Normals that show a mesh's smooth parts smooth and its edges sharp.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "pelagic/floating/hull_mesh.hpp"

namespace pelagic::tools {

/// Returns unit normals at the three corners of each triangle: the mean of the faces around the
/// vertex, weighted by their angles there (Thuermer and Wuethrich 1998), without those that meet
/// the triangle at more than the crease angle.
/// \param crease_rad  [0, pi]; 0: flat faces
std::vector<std::array<glm::dvec3, 3>> corner_normals(const HullMesh& mesh, double crease_rad);

}  // namespace pelagic::tools
