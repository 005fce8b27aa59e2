#include "pelagic/tools/meshes/sea_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/cascade_sum.hpp"

namespace pelagic::tools {

std::size_t cascades_shown_by(double step_m, std::span<const CascadePlan> plans) {
    const auto is_shown = [&](const CascadePlan& plan) {
        return 3 * plan.grid.side_m / plan.resolution >= 2 * step_m;
    };
    std::size_t count = 1;
    while (count < plans.size() && is_shown(plans[count])) ++count;
    return count;
}

glm::vec2 texture_coordinates_of(const Cascade& coarsest, glm::dvec2 rest) {
    const CascadeGrid::Place place = coarsest.grid.in_cascade(rest.x, rest.y);
    const double side_m = coarsest.grid.side_m;
    const double half_m = coarsest.texel_m() / 2;  // from a texel's corner to its centre
    return glm::dvec2((place.along + half_m) / side_m, 1 - (place.across + half_m) / side_m);
}

Mesh mesh_of(const Frame& frame, const SeaPatch& patch) {
    Frame shown = frame;
    shown.cascades = frame.cascades.first(patch.cascades);
    const auto drawn = [&](glm::dvec2 rest) {
        const Displacement d = displacement_of(shown, rest.x, rest.y);
        return glm::dvec3(rest.x + d.dx, d.height, rest.y + d.dz);
    };
    const double reach_m = std::max(patch.side_m / patch.steps, shown.cascades.back().texel_m());
    const FoamSampler foam(frame);

    const auto row = static_cast<std::uint32_t>(patch.steps) + 1;
    Mesh mesh;
    mesh.corners = 4;
    mesh.positions.reserve(std::size_t{row} * row);
    mesh.normals.reserve(std::size_t{row} * row);
    mesh.texture_coordinates.reserve(std::size_t{row} * row);
    mesh.faces.reserve(std::size_t{row - 1} * (row - 1) * mesh.corners);
    for (int j = 0; j <= patch.steps; ++j) {
        for (int i = 0; i <= patch.steps; ++i) {
            const glm::dvec2 rest(i * patch.side_m / patch.steps, j * patch.side_m / patch.steps);
            mesh.positions.push_back(drawn(rest));
            mesh.normals.emplace_back(normal_at(rest, reach_m, drawn));
            mesh.texture_coordinates.push_back(texture_coordinates_of(frame.cascades.front(), rest));
            if (foam.has_foam()) mesh.foam.push_back(foam.at(rest.x, rest.y));
        }
    }
    for (std::uint32_t j = 0; j + 1 < row; ++j)
        for (std::uint32_t i = 0; i + 1 < row; ++i)
            for (const std::uint32_t corner :
                 {j * row + i, (j + 1) * row + i, (j + 1) * row + i + 1, j * row + i + 1})
                mesh.faces.push_back(corner);
    return mesh;
}

}  // namespace pelagic::tools
