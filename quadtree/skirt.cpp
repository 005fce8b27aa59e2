#include "pelagic/quadtree/skirt.hpp"

#include <stdexcept>

#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic {

SkirtMesh::SkirtMesh(int v) : vertices(v) {
    if (v < 2 || v > 128 || v % 2 != 0)
        throw std::invalid_argument(invalid_value_message("vertices", v, "an even number from 2 to 128"));
    // Seen from above, the outside lies to the right of the direction of increasing t: see
    // skirt_position().
    for (int t = 0; t < v; ++t) {
        const auto inner = static_cast<std::uint16_t>(2 * t);
        for (const int k : {0, 2, 1, 1, 2, 3}) indices.push_back(static_cast<std::uint16_t>(inner + k));
    }
}

glm::dvec2 skirt_position(const QuadtreeGrid& grid, const SkirtInstance& piece, int t, bool outer) {
    // Along the east side z increases with t, along the west side it decreases. Along the south
    // side x increases, along the north side it decreases. All four sides have the same
    // orientation.
    const bool runs_down = piece.side == north || piece.side == west;
    const std::int32_t along = piece.start + (runs_down ? grid.vertices - t : t) * grid.stride(piece.level);
    const std::int32_t across = piece.side == east || piece.side == north ? grid.side : 0;
    const bool along_z = piece.side == east || piece.side == west;
    const glm::dvec2 index(along_z ? across : along, along_z ? along : across);
    const glm::dvec2 inner = (glm::dvec2(grid.corner) + index) * grid.step_m;
    if (!outer) return inner;
    const glm::dvec2 middle = (glm::dvec2(grid.corner) + 0.5 * grid.side) * grid.step_m;
    return middle + (inner - middle) * (2 * skirt_reach);
}

}  // namespace pelagic
