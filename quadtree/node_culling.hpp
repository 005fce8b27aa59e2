// Culling of a tree's nodes. Equivalent to Frustum::may_see(), but terms that are constant for a
// level are computed once, and six planes are tested at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>

#include "pelagic/quadtree/draw_list.hpp"
#include "pelagic/quadtree/frustum.hpp"

namespace pelagic {

/// Extents of boxes relative to their nodes.
struct BoxesOfNodes {
    double low_m, high_m;
    glm::dvec2 horizontal_m;  ///< margin along x and z
    /// Scale of the node's size; at least 1, so that a child's box is inside its parent's.
    double cull_scale;
};

class NodeCulling {
   public:
    enum class Sight { none, partial, whole };

    /// Prepares the tests of a view: one extent of the boxes for each plane and level.
    NodeCulling(const Frustum& view, const QuadtreeGrid& grid, const BoxesOfNodes& boxes);

    /// Returns none only if the node's box is outside the view, whole only if all of the box is
    /// inside.
    Sight sight_of(std::int32_t level, std::int32_t x, std::int32_t z) const;

   private:
    static constexpr std::size_t planes = 6, max_levels = 9;
    using Planes = std::array<double, planes>;

    glm::dvec2 corner_m_;
    Planes along_x_, along_z_;
    Planes middle_;  ///< distance of the centre of a box at x = z = 0 from each plane
    struct Level {
        double size_m;
        Planes reach;  ///< half extent of a box along each plane's normal, plus the rounding bound
    };
    std::array<Level, max_levels> levels_;
};

}  // namespace pelagic
