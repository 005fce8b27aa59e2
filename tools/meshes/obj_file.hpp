// Wavefront OBJ files, a text format that most programs read.
#pragma once

#include <string>

#include "pelagic/tools/meshes/mesh.hpp"

namespace pelagic::tools {

/// Digits of positions: those of a 32-bit float, the type that most programs store, or all digits
/// of a double.
enum class ObjDigits { of_floats, all };

/// Returns the OBJ text. A vertex, its texture coordinates and its normal have equal indices. Foam
/// is a grey of 0 to 1 after each position, "v x y z r g b", an extension that Blender, MeshLab and
/// Houdini read as vertex colours.
std::string mesh_as_obj(const Mesh& mesh, ObjDigits digits);

}  // namespace pelagic::tools
