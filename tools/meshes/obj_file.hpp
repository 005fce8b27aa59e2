// A mesh as Wavefront OBJ: text, read by nearly everything.
#pragma once

#include <string>

#include "pelagic/tools/meshes/mesh.hpp"

namespace pelagic::tools {

/// How many digits a position has: as many as a 32-bit float needs, which is what programs keep it in, or all of them.
enum class ObjDigits { of_floats, all };

/// Vertices with texture coordinates and normals under the same number. Foam is a grey of 0 to 1 behind each place, "v x y z r g b",
/// which is no part of the format, but what Blender, MeshLab and Houdini read as vertex colours.
std::string mesh_as_obj(const Mesh& mesh, ObjDigits digits);

}  // namespace pelagic::tools
