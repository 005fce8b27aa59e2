// A step of a hull.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pelagic/floating/hull.hpp"
#include "pelagic/floating/matrix6.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

/// Rotates by a constant angular velocity. The quaternion (1, w t / 2) has the tangent of the half
/// angle where the sine belongs (Cayley's map), which needs no trigonometry.
glm::dquat rotated(const glm::dquat& orientation, const glm::dvec3& angular_velocity_radps, double seconds) {
    const glm::dvec3 half = 0.5 * seconds * angular_velocity_radps;
    const glm::dquat turn(1, half.x, half.y, half.z);
    const glm::dquat result = turn * orientation;
    return result / std::sqrt(glm::dot(result, result));
}

}  // namespace

void Hull::drift(HullState& state, double seconds) {
    state.position_m += seconds * state.velocity_mps;
    state.orientation = rotated(state.orientation, state.angular_velocity_radps, seconds);
}

// A step first reduces the velocities u by drag and slamming, to u1, and then applies forces with a
// potential from u1 to u2 = u1 + du, (dv, dw) in the hull's axes:
//
//   m dv + A11 (dv - t w_m x v_m) + A12 dw                   + t^2/4 (K du)_v = t F
//   I dw - t (I w_m) x w_m + A22 dw + A21 (dv - t w_m x v_m) + t^2/4 (K du)_w = t T
//
// with v_m = v1 + dv/2 and w_m = w1 + dw/2: rotation of the axes does no work. The stiffness K
// carries the pressure from the pose where it was computed, half a step of u away from the
// beginning, to the middle of the motion, (u1 + u2) t/4 away, where a linear force conserves energy
// exactly.
struct Hull::Speeds {
    Vector6 damped, after;
};

/// Returns the matrix whose product with the velocities is minus the forces of the axes' rotation.
HullMatrix Hull::turning_by(const glm::dvec3& spin, double submersion) const {
    HullMatrix turning{};
    for (std::size_t row = 0; row < 6; ++row) {
        const glm::dvec3 added(added_mass_[row][0], added_mass_[row][1], added_mass_[row][2]);
        // added . (w x v) = (added x w) . v
        const glm::dvec3 by_velocity = -submersion * glm::cross(added, spin);
        for (std::size_t column = 0; column < 3; ++column)
            turning[row][column] = by_velocity[static_cast<int>(column)];
    }
    add_block(turning, 3, 3, -1, cross_matrix(inertia_kgm2_ * spin));
    return turning;
}

Hull::Speeds Hull::speeds_after(const HullState& state, const HullLoads& loads, double step_s,
                                const HullInputs& inputs) const {
    const glm::dmat3 to_hull = glm::transpose(glm::mat3_cast(state.orientation));
    const auto in_hull = [&](const HullForce& force) {
        return joined(to_hull * force.force_n, to_hull * force.torque_nm);
    };
    const Vector6 before = joined(to_hull * state.velocity_mps, to_hull * state.angular_velocity_radps);
    HullForce losses = loads.drag;
    losses += loads.slamming;
    const Vector6 lost = solve(loads.mass, in_hull(losses));
    Vector6 damped = before;
    for (std::size_t i = 0; i < 6; ++i) damped[i] += step_s * lost[i];

    HullForce sum = loads.pressure;
    sum += loads.added_mass;
    sum += inputs.force;
    sum.force_n.y -= mass_kg_ * gravity_mps2;
    Vector6 forces = in_hull(sum);
    const Vector6 moved = product(loads.stiffness, lost);
    HullMatrix constant = loads.mass;  // what multiplies the change, but for rotation and stiffness
    if (options_.coefficients) {
        // Radiation at the mean velocity, which is `damped` and half of the change.
        Vector6 reduced = before;
        for (std::size_t i = 0; i < 6; ++i) reduced[i] -= damped[i];
        const Vector6 radiation = in_hull(loads.radiation), less = product(loads.radiation_damping, reduced);
        for (std::size_t i = 0; i < 6; ++i) {
            forces[i] += radiation[i] + less[i];
            for (std::size_t j = 0; j < 6; ++j) constant[i][j] += 0.5 * step_s * loads.radiation_damping[i][j];
        }
    }
    Vector6 change{};
    // Passes approach the spin at the middle of the step.
    for (int pass = 0; pass < 3; ++pass) {
        const glm::dvec3 spin = second_half(damped) + 0.5 * second_half(change);
        const HullMatrix turning = turning_by(spin, loads.submersion);
        const Vector6 turned = product(turning, damped);
        Vector6 right;
        HullMatrix matrix = constant;
        for (std::size_t i = 0; i < 6; ++i) {
            right[i] = step_s * (forces[i] - turned[i] - 0.5 * step_s * step_s * moved[i]);
            for (std::size_t j = 0; j < 6; ++j)
                matrix[i][j] += 0.5 * step_s * turning[i][j] + 0.25 * step_s * step_s * loads.stiffness[i][j];
        }
        change = solve(matrix, right);
    }
    Speeds speeds{damped, damped};
    for (std::size_t i = 0; i < 6; ++i) speeds.after[i] += change[i];
    return speeds;
}

