#include "pelagic/bench/peers/paper_quadtree.hpp"

#include "pelagic/quadtree/quadtree_options.hpp"

namespace pelagic::peers {

PaperQuadtree::PaperQuadtree(const Options& options)
    : options_(options),
      deepest_(deepest_level(options.size_m)),
      width_(std::int32_t{1} << deepest_),
      map_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(width_)) {}

bool PaperQuadtree::is_visible(const Node& node, const Frustum& view) const {
    const double side = options_.size_m / (1 << node.level);
    const double height =
        // section 5.2.2
        options_.height_max_m > 0 ? options_.height_max_m : 0.03 * options_.size_m;
    return view.may_see(
        {{(node.x + 0.5) * side - options_.size_m / 2, 0, (node.y + 0.5) * side - options_.size_m / 2},
         // equation 61
         {side * options_.cull_scale / 2, height / 2, side * options_.cull_scale / 2}});
}

std::uint8_t PaperQuadtree::flag(std::int32_t x, std::int32_t y, std::int32_t level, int bit) const {
    if (x < 0 || y < 0 || x >= width_ || y >= width_) return 0;
    return map_[static_cast<std::size_t>(x + y * width_)] < level ? static_cast<std::uint8_t>(1 << bit) : 0;
}

const std::vector<PaperQuadtree::Patch>& PaperQuadtree::select(const glm::dvec3& viewer_m, const Frustum& view) {
    patches_.clear();
    nodes_visited_ = 0;
    stack_.assign(1, {0, 0, 0, false});
    while (!stack_.empty()) {
        const Node node = stack_.back();
        stack_.pop_back();
        ++nodes_visited_;
        const double side = options_.size_m / (1 << node.level);
        const glm::dvec3 away((node.x + 0.5) * side - options_.size_m / 2 - viewer_m.x, -viewer_m.y,
                              (node.y + 0.5) * side - options_.size_m / 2 - viewer_m.z);
        const double range = side * options_.lod_scale;
        const bool is_leaf = node.level == deepest_;
        const bool subdivides = !is_leaf && glm::dot(away, away) < range * range;  // equation 57
        bool rendered = node.rendered;
        if (!subdivides && !rendered) {
            // The map stores the level of the covering patch, also of culled patches, which the
            // paper does not define.
            const std::int32_t stride = std::int32_t{1} << (deepest_ - node.level);
            for (std::int32_t row = node.y * stride; row < (node.y + 1) * stride; ++row)
                for (std::int32_t column = node.x * stride; column < (node.x + 1) * stride; ++column)
                    map_[static_cast<std::size_t>(column + row * width_)] = static_cast<std::uint8_t>(node.level);
            if (is_visible(node, view)) patches_.push_back({node.x, node.y, node.level, 0});
            rendered = true;
        }
        if (is_leaf) continue;
        for (const std::int32_t child : {3, 2, 1, 0})
            stack_.push_back({2 * node.x + child % 2, 2 * node.y + child / 2, node.level + 1, rendered});
    }
    for (Patch& patch : patches_) {
        const std::int32_t stride = std::int32_t{1} << (deepest_ - patch.level);  // equation 62
        const std::int32_t gx = patch.x * stride, gy = patch.y * stride;
        patch.flags =
            static_cast<std::uint8_t>(flag(gx + stride, gy, patch.level, 0) | flag(gx, gy + stride, patch.level, 1) |
                                      // equations 63 and 64
                                      flag(gx - 1, gy, patch.level, 2) | flag(gx, gy - 1, patch.level, 3));
    }
    return patches_;
}

}  // namespace pelagic::peers
