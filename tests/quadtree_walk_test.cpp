// For a walking viewer, vertices that stay in the mesh do not move, and the surface never jumps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "pelagic/tests/quadtree_scene.hpp"
#include "pelagic/tests/sweep.hpp"

namespace pelagic {
namespace {

#if defined(NDEBUG)
// Grids of up to 2 km snap within 400 m; larger grids, up to 8 km, do not.
double walk_m() { return of_sweep(400.0, 1500.0); }
#else
double walk_m() { return 20; }  // sanitizers need fewer steps
#endif
constexpr double pace_m = 0.01;

struct Walk {
    const char* preset;
    double size_m;
    int vertices = 0;  ///< 0: the preset's number
};
void PrintTo(const Walk& walk, std::ostream* out) {
    *out << walk.preset << " " << walk.size_m << " " << walk.vertices;
}

class EachWalk : public testing::TestWithParam<Walk> {
   protected:
    QuadtreeOptions options() const {
        QuadtreeOptions all = quadtree_preset_named(GetParam().preset)->options(GetParam().size_m);
        if (GetParam().vertices > 0) all.vertices = GetParam().vertices;
        return all;
    }
    /// A slanted direction, so that borders are crossed at an angle, and a path longer than a snap.
    glm::dvec3 on_the_way(double m) const { return {m * 0.8 + 11, 1.7, m * 0.6 - 3}; }
};
// The last two grids have an odd number of coarser squares: their diagonals alternate from patch to
// patch.
INSTANTIATE_TEST_SUITE_P(Walks, EachWalk,
                         testing::Values(Walk{"low", 1024}, Walk{"medium", 1024}, Walk{"high", 1024},
                                         Walk{"ultra", 1024}, Walk{"low", 256}, Walk{"medium", 8192},
                                         Walk{"paper_low", 1024}, Walk{"paper_medium", 2048},
                                         Walk{"paper_high", 2048}, Walk{"paper_ultra", 2048}, Walk{"low", 512, 6},
                                         Walk{"low", 512, 10}),
                         [](const auto& test) {
                             return std::string(test.param.preset) + "_" +
                                    std::to_string(static_cast<int>(test.param.size_m)) +
                                    (test.param.vertices > 0 ? "_V" + std::to_string(test.param.vertices) : "");
                         });

/// Returns the height of the mesh over a point, for a sea without horizontal displacement, whose
/// reference positions are the drawn ones.
class MeshHeight {
   public:
    MeshHeight(const Selection& selection, const SineSea& sea) : selection_(selection), sea_(sea) {
        const QuadtreeGrid& grid = selection.list().grid;
        patches_.assign(static_cast<std::size_t>(selection.level_map().width() * selection.level_map().width()),
                        nullptr);
        for (const DrawBatch& batch : selection.list().batches)
            for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
                const PatchInstance& patch = selection.list().instances[i];
                slot(patch.corner_x / grid.vertices, patch.corner_z / grid.vertices) = &patch;
            }
        for (const DrawBatch& batch : selection.list().batches)
            ends_.push_back({&selection.list().instances[batch.first] + batch.count, batch.stitches});
    }

    double at(glm::dvec2 point) {
        const QuadtreeGrid& grid = selection_.list().grid;
        const glm::dvec2 steps = point / grid.step_m - glm::dvec2(grid.corner);
        // the skirt
        if (steps.x < 0 || steps.y < 0 || steps.x >= grid.side || steps.y >= grid.side) return 0;
        const auto cell_x = static_cast<int>(steps.x) / grid.vertices,
                   cell_z = static_cast<int>(steps.y) / grid.vertices;
        const int level = selection_.level_map().level_at(cell_x, cell_z);
        const int cells = 1 << (grid.deepest_level - level);
        const PatchInstance& patch = *slot(cell_x / cells * cells, cell_z / cells * cells);
        // In vertices of the patch; then in its 3 x 3 cell, whose triangle fan has its centre in
        // the middle.
        const glm::dvec2 in_patch = (steps - glm::dvec2(patch.corner_x, patch.corner_z)) / double(grid.stride(level));
        const int cx = std::min(static_cast<int>(in_patch.x) / 2, grid.vertices / 2 - 1);
        const int cz = std::min(static_cast<int>(in_patch.y) / 2, grid.vertices / 2 - 1);
        const glm::dvec2 from_middle = in_patch - glm::dvec2(2 * cx + 1, 2 * cz + 1);
        return fan_height(patch, stitches_of(&patch), cx, cz, from_middle);
    }

   private:
    const PatchInstance*& slot(int x, int z) {
        return patches_[static_cast<std::size_t>(x + z * selection_.level_map().width())];
    }
    unsigned stitches_of(const PatchInstance* patch) const {
        for (const auto& [end, stitches] : ends_)
            if (patch < end) return stitches;
        return 0;
    }

