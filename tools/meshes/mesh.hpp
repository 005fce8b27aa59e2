// An indexed mesh of the sea: the input of obj_file, ply_file, gltf_file and mdd_file.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

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

}  // namespace pelagic::tools
