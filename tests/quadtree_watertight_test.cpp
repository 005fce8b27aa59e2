// Absence of cracks: two neighbouring triangles share a bit-identical edge after displacement and
// morph.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <unordered_map>

#include "pelagic/quadtree/skirt.hpp"
#include "pelagic/tests/quadtree_scene.hpp"
#include "pelagic/tests/sweep.hpp"

namespace pelagic {
namespace {

#if defined(NDEBUG)
int viewers() { return of_sweep(500, 2000); }
#else
int viewers() { return 60; }  // fewer under sanitizers, which have a tenth of the speed
#endif

constexpr std::int32_t step_x[4] = {1, 0, -1, 0};
constexpr std::int32_t step_z[4] = {0, 1, 0, -1};

/// Maps each cell of the finest level to the instance of a list that covers it, and its stitches.
class Tiling {
   public:
    void build(const DrawList& list) {
        width_ = 1 << list.grid.deepest_level;
        owner_.assign(static_cast<std::size_t>(width_ * width_), -1);
        stitches_.resize(list.instances.size());
        for (const DrawBatch& batch : list.batches)
            for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
                stitches_[i] = batch.stitches;
                const PatchInstance& patch = list.instances[i];
                const int cells = 1 << (list.grid.deepest_level - patch.level);
                const int x = patch.corner_x / list.grid.vertices, z = patch.corner_z / list.grid.vertices;
                for (int row = z; row < z + cells; ++row)
                    std::fill_n(owner_.begin() + x + row * width_, cells, static_cast<int>(i));
            }
    }
    int at(int x, int z) const {
        return x < 0 || z < 0 || x >= width_ || z >= width_ ? -1 : owner_[static_cast<std::size_t>(x + z * width_)];
    }
    int stitches(int instance) const { return stitches_[static_cast<std::size_t>(instance)]; }

   private:
    int width_ = 0;
    std::vector<int> owner_;
    std::vector<std::uint8_t> stitches_;
};

/// Checks all borders of an unculled selection. Two patches of a level must have the same vertices
/// with the same weights. A finer patch must omit vertices that the coarser one lacks, and the
/// coarser one's vertices must have finished morphing.
::testing::AssertionResult borders_close(const DrawList& list, const Tiling& tiling) {
    const QuadtreeGrid& grid = list.grid;
    for (int p = 0; p < static_cast<int>(list.instances.size()); ++p) {
        const PatchInstance& patch = list.instances[static_cast<std::size_t>(p)];
        const int cells = 1 << (grid.deepest_level - patch.level);
        const int x0 = patch.corner_x / grid.vertices, z0 = patch.corner_z / grid.vertices;
        for (int side = 0; side < 4; ++side) {
            const bool is_stitched = (tiling.stitches(p) >> side & 1) != 0;
            const std::uint16_t weight = patch.edge_weights[static_cast<std::size_t>(side)];
            for (int t = 0; t < cells; ++t) {
                const int x = x0 + (step_x[side] > 0 ? cells : step_x[side] < 0 ? -1 : t);
                const int z = z0 + (step_z[side] > 0 ? cells : step_z[side] < 0 ? -1 : t);
                const int n = tiling.at(x, z);
                if (n < 0) {
                    if (is_stitched) return ::testing::AssertionFailure() << "stitched to the skirt";
                    continue;
                }
                const PatchInstance& other = list.instances[static_cast<std::size_t>(n)];
                const int difference = int{other.level} - int{patch.level};
                if (difference < -1 || difference > 1)
                    return ::testing::AssertionFailure()
                           << "levels " << int{patch.level} << " and " << int{other.level};
                if (is_stitched != (difference == -1))
                    return ::testing::AssertionFailure() << "stitched " << is_stitched << " at " << difference;
                const std::uint16_t theirs = other.edge_weights[static_cast<std::size_t>((side + 2) % 4)];
                if (difference == 0 && theirs != weight)
                    return ::testing::AssertionFailure() << "weights " << weight << " and " << theirs;
                if (difference == 1 && weight != full_weight)
                    return ::testing::AssertionFailure() << "a finer neighbour at weight " << weight;
                if (difference == -1 && patch.inner_weight != 0 && theirs != full_weight)
                    return ::testing::AssertionFailure() << "a coarser neighbour at weight " << theirs;
            }
        }
    }
    return ::testing::AssertionSuccess();
}

class EachPresetAndSize : public testing::TestWithParam<QuadtreeOptions> {};
INSTANTIATE_TEST_SUITE_P(Quadtrees, EachPresetAndSize, testing::ValuesIn(all_quadtree_options()),
                         [](const auto& test) {
                             if (test.param.finest_patch_m != QuadtreeOptions().finest_patch_m)
                                 return std::string("near_water");
                             const auto presets = quadtree_presets();
                             return std::string(presets[test.index / std::size(sizes_m)].name) + "_" +
                                    std::to_string(static_cast<int>(test.param.size_m));
                         });

TEST_P(EachPresetAndSize, BordersCloseForEveryViewer) {
    Selection selection(GetParam());
    Tiling tiling;
    Random random(6);
    for (int i = 0; i < viewers(); ++i) {
        const SelectionInput input = random_viewer(random, GetParam().size_m, i);
        const DrawList& list = selection.select(input);
        tiling.build(list);
        ASSERT_TRUE(borders_close(list, tiling)) << describe(GetParam(), input);
    }
}

/// Six doubles: a directed edge between two points of the displaced surface.
struct SurfaceEdge {
    std::array<double, 6> ends;
    bool operator==(const SurfaceEdge& other) const {
        return std::memcmp(ends.data(), other.ends.data(), sizeof ends) == 0;
    }
};
struct EdgeHash {
    std::size_t operator()(const SurfaceEdge& edge) const {
        std::uint64_t hash = 0;
        for (const double end : edge.ends) {
            std::uint64_t bits;
            std::memcpy(&bits, &end, sizeof bits);
            hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 32;
        }
        return hash;
    }
};

SurfaceEdge edge_between(const glm::dvec3& a, const glm::dvec3& b) {
    // 0.0 and -0.0 are one position.
    return {{a.x + 0.0, a.y + 0.0, a.z + 0.0, b.x + 0.0, b.y + 0.0, b.z + 0.0}};
}

/// Returns twice the area seen from above.
double doubled_area(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return (b.y - a.y) * (c.x - a.x) - (b.x - a.x) * (c.y - a.y);
}

/// Checks every triangle of a list.
class WholeMesh {
   public:
    explicit WholeMesh(const PatchMesh& mesh) : mesh_(mesh) {}

