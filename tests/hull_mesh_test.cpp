// Hull meshes: what is refused, and integrals of bodies with a closed form.
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "pelagic/tests/hull_meshes.hpp"

namespace pelagic {
namespace {

TEST(HullMesh, ABoxHasItsVolumeCentreAndMoments) {
    HullSoup soup = box_soup({4, 1, 2}, 3);
    for (glm::dvec3& vertex : soup.vertices) vertex += glm::dvec3(3, -2, 5);
    const HullMesh mesh(soup.vertices, soup.triangles);
    EXPECT_EQ(mesh.triangles().size(), 6u * 9 * 2);
    EXPECT_EQ(mesh.vertices().size(), 56u) << "corners and edges are merged: 6 x 9 + 2";
    EXPECT_NEAR(mesh.volume_m3(), 8, 1e-12);
    EXPECT_NEAR(mesh.centre_m().x, 3, 1e-12);
    EXPECT_NEAR(mesh.centre_m().y, -2, 1e-12);
    EXPECT_NEAR(mesh.centre_m().z, 5, 1e-12);
    EXPECT_NEAR(mesh.second_moments_m5()[0][0], 8.0 * 16 / 12, 1e-10);
    EXPECT_NEAR(mesh.second_moments_m5()[1][1], 8.0 * 1 / 12, 1e-10);
    EXPECT_NEAR(mesh.second_moments_m5()[0][1], 0, 1e-10);
    EXPECT_EQ(mesh.lower_m(), glm::dvec3(1, -2.5, 4));
    EXPECT_EQ(mesh.upper_m(), glm::dvec3(5, -1.5, 6));
}

TEST(HullMesh, AnUnusableMeshIsRefusedInOneLine) {
    const HullSoup good = box_soup({4, 1, 2});
    const auto reason = [](const HullSoup& soup) { return HullMesh::check(soup.vertices, soup.triangles); };
    ASSERT_EQ(reason(good), "");

    HullSoup open = good;
    open.triangles.pop_back();
    EXPECT_NE(reason(open).find("the hull is open at the edge between vertices "), std::string::npos) << reason(open);

    HullSoup inverted = good;
    for (auto& triangle : inverted.triangles) std::swap(triangle[0], triangle[1]);
    EXPECT_EQ(reason(inverted), "the hull's volume is -8 m^3: its triangles are wound inwards");

    HullSoup mixed = good;
    std::swap(mixed.triangles[3][0], mixed.triangles[3][1]);
    EXPECT_NE(reason(mixed).find("in the same direction"), std::string::npos) << reason(mixed);

    HullSoup flat = good;
    for (glm::dvec3& vertex : flat.vertices) vertex.y = 0;
    EXPECT_NE(reason(flat), "") << "no volume";

    HullSoup twice = good;  // each edge has four triangles
    twice.triangles.insert(twice.triangles.end(), good.triangles.begin(), good.triangles.end());
    EXPECT_NE(reason(twice), "");

    HullSoup not_finite = good;
    not_finite.vertices[7].z = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(reason(not_finite), "vertex 7: z nan is out of range [-1000, 1000] m");

    HullSoup outside = good;
    outside.triangles[5][2] = 99;
    EXPECT_EQ(reason(outside), "triangle 5 of the hull has vertex 99, expected less than 24");

    HullSoup large = good;
    large.triangles.assign(1'000'000, good.triangles[0]);
    EXPECT_EQ(reason(large), "the hull has 1000000 triangles, expected 4 to 4096");
    EXPECT_EQ(HullMesh::check({}, {}), "the hull has 0 triangles, expected 4 to 4096");
    EXPECT_THROW(HullMesh(open.vertices, open.triangles), std::invalid_argument);
}

}  // namespace
}  // namespace pelagic
