// What a quadtree can be: its size, its detail, and the named qualities.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace pelagic {

/// A square sea of level-of-detail patches around the viewer (VR Ocean, section 5.1).
struct QuadtreeOptions {
    double size_m = 2048;    ///< S, the side of the square; [256, 8192]
    int vertices = 64;       ///< V, steps along a patch's side, V + 1 vertices; even, [2, 128]
    double lod_scale = 2.2;  ///< tau: a patch splits nearer than tau times its side (equation 57); [0.75, 8]
    double cull_scale =
        1;                ///< beta: widens the boxes that are culled, for applications that displace further; [1, 4]
    int batch_limit = 0;  ///< most instances in one draw call; 0 for no limit
};

/// Empty if usable, else the first bad field: "vertices is 7, needs an even number from 2 to 128".
std::string check(const QuadtreeOptions& options);

/// The level of the smallest patches, equation 56: they measure about 64 m. The root has level 0.
int deepest_level(double size_m);

struct QuadtreePreset {
    std::string_view name;
    int vertices;
    double lod_scale;
    double cull_scale;

    QuadtreeOptions options(double size_m) const { return {size_m, vertices, lod_scale, cull_scale}; }
};

/// low, medium, high, ultra: each has more triangles and finer ones than the one before. Then paper_low ... paper_ultra
/// with the values of the paper's Table 2, whose order is upside down: a larger tau means more detail (errata).
std::span<const QuadtreePreset> quadtree_presets();

/// None: no preset has that name.
const QuadtreePreset* quadtree_preset_named(std::string_view name);

}  // namespace pelagic
