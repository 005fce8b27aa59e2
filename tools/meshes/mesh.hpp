// A piece of sea as artists' programs take it: vertices in one order, and faces between them. What any of the files of meshes
// (obj_file, ply_file, gltf_file, mdd_file) is written from.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace pelagic::tools {

struct Mesh {
    std::vector<glm::dvec3> positions;  ///< metres: x east, y up, z south
    std::vector<glm::vec3> normals;     ///< unit vectors, one a vertex
    /// u and v of an export's maps of the coarsest cascade, one a vertex; v counts from the lower edge of the image, and both go on
    /// beyond 0 and 1 where the cascade repeats.
    std::vector<glm::vec2> texture_coordinates;
    std::vector<float> foam;           ///< 0 none to 1 covered, one a vertex; empty: unknown
    std::vector<std::uint32_t> faces;  ///< vertices of one face after the other, counter-clockwise from above
    std::size_t corners = 3;           ///< of each face, 3 or 4

    std::size_t face_count() const { return faces.size() / corners; }
};

/// Foam as a byte of grey, for programs that read colours and nothing else.
inline std::uint8_t grey_of(float foam) { return static_cast<std::uint8_t>(foam * 255 + 0.5f); }

}  // namespace pelagic::tools
