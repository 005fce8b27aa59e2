// MDD point caches (NewTek's LightWave, Motion Designer): positions of a mesh's vertices in each
// frame. Blender's modifier Mesh Cache and Houdini apply them to a mesh with the vertices in equal
// order. All values are big-endian: number of frames and points as 32-bit integers, times of frames
// in seconds as floats, then x y z of each point of each frame as floats.
#pragma once

#include <span>

#include "pelagic/tools/files/byte_order.hpp"
#include "pelagic/tools/meshes/mesh.hpp"

namespace pelagic::tools {

/// Appends the header.
void append_mdd_header(Bytes& bytes, std::span<const float> times_s, std::size_t points);

/// Appends the next frame.
void append_mdd_frame(Bytes& bytes, const Mesh& mesh);

/// Returns the size of the file in bytes.
constexpr std::size_t mdd_bytes(std::size_t points, std::size_t frames) { return 8 + frames * (4 + points * 12); }

}  // namespace pelagic::tools
