// A mesh as PLY (Turk 1994), binary, little-endian.
#pragma once

#include "pelagic/tools/files/byte_order.hpp"
#include "pelagic/tools/meshes/mesh.hpp"

namespace pelagic::tools {

/// Properties of a vertex by the names that Blender and MeshLab look for: x y z nx ny nz s t, and with foam `foam` as a float and
/// the same as grey in red, green and blue, for programs that skip names they don't know.
Bytes mesh_as_ply(const Mesh& mesh);

}  // namespace pelagic::tools
