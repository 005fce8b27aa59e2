#include "pelagic/quadtree/patch_mesh.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/quadtree/stitching.hpp"

namespace pelagic {
namespace {

/// Cells across a band. A band needs ten new vertices for sixteen triangles if the cache holds the
/// previous row of five vertices, which a cache of 16 entries nearly does. Wider bands need fewer
/// vertices with 32 entries and many more with 16.
constexpr int band_cells = 2;

/// Returns the sides of a cell that lie on a stitched side of its patch (equation 65).
unsigned cell_stitches(int x, int z, int cells, unsigned patch) {
    unsigned touched = 0;
    if (x == cells - 1) touched |= 1u << east;
    if (z == cells - 1) touched |= 1u << north;
    if (x == 0) touched |= 1u << west;
    if (z == 0) touched |= 1u << south;
    return patch & touched;
}

}  // namespace

std::vector<std::uint32_t> cells_in_cache_order(int cells) {
    std::vector<std::uint32_t> order;
    order.reserve(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
    for (int band = 0; band < cells; band += band_cells)
        for (int z = 0; z < cells; ++z)
            for (int x = band; x < std::min(band + band_cells, cells); ++x)
                order.push_back(static_cast<std::uint32_t>(x + z * cells));
    return order;
}

PatchMesh::PatchMesh(int v) : vertices(v) {
    if (v < 2 || v > 128 || v % 2 != 0)
        throw std::invalid_argument(invalid_value_message("vertices", v, "an even number from 2 to 128"));
    for (int j = 0; j <= v; ++j)
        for (int i = 0; i <= v; ++i)
            positions.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j)});

    const int cells = v / 2;
    const std::vector<std::uint32_t> order = cells_in_cache_order(cells);
    std::array<CellPattern, 16> patterns;
    for (unsigned s = 0; s < 16; ++s) patterns[s] = cell_pattern(s);
    for (unsigned stitches = 0; stitches < 16; ++stitches) {
        ranges[stitches].first = static_cast<std::uint32_t>(indices.size());
        for (const std::uint32_t cell : order) {
            const int x = static_cast<int>(cell) % cells, z = static_cast<int>(cell) / cells;
            const auto index = [&](CellVertex vertex) {
                return static_cast<std::uint16_t>(2 * x + vertex.x + (2 * z + vertex.z) * (v + 1));
            };
            const CellPattern& pattern = patterns[cell_stitches(x, z, cells, stitches)];
            for (int t = 0; t < pattern.count; ++t) {
                indices.push_back(index(cell_middle));
                indices.push_back(index(pattern.triangles[static_cast<std::size_t>(t)].second));
                indices.push_back(index(pattern.triangles[static_cast<std::size_t>(t)].third));
            }
        }
        ranges[stitches].count = static_cast<std::uint32_t>(indices.size()) - ranges[stitches].first;
    }
}

}  // namespace pelagic
