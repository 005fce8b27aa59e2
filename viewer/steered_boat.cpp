#include "pelagic/viewer/steered_boat.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace pelagic::viewer {
namespace {

constexpr double thrust_mps2 = 1.6, astern_fraction = 0.4;
constexpr double longest_step_s = 1.0 / 120;
/// Radius of the turning circle with the rudder hard over; the diameter is about three lengths.
constexpr double turning_radius_m = 11;
constexpr double rudder_s = 0.5;
/// Time constants with which heave, and pitch and roll, follow the water.
constexpr double heave_s = 0.25, tilt_s = 0.35;
/// Depth of the half ellipsoid that represents the hull's pressure. It is less than the keel's, for
/// a displacement of four tons.
constexpr double draught_m = 0.45;
constexpr int rows = 5, columns = 3;
/// Fraction of length and beam over which the water height is sampled.
constexpr double sampled_fraction = 0.8;

/// Returns the fraction by which a first-order lag approaches its target.
/// \param of_s  time constant, s
double response(double passed_s, double of_s) { return 1 - std::exp(-passed_s / of_s); }

}  // namespace

glm::dvec2 SteeredBoat::ahead() const { return {std::cos(heading_), std::sin(heading_)}; }

void SteeredBoat::step(double passed_s, const Helm& helm, const WaterHeight& water, double frame_s) {
    drive(passed_s, helm);
    float_on(passed_s, [&](double x, double z) { return water(x, z) - own_depression_m(frame_s, {x, z}); });
}

void SteeredBoat::drive(double passed_s, const Helm& helm) {
    const double thrust = thrust_mps2 * (helm.thrust < 0 ? astern_fraction : 1) * std::clamp(helm.thrust, -1., 1.);
    const double rudder = std::clamp(helm.rudder, -1., 1.);
    const int steps = std::max(1, static_cast<int>(std::ceil(passed_s / longest_step_s)));
    const double step_s = passed_s / steps;
    for (int i = 0; i < steps; ++i) {
        // Drag is mostly quadratic in the speed. A small linear term brings the boat to rest.
        const double drag = 0.9 * speed_ * std::fabs(speed_) / top_speed_mps + 0.1 * speed_;
        speed_ += step_s * (thrust - thrust_mps2 / top_speed_mps * drag);
        turn_rad_ps_ += (rudder * speed_ / turning_radius_m - turn_rad_ps_) * response(step_s, rudder_s);
        heading_ += step_s * turn_rad_ps_;
        place_ += step_s * speed_ * ahead();
    }
}

/// Fits a plane to the sampled water heights by least squares. The boat's pose follows that plane.
void SteeredBoat::float_on(double passed_s, const WaterHeight& water) {
    const glm::dvec2 forward = ahead(), starboard(-forward.y, forward.x);
    double height = 0, along = 0, across = 0, squares_along = 0, squares_across = 0;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double x = (static_cast<double>(i) / (rows - 1) - 0.5) * sampled_fraction * length_m;
            const double z = (static_cast<double>(j) / (columns - 1) - 0.5) * sampled_fraction * beam_m;
            const glm::dvec2 at = place_ + x * forward + z * starboard;
            const double sample_m = water(at.x, at.y);
            height += sample_m / (rows * columns);
            along += x * sample_m;
            across += z * sample_m;
            squares_along += x * x;
            squares_across += z * z;
        }
    const double heaves = floats_ ? response(passed_s, heave_s) : 1, tilts = floats_ ? response(passed_s, tilt_s) : 1;
    floats_ = true;
    height_ += (height - height_) * heaves;
    pitch_ += (std::atan(along / squares_along) - pitch_) * tilts;
    roll_ += (std::atan(-across / squares_across) - roll_) * tilts;
}

Disturbance SteeredBoat::hull() const {
    const glm::dvec2 velocity = speed_ * ahead();
    return {.shape = Disturbance::Shape::hull,
            .x_m = place_.x,
            .z_m = place_.y,
            .radius_m = beam_m / 2,
            .length_m = length_m / 2,
            .heading_rad = std::remainder(heading_, 2 * std::numbers::pi),
            .height_m = -draught_m,
            .velocity_x_mps = velocity.x,
            .velocity_z_mps = velocity.y};
}

Disturbance SteeredBoat::press(double frame_s, double tick_s) {
    has_pressure_ = true;
    pressure_ = hull();
    // The pressure takes effect with the next tick, and a frame shows the water one tick late.
    pressure_shown_s_ = frame_s + 2 * tick_s;
    return pressure_;
}

double SteeredBoat::own_depression_m(double frame_s, glm::dvec2 at) const {
    if (!has_pressure_) return 0;
    const double since_s = frame_s - pressure_shown_s_;
    return shape_at(pressure_, at.x - since_s * pressure_.velocity_x_mps, at.y - since_s * pressure_.velocity_z_mps);
}

glm::dmat4 SteeredBoat::world_from_boat() const {
    glm::dmat4 pose = glm::translate(glm::dmat4(1), glm::dvec3(place_.x, height_, place_.y));
    pose = glm::rotate(pose, -heading_, glm::dvec3(0, 1, 0));
    pose = glm::rotate(pose, pitch_, glm::dvec3(0, 0, 1));
    return glm::rotate(pose, roll_, glm::dvec3(1, 0, 0));
}

}  // namespace pelagic::viewer
