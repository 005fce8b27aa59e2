// The flat sea beyond the grid, out to the horizon: four strips of which each border patch draws its piece, so that
// strip and patch share their vertices and no gap can open (VR Ocean, section 5.7, has three vertex pairs a side).
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "pelagic/quadtree/draw_list.hpp"

namespace pelagic {

/// The strips end where the square of side 2 * skirt_reach * S ends: 10 S from its middle.
inline constexpr double skirt_reach = 10;

/// One mesh for every piece: vertex pairs t = 0 ... V along the border, outer = 0 or 1, number 2 t + outer.
struct SkirtMesh {
    explicit SkirtMesh(int vertices);

    int vertices;
    std::vector<std::uint16_t> indices;  ///< triangles, counter-clockwise seen from above
};

/// Where vertex (t, outer) of a piece lies; y is 0 there. The inner ones are the border patch's own vertices.
glm::dvec2 skirt_position(const QuadtreeGrid& grid, const SkirtInstance& piece, int t, bool outer);

}  // namespace pelagic
