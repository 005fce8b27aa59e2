#include "pelagic/sim/disturbance.hpp"

#include <array>

#include "pelagic/message/refusal.hpp"

namespace pelagic {
namespace {

constexpr double two_pi = 6.283185307179586;

constexpr std::array fields = {
    NumericField<Disturbance>{"x_m", &Disturbance::x_m, -1e8, 1e8, "[-1e8, 1e8]"},
    NumericField<Disturbance>{"z_m", &Disturbance::z_m, -1e8, 1e8, "[-1e8, 1e8]"},
    NumericField<Disturbance>{"radius_m", &Disturbance::radius_m, 0, 1000, "(0, 1000]", Among::above_least},
    NumericField<Disturbance>{"length_m", &Disturbance::length_m, 0, 1000, "(0, 1000]", Among::above_least},
    NumericField<Disturbance>{"heading_rad", &Disturbance::heading_rad, -two_pi, two_pi, "[-2 pi, 2 pi]"},
    NumericField<Disturbance>{"height_m", &Disturbance::height_m, -100, 100, "[-100, 100]"},
    NumericField<Disturbance>{"rate_per_s", &Disturbance::rate_per_s, 0, 1000, "(0, 1000]", Among::above_least},
    NumericField<Disturbance>{"velocity_x_mps", &Disturbance::velocity_x_mps, -1000, 1000, "[-1000, 1000]"},
    NumericField<Disturbance>{"velocity_z_mps", &Disturbance::velocity_z_mps, -1000, 1000, "[-1000, 1000]"},
};

}  // namespace

std::string check(const Disturbance& disturbance) { return check_fields(disturbance, fields); }

}  // namespace pelagic
