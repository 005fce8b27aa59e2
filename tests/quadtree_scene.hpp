// Viewers, seas and meshes that the quadtree's tests share.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "pelagic/quadtree/patch_mesh.hpp"
#include "pelagic/quadtree/patch_vertex.hpp"
#include "pelagic/quadtree/selection.hpp"

namespace pelagic {

inline constexpr double sizes_m[] = {256, 512, 1024, 2048, 4096, 8192};

/// The presets on every size, and a small patch near water.
inline std::vector<QuadtreeOptions> all_quadtree_options() {
    std::vector<QuadtreeOptions> all;
    for (const QuadtreePreset& preset : quadtree_presets())
        for (const double size : sizes_m) all.push_back(preset.options(size));
    QuadtreeOptions near_water = quadtree_preset_named("low")->options(4096);
    near_water.finest_patch_m = 16;
    all.push_back(near_water);
    return all;
}

/// Returns a uniform value in [low, high), the same on every standard library.
class Random {
   public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }
    int below(int count) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(count)); }

   private:
    std::mt19937_64 engine_;
};

/// Viewer positions: over the grid, outside, high above, under water, on borders of cells, on a
/// line.
inline SelectionInput random_viewer(Random& random, double size_m, int number) {
    const double far = 3e4;
    const glm::dvec2 somewhere(random.between(-far, far), random.between(-far, far));
    const auto over = [&](double height) { return glm::dvec3(somewhere.x, height, somewhere.y); };
    switch (number % 6) {
        case 0: return {.viewer_m = over(random.between(0.5, 50))};
        case 1:  // the grid stays behind
            return {
                .viewer_m = over(random.between(1, 200)),
                .centre_m = somewhere + size_m * glm::dvec2(random.between(-1.5, 1.5), random.between(-1.5, 1.5))};
        case 2: return {.viewer_m = over(size_m * random.between(0, 3))};
        case 3: return {.viewer_m = over(-random.between(0, 100))};
        case 4: {  // borders of cells, including corners
            const double cell = size_m / (1 << (1 + random.below(7)));
            return {.viewer_m = {cell * random.below(9), random.between(0, 2), cell * (random.below(9) - 4)}};
        }
        default:  // along a line, in steps that cross every border
            return {.viewer_m = {number * 3.7, 2, number * -1.3}};
    }
}

/// A static analytic sea, gentle enough that no triangle of it can overturn: see `steepest`.
struct SineSea {
    double height_m = 2;
    double horizontal_m = 1;
    /// Lipschitz bound of the horizontal displacement for a longest wave of 40 m: the sum of
    /// amplitudes times wave numbers. A triangle overturns only if the bound exceeds 1/2.
    static constexpr double shortest_wave_m = 40;

    glm::dvec3 operator()(glm::dvec2 rest) const {
        constexpr double turn = 2 * std::numbers::pi;
        const double a = turn * (rest.x * 0.8 + rest.y * 0.6) / shortest_wave_m;
        const double b = turn * (rest.x * -0.5 + rest.y * 0.7) / 97 + 1;
        return {horizontal_m * std::cos(a), height_m * (0.5 * std::sin(a) + 0.5 * std::sin(b)),
                horizontal_m * std::cos(b)};
    }
    FrameBounds bounds() const {
        const auto height = static_cast<float>(height_m), horizontal = static_cast<float>(horizontal_m);
        return {-height, height, horizontal, horizontal};
    }
};

inline std::vector<glm::dvec3> patch_positions(const QuadtreeGrid& grid, const PatchInstance& patch,
                                               const auto& displacement) {
    std::vector<glm::dvec3> all;
    all.reserve(static_cast<std::size_t>((grid.vertices + 1) * (grid.vertices + 1)));
    for (int j = 0; j <= grid.vertices; ++j)
        for (int i = 0; i <= grid.vertices; ++i) all.push_back(patch_vertex(grid, patch, i, j, displacement));
    return all;
}

inline std::string describe(const QuadtreeOptions& o, const SelectionInput& input) {
    std::string text = "S " + std::to_string(o.size_m) + " V " + std::to_string(o.vertices) + " tau " +
                       std::to_string(o.lod_scale) + " viewer " + std::to_string(input.viewer_m.x) + " " +
                       std::to_string(input.viewer_m.y) + " " + std::to_string(input.viewer_m.z);
    if (input.centre_m)
        text += " centre " + std::to_string(input.centre_m->x) + " " + std::to_string(input.centre_m->y);
    return text;
}

}  // namespace pelagic
