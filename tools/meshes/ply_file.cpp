#include "pelagic/tools/meshes/ply_file.hpp"

#include <string>

namespace pelagic::tools {
namespace {

std::string header_of(const Mesh& mesh) {
    std::string header =
        "ply\n"
        "format binary_little_endian 1.0\n"
        "comment Pelagic: a sea, faces counter-clockwise from above\n"
        "element vertex " +
        std::to_string(mesh.positions.size()) + "\n";
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "s", "t"})
        header += std::string("property float ") + name + "\n";
    if (!mesh.foam.empty())
        header += "property float foam\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n";
    return header + "element face " + std::to_string(mesh.face_count()) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
}

}  // namespace

Bytes mesh_as_ply(const Mesh& mesh) {
    const std::string header = header_of(mesh);
    Bytes bytes(header.begin(), header.end());
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::vec3 p(mesh.positions[v]), n = mesh.normals[v];
        const glm::vec2 uv = mesh.texture_coordinates[v];
        for (const float number : {p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y}) append_little_endian(bytes, number);
        if (mesh.foam.empty()) continue;
        append_little_endian(bytes, mesh.foam[v]);
        for (int colour = 0; colour < 3; ++colour) append_little_endian(bytes, grey_of(mesh.foam[v]));
    }
    for (std::size_t at = 0; at < mesh.faces.size(); at += mesh.corners) {
        append_little_endian(bytes, static_cast<std::uint8_t>(mesh.corners));
        for (std::size_t corner = at; corner < at + mesh.corners; ++corner)
            append_little_endian(bytes, mesh.faces[corner]);
    }
    return bytes;
}

}  // namespace pelagic::tools
