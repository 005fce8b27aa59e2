#include <array>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/spray.hpp"

namespace pelagic {
namespace {

constexpr NumericField<SprayOptions> spray_option_fields[] = {
    // generated from schema/spray_options.toml: table
    {"reach_m", &SprayOptions::reach_m, 10, 200, "[10, 200]"},
    {"amount", &SprayOptions::amount, 0, 10, "[0, 10]"},
    {"seed", &SprayOptions::seed, 0, 4294967295.0, "a whole number from 0 to 4294967295"},
    // end of generated
};

constexpr NumericField<SprayEmitter> spray_emitter_field_table[] = {
    // generated from schema/spray_emitter.toml: table
    {"time_s", &SprayEmitter::time_s, -1e9, 1e9, "[-1e9, 1e9]"},
    {"x_m", &SprayEmitter::x_m, -1e8, 1e8, "[-1e8, 1e8]"},
    {"y_m", &SprayEmitter::y_m, -1e8, 1e8, "[-1e8, 1e8]"},
    {"z_m", &SprayEmitter::z_m, -1e8, 1e8, "[-1e8, 1e8]"},
    {"extent_m", &SprayEmitter::extent_m, 0, 100, "[0, 100]"},
    {"velocity_x_mps", &SprayEmitter::velocity_x_mps, -100, 100, "[-100, 100]"},
    {"velocity_y_mps", &SprayEmitter::velocity_y_mps, -100, 100, "[-100, 100]"},
    {"velocity_z_mps", &SprayEmitter::velocity_z_mps, -100, 100, "[-100, 100]"},
    {"spread_mps", &SprayEmitter::spread_mps, 0, 100, "[0, 100]"},
    {"radius_m", &SprayEmitter::radius_m, 0.001, 1, "[0.001, 1]"},
    {"drop_mm", &SprayEmitter::drop_mm, 0.1, 5, "[0.1, 5]"},
    {"count", &SprayEmitter::count, 0, 8192, "[0, 8192]"},
    // end of generated
};

}  // namespace

std::span<const NumericField<SprayEmitter>> spray_emitter_fields() { return spray_emitter_field_table; }
std::span<const NumericField<SprayOptions>> spray_fields() { return spray_option_fields; }
std::string check(const SprayEmitter& emitter) { return check_fields(emitter, spray_emitter_field_table); }
std::string check(const SprayOptions& options) { return check_fields(options, spray_option_fields); }

}  // namespace pelagic
