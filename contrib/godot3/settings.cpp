#include "pelagic/contrib/godot3/settings.hpp"

#include <algorithm>
#include <array>
#include <numbers>

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
        const SeaState& named = preset->sea;
        sea.waves = named.waves;
        sea.wave_strength = named.wave_strength;
        sea.wind_speed_mps = named.wind_speed_mps;
        sea.fetch_m = named.fetch_m;
        sea.choppiness = named.choppiness;
        sea.wind_alignment = named.wind_alignment;
        sea.swell_height_m = named.swell_height_m;
        sea.swell_period_s = named.swell_period_s;
        if (named.swell_height_m > 0) sea.swell_direction_rad = named.swell_direction_rad;
        if (named.depth_m != SeaState{}.depth_m) sea.depth_m = named.depth_m;
    }
    return sea;
}

}  // namespace pelagic::godot
