// Sums of forces over a hull's triangles.
#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <limits>
#include <span>

#include "pelagic/floating/hull.hpp"
#include "pelagic/floating/hull_wake.hpp"
#include "pelagic/floating/matrix6.hpp"
#include "pelagic/floating/wet_surface.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

/// A force and its torque, and the power that the hull loses to it: at most 0.
struct Loss {
    HullForce force;
    double power_w = 0;

    void add(const glm::dvec3& arm_m, const glm::dvec3& force_n, const glm::dvec3& relative_mps) {
        force += {force_n, glm::cross(arm_m, force_n)};
        power_w += glm::dot(force_n, relative_mps);
    }
};

/// Returns the depth of the highest vertex below the surface, 0 if a vertex is above it.
double submergence_m(std::span<const HullVertex> vertices) {
    double least_m = std::numeric_limits<double>::infinity();
    for (const HullVertex& vertex : vertices) least_m = std::min(least_m, vertex.depth_m);
    return std::max(least_m, 0.0);
}

/// The plane through the water's heights and vertical velocities at the vertices, by least squares.
struct MeanWater {
    double x_m = 0, z_m = 0;  // of the vertices, from the centre of mass
    double height_m = 0;
    glm::dvec3 velocity_mps{};
    double slope_x = 0, slope_z = 0;        // of the height
    double gradient_x = 0, gradient_z = 0;  // of the vertical velocity, 1/s
    // vertical velocity of the waves that HullWake acts on
    double wake_mps = 0, wake_gradient_x = 0, wake_gradient_z = 0;
};

MeanWater mean_water(std::span<const double> weights, std::span<const HullVertex> vertices, double height_m,
                     const glm::dvec3& velocity_mps, const glm::dvec3& angular_velocity_radps) {
    double x = 0, y = 0, z = 0, h = 0, w = 0, xx = 0, xz = 0, zz = 0, xh = 0, zh = 0, xv = 0, zv = 0, xw = 0, zw = 0;
    glm::dvec3 relative{};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const HullVertex& vertex = vertices[i];
        const double of_x = weights[i] * vertex.arm_m.x, of_z = weights[i] * vertex.arm_m.z;
        const double height = vertex.arm_m.y + vertex.depth_m, up = vertex.relative_mps.y;
        x += of_x, y += weights[i] * vertex.arm_m.y, z += of_z;
        h += weights[i] * height, w += weights[i] * vertex.wake_up_mps;
        relative += weights[i] * vertex.relative_mps;
        xx += of_x * vertex.arm_m.x, xz += of_x * vertex.arm_m.z, zz += of_z * vertex.arm_m.z;
        xh += of_x * height, zh += of_z * height, xv += of_x * up, zv += of_z * up;
        xw += of_x * vertex.wake_up_mps, zw += of_z * vertex.wake_up_mps;
    }
    MeanWater mean;
    mean.x_m = x;
    mean.z_m = z;
    mean.height_m = height_m + h;
    mean.wake_mps = w;
    // the hull's velocity at the middle of the vertices, without theirs in the water
    mean.velocity_mps =
        velocity_mps + glm::cross(angular_velocity_radps, glm::dvec3(x, y, z)) - relative;
    xx -= x * x, xz -= x * z, zz -= z * z;
    const double determinant = xx * zz - xz * xz;
    if (determinant > 1e-9 * xx * zz) {
        const auto along_x = [&](double of_x, double of_z) { return (zz * of_x - xz * of_z) / determinant; };
        const auto along_z = [&](double of_x, double of_z) { return (xx * of_z - xz * of_x) / determinant; };
        mean.slope_x = along_x(xh - x * h, zh - z * h);
        mean.slope_z = along_z(xh - x * h, zh - z * h);
        mean.gradient_x = angular_velocity_radps.z - along_x(xv - x * relative.y, zv - z * relative.y);
        mean.gradient_z = -angular_velocity_radps.x - along_z(xv - x * relative.y, zv - z * relative.y);
        mean.wake_gradient_x = along_x(xw - x * w, zw - z * w);
        mean.wake_gradient_z = along_z(xw - x * w, zw - z * w);
    }
    return mean;
}

/// Changes of the water's motion in the volume that a hull displaces.
struct WaterChange {
    glm::dvec3 acceleration_mps2{};
    /// Change of rotation: that of a rigid volume on which the water's accelerations have the same moment.
    glm::dvec3 rotation_radps2{};
};

// Waves break before the surface falls freely.
double limited(double mps2) { return std::clamp(mps2, -gravity_mps2, gravity_mps2); }

