#include "pelagic/tools/meshes/corner_normals.hpp"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace pelagic::tools {
namespace {

struct Corner {
    std::size_t triangle;
    double angle_rad;
};

}  // namespace

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
