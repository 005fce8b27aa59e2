#include "pelagic/viewer/steered_boat.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "pelagic/gl/meshes/boat.hpp"
#include "pelagic/jobs/executor.hpp"

namespace pelagic::viewer {
namespace {

constexpr double mass_kg = 4400;
/// Above the centre of buoyancy, so that the boat floats level, and low, as with ballast.
constexpr glm::dvec3 centre_of_mass_m(-0.62, -0.1, 0);
/// Half of those of a box, for a hull with a sharp bow.
constexpr double pressure_coefficient = 0.35, suction_coefficient = 0.17;
constexpr double roll_damping = 0.3;  // with bilge keels

/// Enough to plane: a third of the weight takes it over its bow wave at 4 m/s.
constexpr double thrust_n = 14e3, astern_fraction = 0.4;
constexpr glm::dvec3 propeller_m(-3.4, -0.4, 0);
constexpr double largest_rudder_rad = 0.35;
/// Rudder and skeg. The lift of a flat plate at a small angle of attack, at half the slope of an
/// endless one.
constexpr double rudder_m2 = 0.5, lift_slope = 3;
constexpr double water_kgpm3 = 1025;

Hull boat_hull() {
    const gl::Boat::Surface surface = gl::Boat::hull();
    return Hull(HullMesh(surface.vertices, surface.triangles), {.mass_kg = mass_kg,
                                                                .centre_of_mass_m = centre_of_mass_m,
                                                                .roll_damping = roll_damping,
                                                                .pressure_coefficient = pressure_coefficient,
                                                                .suction_coefficient = suction_coefficient});
}

}  // namespace

SteeredBoat::SteeredBoat(const Frame& frame, glm::dvec2 place_m, double heading_rad)
    : hull_(boat_hull()),
      bodies_(std::make_unique<FloatingBodies>(make_serial_executor())),
      body_(bodies_->add(hull_, hull_.at_rest(WaterQuery(frame), place_m.x, place_m.y, heading_rad))),
      thrown_(hull_) {}

void SteeredBoat::float_on(DynamicWaves& waves) {
    const HullState state = bodies_->state(body_);
    bodies_ = std::make_unique<FloatingBodies>(make_serial_executor(), &waves);
    body_ = bodies_->add(hull_, state);
}

void SteeredBoat::leave_water() { bodies_->clear(); }

HullForce SteeredBoat::engine_and_rudder(const Helm& helm) const {
    const glm::dmat3 axes = glm::mat3_cast(state().orientation);
    const glm::dvec3 arm = axes * (propeller_m - hull_.centre_of_mass_m());
    const double thrust = std::clamp(helm.thrust, -1., 1.) * thrust_n * (helm.thrust < 0 ? astern_fraction : 1);
    const double angle = std::clamp(helm.rudder, -1., 1.) * largest_rudder_rad;
    const glm::dvec3 water = bodies_->loads(body_).water_velocity_mps;
    const glm::dvec3 flow = state().velocity_mps + glm::cross(state().angular_velocity_radps, arm) - water;
    const double ahead_mps = glm::dot(axes[0], flow), aside_mps = glm::dot(axes[2], flow);
    // The rudder turns the propeller's wash with it, and lifts in the water that passes.
    const double lift =
        0.5 * water_kgpm3 * rudder_m2 * lift_slope * std::fabs(ahead_mps) * (angle * ahead_mps + aside_mps);
    const glm::dvec3 force =
        thrust * std::cos(angle) * axes[0] - (std::max(thrust, 0.) * std::sin(angle) + lift) * axes[2];
    const HullLoads& loads = bodies_->loads(body_);
    const double surface_m = loads.water_height_m + loads.water_slope_x * arm.x + loads.water_slope_z * arm.z;
    return state().position_m.y + arm.y < surface_m ? HullForce{force, glm::cross(arm, force)} : HullForce{};
}

void SteeredBoat::advance(const Frame& frame, double passed_s, const Helm& helm) {
    if (!(passed_s > 0)) return;
    bodies_->set_inputs(body_, {.force = engine_and_rudder(helm)});
    bodies_->step(frame, passed_s);
    bodies_->press(frame, passed_s);
    thrown_.update(WaterQuery(frame), state(), bodies_->loads(body_), passed_s, workspace_,
                   bodies_->inputs(body_).wake);
}

glm::dvec2 SteeredBoat::place_m() const {
    const glm::dvec3 at = hull_.mesh_origin_m(state());
    return {at.x, at.z};
}

double SteeredBoat::heading_rad() const {
    const glm::dvec3 ahead = glm::mat3_cast(state().orientation)[0];
    return std::atan2(ahead.z, ahead.x);
}

double SteeredBoat::speed_mps() const {
    return glm::dot(glm::mat3_cast(state().orientation)[0], state().velocity_mps);
}

glm::dmat4 SteeredBoat::world_from_boat() const {
    return glm::translate(glm::dmat4(1), hull_.mesh_origin_m(state())) * glm::mat4_cast(state().orientation);
}

}  // namespace pelagic::viewer