/// Returns the means over the displaced volume. The pressure's force is that of gravity and
/// acceleration on the displaced water, because pressure is 0 on its surface; so is its torque.
/// \param middle_y_m     middle of the displaced volume, from the centre of mass
/// \param displaced_m5   second moments of the volume along the world's axes
WaterChange water_change(const Hydrostatics& wet, double middle_y_m, const glm::dvec3& displaced_m5) {
    WaterChange change;
    if (!(wet.volume_m3 > 0)) return change;
    const glm::dvec3 middle(wet.volume_x_m4 / wet.volume_m3, middle_y_m, wet.volume_z_m4 / wet.volume_m3);
    const glm::dvec3 excess = wet.force_m3 - glm::dvec3(0, wet.volume_m3, 0);
    for (int axis = 0; axis < 3; ++axis)
        change.acceleration_mps2[axis] = limited(gravity_mps2 * excess[axis] / wet.volume_m3);
    const glm::dvec3 torque = wet.torque_m4 - glm::cross(middle, wet.force_m3);
    const glm::dvec3 moments(displaced_m5.y + displaced_m5.z, displaced_m5.x + displaced_m5.z,
                             displaced_m5.x + displaced_m5.y);
    change.rotation_radps2 = gravity_mps2 * torque / moments;
    return change;
}

/// -d pressure / d pose in world axes, about the centre of mass: what the waterplane and the lever
/// of the buoyancy add.
HullMatrix world_stiffness(const Hydrostatics& wet, double weight_npm3, double buoyancy_y_m3) {
    // Rows of the deflection of a point at (x, z): 1 for heave, -z for rotation about x, x about z.
    const double cells[3][3] = {{wet.waterplane_m2, -wet.z_m3, wet.x_m3},
                                {-wet.z_m3, wet.zz_m4, -wet.xz_m4},
                                {wet.x_m3, -wet.xz_m4, wet.xx_m4}};
    constexpr std::size_t axes[] = {1, 3, 5};
    HullMatrix matrix{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) matrix[axes[i]][axes[j]] = weight_npm3 * cells[i][j];
    for (const std::size_t axis : {3, 5}) matrix[axis][axis] += weight_npm3 * buoyancy_y_m3;
    return matrix;
}

/// Rotates a matrix of world axes to those of the hull.
HullMatrix in_hull(const HullMatrix& world, const glm::dmat3& axes) {
    HullMatrix result{};
    for (const std::size_t row : {0, 3})
        for (const std::size_t column : {0, 3}) {
            glm::dmat3 block{0};
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                    block[j][i] = world[row + static_cast<std::size_t>(i)][column + static_cast<std::size_t>(j)];
            add_block(result, row, column, 1, glm::transpose(axes) * block * axes);
        }
    return result;
}

}  // namespace

void Hull::append_points(const HullState& state, HullWorkspace& workspace) const {
    const glm::dmat3 axes = glm::mat3_cast(state.orientation);
    for (const glm::dvec3& arm : arms_m_) {
        const glm::dvec3 at = state.position_m + axes * arm;
        workspace.x.push_back(at.x);
        workspace.y.push_back(at.y);
        workspace.z.push_back(at.z);
    }
    workspace.parts.push_back({workspace.x.size(), footprint_m_, middle_weight_ < 1});
}

void Hull::place_vertices(const WaterKinematics& water, std::size_t first_point, const HullState& state,
                          const HullWake* wake, HullWorkspace& workspace) const {
    workspace.wake_m.assign(arms_m_.size(), 0);
    workspace.wake_up_mps.assign(arms_m_.size(), 0);
    const auto ours = [&](auto& values) { return std::span(values).subspan(first_point, arms_m_.size()); };
    const std::span<float> depths = ours(workspace.depth_m);
    workspace.depth_with_wake_m.assign(depths.begin(), depths.end());
    if (wake)
        workspace.wake_push = wake->leave_out_and_push(*water.frame_or_null(), &state, ours(workspace.x),
                                                       ours(workspace.z), depths, ours(workspace.velocity_y_mps),
                                                       workspace.wake_m, workspace.wake_up_mps);
    const glm::dmat3 axes = glm::mat3_cast(state.orientation);
    const double m_per_pascal = 1 / (water.water_density_kgpm3() * gravity_mps2);
    workspace.vertices.resize(arms_m_.size());
    for (std::size_t i = 0; i < arms_m_.size(); ++i) {
        const std::size_t point = first_point + i;
        HullVertex& vertex = workspace.vertices[i];
        vertex.arm_m = axes * arms_m_[i];
        vertex.depth_m = static_cast<double>(workspace.depth_m[point]);
        vertex.head_m = m_per_pascal * static_cast<double>(workspace.pressure_pa[point]) +
                        (vertex.depth_m - static_cast<double>(workspace.depth_with_wake_m[i]));
        vertex.relative_mps = state.velocity_mps + glm::cross(state.angular_velocity_radps, vertex.arm_m) -
                              glm::dvec3(workspace.velocity_x_mps[point], workspace.velocity_y_mps[point],
                                         workspace.velocity_z_mps[point]);
        if (middle_weight_ < 1) vertex.rise_mps2 = static_cast<double>(workspace.acceleration_y_mps2[point]);
        vertex.wake_m = workspace.wake_m[i];
        vertex.wake_up_mps = workspace.wake_up_mps[i];
    }
}

