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

constexpr NumericField<WaterFrame> origin_field_table[] = {
    {"origin_x_m", &WaterFrame::origin_x_m, -1e8, 1e8, "[-1e8, 1e8]"},
    {"origin_z_m", &WaterFrame::origin_z_m, -1e8, 1e8, "[-1e8, 1e8]"},
};

}  // namespace

std::span<const NumericField<WaterFrame>> water_frame_fields() { return water_frame_field_table; }
std::string check(const WaterFrame& water) {
    const std::string reason = check_fields(water, water_frame_field_table);
    return reason.empty() ? check_fields(water, origin_field_table) : reason;
}

}  // namespace pelagic
