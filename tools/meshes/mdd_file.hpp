// A point cache as MDD (NewTek's LightWave, Motion Designer): where the vertices of a mesh are in each frame. Blender's modifier
// Mesh Cache and Houdini read it, on a mesh with the same vertices in the same order. All of it big-endian: frames and points as
// 32-bit integers, the frames' times in seconds as floats, then x y z of each point of each frame as floats.
#pragma once

#include <span>

#include "pelagic/tools/files/byte_order.hpp"
#include "pelagic/tools/meshes/mesh.hpp"

namespace pelagic::tools {

/// What stands before the first frame.
void append_mdd_header(Bytes& bytes, std::span<const float> times_s, std::size_t points);

/// The next frame.
void append_mdd_frame(Bytes& bytes, const Mesh& mesh);

/// Of the whole file.
constexpr std::size_t mdd_bytes(std::size_t points, std::size_t frames) { return 8 + frames * (4 + points * 12); }

}  // namespace pelagic::tools