HullLoads Hull::loads_at(const WaterKinematics& water, std::size_t first_point, HullState& state, double step_s,
                         const HullInputs& inputs, HullWorkspace& workspace) const {
    const glm::dmat3 axes = glm::mat3_cast(state.orientation);
    place_vertices(water, first_point, state, inputs.wake, workspace);
    const std::vector<HullVertex>& vertices = workspace.vertices;
    const MeanWater mean =
        mean_water(weights_, vertices, state.position_m.y, state.velocity_mps, state.angular_velocity_radps);
    HullLoads loads;
    loads.water_velocity_mps = mean.velocity_mps;
    loads.water_slope_x = mean.slope_x;
    loads.water_slope_z = mean.slope_z;
    loads.water_height_m = mean.height_m - mean.slope_x * mean.x_m - mean.slope_z * mean.z_m;
    // a rotation about z lifts points at x, one about x lowers points at z
    loads.water_rotation_radps = {-mean.gradient_z, 0, mean.gradient_x};

    const double radiates = det::exp(-2 * heave_wave_number_ * submergence_m(vertices));
    Hydrostatics wet;
    double bottom_m2 = 0, bottom_rise = 0;  // of faces that look down, in plan, and their vertical acceleration's sum
    Loss drag;
    HullForce advancing;
    const double half_water = 0.5 * options_.water_density_kgpm3, half_air = 0.5 * options_.air_density_kgpm3;
    const auto add_wet = [&](const HullTriangle& triangle) {
        const glm::dvec3 area = triangle.area_m2(), relative = triangle.relative_mps(), arm = triangle.centre_m();
        wet.add(triangle, area);
        if (inputs.wake) wet.leave_out_wake(triangle, area);
        const double area_m4 = glm::dot(area, area);
        if (area_m4 == 0) return;
        const double flow = glm::dot(relative, area), across = flow / area_m4;  // along the normal
        const glm::dvec3 along = relative - across * area;
        const glm::dvec3 push = half_water * std::fabs(flow) * across *
                                (flow > 0 ? options_.pressure_coefficient : options_.suction_coefficient) * area;
        const double rub = half_water * options_.friction_coefficient * std::sqrt(area_m4 * glm::dot(along, along));
        drag.add(arm, -push - rub * along, relative);
        if (flow > 0) advancing += {-push, glm::cross(push, arm)};
        if (area.y >= 0) return;
        bottom_m2 -= area.y;
        bottom_rise -= HullTriangle::third * area.y *
                       (triangle.a.rise_mps2 + triangle.b.rise_mps2 + triangle.c.rise_mps2);
        // A strip across the length does not take part in roll.
        const glm::dvec3 on_axis = glm::dot(arm, axes[0]) * axes[0], aside = arm - on_axis;
        const glm::dvec3& spin = state.angular_velocity_radps;
        const double rise = relative.y - (spin.z * aside.x - spin.x * aside.z);
        const double damping_n = radiates * strip_damping_ * area.y * rise;
        drag.force += HullForce{{0, damping_n, 0}, {-damping_n * on_axis.z, 0, damping_n * on_axis.x}};
        drag.power_w += damping_n * rise;
    };
    const auto add_dry = [&](const HullTriangle& triangle) {
        const glm::dvec3 area = triangle.area_m2(), arm = triangle.centre_m();
        const glm::dvec3 relative =
            state.velocity_mps + glm::cross(state.angular_velocity_radps, arm) - inputs.wind_mps;
        const double flow = glm::dot(relative, area);
        if (flow <= 0) return;
        drag.add(arm, -half_air * options_.air_coefficient * flow * flow / glm::dot(area, area) * area, relative);
    };
    for (const auto& [a, b, c] : triangles_)
        cut_at_waterline({vertices[a], vertices[b], vertices[c]}, add_wet, add_dry);

    if (options_.skeg_m2 > 0) {
        constexpr double lift = 1.56, plate_drag = 1.17;
        const glm::dvec3 arm = axes * (glm::dvec3(options_.skeg_x_m, options_.skeg_y_m, 0) - centre_of_mass_m_);
        const glm::dvec3 relative =
            state.velocity_mps + glm::cross(state.angular_velocity_radps, arm) - mean.velocity_mps;
        const double depth_m = loads.water_height_m + loads.water_slope_x * arm.x + loads.water_slope_z * arm.z -
                               state.position_m.y - arm.y;
        const double submerged = std::clamp(0.5 + depth_m / std::sqrt(options_.skeg_m2), 0.0, 1.0);
        const double ahead = glm::dot(relative, axes[0]), across = glm::dot(relative, axes[2]);
        const double flow = lift * std::fabs(ahead) + plate_drag * std::fabs(across);
        drag.add(arm, -half_water * submerged * options_.skeg_m2 * flow * across * axes[2], relative);
    }

    loads.displaced_m3 = wet.volume_m3;
    // Given coefficients are those of the hull afloat: they fade below half of its volume.
    const double full_m3 = (options_.coefficients ? 0.5 : 1) * floating_volume_m3_;
    loads.submersion = std::clamp(loads.displaced_m3 / full_m3, 0.0, 1.0);
    const double roll = glm::dot(state.angular_velocity_radps - loads.water_rotation_radps, axes[0]);
    const double roll_nm = -radiates * roll_damping_ * loads.submersion * roll;
    drag.force.torque_nm += roll_nm * axes[0];
    drag.power_w += roll_nm * roll;

    const glm::dvec3 moments_m5 = glm::matrixCompMult(axes, axes) * displaced_m5_;
    // Dynamic waves do not decrease with depth in the water's pressure, but do so to first order by the vertical
    // acceleration of their surface, at a fixed position.
    double wake_change = 0;
    glm::dvec3 wake_spin_change{};
    const glm::dvec3 wake_rotation(-mean.wake_gradient_z, 0, mean.wake_gradient_x);
    if (inputs.wake && state.has_previous_step && step_s > 0) {
        wake_change = (mean.wake_mps - state.wake_velocity_y_mps) / step_s;
        // The surface turns the water of wide hulls, not that along deep ones.
        wake_spin_change = (wake_rotation - state.wake_rotation_radps) / step_s *
                           glm::dvec3(moments_m5.z / (moments_m5.y + moments_m5.z), 0,
                                      moments_m5.x / (moments_m5.x + moments_m5.y));
    }
    const double along_wake =
        state.velocity_mps.x * mean.wake_gradient_x + state.velocity_mps.z * mean.wake_gradient_z;
    const double wake_mps2 =
        inputs.wake && state.has_previous_step ? std::clamp(wake_change - along_wake, -gravity_mps2, gravity_mps2) : 0;
    wake_change = std::clamp(wake_change, -gravity_mps2, gravity_mps2);
    const double weight_npm3 = options_.water_density_kgpm3 * (gravity_mps2 + wake_mps2);
    loads.pressure = {weight_npm3 * wet.force_m3, weight_npm3 * wet.torque_m4};
    const double buoyancy_y_m3 = (mean.height_m - state.position_m.y) * loads.displaced_m3 - wet.depth_moment_m4;
    WaterChange change = water_change(wet, buoyancy_y_m3 / std::max(loads.displaced_m3, 1e-9), moments_m5);
    if (bottom_m2 > 0 && middle_weight_ < 1) {
        const double bottom_mps2 = limited(bottom_rise / bottom_m2);
        change.acceleration_mps2.y = bottom_mps2 + middle_weight_ * (change.acceleration_mps2.y - bottom_mps2);
    }
    loads.water_acceleration_mps2 = change.acceleration_mps2 + glm::dvec3(0, wake_mps2, 0);
    if (inputs.wake) loads.pressure += workspace.wake_push;
    loads.stiffness = in_hull(world_stiffness(wet, weight_npm3, buoyancy_y_m3), axes);

    const glm::dmat3 to_hull = glm::transpose(axes);
    const auto to_world = [&](const Vector6& v) { return HullForce{axes * first_half(v), axes * second_half(v)}; };
    for (std::size_t i = 0; i < 3; ++i) {
        loads.mass[i][i] = mass_kg_;
        loads.mass[i + 3][i + 3] = inertia_kgm2_[static_cast<int>(i)];
    }
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) loads.mass[i][j] += loads.submersion * added_mass_[i][j];
    // The added mass moves with the hull, so its momentum changes with the velocity of the water at
    // the hull. A steady wave that moves with the hull causes no change (Newman, chapter 7).
    const glm::dvec3 moved(0,
                           state.velocity_mps.x * (mean.gradient_x - mean.wake_gradient_x) +
                               state.velocity_mps.z * (mean.gradient_z - mean.wake_gradient_z),
                           0);
    const Vector6 acceleration =
        joined(to_hull * (change.acceleration_mps2 + moved + glm::dvec3(0, wake_change, 0)),
               to_hull * (change.rotation_radps2 + wake_spin_change));
    Vector6 inertial = product(added_mass_, acceleration);
    for (double& value : inertial) value *= loads.submersion;
    loads.added_mass = to_world(inertial);
    const auto in_axes = [&](const HullForce& force) {
        return joined(to_hull * force.force_n, to_hull * force.torque_nm);
    };
    const Vector6 relative = joined(to_hull * (state.velocity_mps - loads.water_velocity_mps),
                                    to_hull * (state.angular_velocity_radps - loads.water_rotation_radps));
    Vector6 slamming{}, slammed{};
    if (state.has_previous_step && step_s > 0 && loads.submersion > state.submersion) {
        slamming = product(added_mass_, relative);
        for (double& value : slamming) value *= (state.submersion - loads.submersion) / step_s;
        loads.slamming = to_world(slamming);
        slammed = solve(loads.mass, slamming);
    }
    // A long step would reverse the motion that drag opposes: the part that stops it is enough.
    const Vector6 dragged = in_axes(drag.force), stopped = solve(loads.mass, dragged);
    const double kick = step_s * dot(dragged, stopped);
    const double kept = kick > -drag.power_w ? -drag.power_w / kick : 1;
    loads.drag = {kept * drag.force.force_n, kept * drag.force.torque_nm};
    // Power at the speeds after the losses: the energy of hull and added mass then falls by half of
    // that of slamming, and by no less than that of the drag.
    const Vector6 advanced = in_axes(advancing);
    double impact_w = 0;
    for (std::size_t i = 0; i < 6; ++i)
        impact_w -= (slamming[i] + kept * advanced[i]) * (relative[i] + step_s * (slammed[i] + kept * stopped[i]));
    loads.impact_n = glm::length(loads.slamming.force_n) + kept * glm::length(advancing.force_n);
    loads.impact_w = std::max(impact_w, 0.0);
    if (options_.coefficients) add_given(water, state, step_s, inputs, radiates, loads);

    state.wake_velocity_y_mps = mean.wake_mps;
    state.wake_rotation_radps = wake_rotation;
    state.submersion = loads.submersion;
    state.has_previous_step = true;
    return loads;
}

