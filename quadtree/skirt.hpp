// The flat sea beyond the grid up to the horizon: four strips. Each border patch draws its piece,
// so that strip and patch share vertices and no gap can open (VR Ocean, section 5.7, has three
// vertex pairs per side).
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "pelagic/quadtree/draw_list.hpp"

namespace pelagic {

/// The strips end at the square of side 2 * skirt_reach * S: 10 S from the grid's middle.
inline constexpr double skirt_reach = 10;

/// The mesh of every piece: vertex pairs t = 0 ... V along the border, outer = 0 or 1, index 2 t +
/// outer.
struct SkirtMesh {
    /// Makes the mesh for patches with this number of vertex steps along a side; even, 2 to 128.
    /// \throws std::invalid_argument  if the number is out of range
    explicit SkirtMesh(int vertices);

    int vertices;
    std::vector<std::uint16_t> indices;  ///< triangles, counter-clockwise seen from above
};

/// Returns x and z of vertex (t, outer) of a piece; y is 0. Inner vertices are vertices of the
/// border patch.
glm::dvec2 skirt_position(const QuadtreeGrid& grid, const SkirtInstance& piece, int t, bool outer);

}  // namespace pelagic
