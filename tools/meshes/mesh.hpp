// An indexed mesh of the sea, and its files: Wavefront OBJ, binary little-endian PLY (Turk 1994), and
// MDD point caches (NewTek's LightWave, Motion Designer).
//
// An MDD file has the positions of a mesh's vertices in each frame. Blender's modifier Mesh Cache and
// Houdini apply them to a mesh with the vertices in equal order. All values are big-endian: number of
// frames and points as 32-bit integers, times of frames in seconds as floats, then x y z of each point
// of each frame as floats. gltf_file.hpp has glTF.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "pelagic/sim/spray.hpp"
#include "pelagic/tools/files/byte_order.hpp"

namespace pelagic::tools {

struct Mesh {
    std::vector<glm::dvec3> positions;  ///< metres: x east, y up, z south
    std::vector<glm::vec3> normals;     ///< unit vectors, one per vertex
    /// Texture coordinates for exported maps of the coarsest cascade, one per vertex. v starts at
    /// the lower edge of the image. Both exceed [0, 1] where the cascade repeats.
    std::vector<glm::vec2> texture_coordinates;
    std::vector<float> foam;           ///< 0 none to 1 covered, one per vertex; empty: unknown
    std::vector<std::uint32_t> faces;  ///< vertex indices of faces, counter-clockwise from above
    std::size_t corners = 3;           ///< vertices per face, 3 or 4

    std::size_t face_count() const { return faces.size() / corners; }
};

/// Returns foam as a grey byte, for programs that read vertex colours only.
inline std::uint8_t grey_of(float foam) { return static_cast<std::uint8_t>(foam * 255 + 0.5f); }

/// Digits of positions: those of a 32-bit float, the type that most programs store, or all digits
/// of a double.
enum class ObjDigits { of_floats, all };

/// Returns the OBJ text. A vertex, its texture coordinates and its normal have equal indices. Foam
/// is a grey of 0 to 1 after each position, "v x y z r g b", an extension that Blender, MeshLab and
/// Houdini read as vertex colours.
std::string mesh_as_obj(const Mesh& mesh, ObjDigits digits);

/// Returns the PLY file. Vertex properties have the names that Blender and MeshLab read: x y z nx
/// ny nz s t. With foam, the file also has `foam` as a float, and red, green and blue as grey for
/// programs that ignore unknown properties.
Bytes mesh_as_ply(const Mesh& mesh);

/// Returns droplets as the points of a PLY file: x y z in metres, vx vy vz in m/s (y up), radius in
/// metres, opacity and age in seconds, as floats.
Bytes spray_as_ply(std::span<const SprayDroplet> droplets);

/// Appends the header.
void append_mdd_header(Bytes& bytes, std::span<const float> times_s, std::size_t points);

/// Appends the next frame.
void append_mdd_frame(Bytes& bytes, const Mesh& mesh);

/// Returns the size of the file in bytes.
constexpr std::size_t mdd_bytes(std::size_t points, std::size_t frames) { return 8 + frames * (4 + points * 12); }

}  // namespace pelagic::tools
