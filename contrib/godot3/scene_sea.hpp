// For both versions of Godot: the sea of a node with a preset.
#pragma once

namespace pelagic::godot {

/// Returns the sea of a preset, with the options of `own` that a preset leaves to the scene. Sea is
/// SeaState or pelagic_sea, by_default a new one.
template <typename Sea>
Sea scene_sea(Sea preset, const Sea& own, const Sea& by_default) {
    preset.cascades = own.cascades;
    preset.resolution = own.resolution;
    preset.patch_size_m = own.patch_size_m;
    preset.seed = own.seed;
    preset.loop_period_s = own.loop_period_s;
    preset.wind_direction_rad = own.wind_direction_rad;
    if (preset.swell_height_m == 0) preset.swell_direction_rad = own.swell_direction_rad;
    if (preset.depth_m == by_default.depth_m) preset.depth_m = own.depth_m;
    return preset;
}

}  // namespace pelagic::godot
