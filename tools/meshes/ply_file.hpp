// Binary little-endian PLY files (Turk 1994).
#pragma once

#include "pelagic/tools/files/byte_order.hpp"
#include "pelagic/tools/meshes/mesh.hpp"

namespace pelagic::tools {

/// Returns the PLY file. Vertex properties have the names that Blender and MeshLab read: x y z nx
/// ny nz s t. With foam, the file also has `foam` as a float, and red, green and blue as grey for
/// programs that ignore unknown properties.
Bytes mesh_as_ply(const Mesh& mesh);

}  // namespace pelagic::tools
