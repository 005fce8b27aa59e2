#include "pelagic/tools/options/sea_scales.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pelagic::tools {
namespace {

constexpr std::array<std::string_view, 13> force_names = {
    "calm",      "light air", "light breeze", "gentle breeze", "moderate breeze", "fresh breeze", "strong breeze",
    "near gale", "gale",      "strong gale",  "storm",         "violent storm",   "hurricane"};
/// Minimum wind speeds of the forces from 1 on, in tenths of m/s.
constexpr std::array<int, 12> force_tenths = {3, 16, 34, 55, 80, 108, 139, 172, 208, 245, 285, 327};

constexpr std::array<std::string_view, 10> sea_names = {"calm (glassy)", "calm (rippled)", "smooth",     "slight",
                                                        "moderate",      "rough",          "very rough", "high",
                                                        "very high",     "phenomenal"};
/// Maximum heights of all states but the last.
constexpr std::array<double, 9> sea_heights_m = {0.005, 0.1, 0.5, 1.25, 2.5, 4, 6, 9, 14};

}  // namespace

ScaleStep beaufort_of(double wind_speed_mps) {
    const double tenths = std::round(10 * wind_speed_mps);
    const auto force = std::upper_bound(force_tenths.begin(), force_tenths.end(), tenths) - force_tenths.begin();
    return {static_cast<int>(force), force_names[static_cast<std::size_t>(force)]};
}

ScaleStep sea_state_of(double significant_wave_height_m) {
    const auto state = std::lower_bound(sea_heights_m.begin(), sea_heights_m.end(), significant_wave_height_m) -
                       sea_heights_m.begin();
    return {static_cast<int>(state), sea_names[static_cast<std::size_t>(state)]};
}

}  // namespace pelagic::tools
