#include "pelagic/sim/water_frame.hpp"

#include <array>

#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic {
namespace {

constexpr NumericField<WaterFrame> water_frame_field_table[] = {
    // generated from schema/water_frame.toml: table
    {"sea_level_m", &WaterFrame::sea_level_m, -1000, 1000, "[-1000, 1000]"},
    {"current_x_mps", &WaterFrame::current_x_mps, -10, 10, "[-10, 10]"},
    {"current_z_mps", &WaterFrame::current_z_mps, -10, 10, "[-10, 10]"},
    // end of generated
};

}  // namespace

std::span<const NumericField<WaterFrame>> water_frame_fields() { return water_frame_field_table; }
std::string check(const WaterFrame& water) { return check_fields(water, water_frame_field_table); }

}  // namespace pelagic
