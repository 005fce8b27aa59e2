// Draw lists, the result of a selection: position of the grid, one instance per patch, and draw
// calls.
//
// Positions are integers in steps. A step is the distance between neighbouring vertices of the
// finest patches. Patches that share a vertex compute its position from equal integers, so the
// positions are bit-identical for any S and V. The position does not change when the grid follows
// the viewer.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace pelagic {

/// The sides of a patch, and the bit numbers of a stitch configuration (VR Ocean, equation 64).
/// East is +x, north is +z.
enum Side : std::uint8_t { east = 0, north = 1, west = 2, south = 3 };

/// The square of S x S metres and its position in the world.
struct QuadtreeGrid {
    /// Vertex (i, j) has the reference position ((corner.x + i) step_m, (corner.y + j) step_m) in x
    /// and z.
    double step_m = 0;
    glm::tvec2<std::int64_t> corner{};  ///< steps from the world's origin to the lowest x and z
    std::int32_t side = 0;              ///< steps along S
    int vertices = 0;                   ///< V
    int deepest_level = 0;

    /// Displacement fades out before the border, where the flat skirt begins. Along x and along z
    /// it is full up to fade_start_m from fade_centre, and zero from fade_end_m on.
    glm::dvec2 fade_centre{};
    double fade_start_m = 0;
    double fade_end_m = 0;

    /// Returns the side of the grid in metres.
    double size_m() const { return side * step_m; }
    /// Returns the steps between two vertices of a patch of this level.
    std::int32_t stride(int level) const { return std::int32_t{1} << (deepest_level - level); }
    /// Returns the steps along the side of a patch of this level.
    std::int32_t patch_side(int level) const { return vertices * stride(level); }
    /// Returns the side of a patch of this level in metres.
    double patch_size_m(int level) const { return patch_side(level) * step_m; }
};

/// Morph weight of vertices that the next coarser level lacks. At 0 they lie on the coarser
/// surface, at full_weight on their own position.
inline constexpr std::uint16_t full_weight = 65535;

/// Instance data of one patch for the vertex shader: four 16-bit integers and four normalised ones.
struct PatchInstance {
    std::uint16_t corner_x = 0;  ///< steps from the grid's corner to the patch's
    std::uint16_t corner_z = 0;
    std::uint8_t level = 0;
    std::uint8_t diagonals = 0;  ///< 1 flips the coarser level's diagonals, see patch_vertex.hpp
    std::uint16_t inner_weight = full_weight;
    /// By Side.
    std::array<std::uint16_t, 4> edge_weights{full_weight, full_weight, full_weight, full_weight};
    bool operator==(const PatchInstance&) const = default;
};
static_assert(sizeof(PatchInstance) == 16);

/// One instanced draw: the mesh's index range of `stitches` for instances [first, first + count).
struct DrawBatch {
    std::uint8_t stitches = 0;  ///< bit `Side` is set if the neighbour on that side is coarser
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// The piece of the skirt at a border patch, see skirt.hpp.
struct SkirtInstance {
    std::uint16_t start = 0;  ///< steps along the side, from its lowest coordinate
    std::uint8_t level = 0;   ///< level of the patch, which defines the stride
    std::uint8_t side = 0;    ///< Side of the grid
    bool operator==(const SkirtInstance&) const = default;
};
static_assert(sizeof(SkirtInstance) == 4);

/// Statistics of a selection.
struct SelectionStatistics {
    std::array<std::uint32_t, 9> patches_by_level{};
    std::uint32_t nodes_visited = 0;  ///< number of nodes popped from the stack
    std::uint64_t triangles = 0;      ///< triangles of all batches, without the skirt
};

/// A draw list for all views of the selection. Draw the batches in order, then the skirt.
struct DrawList {
    QuadtreeGrid grid;
    std::vector<PatchInstance> instances;  ///< sorted by stitch configuration
    std::vector<DrawBatch> batches;        ///< at most 16, unless batch_limit splits batches
    std::vector<SkirtInstance> skirt;
    SelectionStatistics statistics;
    double lod_scale = 2.2;  ///< tau of the selection, for the mip of a vertex's displacement
};

}  // namespace pelagic