    /// Goes around the cell's edge: finds the triangle (middle, a, b) that holds the point, and
    /// evaluates its plane there.
    double fan_height(const PatchInstance& patch, unsigned stitches, int cx, int cz, glm::dvec2 p) const {
        const QuadtreeGrid& grid = selection_.list().grid;
        const int v = grid.vertices;
        const auto height = [&](int di, int dj) {
            return patch_vertex(grid, patch, 2 * cx + 1 + di, 2 * cz + 1 + dj, sea_).y;
        };
        // The quadrant: east is |x| >= |z| with x > 0, and so on. Its side may lack the midpoint.
        const bool is_x = std::abs(p.x) >= std::abs(p.y);
        const int sign = (is_x ? p.x : p.y) >= 0 ? 1 : -1;
        const Side side = is_x ? (sign > 0 ? east : west) : (sign > 0 ? north : south);
        const bool at_border = is_x ? (sign > 0 ? cx == v / 2 - 1 : cx == 0) : (sign > 0 ? cz == v / 2 - 1 : cz == 0);
        const double out = std::abs(is_x ? p.x : p.y), along = is_x ? p.y : p.x;
        const auto edge_height = [&](int a) { return is_x ? height(sign, a) : height(a, sign); };
        const double middle = height(0, 0);
        if (out == 0) return middle;
        // On the side itself the point is at along / out, from -1 to 1.
        const double s = along / out;
        double edge;
        if (at_border && (stitches >> side & 1) != 0)
            edge = edge_height(-1) * (1 - s) / 2 + edge_height(1) * (1 + s) / 2;
        else if (s < 0)
            edge = edge_height(-1) * -s + edge_height(0) * (1 + s);
        else
            edge = edge_height(1) * s + edge_height(0) * (1 - s);
        return middle * (1 - out) + edge * out;
    }

    const Selection& selection_;
    const SineSea& sea_;
    std::vector<const PatchInstance*> patches_;
    std::vector<std::pair<const PatchInstance*, unsigned>> ends_;
};

// A pop would be as high as the error of a coarser grid: up to the wave's whole height, 4 m.
TEST_P(EachWalk, SurfaceChangesByLessThanAMillimetreAStep) {
    const SineSea sea{.height_m = 2, .horizontal_m = 0};
    Random random(10);
    std::vector<glm::dvec2> points;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 near = on_the_way(random.between(-0.2, 1.2) * walk_m());
        points.push_back({near.x + random.between(-150, 150), near.z + random.between(-150, 150)});
    }
    Selection selection(options());
    std::vector<double> before;
    double largest = 0, whole = 0;
    for (int step = 0; step * pace_m <= walk_m(); ++step) {
        selection.select({.viewer_m = on_the_way(step * pace_m)});
        MeshHeight mesh(selection, sea);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double height = mesh.at(points[i]);
            if (step == 0) {
                before.push_back(height);
                continue;
            }
            const double change = std::abs(height - before[i]);
            ASSERT_LT(change, 1e-3) << "step " << step << " point " << points[i].x << " " << points[i].y;
            largest = std::max(largest, change);
            whole += change;
            before[i] = height;
        }
    }
    RecordProperty("largest_change_mm", std::to_string(largest * 1000));
    if (walk_m() >= 400 && options().size_m > 256) {
        EXPECT_GT(whole, 0.1) << "nothing ever morphed, so nothing was tested";
    }
}

// Reference positions by level: a patch of level 2 and finer lies on the world's raster of its
// size. The same position is always covered by the same patch, whose vertices are identical
// doubles.
TEST_P(EachWalk, NoVertexThatStaysInTheMeshMoves) {
    Selection selection(options());
    using Place = std::tuple<int, std::int64_t, std::int64_t>;  // level, raster
    std::map<Place, std::pair<glm::dvec2, glm::dvec2>> known;   // first and last vertex of a patch
    for (double m = 0; m <= walk_m(); m += 0.5) {
        const QuadtreeGrid& grid = selection.select({.viewer_m = on_the_way(m)}).grid;
        for (const PatchInstance& patch : selection.list().instances) {
            if (patch.level < 2) continue;
            const std::int64_t side = grid.patch_side(patch.level);
            const std::int64_t x = grid.corner.x + patch.corner_x, z = grid.corner.y + patch.corner_z;
            ASSERT_EQ(x % side, 0);
            ASSERT_EQ(z % side, 0);
            const std::pair corners(rest_position(grid, patch, 0, 0), rest_position(grid, patch, grid.vertices, 1));
            const auto [entry, is_new] = known.try_emplace({patch.level, x / side, z / side}, corners);
            ASSERT_EQ(entry->second, corners);
        }
    }
    EXPECT_GT(known.size(), 4u);
}

// The grid follows: the viewer is at most S/8 from its middle on either axis.
TEST_P(EachWalk, GridFollowsInStepsOfAQuarter) {
    Selection selection(options());
    for (double m = 0; m <= walk_m(); m += 0.5) {
        const glm::dvec3 viewer = on_the_way(m);
        const QuadtreeGrid& grid = selection.select({.viewer_m = viewer}).grid;
        const glm::dvec2 middle = (glm::dvec2(grid.corner) + grid.side / 2.0) * grid.step_m;
        ASSERT_LE(std::abs(middle.x - viewer.x), grid.size_m() / 8 * (1 + 1e-12));
        ASSERT_LE(std::abs(middle.y - viewer.z), grid.size_m() / 8 * (1 + 1e-12));
        ASSERT_EQ(grid.corner.x % (grid.side / 4), 0);
    }
}

}  // namespace
}  // namespace pelagic
