#include "pelagic/sim/disturbance.hpp"

#include <array>
#include <cmath>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr NumericField<Disturbance> disturbance_field_table[] = {
    // generated from schema/disturbance.toml: table
    {"x_m", &Disturbance::x_m, -1e8, 1e8, "[-1e8, 1e8]"},
    {"z_m", &Disturbance::z_m, -1e8, 1e8, "[-1e8, 1e8]"},
    {"radius_m", &Disturbance::radius_m, 0.001, 1000, "[0.001, 1000]"},
    {"length_m", &Disturbance::length_m, 0.001, 1000, "[0.001, 1000]"},
    {"heading_rad", &Disturbance::heading_rad, -two_pi, two_pi, "[-2 pi, 2 pi]"},
    {"height_m", &Disturbance::height_m, -100, 100, "[-100, 100]"},
    {"rate_per_s", &Disturbance::rate_per_s, 0, 1000, "(0, 1000]", Restriction::above_min},
    {"velocity_x_mps", &Disturbance::velocity_x_mps, -1000, 1000, "[-1000, 1000]"},
    {"velocity_z_mps", &Disturbance::velocity_z_mps, -1000, 1000, "[-1000, 1000]"},
    // end of generated
};

}  // namespace

double shape_at(const Disturbance& of, double x_m, double z_m) {
    const DefaultFloatEnvironment environment(x_m, z_m);
    const double x = x_m - of.x_m, z = z_m - of.z_m;
    if (of.shape == Disturbance::Shape::gauss) {
        const double squared = (x * x + z * z) / (of.radius_m * of.radius_m);
        return environment.result(of.height_m * det::exp(-squared));
    }
    const auto heading = det::sine_cosine_of_turns(of.heading_rad / two_pi);
    const double along = (x * heading.cosine + z * heading.sine) / of.length_m;
    const double across = (z * heading.cosine - x * heading.sine) / of.radius_m;
    const double inside = 1 - along * along - across * across;
    return environment.result(inside > 0 ? of.height_m * std::sqrt(inside) : 0);
}

std::span<const NumericField<Disturbance>> disturbance_fields() { return disturbance_field_table; }

std::string check(const Disturbance& disturbance) { return check_fields(disturbance, disturbance_field_table); }

}  // namespace pelagic
