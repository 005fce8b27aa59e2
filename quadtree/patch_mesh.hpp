// The mesh that all patches share as instances (VR Ocean, section 5.4).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pelagic {

/// (V + 1)^2 vertices and 16 index ranges, one for each stitch configuration.
struct PatchMesh {
    struct Range {
        std::uint32_t first = 0;  ///< index in `indices`
        std::uint32_t count = 0;
    };
    struct Vertex {
        std::uint8_t i, j;  ///< 0 to V; equation 67 without the division
    };

    /// \param vertices  V, even, 2 to 128
    /// \throws std::invalid_argument  if V is out of range
    explicit PatchMesh(int vertices);

    int vertices;                        ///< V
    std::vector<Vertex> positions;       ///< vertex i + j (V + 1), equation 68
    std::vector<std::uint16_t> indices;  ///< triangles, counter-clockwise from above, cache order
    std::array<Range, 16> ranges{};      ///< by stitch configuration
};

/// Returns the draw order of the cells of a patch: bands a few cells wide, so that a small
/// post-transform cache still holds the vertices of one row when the next row uses them. Cell
/// numbers are x + z * cells.
std::vector<std::uint32_t> cells_in_cache_order(int cells);

}  // namespace pelagic
