// Reference position and displaced position of a patch's vertex. The vertex shader computes the
// same.
//
// A patch has the vertices of the next coarser level, (i, j) both even, and extra vertices between
// them. The reference position of an extra vertex is the middle of two coarser vertices at offsets
// -o and +o. The offset is along x if only i is odd, along z if only j is odd, else along the
// diagonal of the coarser patch in that square. The displacement of the extra vertex is
//
//   D = w D(rest) + (1 - w) (D(rest - o) + D(rest + o)) / 2
//
// where rest is the reference position, which never changes. With w = 0 the vertex lies on the
// coarser level's surface, with w = 1 on its own position. w is the patch's inner weight, or the
// weight of the edge on which the vertex lies, which is equal in both patches of that edge.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "pelagic/quadtree/draw_list.hpp"

namespace pelagic {

/// Returns the reference position of vertex (i, j), x and z in metres. The result is bit-identical
/// for every patch that shares the vertex and for every corner of the grid.
inline glm::dvec2 rest_position(const QuadtreeGrid& grid, const PatchInstance& patch, int i, int j) {
    const std::int32_t stride = grid.stride(patch.level);
    const glm::tvec2<std::int64_t> index(grid.corner.x + patch.corner_x + i * stride,
                                         grid.corner.y + patch.corner_z + j * stride);
    return glm::dvec2(index) * grid.step_m;
}

/// Returns the attenuation of the displacement near the border: 1 inside, 0 at the skirt.
inline double border_fade(const QuadtreeGrid& grid, glm::dvec2 rest) {
    const glm::dvec2 away = glm::abs(rest - grid.fade_centre);
    const double fade = (grid.fade_end_m - std::max(away.x, away.y)) / (grid.fade_end_m - grid.fade_start_m);
    return std::clamp(fade, 0.0, 1.0);
}

/// Returns the weight w above, 0 to 1. It is 1 for the vertices of the coarser level.
inline double vertex_weight(const PatchInstance& patch, int vertices, int i, int j) {
    if (i % 2 == 0 && j % 2 == 0) return 1;
    std::uint16_t weight = patch.inner_weight;
    if (i == 0) weight = patch.edge_weights[west];
    if (i == vertices) weight = patch.edge_weights[east];
    if (j == 0) weight = patch.edge_weights[south];
    if (j == vertices) weight = patch.edge_weights[north];
    return static_cast<double>(weight) / full_weight;
}

/// Returns the offset o above, in vertices of the patch. It is (0, 0) for the vertices of the
/// coarser level.
inline glm::ivec2 coarser_offset(const PatchInstance& patch, int i, int j) {
    const bool odd_i = i % 2 != 0, odd_j = j % 2 != 0;
    if (odd_i && odd_j) {
        // The diagonals of the squares alternate, because each cell of 3 x 3 vertices is a fan.
        const bool is_falling = ((i / 2 + j / 2 + patch.diagonals) & 1) != 0;
        return {1, is_falling ? -1 : 1};
    }
    return {odd_i ? 1 : 0, odd_j ? 1 : 0};
}

/// Returns the displaced position of a vertex in metres.
/// \param displacement  function from a reference position to glm::dvec3(Dx, height, Dz), the sum
///                      of all cascades
template <class Displacement>
glm::dvec3 patch_vertex(const QuadtreeGrid& grid, const PatchInstance& patch, int i, int j,
                        const Displacement& displacement) {
    const auto faded = [&](int at_i, int at_j) -> glm::dvec3 {
        const glm::dvec2 rest = rest_position(grid, patch, at_i, at_j);
        const double fade = border_fade(grid, rest);
        return fade > 0 ? displacement(rest) * fade : glm::dvec3(0);
    };
    const glm::dvec2 rest = rest_position(grid, patch, i, j);
    glm::dvec3 moved = faded(i, j);
    const double w = vertex_weight(patch, grid.vertices, i, j);
    if (w < 1) {
        const glm::ivec2 o = coarser_offset(patch, i, j);
        const glm::dvec3 coarser = 0.5 * (faded(i - o.x, j - o.y) + faded(i + o.x, j + o.y));
        moved = w * moved + (1 - w) * coarser;
    }
    return {rest.x + moved.x, moved.y, rest.y + moved.z};
}

}  // namespace pelagic
