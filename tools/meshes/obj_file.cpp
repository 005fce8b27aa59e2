#include "pelagic/tools/meshes/obj_file.hpp"

#include <charconv>
#include <initializer_list>

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

}  // namespace pelagic::tools
