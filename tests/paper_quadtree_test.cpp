// The paper's traversal, with which Pelagic's speed is compared, matches the paper, errata
// included.
#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "pelagic/bench/peers/paper_quadtree.hpp"
#include "pelagic/tests/quadtree_scene.hpp"

namespace pelagic {
namespace {

/// A view that contains everything.
const Frustum everything(glm::dmat4(glm::dvec4(1e-6, 0, 0, 0), glm::dvec4(0, 1e-6, 0, 0), glm::dvec4(0, 0, 1e-6, 0),
                                    glm::dvec4(0, 0, 0, 1)));

TEST(PaperQuadtree, VisitsEveryNode) {
    peers::PaperQuadtree six_levels({.size_m = 4096}), seven_levels({.size_m = 8192});
    six_levels.select({0, 2, 0}, everything);
    seven_levels.select({0, 2, 0}, everything);
    EXPECT_EQ(six_levels.nodes_visited(), 5461u);
    EXPECT_EQ(seven_levels.nodes_visited(), 21845u);
}

// Where equation 57 alone gives a balanced tree, the patches equal Pelagic's except for splits that
// begin soon.
TEST(PaperQuadtree, DrawsPelagicsPatchesWhereItIsBalanced) {
    Random random(13);
    Selection selection({.size_m = 2048, .vertices = 2, .lod_scale = 2.4});
    peers::PaperQuadtree paper({.size_m = 2048, .lod_scale = 2.4});
    int same = 0, all = 0;
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 viewer(random.between(-200, 200), 2, random.between(-200, 200));
        const DrawList& ours = selection.select({.viewer_m = viewer, .centre_m = glm::dvec2(0)});
        for (const auto& patch : paper.select(viewer, everything)) {
            const int side = ours.grid.patch_side(patch.level);
            for (const PatchInstance& instance : ours.instances)
                if (instance.level == patch.level && instance.corner_x == patch.x * side &&
                    instance.corner_z == patch.y * side)
                    ++same;
            ++all;
        }
    }
    EXPECT_GT(same, all * 0.9);
}

// The erratum behind the balanced selection: at tau = 1.5 neighbours two levels apart are common,
// and more so with more levels. A stitch closes only one level.
TEST(PaperQuadtree, HasNeighboursTwoLevelsApart) {
    for (const auto& [size, share] : {std::pair{2048.0, 0.05}, {8192.0, 0.3}}) {
        Random random(14);
        peers::PaperQuadtree paper({.size_m = size, .lod_scale = 1.5});
        const int width = 1 << deepest_level(size);
        int torn = 0;
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 viewer(random.between(-0.2, 0.2) * size, 2, random.between(-0.2, 0.2) * size);
            std::vector<int> levels(static_cast<std::size_t>(width * width));
            for (const auto& patch : paper.select(viewer, everything)) {
                const int cells = 1 << (deepest_level(size) - patch.level);
                for (int z = patch.y * cells; z < (patch.y + 1) * cells; ++z)
                    for (int x = patch.x * cells; x < (patch.x + 1) * cells; ++x)
                        levels[static_cast<std::size_t>(x + z * width)] = patch.level;
            }
            bool is_torn = false;
            const auto level = [&](int x, int z) { return levels[static_cast<std::size_t>(x + z * width)]; };
            for (int a = 0; a < width; ++a)
                for (int b = 0; b + 1 < width; ++b)
                    is_torn = is_torn || std::abs(level(b, a) - level(b + 1, a)) > 1 ||
                              std::abs(level(a, b) - level(a, b + 1)) > 1;
            torn += is_torn;
        }
        EXPECT_GE(torn, 200 * share) << size;
    }
}

}  // namespace
}  // namespace pelagic
