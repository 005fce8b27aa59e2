#include <array>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/spray.hpp"

namespace pelagic {
namespace {

constexpr std::array spray_option_fields = {
    NumericField<SprayOptions>{"reach_m", &SprayOptions::reach_m, 10, 200, "[10, 200]"},
    NumericField<SprayOptions>{"amount", &SprayOptions::amount, 0, 10, "[0, 10]"},
    NumericField<SprayOptions>{"seed", &SprayOptions::seed, 0, UINT32_MAX, "a whole number from 0 to 4294967295"},
};

constexpr std::array spray_emitter_field_table = {
    NumericField<SprayEmitter>{"time_s", &SprayEmitter::time_s, -1e9, 1e9, "[-1e9, 1e9]"},
    NumericField<SprayEmitter>{"x_m", &SprayEmitter::x_m, -1e8, 1e8, "[-1e8, 1e8]"},
    NumericField<SprayEmitter>{"y_m", &SprayEmitter::y_m, -1e8, 1e8, "[-1e8, 1e8]"},
    NumericField<SprayEmitter>{"z_m", &SprayEmitter::z_m, -1e8, 1e8, "[-1e8, 1e8]"},
    NumericField<SprayEmitter>{"extent_m", &SprayEmitter::extent_m, 0, 100, "[0, 100]"},
    NumericField<SprayEmitter>{"velocity_x_mps", &SprayEmitter::velocity_x_mps, -100, 100, "[-100, 100]"},
    NumericField<SprayEmitter>{"velocity_y_mps", &SprayEmitter::velocity_y_mps, -100, 100, "[-100, 100]"},
    NumericField<SprayEmitter>{"velocity_z_mps", &SprayEmitter::velocity_z_mps, -100, 100, "[-100, 100]"},
    NumericField<SprayEmitter>{"spread_mps", &SprayEmitter::spread_mps, 0, 100, "[0, 100]"},
    NumericField<SprayEmitter>{"radius_m", &SprayEmitter::radius_m, 0.001, 1, "[0.001, 1]"},
    NumericField<SprayEmitter>{"drop_mm", &SprayEmitter::drop_mm, 0.1, 5, "[0.1, 5]"},
    NumericField<SprayEmitter>{"count", &SprayEmitter::count, 0, static_cast<double>(max_spray_droplets),
                               "[0, 8192]"},
};

}  // namespace

std::span<const NumericField<SprayEmitter>> spray_emitter_fields() { return spray_emitter_field_table; }
std::span<const NumericField<SprayOptions>> spray_fields() { return spray_option_fields; }
std::string check(const SprayEmitter& emitter) { return check_fields(emitter, spray_emitter_field_table); }
std::string check(const SprayOptions& options) { return check_fields(options, spray_option_fields); }

}  // namespace pelagic
