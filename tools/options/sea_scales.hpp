// Scales of forecasts: Beaufort force and sea state.
#pragma once

#include <string_view>

namespace pelagic::tools {

/// A number of a scale and its name.
struct ScaleStep {
    int number;
    std::string_view name;
};

/// Returns the Beaufort force, from 0, "calm", to 12, "hurricane". Source: World Meteorological
/// Organization, Manual on Codes, WMO-No. 306, Beaufort scale, in tenths of m/s.
/// \param wind_speed_mps  mean wind speed 10 m above the sea
ScaleStep beaufort_of(double wind_speed_mps);

/// Returns the sea state (Douglas scale), from 0, "calm (glassy)", to 9, "phenomenal". A height on
/// a border belongs to the lower state. Waves up to 0.005 m count as state 0. Source: WMO-No. 306,
/// code table 3700.
ScaleStep sea_state_of(double significant_wave_height_m);

}  // namespace pelagic::tools
