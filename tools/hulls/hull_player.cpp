#include "pelagic/tools/hulls/hull_player.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "pelagic/floating/given_coefficients.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

constexpr double hull_step_s = 1.0 / HullPlayer::steps_per_s;

std::int64_t first_step(double first_s) {
    return static_cast<std::int64_t>(std::floor((first_s - HullPlayer::launch_s) * HullPlayer::steps_per_s));
}

double time_of(std::int64_t step) { return static_cast<double>(step) / HullPlayer::steps_per_s; }

/// Returns the foam behind a stern. The water closes there as a breaker, at most as high as the head of
/// the speed and half of the beam; by eye.
std::array<Disturbance, 2> stern_foam(const Hull& hull, const HullState& state, const HullLoads& loads) {
    const HullMesh& mesh = hull.mesh();
    const double stern_m = mesh.lower_m().x, length_m = mesh.upper_m().x - stern_m;
    double half_beam_m = 0.001;
    for (const glm::dvec3& vertex : mesh.vertices())
        if (vertex.x < stern_m + 0.05 * length_m) half_beam_m = std::max(half_beam_m, std::fabs(vertex.z));
    const glm::dmat3 axes = glm::mat3_cast(state.orientation);
    const double speed_mps = std::max(glm::dot(axes[0], state.velocity_mps - loads.water_velocity_mps), 0.0);
    const double head_m = speed_mps * speed_mps / (2 * gravity_mps2);
    Disturbance foam{.mode = Disturbance::Mode::foam,
                     .radius_m = std::min(0.65 * half_beam_m, 1000.0),
                     .height_m = std::min({head_m, half_beam_m, 100.0})};
    std::array<Disturbance, 2> both = {foam, foam};
    for (std::size_t side = 0; side < both.size(); ++side) {
        const double z_m = (side == 0 ? -0.5 : 0.5) * half_beam_m;
        const glm::dvec3 at = hull.mesh_origin_m(state) + axes * glm::dvec3(stern_m, 0, z_m);
        both[side].x_m = at.x;
        both[side].z_m = at.z;
    }
    return both;
}

constexpr std::array hull_column_names = {"time", "x",  "y",  "z",  "heave",   "heading",  "pitch",
                                          "roll", "vx", "vy", "vz", "draught", "displaced"};

}  // namespace

HullPlayer::HullPlayer(const HullLaunch& launch, Ocean& ocean, EventPlayer& waves, double first_s,
                       std::shared_ptr<Executor> executor, bool has_spray)
    : launch_(launch),
      ocean_(ocean),
      waves_(waves),
      bodies_(std::move(executor), &waves.waves()),
      step_(first_step(first_s)) {
    waves_.follow_hull(launch_.x_m, launch_.z_m);
    body_ = bodies_.add(*launch_.hull, launch_.hull->at_rest(WaterQuery(frame_at(step_)), launch_.x_m, launch_.z_m,
                                                             launch_.heading_rad));
    before_ = bodies_.state(body_);
    // finer than by default, because an image shows each droplet
    if (has_spray) thrown_.emplace(bodies_.hull(body_), HullSprayOptions{.radius_m = 0.1, .clump_kg = 0.1});
}

double HullPlayer::begins_s(double first_s) { return time_of(first_step(first_s)); }

Frame HullPlayer::frame_at(std::int64_t step) {
    return with_water(ocean_.frame_at(time_of(step)), waves_.at(time_of(step)));
}

void HullPlayer::step() {
    const Frame frame = frame_at(step_);
    try {
        bodies_.press(frame, hull_step_s);
        before_ = bodies_.state(body_);
        waves_.follow_hull(before_.position_m.x, before_.position_m.z);
        bodies_.set_inputs(body_,
                           {.force = {.force_n = launch_.thrust_n * glm::mat3_cast(before_.orientation)[0]}});
        bodies_.step(frame, hull_step_s);
        if (thrown_) break_water(frame);
    } catch (const std::invalid_argument& error) {
        if (launch_.hull->diffraction() && !SeaForces::reason_unavailable(&frame).empty())
            throw InputError(std::string("--hull-coefficients: ") + error.what());
        throw InputError(launch_.typed + ": the hull moves out of range: " + error.what());
    }
    ++step_;
}

