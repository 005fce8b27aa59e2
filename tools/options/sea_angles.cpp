// Sea options that are angles. Code that reads or writes files uses them without the command line.
#include <algorithm>
#include <array>

#include "pelagic/tools/options/sea_options.hpp"

namespace pelagic::tools {
namespace {

constexpr std::array angle_fields = {
    SeaAngle{"wind_direction_rad", "wind_direction_deg", &SeaState::wind_direction_rad,
             &ResolvedSea::wind_direction_deg},
    SeaAngle{"swell_direction_rad", "swell_direction_deg", &SeaState::swell_direction_rad,
             &ResolvedSea::swell_direction_deg},
    SeaAngle{"swell_spread_rad", "swell_spread_deg", &SeaState::swell_spread_rad, &ResolvedSea::swell_spread_deg},
};

}  // namespace

std::span<const SeaAngle> sea_angles() { return angle_fields; }

const SeaAngle* sea_angle(std::string_view field) {
    const auto found = std::find_if(angle_fields.begin(), angle_fields.end(),
                                    [&](const auto& angle) { return angle.field == field; });
    return found == angle_fields.end() ? nullptr : found;
}

}  // namespace pelagic::tools