void Hull::accelerate(HullState& state, const HullLoads& loads, double step_s, const HullInputs& inputs) const {
    const DefaultFloatEnvironment environment(step_s);
    const Vector6 after = speeds_after(state, loads, step_s, inputs).after;
    const glm::dmat3 axes = glm::mat3_cast(state.orientation);
    state.velocity_mps = axes * first_half(after);
    state.angular_velocity_radps = axes * second_half(after);
}

Hull::Steps::Steps(double step_s) {
    constexpr double longest_s = 0.1, longest_sum_s = 1;
    const double sum_s = std::min(step_s, longest_sum_s);
    count = static_cast<int>(std::ceil(sum_s / longest_s));
    each_s = count > 0 ? sum_s / count : 0;
    are_all = sum_s == step_s;
}

bool Hull::step(const WaterKinematics& water, HullState& state, double step_s, const HullInputs& inputs,
                HullWorkspace& workspace) const {
    check_step(water, inputs, step_s);
    check_waves(inputs);
    require(check(state));
    require(check(inputs));
    HullLoads loads;
    const Moving moving{*this, state, inputs, loads};
    return advance(water, {&moving, 1}, step_s, workspace);
}

bool Hull::advance(const WaterKinematics& water, std::span<const Moving> hulls, double step_s,
                   HullWorkspace& workspace) {
    const DefaultFloatEnvironment environment(step_s);
    const Steps steps(step_s);
    // The frame does not show how the water moves in the parts of a step.
    if (steps.count > 1)
        for (const Moving& of : hulls) of.state.has_previous_step = false;
    for (int i = 0; i < steps.count; ++i) {
        workspace.clear();
        for (const Moving& of : hulls) {
            drift(of.state, 0.5 * steps.each_s);
            of.hull.append_points(of.state, workspace);
        }
        workspace.sample(water);
        std::size_t point = 0;
        for (const Moving& of : hulls) {
            of.loads = of.hull.loads_at(water, point, of.state, steps.each_s, of.inputs, workspace);
            of.hull.complete_step(of.state, of.loads, steps.each_s, of.inputs);
            point += of.hull.arms_m_.size();
        }
    }
    return steps.are_all;
}

void Hull::complete_step(HullState& middle, const HullLoads& forces, double step_s, const HullInputs& inputs) const {
    const Speeds speeds = speeds_after(middle, forces, step_s, inputs);
    const glm::dmat3 axes = glm::mat3_cast(middle.orientation);
    if (options_.coefficients) {
        Vector6 mean;
        for (std::size_t i = 0; i < 6; ++i) mean[i] = 0.5 * (speeds.damped[i] + speeds.after[i]);
        remember(middle, forces, step_s, inputs, mean);
    }
    // The first half moved with the velocity before the losses.
    HullState correction = middle;
    correction.velocity_mps = axes * first_half(speeds.damped) - middle.velocity_mps;
    correction.angular_velocity_radps = axes * second_half(speeds.damped) - middle.angular_velocity_radps;
    drift(correction, 0.5 * step_s);
    middle.position_m = correction.position_m;
    middle.orientation = correction.orientation;
    middle.velocity_mps = axes * first_half(speeds.after);
    middle.angular_velocity_radps = axes * second_half(speeds.after);
    drift(middle, 0.5 * step_s);
}

}  // namespace pelagic