void HullPlayer::break_water(const Frame& frame) {
    const HullState& state = bodies_.state(body_);
    thrown_->update(WaterQuery(frame), state, bodies_.loads(body_), hull_step_s, workspace_,
                    bodies_.inputs(body_).wake);
    ocean_.emit(thrown_->emitters());
    for (const Disturbance& foam : thrown_->foam()) waves_.waves().add_impulse(foam);
    for (const Disturbance& foam : stern_foam(*launch_.hull, state, bodies_.loads(body_)))
        waves_.waves().add_impulse(foam);
}

HullMoment HullPlayer::at(double time_s) {
    while (time_of(step_) < time_s) step();
    const HullState& now = bodies_.state(body_);
    // of the last step; 1 at its end
    const double along = std::clamp(1 - (time_of(step_) - time_s) / hull_step_s, 0.0, 1.0);
    HullMoment moment{.state = now};
    HullState& state = moment.state;
    state.position_m = glm::mix(before_.position_m, now.position_m, along);
    state.velocity_mps = glm::mix(before_.velocity_mps, now.velocity_mps, along);
    // a turn within a step is small, so the quaternions are near each other
    state.orientation = glm::normalize(before_.orientation * (1 - along) + now.orientation * along);

    const glm::dmat3 axes = glm::mat3_cast(state.orientation);
    moment.heave_m = state.position_m.y - launch_.hull->afloat().height_m - ocean_.water_frame().sea_level_m;
    moment.heading_rad = std::atan2(axes[0].z, axes[0].x);
    moment.pitch_rad = std::asin(std::clamp(axes[0].y, -1.0, 1.0));
    moment.roll_rad = std::atan2(-axes[2].y, axes[1].y);
    const HullLoads& loads = bodies_.loads(body_);
    moment.draught_m = -1e9;
    for (const glm::dvec3& vertex : launch_.hull->mesh().vertices()) {
        const glm::dvec3 arm = axes * (vertex - launch_.hull->centre_of_mass_m());
        const double surface_m = loads.water_height_m + loads.water_slope_x * arm.x + loads.water_slope_z * arm.z;
        moment.draught_m = std::max(moment.draught_m, surface_m - state.position_m.y - arm.y);
    }
    moment.displaced_m3 = loads.displaced_m3;
    return moment;
}

glm::dmat4 HullPlayer::world_from_mesh(const HullMoment& moment) const {
    return glm::translate(glm::dmat4(1), launch_.hull->mesh_origin_m(moment.state)) *
           glm::mat4_cast(moment.state.orientation);
}

std::string hull_columns() {
    std::string text;
    for (const char* name : hull_column_names) text.append(text.empty() ? "" : ",").append(name);
    return text;
}

std::string hull_row(double time_s, const HullMoment& moment, bool as_json) {
    constexpr double degrees = 180 / std::numbers::pi;
    const HullState& state = moment.state;
    const std::array<double, hull_column_names.size()> values = {time_s,
                                                                 state.position_m.x,
                                                                 state.position_m.y,
                                                                 state.position_m.z,
                                                                 moment.heave_m,
                                                                 moment.heading_rad * degrees,
                                                                 moment.pitch_rad * degrees,
                                                                 moment.roll_rad * degrees,
                                                                 state.velocity_mps.x,
                                                                 state.velocity_mps.y,
                                                                 state.velocity_mps.z,
                                                                 moment.draught_m,
                                                                 moment.displaced_m3};
    std::string text = as_json ? "{" : "";
    for (std::size_t i = 0; i < hull_column_names.size(); ++i) {
        if (i > 0) text += ',';
        if (as_json) text.append("\"").append(hull_column_names[i]).append("\":");
        // Angles come from libm, whose last digits differ between systems.
        text += i == 0 ? number_text(values[i]) : rounded_text(values[i], 9);
    }
    return as_json ? text + "}" : text;
}

}  // namespace pelagic::tools
