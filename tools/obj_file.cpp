#include "pelagic/tools/obj_file.hpp"

#include <cstdio>

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

template <class... Values>
void append_line(std::string& text, const char* format, Values... values) {
    char line[200];
    text.append(line, static_cast<std::size_t>(std::snprintf(line, sizeof line, format, values...)));
}

}  // namespace

std::string mesh_as_obj(const Mesh& mesh, ObjDigits digits) {
    std::string text = "# Pelagic: a sea, metres, y up, faces counter-clockwise from above\ns 1\n";
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        text += 'v';
        append_position(text, mesh.positions[v], digits);
        if (!mesh.foam.empty()) {
            const auto foam = static_cast<double>(mesh.foam[v]);
            append_line(text, " %.4f %.4f %.4f", foam, foam, foam);
        }
        const glm::dvec2 uv(mesh.texture_coordinates[v]);
        const glm::dvec3 n(mesh.normals[v]);
        append_line(text, "\nvt %.6f %.6f\nvn %.4f %.4f %.4f\n", uv.x, uv.y, n.x, n.y, n.z);
    }
    for (std::size_t at = 0; at < mesh.faces.size(); at += mesh.corners) {
        text += 'f';
        for (std::size_t corner = at; corner < at + mesh.corners; ++corner) {
            const std::uint32_t number = mesh.faces[corner] + 1;
            append_line(text, " %u/%u/%u", number, number, number);
        }
        text += '\n';
    }
    return text;
}

}  // namespace pelagic::tools
