#include "pelagic/quadtree/node_culling.hpp"

#include <bit>
#include <cmath>

namespace pelagic {

NodeCulling::NodeCulling(const Frustum& view, const QuadtreeGrid& grid, const BoxesOfNodes& boxes)
    : corner_m_(glm::dvec2(grid.corner) * grid.step_m) {
    const double middle_m = (boxes.low_m + boxes.high_m) / 2, half_height_m = (boxes.high_m - boxes.low_m) / 2;
    const glm::dvec2 furthest = glm::abs(corner_m_) + grid.size_m();
    for (std::size_t p = 0; p < planes; ++p) {
        const glm::dvec4& plane = view.planes[p];
        const glm::dvec3 size = glm::abs(glm::dvec3(plane));
        along_x_[p] = plane.x;
        along_z_[p] = plane.z;
        middle_[p] = plane.y * middle_m + plane.w;
        const auto reach_of = [&](double node_m) {
            const glm::dvec2 half = node_m * boxes.cull_scale / 2 + boxes.horizontal_m;
            return size.x * half.x + size.y * half_height_m + size.z * half.y;
        };
        // Bound of the rounding error: a few units in the last place of the largest term of any
        // sum.
        const double rounding = 1e-14 * (size.x * furthest.x + size.y * std::abs(middle_m) + size.z * furthest.y +
                                         std::abs(plane.w) + reach_of(grid.size_m()));
        for (int level = 0; level <= grid.deepest_level; ++level) {
            Level& of = levels_[static_cast<std::size_t>(level)];
            of.size_m = grid.patch_size_m(level);
            of.reach[p] = reach_of(of.size_m) + rounding;
        }
    }
}

NodeCulling::Sight NodeCulling::sight_of(std::int32_t level, std::int32_t x, std::int32_t z) const {
    const Level& of = levels_[static_cast<std::size_t>(level)];
    const double centre_x = corner_m_.x + (x + 0.5) * of.size_m, centre_z = corner_m_.y + (z + 0.5) * of.size_m;
    std::uint64_t outside = 0, cut = 0;  // the highest bit is the sign
    for (std::size_t p = 0; p < planes; ++p) {
        const double middle = along_x_[p] * centre_x + along_z_[p] * centre_z + middle_[p];
        outside |= std::bit_cast<std::uint64_t>(middle + of.reach[p]);
        cut |= std::bit_cast<std::uint64_t>(middle - of.reach[p]);
    }
    return outside >> 63 ? Sight::none : cut >> 63 ? Sight::partial : Sight::whole;
}

}  // namespace pelagic
