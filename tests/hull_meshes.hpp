// Meshes of hulls for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>
#include <vector>

#include "pelagic/examples/boat/boat_mesh.hpp"
#include "pelagic/floating/hull_mesh.hpp"

namespace pelagic {

struct HullSoup {
    std::vector<glm::dvec3> vertices;
    std::vector<HullMesh::Triangle> triangles;
};

/// A box around the origin, each face of cells x cells squares of two triangles.
inline HullSoup box_soup(const glm::dvec3& size_m, int cells = 1) {
    HullSoup soup;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            const int right = (axis + 1) % 3, up = (axis + 2) % 3;
            const auto first = static_cast<std::uint32_t>(soup.vertices.size());
            const auto across = static_cast<std::uint32_t>(cells + 1);
            for (int j = 0; j <= cells; ++j)
                for (int i = 0; i <= cells; ++i) {
                    glm::dvec3 at{};
                    at[axis] = side / 2;
                    at[right] = static_cast<double>(i) / cells - 0.5;
                    at[up] = static_cast<double>(j) / cells - 0.5;
                    soup.vertices.push_back(at * size_m);
                }
            for (std::uint32_t j = 0; j + 1 < across; ++j)
                for (std::uint32_t i = 0; i + 1 < across; ++i) {
                    const std::uint32_t a = first + j * across + i, b = a + 1, c = a + across, d = c + 1;
                    if (side > 0)
                        soup.triangles.insert(soup.triangles.end(), {{a, b, d}, {a, d, c}});
                    else
                        soup.triangles.insert(soup.triangles.end(), {{a, d, b}, {a, c, d}});
                }
        }
    return soup;
}

inline HullMesh box_mesh(const glm::dvec3& size_m, int cells = 1) {
    const HullSoup soup = box_soup(size_m, cells);
    return HullMesh(soup.vertices, soup.triangles);
}

/// A cylinder around the y axis and the origin.
inline HullMesh cylinder_mesh(double radius_m, double height_m, std::uint32_t sides, std::uint32_t rings) {
    std::vector<glm::dvec3> vertices;
    std::vector<HullMesh::Triangle> triangles;
    for (std::uint32_t ring = 0; ring <= rings; ++ring)
        for (std::uint32_t side = 0; side < sides; ++side) {
            const double angle = 2 * std::numbers::pi * side / sides;
            vertices.emplace_back(radius_m * std::cos(angle), height_m * (static_cast<double>(ring) / rings - 0.5),
                                  radius_m * std::sin(angle));
        }
    for (std::uint32_t side = 0; side < sides; ++side) {
        const std::uint32_t next = (side + 1) % sides;
        for (std::uint32_t ring = 0; ring < rings; ++ring) {
            const std::uint32_t a = ring * sides + side, b = ring * sides + next, c = a + sides, d = b + sides;
            triangles.insert(triangles.end(), {{a, c, b}, {b, c, d}});
        }
    }
    // fans around the middles of the ends: even weights
    const std::uint32_t top = rings * sides, bottom_middle = top + sides, top_middle = bottom_middle + 1;
    for (const double y : {-0.5, 0.5}) vertices.emplace_back(0, height_m * y, 0);
    for (std::uint32_t side = 0; side < sides; ++side) {
        const std::uint32_t next = (side + 1) % sides;
        triangles.insert(triangles.end(), {{bottom_middle, side, next}, {top_middle, top + next, top + side}});
    }
    return HullMesh(vertices, triangles);
}

/// A prism along x whose section is a triangle with its edge down: a keel at y = 0, a deck at
/// y = height_m.
inline HullMesh wedge_mesh(double length_m, double beam_m, double height_m) {
    const double x = length_m / 2, z = beam_m / 2;
    const std::vector<glm::dvec3> vertices{{-x, 0, 0}, {-x, height_m, -z}, {-x, height_m, z},
                                           {x, 0, 0},  {x, height_m, -z},  {x, height_m, z}};
    const std::vector<HullMesh::Triangle> triangles{{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                                                    {0, 3, 5}, {0, 5, 2}, {1, 2, 5}, {1, 5, 4}};
    return HullMesh(vertices, triangles);
}

using examples::boat_mesh;

}  // namespace pelagic
