// What a view sees of a tree's nodes: Frustum::may_see(), of which all that is the same for a level's boxes is done once,
// and the rest for six planes at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>

#include "pelagic/quadtree/draw_list.hpp"
#include "pelagic/quadtree/frustum.hpp"

namespace pelagic {

/// How far boxes reach beyond their nodes.
struct BoxesOfNodes {
    double low_m, high_m;
    glm::dvec2 horizontal_m;  ///< along x and z
    double cull_scale;        ///< times their nodes' size; 1 or more, so that a child's box is inside its parent's
};

class NodeCulling {
   public:
    enum class Sight { none, part, whole };

    NodeCulling(const Frustum& view, const QuadtreeGrid& grid, const BoxesOfNodes& boxes);

    /// None only if the box is outside, whole only if all of it is inside.
    Sight sight_of(std::int32_t level, std::int32_t x, std::int32_t z) const;

   private:
    static constexpr std::size_t planes = 6, max_levels = 9;
    using Planes = std::array<double, planes>;

    glm::dvec2 corner_m_;
    Planes along_x_, along_z_;
    Planes middle_;  ///< of a box around x = z = 0
    struct Level {
        double size_m;
        Planes reach;  ///< of a box along the plane's normal, and what rounding may take
    };
    std::array<Level, max_levels> levels_;
};

}  // namespace pelagic
