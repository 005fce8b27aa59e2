// The one mesh that every patch is an instance of (VR Ocean, section 5.4).
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

    /// Throws std::invalid_argument unless V is even and from 2 to 128.
    explicit PatchMesh(int vertices);

    int vertices;                        ///< V
    std::vector<Vertex> positions;       ///< vertex i + j (V + 1), equation 68
    std::vector<std::uint16_t> indices;  ///< triangles, counter-clockwise seen from above, ordered for the cache
    std::array<Range, 16> ranges{};      ///< by stitch configuration
};

/// The order in which the cells of a patch are drawn: bands a few cells wide, so that the vertices of one row are still
/// in a small post-transform cache when the next row uses them. Cell numbers are x + z * cells.
std::vector<std::uint32_t> cells_in_cache_order(int cells);

}  // namespace pelagic
