#include "pelagic/contrib/godot3/settings.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

namespace pelagic::godot {
namespace {

// Equal to the command line's conversion factor, so that both have bit-identical seas.
constexpr double degree = std::numbers::pi / 180;

}  // namespace

bool is_quality(std::string_view name) {
    constexpr std::array qualities = {"low", "medium", "high", "ultra"};
    return std::find(qualities.begin(), qualities.end(), name) != qualities.end();
}

SeaState sea_of(const OceanSettings& settings) {
    SeaState sea = settings.sea;
    sea.wind_direction_rad = settings.wind_direction_deg * degree;
    sea.swell_direction_rad = settings.swell_direction_deg * degree;
    if (const SeaPreset* preset = sea_preset_named(settings.preset)) {
        const SeaState own = std::exchange(sea, preset->sea);
        sea.cascades = own.cascades;
        sea.resolution = own.resolution;
        sea.patch_size_m = own.patch_size_m;
        sea.seed = own.seed;
        sea.loop_period_s = own.loop_period_s;
        sea.wind_direction_rad = own.wind_direction_rad;
        if (sea.swell_height_m == 0) sea.swell_direction_rad = own.swell_direction_rad;
        if (sea.depth_m == SeaState{}.depth_m) sea.depth_m = own.depth_m;
    }
    return sea;
}

}  // namespace pelagic::godot
