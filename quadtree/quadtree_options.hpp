// Options of a quadtree: size, level of detail, culling, and presets.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace pelagic {

/// Side of the paper's smallest patches (equation 56).
inline constexpr double paper_patch_m = 64;

/// A square sea of level-of-detail patches around the viewer (VR Ocean, section 5.1).
struct QuadtreeOptions {
    // generated from schema/quadtree.toml: members
    double size_m = 2048;  ///< S, the side of the square; [256, 8192]
    /// V, steps along a patch's side, with V + 1 vertices; an even number from 2 to 128.
    int vertices = 64;
    /// Tau: a patch splits nearer than tau times its side (equation 57); [0.75, 8].
    double lod_scale = 2.2;
    /// Beta: scales the boxes for culling, for applications that add displacement; [1, 4].
    double cull_scale = 1;
    /// Maximum number of instances in one draw call; at least 1. Unset: no limit.
    std::optional<int> batch_limit = {};
    /// Side of the smallest patches, about, for eyes near the water; [16, 64]. The paper has 64 m
    /// (equation 56), whose vertices are 1 m apart if V is 64.
    double finest_patch_m = 64;
    // end of generated
};

/// Returns an empty string if the options are valid, else a message about the first invalid field:
/// "vertices is 7, expected an even number from 2 to 128".
std::string check(const QuadtreeOptions& options);

/// Returns the level of the smallest patches (equation 56), whose side is about `finest_patch_m`.
/// The level is at most 8, and the root has level 0.
int deepest_level(double size_m, double finest_patch_m = paper_patch_m);

struct QuadtreePreset {
    std::string_view name;
    int vertices;
    double lod_scale;
    double cull_scale;
    double finest_patch_near_water_m = paper_patch_m;

    /// Returns options for a square of this side in metres.
    QuadtreeOptions options(double size_m) const { return {size_m, vertices, lod_scale, cull_scale}; }
    /// Returns options for eyes near an open sea, where waves of 1 to 3 m hide others: `high` and
    /// `ultra` then have patches of 16 m, and a lower lod_scale for about as many triangles in all.
    QuadtreeOptions options_near_water(double size_m) const {
        QuadtreeOptions near_water = options(size_m);
        near_water.finest_patch_m = finest_patch_near_water_m;
        if (finest_patch_near_water_m < paper_patch_m) near_water.lod_scale *= 0.8;
        return near_water;
    }
};

/// Returns the presets: low, medium, high, ultra, in increasing number of triangles and detail;
/// then paper_low ... paper_ultra with the values of the paper's Table 2. The order of that table
/// is reversed: a larger tau means more detail (errata).
std::span<const QuadtreePreset> quadtree_presets();

/// Returns null if no preset has this name.
const QuadtreePreset* quadtree_preset_named(std::string_view name);

}  // namespace pelagic
