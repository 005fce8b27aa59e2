// Where a patch's vertex rests and where it is drawn. A vertex shader does the same.
//
// A patch has the vertices of the next coarser level, (i, j) both even, and extra ones between them. An extra one rests
// in the middle between two coarser vertices, a step to either side: along x if only i is odd, along z if only j is,
// else along the diagonal by which the coarser patch cuts that square. Its displacement is
//
//   D = w D(rest) + (1 - w) (D(rest - o) + D(rest + o)) / 2
//
// With w = 0 it lies on the coarser level's surface, with w = 1 in its own place; w is the patch's inner weight, or the
// weight of the edge on which the vertex lies, which both patches of that edge know. The reference position never moves.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "pelagic/quadtree/draw_list.hpp"

namespace pelagic {

/// Metres; the same bits for every patch that has the vertex, whatever the grid's corner.
inline glm::dvec2 rest_position(const QuadtreeGrid& grid, const PatchInstance& patch, int i, int j) {
    const std::int32_t stride = grid.stride(patch.level);
    const glm::tvec2<std::int64_t> index(grid.corner.x + patch.corner_x + i * stride,
                                         grid.corner.y + patch.corner_z + j * stride);
    return glm::dvec2(index) * grid.step_m;
}

/// The part of the displacement that is left near the border: 1 inside, 0 where the skirt begins.
inline double border_fade(const QuadtreeGrid& grid, glm::dvec2 rest) {
    const glm::dvec2 away = glm::abs(rest - grid.fade_centre);
    const double left = (grid.fade_end_m - std::max(away.x, away.y)) / (grid.fade_end_m - grid.fade_start_m);
    return std::clamp(left, 0.0, 1.0);
}

/// The weight w above, 0 to 1; 1 for the vertices of the coarser level.
inline double vertex_weight(const PatchInstance& patch, int vertices, int i, int j) {
    if (i % 2 == 0 && j % 2 == 0) return 1;
    std::uint16_t weight = patch.inner_weight;
    if (i == 0) weight = patch.edge_weights[west];
    if (i == vertices) weight = patch.edge_weights[east];
    if (j == 0) weight = patch.edge_weights[south];
    if (j == vertices) weight = patch.edge_weights[north];
    return static_cast<double>(weight) / full_weight;
}

/// The offset o above, in vertices of the patch; (0, 0) for the vertices of the coarser level.
inline glm::ivec2 coarser_offset(const PatchInstance& patch, int i, int j) {
    const bool odd_i = i % 2 != 0, odd_j = j % 2 != 0;
    if (odd_i && odd_j) {
        // Fans around the middles of 3 x 3 cells: the diagonals of the squares alternate.
        const bool is_falling = ((i / 2 + j / 2 + patch.diagonals) & 1) != 0;
        return {1, is_falling ? -1 : 1};
    }
    return {odd_i ? 1 : 0, odd_j ? 1 : 0};
}

/// Where the vertex is drawn, metres. `displacement` maps a reference position to glm::dvec3(Dx, height, Dz), the sum of all cascades.
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
