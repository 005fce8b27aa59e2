// The bodies of potential_flow/make_truths.py.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "pelagic/floating/hull_mesh.hpp"
#include "pelagic/tests/hull_meshes.hpp"

namespace pelagic {

struct FloatingBody {
    const char* name;
    HullMesh mesh;
    glm::dvec3 centre_of_mass_m;
    double waterline_y_m, volume_m3;
};

inline HullMesh sphere_mesh(double radius_m, int around, int down) {
    std::vector<glm::dvec3> vertices;
    std::vector<HullMesh::Triangle> triangles;
    for (int j = 0; j <= down; ++j)
        for (int i = 0; i < around; ++i) {
            const double up = std::numbers::pi * (static_cast<double>(j) / down - 0.5);
            const double angle = 2 * std::numbers::pi * i / around, r = j > 0 && j < down ? std::cos(up) : 0;
            vertices.push_back(radius_m * glm::dvec3(r * std::cos(angle), std::sin(up), r * std::sin(angle)));
        }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * around + i % around); };
    for (int j = 0; j < down; ++j)
        for (int i = 0; i < around; ++i)
            triangles.insert(triangles.end(),
                             {{at(i, j), at(i + 1, j + 1), at(i + 1, j)}, {at(i, j), at(i, j + 1), at(i + 1, j + 1)}});
    return HullMesh(vertices, triangles);
}

/// A cylinder around the x axis and the origin.
inline HullMesh lying_cylinder_mesh(double radius_m, double length_m, std::uint32_t sides) {
    const HullMesh upright = cylinder_mesh(radius_m, length_m, sides, 1);
    std::vector<glm::dvec3> vertices;
    for (const glm::dvec3& v : upright.vertices()) vertices.emplace_back(v.y, v.z, v.x);
    return HullMesh(vertices, upright.triangles());
}

inline FloatingBody hemisphere_body() {
    return {"hemisphere", sphere_mesh(1, 48, 24), glm::dvec3(0), 0, 2 * std::numbers::pi / 3};
}
/// Diameter 4 m, draught 20 m, the centre of mass 12 m below the water.
inline FloatingBody spar_body() {
    return {"spar", cylinder_mesh(2, 30, 48, 1), glm::dvec3(0, -7, 0), 5, 80 * std::numbers::pi};
}
/// 100 m x 20 m, draught 6 m, the centre of mass at the water.
inline FloatingBody barge_body() { return {"barge", box_mesh({100, 12, 20}), glm::dvec3(0), 0, 12000}; }
/// The boat of the examples, 350 kg.
inline FloatingBody dinghy_body() {
    HullMesh mesh = boat_mesh(4, 1.7, 0.8);
    const glm::dvec3 centre = mesh.centre_m();
    return {"dinghy", std::move(mesh), centre, 0.2419476720970124, 350 / 1025.0};
}

}  // namespace pelagic
