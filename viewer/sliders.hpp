// Names, ranges and groups of the sliders, shared by the window's panel and the web page
// (web/page).
#pragma once

#include <array>
#include <string_view>

#include "pelagic/gl/exposure.hpp"

namespace pelagic::viewer {

struct Slider {
    const char* label;
    std::string_view option;  ///< name of a field of SeaState, gl::SkyOptions or gl::CameraSettings
    double min, max;          ///< range; in degrees if the option ends in _rad
    const char* format;       ///< printf format: "%.1f m/s"
};

namespace sliders {

inline constexpr Slider wind{"wind", "wind_speed_mps", 1, 30, "%.1f m/s"};
inline constexpr Slider wind_direction{"wind towards", "wind_direction_rad", -180, 180, "%.0f deg"};
inline constexpr Slider choppiness{"choppiness", "choppiness", 0, 1, "%.2f"};
inline constexpr Slider strength{"strength", "wave_strength", 0, 2, "%.2f"};
inline constexpr Slider drag{"drag", "wave_drag", 0, 1, "%.2f"};
inline constexpr Slider cascades{"cascades", "cascades", 1, 4, "%.0f"};
inline constexpr std::array sea = {wind, wind_direction, choppiness, strength, drag, cascades};

inline constexpr Slider sun_direction{"sun towards", "sun_azimuth_rad", -180, 180, "%.0f deg"};
inline constexpr Slider sun_height{"sun height", "sun_elevation_rad", -40, 90, "%.0f deg"};
inline constexpr Slider clouds{"clouds", "cloud_cover", 0, 1, "%.2f"};
inline constexpr Slider brighter{"brighter", "bias_stops", -double{gl::max_bias_stops}, double{gl::max_bias_stops},
                                 "%+.1f stops"};
inline constexpr std::array light = {sun_direction, sun_height, clouds, brighter};

}  // namespace sliders
}  // namespace pelagic::viewer
