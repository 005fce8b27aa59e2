// What the editor shows of a PelagicOcean, and what it becomes: a sea, how it is computed and how finely it is drawn.
#pragma once

#include <string>
#include <string_view>

#include "pelagic/sim/sea_state.hpp"

namespace pelagic::godot {

struct OceanSettings {
    /// "custom", or a sea_presets() name, whose wind speed, fetch, choppiness and swell count then, not those of `sea`.
    std::string preset = "custom";
    SeaState sea;  ///< but for its directions
    double wind_direction_deg = 0;
    double swell_direction_deg = 0;
    int threads = 0;  ///< the engine's own included; 0: one per core
    bool foam = true;
    bool velocities = false;
    std::string interpolation = "linear";  ///< of answers between texels, or "cubic"
    std::string quality = "medium";        ///< of the mesh: a quadtree_presets() name
    double size_m = 2048;                  ///< of the square that has waves, around the camera
};

inline constexpr std::string_view no_preset = "custom";
/// "low", "medium", "high" and "ultra".
bool is_quality(std::string_view name);

SeaState sea_of(const OceanSettings& settings);

}  // namespace pelagic::godot
