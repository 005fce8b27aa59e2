#include "pelagic/tools/meshes/mesh.hpp"

#include <charconv>
#include <cstdint>
#include <initializer_list>
#include <string>

#include "pelagic/message/number_text.hpp"

namespace pelagic::tools {
namespace {

void append_position(std::string& text, const glm::dvec3& position, ObjDigits digits) {
    for (const double metres : {position.x, position.y, position.z}) {
        text += ' ';
        if (digits == ObjDigits::all)
            append_number(text, metres);
        else
            append_number(text, static_cast<float>(metres));
    }
}

/// Appends each number after a space, with a fixed number of decimals.
void append_rounded(std::string& text, int decimals, std::initializer_list<float> numbers) {
    char digits[64];
    for (const float number : numbers) {
        const auto end =
            std::to_chars(digits, digits + sizeof digits, number, std::chars_format::fixed, decimals).ptr;
        text.append(" ").append(digits, static_cast<std::size_t>(end - digits));
    }
}

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

std::string mesh_as_obj(const Mesh& mesh, ObjDigits digits) {
    std::string text = "# Pelagic: a sea, faces counter-clockwise from above\ns 1\n";
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        text += 'v';
        append_position(text, mesh.positions[v], digits);
        if (!mesh.foam.empty()) append_rounded(text, 4, {mesh.foam[v], mesh.foam[v], mesh.foam[v]});
        text += "\nvt";
        append_rounded(text, 6, {mesh.texture_coordinates[v].x, mesh.texture_coordinates[v].y});
        text += "\nvn";
        append_rounded(text, 4, {mesh.normals[v].x, mesh.normals[v].y, mesh.normals[v].z});
        text += '\n';
    }
    for (std::size_t at = 0; at < mesh.faces.size(); at += mesh.corners) {
        text += 'f';
        for (std::size_t corner = at; corner < at + mesh.corners; ++corner) {
            const std::string number = number_text(mesh.faces[corner] + 1);
            text.append(" ").append(number).append("/").append(number).append("/").append(number);
        }
        text += '\n';
    }
    return text;
}

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

Bytes spray_as_ply(std::span<const SprayDroplet> droplets) {
    std::string header = "ply\nformat binary_little_endian 1.0\ncomment Pelagic: spray, x east, y up, z south\n";
    header += "element vertex " + std::to_string(droplets.size()) + '\n';
    for (const char* const name : {"x", "y", "z", "vx", "vy", "vz", "radius", "opacity", "age"})
        header.append("property float ").append(name).append("\n");
    header += "end_header\n";
    Bytes bytes(header.begin(), header.end());
    for (const SprayDroplet& drop : droplets)
        for (const float number :
             {static_cast<float>(drop.x_m), static_cast<float>(drop.y_m), static_cast<float>(drop.z_m),
              drop.velocity_x_mps, drop.velocity_y_mps, drop.velocity_z_mps, drop.radius_m, drop.opacity, drop.age_s})
            append_little_endian(bytes, number);
    return bytes;
}

void append_mdd_header(Bytes& bytes, std::span<const float> times_s, std::size_t points) {
    append_big_endian(bytes, static_cast<std::int32_t>(times_s.size()));
    append_big_endian(bytes, static_cast<std::int32_t>(points));
    for (const float time_s : times_s) append_big_endian(bytes, time_s);
}

void append_mdd_frame(Bytes& bytes, const Mesh& mesh) {
    for (const glm::vec3 position : mesh.positions)
        for (const float metres : {position.x, position.y, position.z}) append_big_endian(bytes, metres);
}

}  // namespace pelagic::tools
