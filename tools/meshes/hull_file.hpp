// Hulls from mesh files: Wavefront OBJ, and glTF 2.0 as .gltf or .glb (Khronos, ISO/IEC 12113), and
// their normals for drawing. Metres; x forward, y up, z to starboard.
#pragma once

#include <array>
#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/floating/hull_mesh.hpp"

namespace pelagic::tools {

struct HullFile {
    static constexpr std::size_t max_bytes = std::size_t{16} << 20;  ///< of a file
    static constexpr std::size_t max_buffer_bytes = 2 * max_bytes;   ///< of all buffers of a file

    std::vector<glm::dvec3> vertices;
    std::vector<HullMesh::Triangle> triangles;
    std::size_t first_number = 0;  ///< of the first vertex, as the format counts them
};

/// Parses an OBJ file: vertices and faces, which may have more than three corners.
/// \param name  of the file, for messages
/// \throws InputError  in one line with the file's name and the number of the line
HullFile parse_obj_hull(const std::string& name, std::string_view text);

/// Parses a glTF file, JSON or binary: the triangles of its scene with the transforms of its nodes.
/// Buffers are in the file, data URIs, or regular files in its folder or below, also behind links.
/// \param file  its path; also its name in messages
/// \throws InputError  in one line with the file's name and the element
HullFile parse_gltf_hull(const std::filesystem::path& file, std::string_view bytes);

/// Reads a hull from a file of either format, which the contents determine.
/// \param option  that names the file, for messages
/// \throws InputError  in one line, also for a mesh that HullMesh::check() rejects
HullMesh read_hull(const std::string& option, const std::filesystem::path& file);

/// Returns unit normals at the three corners of each triangle: the mean of the faces around the
/// vertex, weighted by their angles there (Thuermer and Wuethrich 1998), without those that meet
/// the triangle at more than the crease angle.
/// \param crease_rad  [0, pi]; 0: flat faces
std::vector<std::array<glm::dvec3, 3>> corner_normals(const HullMesh& mesh, double crease_rad);

}  // namespace pelagic::tools
