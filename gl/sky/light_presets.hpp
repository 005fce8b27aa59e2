// Named light presets: position of the sun or the moon, clouds, visibility, exposure bias and light
// through crests.
#pragma once

#include <span>
#include <string_view>

#include "pelagic/gl/sky/sky.hpp"

namespace pelagic::gl {

struct LightPreset {
    std::string_view name;
    std::string_view meaning;  ///< description for help texts, one line
    SkyOptions sky;
    float bias_stops = 0;  ///< value for CameraSettings::bias_stops
    float crest_glow = 1;  ///< value for DrawInput::crest_glow
};

/// Returns all presets: noon, golden-hour, overcast, storm, moonlight.
std::span<const LightPreset> light_presets();
/// Returns the preset with that name, or null.
const LightPreset* light_preset_named(std::string_view name);

}  // namespace pelagic::gl
