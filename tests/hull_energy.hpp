// Mechanical energy of boxes afloat, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "pelagic/floating/hull.hpp"
#include "pelagic/simd/constants.hpp"

namespace pelagic {

/// Mechanical energy of a box in still water: kinetic with the added mass, weight, and the work
/// that displaced the water, which is rho g times the integral of the depth over the submerged
/// volume. The integral is a sum over columns along the box axis that is closest to vertical,
/// independent of the mesh.
inline double box_energy_j(const Hull& hull, const HullState& state, const glm::dvec3& size,
                           const glm::dvec3& inertia) {
    const glm::dmat3 axes = glm::mat3_cast(state.orientation);
    int along = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (std::fabs(axes[axis].y) > std::fabs(axes[along].y)) along = axis;
    const int a = (along + 1) % 3, b = (along + 2) % 3;
    constexpr int columns = 100;
    const double slope = std::fabs(axes[along].y), length = size[along];
    double sum = 0;
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < columns; ++j) {
            glm::dvec3 middle{};
            middle[a] += ((i + 0.5) / columns - 0.5) * size[a];
            middle[b] += ((j + 0.5) / columns - 0.5) * size[b];
            const double lowest = state.position_m.y + (axes * middle).y - slope * length / 2;
            const double wet = std::clamp(-lowest / slope, 0.0, length);
            sum += wet * (-lowest - slope * wet / 2);
        }
    const double cell = size[a] * size[b] / (columns * columns);
    const double displaced = 1025 * gravity_mps2 * sum * cell;
    const glm::dvec3 v = state.velocity_mps * axes, w = state.angular_velocity_radps * axes;
    const double u[] = {v.x, v.y, v.z, w.x, w.y, w.z};
    double kinetic = hull.mass_kg() / 2 * glm::dot(v, v) + glm::dot(inertia * w, w) / 2;
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) kinetic += state.submersion * hull.added_mass()[i][j] * u[i] * u[j] / 2;
    return kinetic + hull.mass_kg() * gravity_mps2 * state.position_m.y + displaced;
}

}  // namespace pelagic
