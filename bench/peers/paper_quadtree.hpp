// The quadtree traversal as printed in the VR paper (section 5.2): every node down to the leaves, a
// level map of the finest cells, then the neighbours' flags. For timing only: see docs/errata.md
// for its errata.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "pelagic/quadtree/frustum.hpp"

namespace pelagic::peers {

class PaperQuadtree {
   public:
    struct Options {
        double size_m = 8192;
        double lod_scale = 2;
        double cull_scale = 1;
        double height_max_m = 0;  ///< 0: 0.03 S, as in the paper
    };
    struct Patch {
        std::int32_t x, y, level;
        std::uint8_t flags;  ///< equation 64
    };

    explicit PaperQuadtree(const Options& options);

    /// Returns the patches in the view, in the order of the traversal. The grid is centred at the
    /// origin.
    const std::vector<Patch>& select(const glm::dvec3& viewer_m, const Frustum& view);

    std::uint32_t nodes_visited() const { return nodes_visited_; }

   private:
    struct Node {
        std::int32_t x, y, level;
        bool rendered;
    };
    bool is_visible(const Node& node, const Frustum& view) const;
    std::uint8_t flag(std::int32_t x, std::int32_t y, std::int32_t level, int bit) const;

    Options options_;
    int deepest_;
    std::int32_t width_;
    std::vector<std::uint8_t> map_;
    std::vector<Node> stack_;
    std::vector<Patch> patches_;
    std::uint32_t nodes_visited_ = 0;
};

}  // namespace pelagic::peers
