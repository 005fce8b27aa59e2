// The selected patches, compared with the rule evaluated on the whole tree and with each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

#include "pelagic/quadtree/stitching.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/quadtree_scene.hpp"

namespace pelagic {
namespace {

/// Applies level_map.hpp's rule to every node of every level until nothing changes.
class WholeTree {
   public:
    WholeTree(const QuadtreeOptions& o, glm::dvec3 viewer_m) : deepest_(deepest_level(o.size_m, o.finest_patch_m)) {
        const auto cells = [](int level) { return 1 << level; };
        for (int level = 0; level < deepest_; ++level) {
            const double side = o.size_m / cells(level);
            for (int z = 0; z < cells(level); ++z)
                for (int x = 0; x < cells(level); ++x) {
                    const glm::dvec3 centre((x + 0.5) * side, 0, (z + 0.5) * side);
                    const glm::dvec3 away = centre - viewer_m;
                    measures_[{level, x, z}] =
                        static_cast<float>(1 - glm::dot(away, away) / (o.lod_scale * side * o.lod_scale * side));
                }
        }
        for (bool changed = true; changed;) {
            changed = false;
            for (const auto& [node, g] : measures_) {
                const auto [level, x, z] = node;
                for (const auto& [dx, dz] : {std::pair{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                    if (x + dx < 0 || z + dz < 0) continue;
                    const auto parent = measures_.find({level - 1, (x + dx) / 2, (z + dz) / 2});
                    if (parent == measures_.end()) continue;
                    const float demand = 0.25f + std::min(g, 0.f);
                    if (parent->second >= demand) continue;
                    parent->second = demand;
                    changed = true;
                }
            }
        }
    }
    int level_at(int x, int z) const {
        int level = 0;
        while (level < deepest_ && measures_.at({level, x >> (deepest_ - level), z >> (deepest_ - level)}) > 0)
            ++level;
        return level;
    }

   private:
    int deepest_;
    std::map<std::array<int, 3>, float> measures_;
};

TEST(Selection, MatchesTheRuleOnTheWholeTree) {
    Random random(1);
    for (const double size : {256.0, 512.0, 1024.0, 2048.0}) {
        for (const double tau : {0.75, 1.0, 1.5, 2.0, 3.0}) {
            Selection selection({.size_m = size, .vertices = 2, .lod_scale = tau});
            for (int i = 0; i < 12; ++i) {
                const SelectionInput input = random_viewer(random, size, i);
                const QuadtreeGrid& grid = selection.select(input).grid;
                const glm::dvec2 corner = glm::dvec2(grid.corner) * grid.step_m;
                const WholeTree tree(selection.options(), input.viewer_m - glm::dvec3(corner.x, 0, corner.y));
                const int width = selection.level_map().width();
                for (int z = 0; z < width; ++z)
                    for (int x = 0; x < width; ++x)
                        ASSERT_EQ(selection.level_map().level_at(x, z), tree.level_at(x, z))
                            << describe(selection.options(), input) << " cell " << x << " " << z;
            }
        }
    }
}

// Where the paper's rule alone gives a balanced tree, the only additions are nodes that are split
// early for a neighbour's sake: those whose measure is above -k.
TEST(Selection, MatchesEquation57WhereItIsBalanced) {
    Random random(2);
    const double size = 2048, tau = 2.4;
    Selection selection({.size_m = size, .vertices = 2, .lod_scale = tau});
    for (int i = 0; i < 200; ++i) {
        const SelectionInput input{.viewer_m = {random.between(-500, 500), 2, random.between(-500, 500)}};
        const QuadtreeGrid& grid = selection.select(input).grid;
        for (int level = 0; level < grid.deepest_level; ++level) {
            const double side = size / (1 << level);
            for (int z = 0; z < 1 << level; ++z)
                for (int x = 0; x < 1 << level; ++x) {
                    const glm::dvec2 centre =
                        glm::dvec2(grid.corner) * grid.step_m + glm::dvec2(x + 0.5, z + 0.5) * side;
                    const double d = glm::length(glm::dvec3(centre.x, 0, centre.y) - input.viewer_m);
                    if (d < side * tau * 0.999999) {
                        ASSERT_TRUE(selection.level_map().splits(level, x, z));
                    }
                    if (d > side * tau * std::sqrt(1 + LevelMap::morph_zone)) {
                        ASSERT_FALSE(selection.level_map().splits(level, x, z));
                    }
                }
        }
    }
}

TEST(Selection, DeepestLevelIsEquation56) {
    EXPECT_EQ(deepest_level(256), 2);
    EXPECT_EQ(deepest_level(300), 2);
    EXPECT_EQ(deepest_level(512), 3);
    EXPECT_EQ(deepest_level(1024), 4);
    EXPECT_EQ(deepest_level(8192), 7);
    // Smaller patches than the paper's, for eyes near the water.
    EXPECT_EQ(deepest_level(4096, 16), 8);
    EXPECT_EQ(deepest_level(8192, 16), 8);
    // The presets of the paper's table keep the paper's patches.
    for (const QuadtreePreset& preset : quadtree_presets())
        EXPECT_EQ(preset.options_near_water(4096).finest_patch_m,
                  preset.name == "high" || preset.name == "ultra" ? 16 : 64)
            << preset.name;
}

// Two levels more would add half as many triangles. A smaller lod_scale, tau, makes up for them:
// their number is proportional to tau^2 at each level.
TEST(Selection, NearWaterHasAboutAsManyTriangles) {
    for (const char* name : {"high", "ultra"}) {
        const QuadtreePreset& preset = *quadtree_preset_named(name);
        Selection usual(preset.options(4096)), near_water(preset.options_near_water(4096));
        const SelectionInput input{.viewer_m = {0, 2, 0}};
        const auto triangles = [&](Selection& selection) {
            return static_cast<double>(selection.select(input).statistics.triangles);
        };
        EXPECT_NEAR(triangles(near_water) / triangles(usual), 1, 0.2) << name;
    }
}

// The drawn patches cover the grid once, with the levels of the level map.
TEST(Selection, LevelMapHoldsTheDrawnAndTheCulledLevels) {
    Random random(3);
    for (const QuadtreeOptions& options : all_quadtree_options()) {
        Selection selection(options), culled(options);
        for (int i = 0; i < 30; ++i) {
            SelectionInput input = random_viewer(random, options.size_m, i);
            const DrawList& list = selection.select(input);
            const int width = selection.level_map().width();
            std::vector<int> covered(static_cast<std::size_t>(width * width), 0);
            for (const PatchInstance& patch : list.instances) {
                const int cells = 1 << (list.grid.deepest_level - patch.level);
                const int x0 = patch.corner_x / options.vertices, z0 = patch.corner_z / options.vertices;
                for (int z = z0; z < z0 + cells; ++z)
                    for (int x = x0; x < x0 + cells; ++x) {
                        ++covered[static_cast<std::size_t>(x + z * width)];
                        ASSERT_EQ(selection.level_map().level_at(x, z), patch.level);
                    }
            }
            ASSERT_TRUE(std::all_of(covered.begin(), covered.end(), [](int n) { return n == 1; }))
                << describe(options, input);

            const glm::dmat4 nothing_seen(glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, 1, 0),
                                          glm::dvec4(0, -1e9, 0, 1));
            input.views = {&nothing_seen, 1};
            EXPECT_TRUE(culled.select(input).instances.empty());
            for (int z = 0; z < width; ++z)
                for (int x = 0; x < width; ++x)
                    ASSERT_EQ(culled.level_map().level_at(x, z), selection.level_map().level_at(x, z));
        }
    }
}

TEST(Selection, LargerTauGivesMoreTriangles) {
    Random random(4);
    for (const double size : sizes_m) {
        for (int i = 0; i < 60; ++i) {
            const SelectionInput input = random_viewer(random, size, i);
            std::uint64_t before = 0;
            for (double tau = 0.75; tau <= 8; tau *= 1.25) {
                Selection selection({.size_m = size, .vertices = 16, .lod_scale = tau});
                const std::uint64_t triangles = selection.select(input).statistics.triangles;
                EXPECT_GE(triangles, before) << describe(selection.options(), input);
                before = triangles;
            }
        }
    }
    // The count rises wherever there is something to split.
    Selection coarse({.size_m = 4096, .lod_scale = 1}), fine({.size_m = 4096, .lod_scale = 2});
    const SelectionInput on_board{.viewer_m = {0, 3, 0}};
    EXPECT_GT(fine.select(on_board).statistics.triangles, 2 * coarse.select(on_board).statistics.triangles);
}

TEST(Selection, PresetsGrowInTrianglesAndInDetail) {
    for (const double size : sizes_m) {
        std::uint64_t triangles = 0;
        double step = std::numeric_limits<double>::infinity();
        for (const char* name : {"low", "medium", "high", "ultra"}) {
            Selection selection(quadtree_preset_named(name)->options(size));
            const DrawList& list = selection.select({.viewer_m = {10, 2, 20}});
            EXPECT_GT(list.statistics.triangles, triangles) << name << " " << size;
            EXPECT_LT(list.grid.step_m, step) << name << " " << size;
            triangles = list.statistics.triangles;
            step = list.grid.step_m;
        }
    }
}

TEST(Selection, ThePapersPresetsStayAvailable) {
    // Table 2: vertices, LOD scale, cull scale.
    const std::map<std::string, std::array<double, 3>> table = {{"paper_low", {16, 2.0, 1.2}},
                                                                {"paper_medium", {32, 1.5, 1.5}},
                                                                {"paper_high", {64, 1.2, 1.8}},
                                                                {"paper_ultra", {64, 1.0, 2.0}}};
    for (const auto& [name, values] : table) {
        const QuadtreePreset* preset = quadtree_preset_named(name);
        ASSERT_NE(preset, nullptr) << name;
        EXPECT_EQ(
            (std::array<double, 3>{static_cast<double>(preset->vertices), preset->lod_scale, preset->cull_scale}),
            values);
    }
    EXPECT_EQ(quadtree_preset_named("best"), nullptr);
}

TEST(Selection, BatchesHoldEveryInstanceOnceAtAnyLimit) {
    Selection unlimited({.size_m = 4096, .vertices = 16});
    const SelectionInput input{.viewer_m = {100, 3, -70}};
    const DrawList& all = unlimited.select(input);
    EXPECT_LE(all.batches.size(), 16u);
    const auto count = static_cast<int>(all.instances.size());
    for (int limit = 1; limit <= count + 1; ++limit) {
        Selection limited({.size_m = 4096, .vertices = 16, .batch_limit = limit});
        const DrawList& list = limited.select(input);
        ASSERT_EQ(list.instances, all.instances);
        std::uint32_t next = 0;
        for (const DrawBatch& batch : list.batches) {
            ASSERT_EQ(batch.first, next);
            ASSERT_GT(batch.count, 0u);
            ASSERT_LE(batch.count, static_cast<std::uint32_t>(limit));
            next += batch.count;
        }
        ASSERT_EQ(next, all.instances.size());
        // Each instance is still drawn with its stitches.
        for (const DrawBatch& whole : all.batches)
            for (const DrawBatch& part : list.batches)
                if (part.first >= whole.first && part.first < whole.first + whole.count) {
                    ASSERT_EQ(part.stitches, whole.stitches);
                }
    }
}

TEST(Selection, CountsTheDrawnPatches) {
    Selection selection(quadtree_preset_named("high")->options(8192));
    const DrawList& list = selection.select({.viewer_m = {3, 2, 4}});
    std::uint64_t triangles = 0, patches = 0;
    for (const DrawBatch& batch : list.batches)
        triangles += std::uint64_t{batch.count} * patch_triangles(64, batch.stitches);
    for (const std::uint32_t n : list.statistics.patches_by_level) patches += n;
    EXPECT_EQ(list.statistics.triangles, triangles);
    EXPECT_EQ(patches, list.instances.size());
    // In a tree whose inner nodes have four children, n leaves have (n - 1) / 3 inner nodes.
    EXPECT_EQ(list.statistics.nodes_visited, patches + (patches - 1) / 3);
}

// Doubling the size adds one level: the cost is proportional to the drawn patches.
TEST(Selection, VisitsGrowWithTheLevelsAndNotWithTheArea) {
    std::vector<double> visits;
    for (const double size : sizes_m) {
        Selection selection(quadtree_preset_named("medium")->options(size));
        visits.push_back(selection.select({.viewer_m = {1, 2, 3}}).statistics.nodes_visited);
    }
    for (std::size_t k = 3; k < visits.size(); ++k)
        EXPECT_LT(visits[k] - visits[k - 1], 1.5 * (visits[k - 1] - visits[k - 2]) + 20);
    EXPECT_LT(visits.back(), 500);  // of 21845 nodes
}

TEST(Selection, OneListHoldsThePatchesVisibleInAnyView) {
    Random random(5);
    // a box 400 m long and 100 m wide, as a view for shadows
    const auto towards = [](double heading) {
        const double c = std::cos(heading), s = std::sin(heading);
        return glm::dmat4(c / 200, 0, s / 50, 0, 0, 1e-3, 0, 0, -s / 200, 0, c / 50, 0, -1, 0, 0, 1);
    };
    const QuadtreeOptions options = quadtree_preset_named("low")->options(2048);
    Selection one(options), other(options), both(options);
    const auto contains = [](const DrawList& list, const PatchInstance& patch) {
        return std::find(list.instances.begin(), list.instances.end(), patch) != list.instances.end();
    };
    for (int i = 0; i < 200; ++i) {
        const std::array<glm::dmat4, 2> views = {towards(random.between(0, 6.28)), towards(random.between(0, 6.28))};
        const glm::dvec3 viewer(random.between(-9, 9), 2, 0);
        one.select({.viewer_m = viewer, .views = {&views[0], 1}});
        other.select({.viewer_m = viewer, .views = {&views[1], 1}});
        both.select({.viewer_m = viewer, .views = views});
        for (const PatchInstance& patch : both.list().instances)
            EXPECT_TRUE(contains(one.list(), patch) || contains(other.list(), patch));
        for (const DrawList* list : {&one.list(), &other.list()})
            for (const PatchInstance& patch : list->instances) EXPECT_TRUE(contains(both.list(), patch));
        EXPECT_GT(one.list().instances.size(), 0u);
    }
}

TEST(Selection, KeepsTheUndisplacedSeaForAnyBounds) {
    // The view contains the water within a metre of the rest level, where the waves have faded out.
    const glm::dmat4 slice(1e-4, 0, 0, 0, 0, 0, 1, 0, 0, 1e-4, 0, 0, 0, 0, 0, 1);
    Selection selection(quadtree_preset_named("low")->options(1024));
    for (const FrameBounds& bounds : {FrameBounds{3, 4, 0, 0}, FrameBounds{-4, -3, 0, 0}})
        EXPECT_EQ(selection.select({.views = {&slice, 1}, .bounds = bounds}).instances.size(),
                  selection.select({}).instances.size());
}

void expect_rejected(const QuadtreeOptions& options, const std::string& said) {
    EXPECT_EQ(message_of([&] { Selection selection(options); }), said);
}

TEST(SelectionInput, NamesOptionsOutOfRange) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect_rejected({.size_m = 255}, "size_m 255 is out of range [256, 8192]");
    expect_rejected({.size_m = 8193}, "size_m 8193 is out of range [256, 8192]");
    expect_rejected({.size_m = nan}, "size_m nan is out of range [256, 8192]");
    expect_rejected({.vertices = 0}, "vertices is 0, expected an even number from 2 to 128");
    expect_rejected({.vertices = 63}, "vertices is 63, expected an even number from 2 to 128");
    expect_rejected({.vertices = 130}, "vertices is 130, expected an even number from 2 to 128");
    expect_rejected({.lod_scale = 0.5}, "lod_scale 0.5 is out of range [0.75, 8]");
    expect_rejected({.lod_scale = nan}, "lod_scale nan is out of range [0.75, 8]");
    expect_rejected({.cull_scale = 0.9}, "cull_scale 0.9 is out of range [1, 4]");
    expect_rejected({.batch_limit = 0}, "batch_limit is 0, expected 1 or more");
    expect_rejected({.finest_patch_m = 8}, "finest_patch_m 8 is out of range [16, 64]");
}

TEST(SelectionInput, RejectsInvalidFramesAndKeepsTheList) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    Selection selection({});
    const std::vector<PatchInstance> before = selection.select({.viewer_m = {1, 2, 3}}).instances;
    glm::dmat4 no_number(1), flat(1), twice(1);
    no_number[2][1] = nan;
    flat[1] = glm::dvec4(0);
    twice[0] = twice[1];
    const glm::dmat4 zero(0);
    const std::vector<SelectionInput> bad = {
        {.viewer_m = {nan, 0, 0}},        {.viewer_m = {0, inf, 0}},  {.viewer_m = {0, 0, 1e9}},
        {.centre_m = glm::dvec2(nan, 0)}, {.views = {&no_number, 1}}, {.views = {&flat, 1}},
        {.views = {&twice, 1}},           {.views = {&zero, 1}},      {.bounds = {std::nanf(""), 0, 0, 0}},
        {.bounds = {2, 1, 0, 0}},         {.bounds = {0, 0, -1, 0}},
    };
    for (std::size_t i = 0; i < bad.size(); ++i) {
        EXPECT_THROW(selection.select(bad[i]), std::invalid_argument) << i;
        EXPECT_EQ(selection.list().instances, before) << i;
    }
    EXPECT_EQ(selection.select({.viewer_m = {1, 2, 3}}).instances, before);
}

}  // namespace
}  // namespace pelagic
