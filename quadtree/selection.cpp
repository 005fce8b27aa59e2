#include "pelagic/quadtree/selection.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>

#include "pelagic/message/number_text.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/quadtree/stitching.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr double furthest_m = 1e8;  // positions in steps are exact doubles up to here

void check_position(const char* name, const double* values, int count) {
    for (int i = 0; i < count; ++i) {
        if (std::abs(values[i]) <= furthest_m) continue;  // false for NaN
        throw std::invalid_argument(std::string(name) + " holds " + number_text(values[i]) +
                                    ", expected finite numbers within 1e8 m of the origin");
    }
}

void check_bounds(const FrameBounds& b) {
    const bool ok = std::isfinite(b.height_min_m) && std::isfinite(b.height_max_m) &&
                    b.height_min_m <= b.height_max_m && std::isfinite(b.horizontal_x_max_m) &&
                    b.horizontal_x_max_m >= 0 && std::isfinite(b.horizontal_z_max_m) && b.horizontal_z_max_m >= 0;
    if (!ok)
        throw std::invalid_argument(
            "bounds need finite metres, height_min_m <= height_max_m and horizontal distances of 0 or more");
}

constexpr std::size_t max_views = 32;

/// Offset of the neighbour across each Side.
constexpr std::int32_t step_x[4] = {1, 0, -1, 0};
constexpr std::int32_t step_z[4] = {0, 1, 0, -1};

}  // namespace

Selection::Selection(const QuadtreeOptions& options) : options_(checked(options)), levels_(options_) {
    list_.lod_scale = options.lod_scale;
    list_.instances.reserve(levels_.max_patches());
    found_.reserve(levels_.max_patches());
    list_.batches.reserve(
        16 + (options_.batch_limit ? levels_.max_patches() / static_cast<std::size_t>(*options_.batch_limit) : 0));
    list_.skirt.reserve(4 * static_cast<std::size_t>(levels_.width()));
    stack_.reserve(4 + 3 * static_cast<std::size_t>(levels_.deepest_level()));
    culling_.reserve(max_views);
    frusta_.reserve(max_views);
    next_frusta_.reserve(max_views);
}

const DrawList& Selection::select(const SelectionInput& input) {
    const DefaultFloatEnvironment environment;
    check_position("viewer_m", &input.viewer_m.x, 3);
    const glm::dvec2 centre = input.centre_m.value_or(glm::dvec2(input.viewer_m.x, input.viewer_m.z));
    check_position("centre_m", &centre.x, 2);
    check_position("sea_level_m", &input.sea_level_m, 1);
    check_bounds(input.bounds);
    if (input.views.size() > max_views) throw std::invalid_argument("views are more than 32");
    next_frusta_.clear();  // separate, so that an invalid view does not change the list
    const glm::dvec3 still_water(0, input.sea_level_m, 0);
    for (const glm::dmat4& view : input.views)
        next_frusta_.emplace_back(glm::translate(view, still_water), input.depth);

    frusta_.swap(next_frusta_);
    list_.grid = grid_around(centre);
    const glm::dvec2 corner = glm::dvec2(list_.grid.corner) * list_.grid.step_m;
    levels_.update({input.viewer_m.x - corner.x, input.viewer_m.y - input.sea_level_m, input.viewer_m.z - corner.y});
    list_.statistics = {};
    walk(input.bounds);
    sort_into_batches();
    walk_border();
    return list_;
}

QuadtreeGrid Selection::grid_around(glm::dvec2 centre_m) const {
    QuadtreeGrid grid;
    grid.vertices = options_.vertices;
    grid.deepest_level = levels_.deepest_level();
    grid.side = levels_.width() * options_.vertices;
    grid.step_m = options_.size_m / grid.side;
    const std::int32_t snap = grid.side / 4;  // exact: the width is a multiple of 4
    const double snap_m = options_.size_m / 4;
    for (int axis = 0; axis < 2; ++axis)
        grid.corner[axis] =
            static_cast<std::int64_t>(std::floor(centre_m[axis] / snap_m + 0.5)) * snap - grid.side / 2;
    grid.fade_centre = centre_m;
    grid.fade_start_m = options_.size_m * 5 / 16;
    grid.fade_end_m = options_.size_m * 3 / 8;  // half of S less half of a snap step
    return grid;
}

/// Returns the views that see a node. Tests only views that see its parent partially: a view that
/// sees all of the parent sees all of the node.
Selection::Views Selection::views_that_see(const Node& node) const {
    Views views = node.parent;
    for (std::uint32_t remaining = node.parent.partial; remaining != 0; remaining &= remaining - 1) {
        const std::uint32_t view = remaining & (0 - remaining);
        const NodeCulling& culling = culling_[static_cast<std::size_t>(std::countr_zero(remaining))];
        switch (culling.sight_of(node.level, node.x, node.z)) {
            case NodeCulling::Sight::none: views.partial ^= view; break;
            case NodeCulling::Sight::partial: break;
            case NodeCulling::Sight::whole: views.partial ^= view, views.whole |= view;
        }
    }
    return views;
}

