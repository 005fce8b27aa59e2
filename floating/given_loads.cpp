// Loads of a hull by given coefficients.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "pelagic/floating/given_coefficients.hpp"
#include "pelagic/floating/hull.hpp"
#include "pelagic/floating/matrix6.hpp"
#include "pelagic/floating/radiation_states.hpp"
#include "pelagic/floating/wet_surface.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/direction.hpp"

namespace pelagic {
namespace {

/// Returns the velocity of the water that given radiation is relative to, in axes of the hull.
Vector6 radiation_water(const HullState& state, const HullInputs& inputs, const HullLoads& loads) {
    if (inputs.diffraction) return {};
    const glm::dmat3 to_hull = glm::transpose(glm::mat3_cast(state.orientation));
    return joined(to_hull * loads.water_velocity_mps, to_hull * loads.water_rotation_radps);
}

}  // namespace

/// Checks that the hull floats, and moves with any fraction of the added mass: all pivots are positive.
void Hull::check_mass() const {
    if (!afloat_.floats) throw std::invalid_argument("coefficients need a hull that floats, and this one sinks");
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
    if (diffraction_ && !inputs.diffraction)
        throw std::invalid_argument(
            "the inputs have no diffraction, expected that of a sea: the hull's coefficients have wave forces");
    if (!diffraction_ && inputs.diffraction)
        throw std::invalid_argument(
            "the inputs have diffraction, expected null: the hull's coefficients have no wave forces");
}

/// Subtracts from the given forces those of the pressure of undisturbed waves (Froude and Krylov's) on the hull at
/// rest: rho g exp(k y - i k s), s the distance from the centre of mass along the wave.
void Hull::find_diffraction() {
    if (!options_.coefficients->excitation()) return;
    // Pressure is linear on each triangle, as in Hydrostatics: a sum over vertices.
    struct Node {
        glm::dvec3 force{}, torque{};
    };
    std::map<std::array<double, 3>, Node> nodes;
    const auto vertex = [&](std::uint32_t i) {
        const double depth_m = -(afloat_.height_m + arms_m_[i].y);
        return HullVertex{arms_m_[i], glm::dvec3{}, depth_m, depth_m};
    };
    for (const auto& [a, b, c] : triangles_)
        cut_at_waterline(
            {vertex(a), vertex(b), vertex(c)},
            [&](const HullTriangle& wet) {
                const glm::dvec3 area = wet.area_m2(), arms = wet.a.arm_m + wet.b.arm_m + wet.c.arm_m;
                for (const HullVertex* const of : {&wet.a, &wet.b, &wet.c}) {
                    Node& node = nodes[{of->arm_m.x, of->arm_m.y, of->arm_m.z}];
                    node.force -= area / 3.0;
                    node.torque += glm::cross(area, arms + of->arm_m) / 12.0;
                }
            },
            [](const HullTriangle&) {});
    ForceTable table = WaveForces::at_each_heading(*options_.coefficients->excitation());
    const double weight_npm3 = options_.water_density_kgpm3 * gravity_mps2;
    std::vector<std::pair<double, double>> directions;  // cosine, sine
    for (const double heading : table.heading_rad) {
        const auto [sine, cosine] = det::sine_cosine_of_turns(heading / two_pi);
        directions.emplace_back(cosine, sine);
    }
    ForceTable::Forces* row = table.forces.data();
    for (const double omega : table.omega_radps) {
        const double k = omega * omega / gravity_mps2;
        for (const auto& [at, node] : nodes) {
            const double pressure = weight_npm3 * det::exp(k * std::min(at[1] + afloat_.height_m, 0.0));
            const Vector6 of = joined(node.force, node.torque);
            for (std::size_t h = 0; h < directions.size(); ++h) {
                const double along_m = at[0] * directions[h].first + at[2] * directions[h].second;
                const auto [sine, cosine] = det::sine_cosine_of_turns(-k * along_m / two_pi);
                for (std::size_t mode = 0; mode < 6; ++mode)
                    row[h][mode] -= std::complex<double>(pressure * cosine * of[mode], pressure * sine * of[mode]);
            }
        }
        row += directions.size();
    }
    diffraction_ = std::make_shared<const ForceTable>(std::move(table));
}

/// Adds radiation and diffraction.
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
    if (!inputs.diffraction) return;

    loads.added_mass = {};
    const Frame* const frame = water.frame_or_null();
    const WaterFrame::Origin origin = frame ? frame->water_frame.origin_at(water.time_s()) : WaterFrame::Origin{};
    const double heading_rad = angle_of(axes[0].x, axes[0].z);
    const Vector6 force = inputs.diffraction->force(state.position_m.x - origin.x_m, state.position_m.z - origin.z_m,
                                                    heading_rad, water.time_s());
    // In axes of the hull, as the radiation: in long waves both cancel, and no mean force remains.
    loads.pressure += {share * (axes * first_half(force)), share * (axes * second_half(force))};
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
