#include "pelagic/tools/meshes/hull_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <utility>

#include "pelagic/tools/files/input_file.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

constexpr std::string_view obj_blanks = " \t\r";

/// Removes the first word of a line and returns it; empty at the end.
std::string_view take_word(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(obj_blanks), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(obj_blanks));
    line.remove_prefix(word.size());
    return word;
}

class ObjReader {
   public:
    explicit ObjReader(const std::string& name) : name_(name) {}

    /// \param lines  of the file that the line continues over
    void take_line(std::string_view line, std::size_t lines) {
        line_number_ = next_line_;
        next_line_ += lines;
        const std::string_view keyword = take_word(line);
        if (keyword == "v") take_vertex(line);
        if (keyword == "f") take_face(line);
    }

    HullFile hull{.vertices = {}, .triangles = {}, .first_number = 1};

   private:
    [[noreturn]] void reject(const std::string& reason) const {
        throw InputError(name_ + ":" + number_text(line_number_) + ": " + reason);
    }
    [[noreturn]] void reject(std::string_view what, std::string_view value, std::string_view accepted) const {
        constexpr std::size_t longest = 40;
        reject(invalid_value_message(what, value.substr(0, longest), accepted));
    }

    void take_vertex(std::string_view line) {
        glm::dvec3& vertex = hull.vertices.emplace_back();
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = take_word(line);
            const auto value = parse_number(word);
            if (!value) reject(std::string(1, "xyz"[axis]) + " of a vertex", word, "a number of metres");
            vertex[axis] = *value;
        }
    }

    std::uint32_t vertex_of(std::string_view corner) const {
        const auto count = static_cast<std::int64_t>(hull.vertices.size());
        const auto number = parse_integer(corner.substr(0, corner.find('/')));
        if (!number || *number == 0 || *number > count || *number < -count)
            reject("a corner of a face", corner,
                   "the number of one of the " + number_text(count) + " vertices above");
        return static_cast<std::uint32_t>(*number > 0 ? *number - 1 : count + *number);
    }

    /// Splits a face into triangles around its first corner.
    void take_face(std::string_view line) {
        HullMesh::Triangle triangle{};
        std::size_t corners = 0;
        for (std::string_view word; !(word = take_word(line)).empty(); ++corners) {
            triangle[1] = triangle[2];
            triangle[2] = vertex_of(word);
            if (corners == 0) triangle[0] = triangle[2];
            if (corners < 2) continue;
            if (hull.triangles.size() == HullMesh::max_triangles)
                reject("the hull has more than " + number_text(HullMesh::max_triangles) + " triangles");
            hull.triangles.push_back(triangle);
        }
        if (corners < 3) reject("the number of a face's corners", number_text(corners), "3 or more");
    }

    const std::string& name_;
    std::size_t line_number_ = 0, next_line_ = 1;
};

bool is_gltf(std::string_view bytes) {
    if (bytes.starts_with("glTF")) return true;
    const std::size_t first = bytes.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && bytes[first] == '{';
}

struct Corner {
    std::size_t triangle;
    double angle_rad;
};

}  // namespace

HullFile parse_obj_hull(const std::string& name, std::string_view text) {
    ObjReader reader(name);
    std::string continued;  // from lines that end with a backslash
    std::size_t lines = 0;
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        ++lines;
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (line.ends_with('\\') && !line.starts_with('#')) {
            continued.append(line.substr(0, line.size() - 1)).append(" ");
            if (!text.empty()) continue;
            line = {};
        }
        if (!continued.empty()) line = continued.append(line);
        reader.take_line(line, lines);
        continued.clear();
        lines = 0;
    }
    if (reader.hull.triangles.empty()) throw InputError(name + " has no faces, expected an OBJ or glTF 2.0 file");
    return std::move(reader.hull);
}

HullMesh read_hull(const std::string& option, const std::filesystem::path& file) {
    InputFile input(option, file, "an OBJ or glTF 2.0 file");
    const std::string content = input.read_all(HullFile::max_bytes);
    std::string_view bytes = content;
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // a byte order mark
    const HullFile hull = is_gltf(bytes) ? parse_gltf_hull(file, bytes) : parse_obj_hull(input.name(), bytes);
    if (const std::string reason = HullMesh::check(hull.vertices, hull.triangles, hull.first_number); !reason.empty())
        throw InputError(input.name() + ": " + reason);
    HullMesh mesh(hull.vertices, hull.triangles);
    const glm::dvec3 size = mesh.upper_m() - mesh.lower_m();
    for (const double side : {size.x, size.z})  // the range of a PressureFootprint
        if (!(side >= 0.001 && side <= 1000))
            throw InputError(input.name() + ": " +
                             invalid_value_message("the hull's length or beam", side, "[0.001, 1000] m"));
    return mesh;
}

std::vector<std::array<glm::dvec3, 3>> corner_normals(const HullMesh& mesh, double crease_rad) {
    const auto& triangles = mesh.triangles();
    const auto& vertices = mesh.vertices();
    std::vector<glm::dvec3> faces(triangles.size());
    std::vector<std::vector<Corner>> around(vertices.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto at = [&](std::size_t corner) { return vertices[triangles[i][corner % 3]]; };
        const glm::dvec3 across = glm::cross(at(1) - at(0), at(2) - at(0));
        const double length = glm::length(across);
        faces[i] = length > 0 ? across / length : glm::dvec3(0, 1, 0);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const glm::dvec3 next = at(corner + 1) - at(corner), last = at(corner + 2) - at(corner);
            around[triangles[i][corner]].push_back(
                {i, std::atan2(glm::length(glm::cross(next, last)), glm::dot(next, last))});
        }
    }
    const double least_cosine = std::cos(crease_rad);
    std::vector<std::array<glm::dvec3, 3>> normals(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            glm::dvec3 sum{};
            for (const Corner& other : around[triangles[i][corner]])
                if (other.triangle == i || glm::dot(faces[i], faces[other.triangle]) >= least_cosine)
                    sum += other.angle_rad * faces[other.triangle];
            const double length = glm::length(sum);
            normals[i][corner] = length > 0 ? sum / length : faces[i];
        }
    return normals;
}

}  // namespace pelagic::tools
