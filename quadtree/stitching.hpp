// How a cell of 3 x 3 vertices is cut into triangles (VR Ocean, section 5.3.3): a fan around its middle, which leaves
// out the midpoint of each side whose neighbour is coarser. The same sixteen patterns serve a whole patch.
//
//   z   6---7---0     0 north-east, 1 east, ... counter-clockwise seen from below, so that a triangle
//   ^   |   |   |     (middle, k, k + 1) faces +y.
//   |   5---m---1
//   |   |   |   |
//   |   4---3---2
//   +-------------> x
#pragma once

#include <array>
#include <cstdint>

#include "pelagic/quadtree/draw_list.hpp"

namespace pelagic {

/// Place of a vertex in its cell, 0 to 2.
struct CellVertex {
    std::uint8_t x, z;
    bool operator==(const CellVertex&) const = default;
};
inline constexpr CellVertex cell_middle{1, 1};

/// One triangle: cell_middle, then these two, counter-clockwise seen from above.
struct FanTriangle {
    CellVertex second, third;
};

struct CellPattern {
    std::array<FanTriangle, 8> triangles{};
    int count = 0;  ///< 8 less one for each coarser side
};

/// \param stitches  bit `Side` set: that side of the cell lies on a coarser patch
constexpr CellPattern cell_pattern(unsigned stitches) {
    constexpr CellVertex ring[8] = {{2, 2}, {2, 1}, {2, 0}, {1, 0}, {0, 0}, {0, 1}, {0, 2}, {1, 2}};
    constexpr Side side_of_midpoint[4] = {east, south, west, north};  // ring[1], [3], [5], [7]
    CellPattern pattern;
    std::array<CellVertex, 8> kept{};
    unsigned count = 0;
    for (unsigned k = 0; k < 8; ++k) {
        if (k % 2 == 1 && (stitches >> side_of_midpoint[k / 2] & 1) != 0) continue;
        kept[count++] = ring[k];
    }
    for (unsigned k = 0; k < count; ++k) pattern.triangles[k] = {kept[k], kept[(k + 1) % count]};
    pattern.count = static_cast<int>(count);
    return pattern;
}

/// Triangles of a patch of V x V steps under a stitch configuration.
constexpr std::uint32_t patch_triangles(int vertices, unsigned stitches) {
    const auto v = static_cast<std::uint32_t>(vertices);
    const std::uint32_t sides = (stitches & 1) + (stitches >> 1 & 1) + (stitches >> 2 & 1) + (stitches >> 3 & 1);
    return 2 * v * v - sides * (v / 2);
}

}  // namespace pelagic