HullLoads Hull::loads(const WaterKinematics& water, HullState& state, double step_s, const HullInputs& inputs,
                      HullWorkspace& workspace) const {
    const DefaultFloatEnvironment environment(step_s);
    check_step(water, inputs, step_s);
    check_waves(inputs);
    require(check(state));
    require(check(inputs));
    workspace.clear();
    append_points(state, workspace);
    workspace.sample(water);
    const HullLoads result = loads_at(water, 0, state, step_s, inputs, workspace);
    if (options_.coefficients) {
        const glm::dmat3 to_hull = glm::transpose(glm::mat3_cast(state.orientation));
        remember(state, result, step_s, inputs,
                 joined(to_hull * state.velocity_mps, to_hull * state.angular_velocity_radps));
    }
    return result;
}

void HullWorkspace::clear() {
    for (auto* positions : {&x, &y, &z}) positions->clear();
    parts.clear();
}

void HullWorkspace::sample(const WaterKinematics& water) {
    for (auto* values : {&depth_m, &pressure_pa, &velocity_x_mps, &velocity_y_mps, &velocity_z_mps,
                         &acceleration_y_mps2})
        values->resize(x.size());
    // A hull that touches the ground has the water there.
    for (double& height : y) height = std::max(height, water.floor_m());
    // Hulls differ in their footprints, and none depends on others.
    std::size_t first = 0;
    for (const Part& part : parts) {
        const auto of = [&](auto& all) { return std::span(all).subspan(first, part.end - first); };
        water.sample({.x = of(x), .y = of(y), .z = of(z), .footprint_m = part.footprint_m, .whole_cascades = true},
                     {.depth_m = of(depth_m),
                      .pressure_pa = of(pressure_pa),
                      .velocity_x_mps = of(velocity_x_mps),
                      .velocity_y_mps = of(velocity_y_mps),
                      .velocity_z_mps = of(velocity_z_mps),
                      .acceleration_y_mps2 = part.has_rise ? of(acceleration_y_mps2) : std::span<float>()});
        first = part.end;
    }
}

}  // namespace pelagic