    void add(const DrawList& list, const SineSea& sea) {
        for (const DrawBatch& batch : list.batches)
            for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i)
                add_patch(list.grid, list.instances[i], mesh_.ranges[batch.stitches], sea);
    }

    /// The skirt closes the border; the only open edges are its outer ones.
    void add_skirt(const DrawList& list) {
        const SkirtMesh strip(list.grid.vertices);
        for (const SkirtInstance& piece : list.skirt) {
            std::vector<glm::dvec3> at;
            for (int t = 0; t <= list.grid.vertices; ++t)
                for (const bool outer : {false, true}) {
                    const glm::dvec2 place = skirt_position(list.grid, piece, t, outer);
                    at.push_back({place.x, 0, place.y});
                }
            for (std::size_t k = 0; k < strip.indices.size(); k += 3) {
                const glm::dvec3 corner[3] = {at[strip.indices[k]], at[strip.indices[k + 1]],
                                              at[strip.indices[k + 2]]};
                if (doubled_area({corner[0].x, corner[0].z}, {corner[1].x, corner[1].z},
                                 {corner[2].x, corner[2].z}) <= 0)
                    ++flipped_;
                for (int e = 0; e < 3; ++e) cancel(corner[e], corner[(e + 1) % 3]);
            }
        }
    }

    std::size_t open_edges() const { return open_.size(); }
    const auto& open() const { return open_; }
    int flipped() const { return flipped_; }
    int doubled() const { return doubled_; }
    double rest_area() const { return rest_area_ / 2; }
    double displaced_area() const { return displaced_area_ / 2; }

   private:
    void add_patch(const QuadtreeGrid& grid, const PatchInstance& patch, PatchMesh::Range range, const SineSea& sea) {
        const int row = grid.vertices + 1;
        const std::vector<glm::dvec3> at = patch_positions(grid, patch, sea);
        // Edges span two vertices at most: 25 directions from each vertex.
        directed_.assign(static_cast<std::size_t>(row * row) * 25, 0);
        const auto slot = [&](int a, int b) {
            const int di = b % row - a % row + 2, dj = b / row - a / row + 2;
            return static_cast<std::size_t>(a * 25 + di + 5 * dj);
        };
        for (std::uint32_t k = range.first; k < range.first + range.count; k += 3) {
            const int v[3] = {mesh_.indices[k], mesh_.indices[k + 1], mesh_.indices[k + 2]};
            glm::dvec2 rest[3], moved[3];
            for (int e = 0; e < 3; ++e) {
                rest[e] = rest_position(grid, patch, v[e] % row, v[e] / row);
                const glm::dvec3& p = at[static_cast<std::size_t>(v[e])];
                moved[e] = {p.x, p.z};
                if (++directed_[slot(v[e], v[(e + 1) % 3])] != 1) ++doubled_;
            }
            const double rest_doubled = doubled_area(rest[0], rest[1], rest[2]);
            const double moved_doubled = doubled_area(moved[0], moved[1], moved[2]);
            if (rest_doubled <= 0 || moved_doubled <= 0) ++flipped_;
            rest_area_ += rest_doubled;
            displaced_area_ += moved_doubled;
        }
        for (std::uint32_t k = range.first; k < range.first + range.count; ++k) {
            const std::uint32_t triangle = (k - range.first) / 3 * 3 + range.first;
            const int a = mesh_.indices[k], b = mesh_.indices[triangle + (k - triangle + 1) % 3];
            if (directed_[slot(b, a)] == 0) cancel(at[static_cast<std::size_t>(a)], at[static_cast<std::size_t>(b)]);
        }
    }

