#include "pelagic/gl/sky/light_presets.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace pelagic::gl {
namespace {

constexpr float degree = std::numbers::pi_v<float> / 180;

// Azimuths suit the default camera, which looks towards 45 degrees.
constexpr std::array presets = {
    LightPreset{"noon",
                "sun 65 degrees high, few clouds, clear air",
                {.sun_azimuth_rad = 110 * degree,
                 .sun_elevation_rad = 65 * degree,
                 .cloud_cover = 0.25f,
                 .visibility_m = 60e3f}},
    LightPreset{"golden-hour",
                "sun 5 degrees high and ahead, some clouds, 0.3 stops darker",
                {.sun_azimuth_rad = 62 * degree,
                 .sun_elevation_rad = 5 * degree,
                 .cloud_cover = 0.35f,
                 .visibility_m = 40e3f,
                 .cloud_seed = 30},
                -0.3f},
    LightPreset{
        "overcast",
        "a closed layer of clouds before a sun 45 degrees high",
        {.sun_azimuth_rad = 80 * degree, .sun_elevation_rad = 45 * degree, .cloud_cover = 1, .visibility_m = 20e3f}},
    LightPreset{"storm",
                "dark torn clouds, 18 km of visibility, 0.3 stops darker",
                {.sun_azimuth_rad = 170 * degree,
                 .sun_elevation_rad = 30 * degree,
                 .cloud_cover = 0.9f,
                 .visibility_m = 18e3f,
                 .cloud_seed = 17},
                -0.3f},
    LightPreset{"moonlight",
                "the full moon 18 degrees high and ahead, few clouds",
                {.sun_azimuth_rad = 232 * degree,
                 .sun_elevation_rad = -18 * degree,
                 .cloud_cover = 0.2f,
                 .visibility_m = 50e3f}},
};

}  // namespace

std::span<const LightPreset> light_presets() { return presets; }

const LightPreset* light_preset_named(std::string_view name) {
    const auto is_it = [name](const LightPreset& preset) { return preset.name == name; };
    const auto found = std::find_if(presets.begin(), presets.end(), is_it);
    return found == presets.end() ? nullptr : &*found;
}

}  // namespace pelagic::gl
