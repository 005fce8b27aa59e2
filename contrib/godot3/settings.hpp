// Settings of a PelagicOcean in the editor: the sea, its computation and its level of detail.
#pragma once

#include <string>
#include <string_view>

#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/shore.hpp"
#include "pelagic/sim/spray.hpp"

namespace pelagic::godot {

struct OceanSettings {
    /// "custom", or a name of sea_presets(), whose options replace those of `sea`, except those that
    /// scene_sea() keeps.
    std::string preset = "custom";
    SeaState sea;  ///< all options but the directions
    double wind_direction_deg = 0;
    double swell_direction_deg = 0;
    int threads = 0;  ///< number of threads including the engine's; 0: one per usable CPU
    bool foam = true;
    bool velocities = false, depth = false;
    bool dynamic_waves = false;
    DynamicWavesOptions dynamic_waves_options;
    bool spray = false;
    SprayOptions spray_options;
    ShoreOptions shore;                    ///< no shore if heights_m is empty
    std::string interpolation = "linear";  ///< interpolation of queries: "linear" or "cubic"
    double footprint_m = 0;                ///< queries leave out shorter waves
    std::string quality = "medium";        ///< level of detail, a name of quadtree_presets()
    double size_m = 2048;                  ///< side of the square of waves around the camera
};

inline constexpr std::string_view no_preset = "custom";
/// Returns "low", "medium", "high" and "ultra".
bool is_quality(std::string_view name);

SeaState sea_of(const OceanSettings& settings);

}  // namespace pelagic::godot
