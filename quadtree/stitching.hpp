// Triangulation of a cell of 3 x 3 vertices (VR Ocean, section 5.3.3): a fan around its middle,
// without the midpoint of each side whose neighbour is coarser. A patch uses the same sixteen
// patterns.
//
//   z   6---7---0     Seen from below: 0 north-east, 1 east, ... clockwise, so that a triangle
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

/// Position of a vertex in its cell, 0 to 2.
struct CellVertex {
    std::uint8_t x, z;
    bool operator==(const CellVertex&) const = default;
};
inline constexpr CellVertex cell_middle{1, 1};

/// One triangle: cell_middle, second, third, counter-clockwise seen from above.
struct FanTriangle {
    CellVertex second, third;
};

struct CellPattern {
    std::array<FanTriangle, 8> triangles{};
    int count = 0;  ///< 8 minus the number of coarser sides
};

/// Returns the triangles of a cell.
/// \param stitches  bit `Side` is set if that side of the cell borders a coarser patch
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

/// Returns the number of triangles of a patch of V x V steps for a stitch configuration.
constexpr std::uint32_t patch_triangles(int vertices, unsigned stitches) {
    const auto v = static_cast<std::uint32_t>(vertices);
    const std::uint32_t sides = (stitches & 1) + (stitches >> 1 & 1) + (stitches >> 2 & 1) + (stitches >> 3 & 1);
    return 2 * v * v - sides * (v / 2);
}

}  // namespace pelagic
