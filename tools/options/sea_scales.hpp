// Wind and waves in the numbers that forecasts use: forces and sea states.
#pragma once

#include <string_view>

namespace pelagic::tools {

/// A number of a scale, and its name there.
struct ScaleStep {
    int number;
    std::string_view name;
};

/// Force 0, "calm", to 12, "hurricane", of a mean wind 10 m above the sea (World Meteorological Organization, Manual on Codes,
/// WMO-No. 306, Beaufort scale, whose speeds are in tenths of m/s).
ScaleStep beaufort_of(double wind_speed_mps);

/// Sea state 0, "calm (glassy)", to 9, "phenomenal", of a significant wave height, also known as Douglas' (the same, code table
/// 3700; a height on a border belongs to the lower state). Waves below half a centimetre count as none.
ScaleStep sea_state_of(double significant_wave_height_m);

}  // namespace pelagic::tools
