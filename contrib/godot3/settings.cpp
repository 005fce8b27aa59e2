#include "pelagic/contrib/godot3/settings.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "pelagic/contrib/godot3/scene_sea.hpp"

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
    const SeaPreset* preset = sea_preset_named(settings.preset);
    return preset ? scene_sea(preset->sea, sea, {}) : sea;
}

}  // namespace pelagic::godot
