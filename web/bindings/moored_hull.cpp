#include "pelagic/web/bindings/moored_hull.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <utility>

namespace pelagic::web {
namespace {

/// Longest time between frames over which the hull moves.
constexpr double max_step_s = 1;
/// Damping of the mooring over the critical one: a hull that is pulled aside returns without overshoot.
constexpr double mooring_damping = 1;

}  // namespace

MooredHull::MooredHull(Hull hull, const Mooring& mooring) : hull_(std::move(hull)), mooring_(mooring) {}

void MooredHull::follow(const Frame& frame, double time_s) {
    const WaterQuery water(frame);
    const double step_s = time_s_ ? time_s - *time_s_ : -1;
    if (step_s >= 0 && step_s <= max_step_s)
        hull_.step(water, state_, step_s, {.force = pull()}, workspace_);
    else
        put_on(water);
    time_s_ = time_s;
}

void MooredHull::put_on(const WaterQuery& water) {
    state_ = hull_.at_rest(water, mooring_.x_m, mooring_.z_m, mooring_.heading_rad);
    // A hull much smaller than the waves heels with their slope (W. Froude, "On the rolling of ships", 1861).
    HullState seen = state_;
    const HullLoads loads = hull_.loads(water, seen, 0, {}, workspace_);
    const glm::dvec3 up = glm::normalize(glm::dvec3(-loads.water_slope_x, 1, -loads.water_slope_z));
    const glm::dquat heel(glm::dvec3(0, 1, 0), up);
    state_.orientation = glm::normalize(heel * state_.orientation);
    state_.position_m.y = loads.water_height_m + hull_.afloat().height_m;
}

HullForce MooredHull::pull() const {
    if (mooring_.period_s <= 0) return {};
    const double rate = 2 * std::numbers::pi / mooring_.period_s;
    const double damping = 2 * mooring_damping * rate;
    glm::dvec3 away = state_.position_m - glm::dvec3(mooring_.x_m, 0, mooring_.z_m), velocity = state_.velocity_mps;
    away.y = velocity.y = 0;
    const glm::dvec3 bow = state_.orientation * glm::dvec3(1, 0, 0);
    const glm::dvec3 wanted(std::cos(mooring_.heading_rad), 0, std::sin(mooring_.heading_rad));
    const double turn = glm::cross(bow, wanted).y;  // the sine of what is missing, about y
    // A hull's radius of gyration in yaw is about a quarter of its length.
    const double radius_m = (hull_.mesh().upper_m().x - hull_.mesh().lower_m().x) / 4;
    HullForce force;
    force.force_n = -hull_.mass_kg() * (rate * rate * away + damping * velocity);
    force.torque_nm.y = hull_.mass_kg() * radius_m * radius_m *
                        (rate * rate * turn - damping * state_.angular_velocity_radps.y);
    return force;
}

glm::dmat4 MooredHull::world_from_mesh() const {
    glm::dmat4 matrix = glm::mat4_cast(state_.orientation);
    matrix[3] = glm::dvec4(hull_.mesh_origin_m(state_), 1);
    return matrix;
}

}  // namespace pelagic::web
