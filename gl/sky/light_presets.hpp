// Light by name: where the sun or the moon stands, the clouds, the air, and how bright a photographer would have it.
#pragma once

#include <span>
#include <string_view>

#include "pelagic/gl/sky/sky.hpp"

namespace pelagic::gl {

struct LightPreset {
    std::string_view name;
    std::string_view meaning;  ///< one line for people
    SkyOptions sky;
    float bias_stops = 0;  ///< CameraSettings::bias_stops
};

/// noon, golden-hour, overcast, storm, moonlight.
std::span<const LightPreset> light_presets();
/// Null if there is none.
const LightPreset* light_preset_named(std::string_view name);

}  // namespace pelagic::gl