    void cancel(const glm::dvec3& a, const glm::dvec3& b) {
        if (open_.erase(edge_between(b, a)) > 0) return;
        if (++open_[edge_between(a, b)] != 1) ++doubled_;
    }

    const PatchMesh& mesh_;
    std::vector<std::uint8_t> directed_;
    /// edges whose second triangle has not been visited
    std::unordered_map<SurfaceEdge, int, EdgeHash> open_;
    int flipped_ = 0, doubled_ = 0;
    double rest_area_ = 0, displaced_area_ = 0;
};

void expect_closed(const QuadtreeOptions& options, const SelectionInput& input, const PatchMesh& patch_mesh) {
    SCOPED_TRACE(describe(options, input));
    Selection selection(options);
    const DrawList& list = selection.select(input);
    WholeMesh mesh(patch_mesh);
    mesh.add(list, SineSea{});
    EXPECT_EQ(mesh.doubled(), 0);
    EXPECT_EQ(mesh.flipped(), 0);
    // Sums of a million products of doubles. The border is undisplaced, so both areas are those of
    // the square.
    const double area = options.size_m * options.size_m;
    EXPECT_NEAR(mesh.rest_area() / area, 1, 1e-9);
    EXPECT_NEAR(mesh.displaced_area() / area, 1, 1e-9);
    // Only the border is open, and the skirt closes it.
    const glm::dvec2 low = glm::dvec2(list.grid.corner) * list.grid.step_m;
    const glm::dvec2 high =
        glm::dvec2(list.grid.corner + glm::tvec2<std::int64_t>(list.grid.side)) * list.grid.step_m;
    for (const auto& [edge, count] : mesh.open()) {
        const auto& e = edge.ends;
        const bool on_border = (e[0] == e[3] && (e[0] == low.x || e[0] == high.x)) ||
                               (e[2] == e[5] && (e[2] == low.y || e[2] == high.y));
        ASSERT_TRUE(on_border) << e[0] << " " << e[1] << " " << e[2];
        ASSERT_EQ(e[1], 0);
    }
    mesh.add_skirt(list);
    EXPECT_EQ(mesh.doubled(), 0);
    EXPECT_EQ(mesh.flipped(), 0);
    const glm::dvec2 middle = (low + high) / 2.0;
    for (const auto& [edge, count] : mesh.open()) {
        const double away = std::max(std::abs(edge.ends[0] - middle.x), std::abs(edge.ends[2] - middle.y));
        ASSERT_NEAR(away, 10 * options.size_m, 1e-6 * options.size_m);
    }
}

// Two hundred viewers for patches of 16 steps a side, and as many triangles for patches of more:
// some three thousand selections in all. The quick run makes half of them.
TEST_P(EachPresetAndSize, EveryEdgeHasExactlyTwoTriangles) {
    const PatchMesh mesh(GetParam().vertices);
    Random random(static_cast<std::uint64_t>(GetParam().size_m) + 7);
#if defined(NDEBUG)
    const int all = std::max(6, 200 * 16 * 16 / (GetParam().vertices * GetParam().vertices));
    const int count = of_sweep(all / 2, all);
#else
    constexpr int count = 1;
    if (GetParam().vertices > 32) GTEST_SKIP() << "too slow without optimisation; release runs it";
#endif
    for (int i = 0; i < count; ++i) expect_closed(GetParam(), random_viewer(random, GetParam().size_m, i), mesh);
}

// Every even V, with sizes that are not powers of two and neighbours of every allowed kind.
TEST(Watertight, EveryEvenVertexCountIsClosed) {
    Random random(8);
    for (int v = 2; v <= 128; v += 2) {
        const PatchMesh mesh(v);
        for (const double tau : {1.0, 2.2}) {
#if !defined(NDEBUG)
            if (v > 24) continue;
#endif
            const QuadtreeOptions options{.size_m = 700 + 3.3 * v, .vertices = v, .lod_scale = tau};
            expect_closed(options, random_viewer(random, options.size_m, v / 2), mesh);
        }
    }
}

/// Every pair of neighbours that a balanced tree allows, and the sixteen configurations, occur
/// above.
TEST(Watertight, EveryConfigurationOccurs) {
    std::array<int, 16> met{};
    Random random(9);
    for (const double tau : {0.75, 1.0, 2.0}) {
        Selection selection({.size_m = 8192, .vertices = 2, .lod_scale = tau});
        for (int i = 0; i < 2000; ++i)
            for (const DrawBatch& batch : selection.select(random_viewer(random, 8192, i)).batches)
                ++met[batch.stitches];
    }
    // Opposite sides cannot both be coarser: the siblings on one of them have the patch's own level
    // or finer ones.
    for (unsigned stitches = 0; stitches < 16; ++stitches) {
        const bool is_possible = (stitches & 5) != 5 && (stitches & 10) != 10;
        EXPECT_EQ(met[stitches] > 0, is_possible) << stitches;
    }
}

}  // namespace
}  // namespace pelagic
