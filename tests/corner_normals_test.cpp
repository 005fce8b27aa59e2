// Normals for drawing hulls, against closed forms.
#include "pelagic/tools/meshes/hull_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace pelagic::tools {
namespace {

using std::numbers::pi;

// A few roundings of numbers up to 1.
constexpr double rounding = 1e-14;

/// A prism of a regular polygon: radius 1, axis y from -1 to 1, with fans as lids.
HullMesh prism(std::uint32_t sides) {
    std::vector<glm::dvec3> vertices;
    std::vector<HullMesh::Triangle> triangles;
    for (std::uint32_t side = 0; side < sides; ++side) {
        const double angle = 2 * pi * side / sides;
        for (const double y : {-1.0, 1.0}) vertices.emplace_back(std::cos(angle), y, -std::sin(angle));
        const std::uint32_t low = 2 * side, next = 2 * ((side + 1) % sides);
        triangles.push_back({low, next, next + 1});
        triangles.push_back({low, next + 1, low + 1});
        if (side == 0 || side + 1 == sides) continue;
        triangles.push_back({1, low + 1, next + 1});
        triangles.push_back({0, next, low});
    }
    return {vertices, triangles};
}

/// Returns the largest distance of a corner's normal from an expected one.
template <class Expected>
double largest_error(const HullMesh& mesh, double crease_rad, Expected expected) {
    const auto normals = corner_normals(mesh, crease_rad);
    double largest = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const auto at = [&](std::size_t corner) { return mesh.vertices()[mesh.triangles()[i][corner]]; };
        const glm::dvec3 face = glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0)));
        for (std::size_t corner = 0; corner < 3; ++corner)
            largest = std::max(largest, glm::distance(normals[i][corner], expected(at(corner), face)));
    }
    return largest;
}

// Sides of 24 meet at 15 degrees, lids and sides at 90.
TEST(CornerNormals, OfACylinderPointAwayFromItsAxisUpToTheSharpLids) {
    const auto cylinder = [](const glm::dvec3& at, const glm::dvec3& face) {
        return std::fabs(face.y) > 0.5 ? face : glm::dvec3(at.x, 0, at.z);
    };
    EXPECT_LT(largest_error(prism(24), 40 * pi / 180, cylinder), rounding);
}

TEST(CornerNormals, OfFacesThatMeetAtMoreThanTheCreaseAngleAreFlat) {
    const auto flat = [](const glm::dvec3&, const glm::dvec3& face) { return face; };
    EXPECT_LT(largest_error(prism(24), 14 * pi / 180, flat), rounding);
    EXPECT_LT(largest_error(prism(4), 40 * pi / 180, flat), rounding);
}

// Three faces of a box meet at a corner. A diagonal divides some of them there, which must not
// count twice.
TEST(CornerNormals, OfABoxWithoutCreasesAreItsDiagonals) {
    const auto diagonal = [](const glm::dvec3& at, const glm::dvec3&) {
        return glm::dvec3(std::sqrt(2.0) * at.x, at.y, std::sqrt(2.0) * at.z) / std::sqrt(3.0);
    };
    EXPECT_LT(largest_error(prism(4), pi, diagonal), rounding);
}

}  // namespace
}  // namespace pelagic::tools
