// A hull for the example and for tests.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "pelagic/floating/hull_mesh.hpp"

namespace pelagic::examples {

/// Returns a boat of 128 triangles with a keel, chines, gunwales and a cambered deck, narrower
/// towards the bow; the keel is at y = 0. An application reads its own mesh instead.
inline HullMesh boat_mesh(double length_m, double beam_m, double height_m) {
    constexpr std::uint32_t sections = 10, ring = 6;
    constexpr double y[ring] = {0, 0.4, 1, 1.05, 1, 0.4}, z[ring] = {0, 0.75, 1, 0, -1, -0.75};
    std::vector<glm::dvec3> vertices;
    std::vector<HullMesh::Triangle> triangles;
    for (std::uint32_t i = 0; i <= sections; ++i) {
        const double along = static_cast<double>(i) / sections;
        for (std::uint32_t j = 0; j < ring; ++j)
            vertices.emplace_back(length_m * (along - 0.5), height_m * y[j],
                                  beam_m / 2 * (1 - 0.8 * along * along) * z[j]);
    }
    for (std::uint32_t i = 0; i < sections; ++i)
        for (std::uint32_t j = 0; j < ring; ++j) {
            const std::uint32_t a = ring * i + j, b = ring * i + (j + 1) % ring, c = a + ring, d = b + ring;
            triangles.insert(triangles.end(), {{a, c, b}, {b, c, d}});
        }
    constexpr std::uint32_t bow = ring * sections;
    for (std::uint32_t j = 1; j + 1 < ring; ++j)
        triangles.insert(triangles.end(), {{0, j, j + 1}, {bow, bow + j + 1, bow + j}});
    return HullMesh(vertices, triangles);
}

}  // namespace pelagic::examples
