// The sixteen stitch patterns and the mesh built from them, tested exhaustively.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include "pelagic/quadtree/patch_mesh.hpp"
#include "pelagic/quadtree/stitching.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

using Point = std::pair<int, int>;
using Edge = std::pair<Point, Point>;

Point point(CellVertex v) { return {v.x, v.z}; }

/// Returns twice the area seen from above, positive if counter-clockwise. With x to the right, z
/// points down.
int doubled_cell_area(Point a, Point b, Point c) {
    return (b.second - a.second) * (c.first - a.first) - (b.first - a.first) * (c.second - a.second);
}

TEST(Stitching, PatternCoversItsCellOnceWithTrianglesThatFaceUp) {
    for (unsigned stitches = 0; stitches < 16; ++stitches) {
        const CellPattern pattern = cell_pattern(stitches);
        EXPECT_EQ(pattern.count, 8 - std::popcount(stitches));  // equation 66: 8 down to 4
        int area = 0;
        for (int t = 0; t < pattern.count; ++t) {
            const FanTriangle& triangle = pattern.triangles[static_cast<std::size_t>(t)];
            const int doubled = doubled_cell_area(point(cell_middle), point(triangle.second), point(triangle.third));
            EXPECT_GT(doubled, 0) << stitches;
            area += doubled;
        }
        EXPECT_EQ(area, 2 * 4) << stitches;
    }
}

TEST(Stitching, OnlyStitchedSidesHaveNoMidpoint) {
    const std::map<Side, CellVertex> midpoints = {{east, {2, 1}}, {north, {1, 2}}, {west, {0, 1}}, {south, {1, 0}}};
    for (unsigned stitches = 0; stitches < 16; ++stitches) {
        std::set<Point> used;
        const CellPattern pattern = cell_pattern(stitches);
        for (int t = 0; t < pattern.count; ++t)
            used.insert(point(pattern.triangles[static_cast<std::size_t>(t)].second));
        for (const auto& [side, midpoint] : midpoints)
            EXPECT_EQ(used.contains(point(midpoint)), (stitches >> side & 1) == 0)
                << stitches << " side " << int{side};
    }
}

class EachMesh : public testing::TestWithParam<int> {
   protected:
    PatchMesh mesh_{GetParam()};
    int v() const { return mesh_.vertices; }
    Point at(std::uint32_t index) const {
        return {mesh_.positions[mesh_.indices[index]].i, mesh_.positions[mesh_.indices[index]].j};
    }
};
std::vector<int> every_even_v() {
    if (is_sanitized) return {2, 4, 6, 8, 10, 16, 30, 64, 128};
    std::vector<int> all;
    for (int v = 2; v <= 128; v += 2) all.push_back(v);
    return all;
}
INSTANTIATE_TEST_SUITE_P(V, EachMesh, testing::ValuesIn(every_even_v()));

TEST_P(EachMesh, RangesAreClosedInsideAndHaveTheExpectedBorder) {
    for (unsigned stitches = 0; stitches < 16; ++stitches) {
        const PatchMesh::Range range = mesh_.ranges[stitches];
        ASSERT_EQ(range.count, 3 * patch_triangles(v(), stitches));
        std::vector<Edge> edges;
        long area = 0;
        for (std::uint32_t k = range.first; k < range.first + range.count; k += 3) {
            const Point corners[3] = {at(k), at(k + 1), at(k + 2)};
            const int doubled = doubled_cell_area(corners[0], corners[1], corners[2]);
            ASSERT_GT(doubled, 0);
            area += doubled;
            for (int e = 0; e < 3; ++e) edges.push_back({corners[e], corners[(e + 1) % 3]});
        }
        EXPECT_EQ(area, 2L * v() * v());
        // Every inner edge occurs once in each direction.
        std::sort(edges.begin(), edges.end());
        ASSERT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end());
        std::set<Edge> border;
        for (const Edge& edge : edges)
            if (!std::binary_search(edges.begin(), edges.end(), Edge{edge.second, edge.first})) border.insert(edge);
        std::set<Edge> expected;  // up the east side; with z downwards this is clockwise
        const auto side = [&](unsigned which, auto place) {
            const int step = (stitches >> which & 1) != 0 ? 2 : 1;
            for (int t = 0; t < v(); t += step) expected.insert({place(t), place(t + step)});
        };
        side(east, [&](int t) { return Point{v(), v() - t}; });
        side(north, [&](int t) { return Point{t, v()}; });
        side(west, [&](int t) { return Point{0, t}; });
        side(south, [&](int t) { return Point{v() - t, 0}; });
        EXPECT_EQ(border, expected) << "V " << v() << " stitches " << stitches;
    }
}

TEST_P(EachMesh, VerticesAreNumberedByEquation68AndFitSixteenBits) {
    ASSERT_EQ(mesh_.positions.size(), static_cast<std::size_t>((v() + 1) * (v() + 1)));
    for (int j = 0; j <= v(); ++j)
        for (int i = 0; i <= v(); ++i) {
            const auto& position = mesh_.positions[static_cast<std::size_t>(i + j * (v() + 1))];
            ASSERT_EQ((Point{position.i, position.j}), (Point{i, j}));
        }
    EXPECT_LE(mesh_.positions.size(), 65536u);
}

/// Returns the vertices transformed per triangle with a first-in, first-out cache.
double transforms_per_triangle(const std::vector<std::uint16_t>& indices, PatchMesh::Range range,
                               std::size_t entries) {
    std::deque<std::uint16_t> cache;
    int misses = 0;
    for (std::uint32_t k = range.first; k < range.first + range.count; ++k) {
        if (std::find(cache.begin(), cache.end(), indices[k]) != cache.end()) continue;
        ++misses;
        cache.push_back(indices[k]);
        if (cache.size() > entries) cache.pop_front();
    }
    return misses / (range.count / 3.0);
}

// Bands of two cells need ten new vertices for sixteen triangles, 0.625, and five for the first row
// of each band, which is 0.04 more at V = 16. A cache of 16 entries misses a few of them. In row
// order a patch needs 0.75 and more.
TEST(PatchMesh, IndicesSuitASmallVertexCache) {
    for (const int v : {16, 32, 64, 128}) {
        const PatchMesh mesh(v);
        EXPECT_LT(transforms_per_triangle(mesh.indices, mesh.ranges[0], 32), 0.625 + 0.7 / v) << v;
        EXPECT_LT(transforms_per_triangle(mesh.indices, mesh.ranges[0], 16), 0.72) << v;
        EXPECT_LT(transforms_per_triangle(mesh.indices, mesh.ranges[15], 16), 0.72) << v;
    }
}

TEST(PatchMesh, RejectsOtherVertexCounts) {
    for (const int v : {-2, 0, 1, 3, 63, 129, 130}) EXPECT_THROW(PatchMesh{v}, std::invalid_argument) << v;
}

}  // namespace
}  // namespace pelagic
