// Loads of a hull by given coefficients.
#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <stdexcept>

#include "pelagic/floating/given_coefficients.hpp"
#include "pelagic/floating/hull.hpp"
#include "pelagic/floating/matrix6.hpp"
#include "pelagic/floating/radiation_states.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/simd/direction.hpp"

namespace pelagic {
namespace {

/// Returns the velocity of the water that given radiation is relative to, in axes of the hull.
Vector6 radiation_water(const HullState& state, const HullInputs& inputs, const HullLoads& loads) {
    if (inputs.wave_forces) return {};
    const glm::dmat3 to_hull = glm::transpose(glm::mat3_cast(state.orientation));
    return joined(to_hull * loads.water_velocity_mps, to_hull * loads.water_rotation_radps);
}

}  // namespace

/// Checks that hull and added mass move, whatever the fraction of the latter: all pivots are positive.
void Hull::check_mass() const {
    HullMatrix matrix = added_mass_;
    for (std::size_t i = 0; i < 3; ++i) {
        matrix[i][i] += mass_kg_;
        matrix[i + 3][i + 3] += inertia_kgm2_[static_cast<int>(i)];
    }
    for (std::size_t pivot = 0; pivot < 6; ++pivot) {
        if (!(matrix[pivot][pivot] > 0))
            throw std::invalid_argument(
                "the coefficients' added mass at infinite frequency and the hull's mass are not positive definite, "
                "expected coefficients of this hull about its origin");
        for (std::size_t row = pivot + 1; row < 6; ++row) {
            const double factor = matrix[row][pivot] / matrix[pivot][pivot];
            for (std::size_t column = pivot; column < 6; ++column)
                matrix[row][column] -= factor * matrix[pivot][column];
        }
    }
}

void Hull::check_waves(const HullInputs& inputs) const {
    const bool has_forces = options_.coefficients && options_.coefficients->excitation();
    if (has_forces && !inputs.wave_forces)
        throw std::invalid_argument("the hull's coefficients have wave forces, expected those of a sea in the inputs");
    if (!has_forces && inputs.wave_forces)
        throw std::invalid_argument("wave_forces of a hull whose coefficients have none, expected null");
}

/// Places the vertices in still water. Velocities stay those of the waves. Returns its height.
double Hull::still_water(const WaterKinematics& water, const HullState& state, HullWorkspace& workspace) const {
    const Frame* const frame = water.frame_or_null();
    const double level_m = frame ? frame->water_frame.sea_level_m : 0;
    for (HullWorkspace::Vertex& vertex : workspace.vertices)
        vertex.depth_m = vertex.head_m = level_m - (state.position_m.y + vertex.arm_m.y);
    return level_m;
}

/// Adds radiation and the forces of waves.
/// \param radiates  what remains of the square of the waves that a submerged hull makes
void Hull::add_given(const WaterKinematics& water, const HullState& state, double step_s, const HullInputs& inputs,
                     double radiates, HullLoads& loads) const {
    const glm::dmat3 axes = glm::mat3_cast(state.orientation), to_hull = glm::transpose(axes);
    loads.radiation_share = loads.submersion * std::sqrt(radiates);
    const double share = loads.radiation_share;
    RadiationStep memory = begin_step(options_.coefficients->radiation(), state.radiation, step_s);
    Vector6 relative = joined(to_hull * state.velocity_mps, to_hull * state.angular_velocity_radps);
    const Vector6 of_water = radiation_water(state, inputs, loads);
    for (std::size_t i = 0; i < 6; ++i) {
        relative[i] -= of_water[i];
        memory.force[i] *= share;
        for (double& damping : memory.damping[i]) damping *= share * share;
    }
    const Vector6 damped = product(memory.damping, relative);
    for (std::size_t i = 0; i < 6; ++i) memory.force[i] -= damped[i];
    loads.radiation = {axes * first_half(memory.force), axes * second_half(memory.force)};
    loads.radiation_damping = memory.damping;
    if (!inputs.wave_forces) return;

    loads.added_mass = {};
    const Frame* const frame = water.frame_or_null();
    const WaterFrame::Origin origin = frame ? frame->water_frame.origin_at(water.time_s()) : WaterFrame::Origin{};
    const double heading_rad = angle_of(axes[0].x, axes[0].z);
    const Vector6 force = inputs.wave_forces->force(state.position_m.x - origin.x_m, state.position_m.z - origin.z_m,
                                                    heading_rad, water.time_s());
    // Axes of the hull upright: forward, up and starboard.
    const double level = std::sqrt(axes[0].x * axes[0].x + axes[0].z * axes[0].z);
    const double cosine = level > 0 ? axes[0].x / level : 1, sine = level > 0 ? axes[0].z / level : 0;
    const glm::dmat3 upright(glm::dvec3(cosine, 0, sine), glm::dvec3(0, 1, 0), glm::dvec3(-sine, 0, cosine));
    loads.pressure += {share * (upright * first_half(force)), share * (upright * second_half(force))};
}

/// Advances the memory of radiation by a step.
/// \param mean_velocity  of the step, in axes of the hull
void Hull::remember(HullState& state, const HullLoads& loads, double step_s, const HullInputs& inputs,
                    const Vector6& mean_velocity) const {
    Vector6 relative = mean_velocity;
    const Vector6 of_water = radiation_water(state, inputs, loads);
    for (std::size_t i = 0; i < 6; ++i) relative[i] = loads.radiation_share * (relative[i] - of_water[i]);
    pelagic::complete_step(options_.coefficients->radiation(), state.radiation, step_s, relative);
}

}  // namespace pelagic
