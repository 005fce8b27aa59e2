#include "pelagic/examples/buoyancy/box_wake.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "pelagic/simd/det_math.hpp"

namespace pelagic::buoyancy {

double heading_rad(const BoxState& state) {
    const glm::dvec3 forward = state.orientation * glm::dvec3(1, 0, 0);
    const double length = std::sqrt(forward.x * forward.x + forward.z * forward.z);
    if (!(length > 0)) return 0;  // the box is vertical
    const double x = forward.x / length, z = forward.z / length;
    // The first estimate is within 1/8 turn. Each step adds the sine of the error, so the error is
    // cubed.
    double turns = std::fabs(x) >= std::fabs(z) ? (x > 0 ? 0 : 0.5) : (z > 0 ? 0.25 : -0.25);
    for (int step = 0; step < 5; ++step) {
        const auto found = det::sine_cosine_of_turns(turns);
        turns += (z * found.cosine - x * found.sine) / (2 * std::numbers::pi);
    }
    if (turns > 0.5) turns -= 1;
    return 2 * std::numbers::pi * turns;
}

Disturbance pressure_of(const FloatingBox& box) {
    const BoxOptions& of = box.options();
    const double area = std::numbers::pi / 4 * of.length_m * of.beam_m;
    return {.shape = Disturbance::Shape::hull,
            .x_m = box.state().position_m.x,
            .z_m = box.state().position_m.z,
            .radius_m = of.beam_m / 2,
            .length_m = of.length_m / 2,
            .heading_rad = heading_rad(box.state()),
            .height_m = -of.mass_kg / water_density_kgpm3 / (2.0 / 3 * area)};
}

BoxWake::BoxWake(Ocean& ocean, const FloatingBox& box)
    : box_m_(box.state().position_m), pressure_m_(box.state().position_m) {
    pressures_.fill(pressing(box));
    source_ = ocean.dynamic_waves().add_source(pressures_[0]);
}

double BoxWake::launch_s(const BoxOptions& box) {
    return 4 * std::sqrt(2 * std::numbers::pi * box.length_m / gravity_mps2);
}

Disturbance BoxWake::pressing(const FloatingBox& box) const {
    Disturbance press = pressure_of(box);
    const double fraction = std::min(afloat_s_ / launch_s(box.options()), 1.0);
    press.height_m *= fraction * fraction * (3 - 2 * fraction);
    press.x_m = pressure_m_.x;
    press.z_m = pressure_m_.z;
    return press;
}

void BoxWake::press(Ocean& ocean, const FloatingBox& box, double tick_s) {
    afloat_s_ += tick_s;
    const glm::dvec3 now_m = box.state().position_m;
    pressure_m_ += now_m - box_m_ - tick_s * box.water_velocity_mps();
    pressure_m_ += tick_s / return_s * (now_m - pressure_m_);
    box_m_ = now_m;
    pressures_ = {pressing(box), pressures_[0], pressures_[1]};
    ocean.dynamic_waves().set_source(source_, pressures_[0]);
}

void BoxWake::leave_out(HullWater& hull, std::size_t first, std::size_t columns, double tick_s) const {
    for (std::size_t column = first; column < first + columns; ++column) {
        const double before = shape_at(pressures_[2], hull.x[column], hull.z[column]);
        const double after = shape_at(pressures_[1], hull.x[column], hull.z[column]);
        hull.height_m[column] = static_cast<float>(hull.height_m[column] - before);
        hull.velocity_y_mps[column] = static_cast<float>(hull.velocity_y_mps[column] - (after - before) / tick_s);
    }
}

}  // namespace pelagic::buoyancy