void Selection::walk(const FrameBounds& bounds) {
    // The boxes include the undisplaced level, because the waves fade out.
    const BoxesOfNodes boxes{.low_m = std::min(double{bounds.height_min_m}, 0.0),
                             .high_m = std::max(double{bounds.height_max_m}, 0.0),
                             .horizontal_m = {bounds.horizontal_x_max_m, bounds.horizontal_z_max_m},
                             .cull_scale = options_.cull_scale};
    culling_.clear();
    for (const Frustum& frustum : frusta_) culling_.emplace_back(frustum, list_.grid, boxes);
    const bool culls = !frusta_.empty();
    const auto all_views = static_cast<std::uint32_t>((std::uint64_t{1} << frusta_.size()) - 1);

    found_.clear();
    stack_.clear();
    stack_.push_back({0, 0, 0, {.partial = all_views, .whole = 0}});
    while (!stack_.empty()) {
        const Node node = stack_.back();
        stack_.pop_back();
        ++list_.statistics.nodes_visited;
        const Views views = views_that_see(node);
        if (culls && (views.partial | views.whole) == 0) continue;
        if (!levels_.splits(node.level, node.x, node.z)) {
            emit(node);
            continue;
        }
        for (const std::int32_t child : {3, 2, 1, 0})  // the lowest x and z is popped first
            stack_.push_back({node.level + 1, 2 * node.x + child % 2, 2 * node.z + child / 2, views});
    }
}

void Selection::emit(const Node& node) {
    const std::int32_t side = list_.grid.patch_side(node.level);
    Found found{};
    found.patch.corner_x = static_cast<std::uint16_t>(node.x * side);
    found.patch.corner_z = static_cast<std::uint16_t>(node.z * side);
    found.patch.level = static_cast<std::uint8_t>(node.level);
    // The diagonals of the coarser squares alternate over the whole parent. A child starts at a
    // multiple of V/2 squares in the parent.
    found.patch.diagonals = static_cast<std::uint8_t>((node.x + node.z) * (options_.vertices / 2) & 1);
    if (node.level > 0) {
        const int above = node.level - 1;
        const std::int32_t parents = std::int32_t{1} << above;
        const std::int32_t parent_x = node.x >> 1, parent_z = node.z >> 1;
        const std::uint16_t inner = LevelMap::weight(levels_.measure(above, parent_x, parent_z));
        found.patch.inner_weight = inner;
        for (std::size_t side_of = 0; side_of < 4; ++side_of) {
            const std::int32_t x = (node.x + step_x[side_of]) >> 1, z = (node.z + step_z[side_of]) >> 1;
            std::uint16_t& weight = found.patch.edge_weights[side_of];
            weight = inner;
            if (x == parent_x && z == parent_z) continue;  // a sibling
            // The skirt shares every vertex of the border.
            if (x < 0 || z < 0 || x >= parents || z >= parents) continue;
            const float measure = levels_.measure(above, x, z);
            weight = std::min(inner, LevelMap::weight(measure));
            if (!(measure > 0)) found.stitches |= static_cast<std::uint8_t>(1u << side_of);
        }
    }
    found_.push_back(found);
    ++list_.statistics.patches_by_level[static_cast<std::size_t>(node.level)];
    list_.statistics.triangles += patch_triangles(options_.vertices, found.stitches);
}

void Selection::sort_into_batches() {
    std::array<std::uint32_t, 17> start{};
    for (const Found& found : found_) ++start[found.stitches + 1u];
    for (std::size_t s = 0; s < 16; ++s) start[s + 1] += start[s];

    list_.batches.clear();
    const std::size_t limit =
        options_.batch_limit ? static_cast<std::size_t>(*options_.batch_limit) : found_.size();
    for (std::uint8_t s = 0; s < 16; ++s) {
        for (std::uint32_t first = start[s]; first < start[s + 1u];) {
            const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(limit, start[s + 1u] - first));
            list_.batches.push_back({s, first, count});
            first += count;
        }
    }
    list_.instances.resize(found_.size());
    for (const Found& found : found_) list_.instances[start[found.stitches]++] = found.patch;
}

void Selection::walk_border() {
    list_.skirt.clear();
    for (const Side side : {east, north, west, south}) walk_side(side, 0, 0);
}

/// Adds skirt pieces for the drawn nodes along a side, in the subtree of the level's border node
/// `along`.
void Selection::walk_side(Side side, std::int32_t level, std::int32_t along) {
    const std::int32_t across = side == east || side == north ? (std::int32_t{1} << level) - 1 : 0;
    const bool along_z = side == east || side == west;
    if (along_z ? levels_.splits(level, across, along) : levels_.splits(level, along, across)) {
        walk_side(side, level + 1, 2 * along);
        walk_side(side, level + 1, 2 * along + 1);
        return;
    }
    list_.skirt.push_back(
        {static_cast<std::uint16_t>(along * list_.grid.patch_side(level)), static_cast<std::uint8_t>(level), side});
}

}  // namespace pelagic
