// Reads a Mesh of the engine as the mesh of a hull.
#pragma once

#include "pelagic/contrib/godot3/engine.hpp"
#include "pelagic/floating/hull_mesh.hpp"

namespace pelagic::godot {

/// Joins all surfaces of a Mesh. Vertices have the numbers of the surfaces' arrays, one after the
/// other; those that are apart by rounding get one position. Axes are those of the mesh. The
/// winding is reversed, because the engine's front faces are clockwise.
/// \throws std::invalid_argument  for another object, for surfaces that are not of
///                                PRIMITIVE_TRIANGLES, and what HullMesh throws
HullMesh hull_mesh_of(const Variant& mesh);

}  // namespace pelagic::godot
