// What a selection hands to the one who draws: where the grid lies, one instance a patch, and the draw calls.
//
// Positions are integers, counted in steps: the distance between neighbouring vertices of the finest patches. A vertex
// that two patches share is so computed from the same numbers and lies at the same place, to the bit, for any S and V;
// it also stays there when the grid follows the viewer.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace pelagic {

/// The side of a patch; the bits of a stitch configuration (VR Ocean, equation 64). East is +x, north is +z.
enum Side : std::uint8_t { east = 0, north = 1, west = 2, south = 3 };

/// The square of S x S metres and how it lies in the world.
struct QuadtreeGrid {
    double step_m = 0;                  ///< a vertex of index (i, j) rests at x = (corner.x + i) step_m, z likewise
    glm::tvec2<std::int64_t> corner{};  ///< steps from the world's origin to the lowest x and z
    std::int32_t side = 0;              ///< steps along S
    int vertices = 0;                   ///< V
    int deepest_level = 0;

    /// Displacement fades out before the border, where the flat skirt begins: full up to fade_start_m from
    /// fade_centre along x and z alike, none from fade_end_m on.
    glm::dvec2 fade_centre{};
    double fade_start_m = 0;
    double fade_end_m = 0;

    double size_m() const { return side * step_m; }
    /// Steps between two vertices of a patch of that level.
    std::int32_t stride(int level) const { return std::int32_t{1} << (deepest_level - level); }
    /// Steps along the side of a patch of that level.
    std::int32_t patch_side(int level) const { return vertices * stride(level); }
    double patch_size_m(int level) const { return patch_side(level) * step_m; }
};

/// Vertices that the next coarser level lacks are weighted between its surface, 0, and their own place, full_weight.
inline constexpr std::uint16_t full_weight = 65535;

/// One patch, as a vertex shader reads it: four 16-bit integers and four normalised ones.
struct PatchInstance {
    std::uint16_t corner_x = 0;  ///< steps from the grid's corner to the patch's
    std::uint16_t corner_z = 0;
    std::uint8_t level = 0;
    std::uint8_t diagonals = 0;  ///< 1 turns the coarser level's diagonals, see patch_vertex.hpp
    std::uint16_t inner_weight = full_weight;
    std::array<std::uint16_t, 4> edge_weights{full_weight, full_weight, full_weight, full_weight};  ///< by Side
    bool operator==(const PatchInstance&) const = default;
};
static_assert(sizeof(PatchInstance) == 16);

/// One instanced draw: the mesh's index range of `stitches` for instances [first, first + count).
struct DrawBatch {
    std::uint8_t stitches = 0;  ///< bit `Side` set: the neighbour there is coarser
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// A border patch's piece of the skirt, see skirt.hpp.
struct SkirtInstance {
    std::uint16_t start = 0;  ///< steps along the side, from its lowest coordinate
    std::uint8_t level = 0;   ///< of the patch: its stride
    std::uint8_t side = 0;    ///< Side of the grid
    bool operator==(const SkirtInstance&) const = default;
};
static_assert(sizeof(SkirtInstance) == 4);

/// What a selection cost and yielded.
struct SelectionStatistics {
    std::array<std::uint32_t, 9> patches_by_level{};
    std::uint32_t nodes_visited = 0;  ///< popped from the stack
    std::uint64_t triangles = 0;      ///< of all batches, the skirt not counted
};

/// Ready to draw for every view of the selection: batches one after the other, then the skirt.
struct DrawList {
    QuadtreeGrid grid;
    std::vector<PatchInstance> instances;  ///< sorted by stitch configuration
    std::vector<DrawBatch> batches;        ///< at most 16, more only where batch_limit splits one
    std::vector<SkirtInstance> skirt;
    SelectionStatistics statistics;
};

}  // namespace pelagic
