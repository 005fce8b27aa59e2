// Uniforms for the lens, the floor and the caustics.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "pelagic/gl/water/scene_block.hpp"
#include "pelagic/gl/water/sea_renderer.hpp"

namespace pelagic::gl {
namespace {

using std::numbers::pi;

/// Deepest even floor that is visible from above. In Jerlov type IB (k = 0.034 1/m at the clearest
/// wavelength) and in more turbid water exp(-2 k d) is then below 1e-4.
constexpr double deepest_seen_floor_m = 150;
/// Period of the patterns on sand.
constexpr double sand_tile_m = 64;
/// Period, in sides of the caustics, of the noise that selects their copies. The noise changes by
/// two or three copies a side. The value is far from every integer.
constexpr double caustic_noise_sides = 7.317;

/// Returns w of the near plane, which is its distance ahead of the eye. The projection determines
/// which end of the depth range is near.
double near_plane(const glm::dmat4& viewer_from_clip) {
    double nearest = 0;
    for (const double z : {-1.0, 1.0}) {
        const double w = 1 / (viewer_from_clip * glm::dvec4(0, 0, z, 1)).w;
        if (std::isfinite(w) && w > 0 && (nearest == 0 || w < nearest)) nearest = w;
    }
    return nearest;
}

glm::vec4 lens_of(const DrawInput& input) {
    if (!input.camera_water_plane || input.eyes.empty()) return {};
    const CameraWaterPlane& water = *input.camera_water_plane;
    const double above = input.viewer().y - water.height_m;
    const double near_m = near_plane(glm::inverse(input.eyes[0].clip_from_world));
    if (above > std::max(1.0, 4 * near_m)) return {};
    return {-above, water.slope.x, water.slope.y, near_m};
}

/// Returns the height of a pixel in radians.
double pixel_of(const Eye& eye) {
    const glm::dmat4& m = eye.clip_from_world;
    const double w = glm::length(glm::dvec3(m[0][3], m[1][3], m[2][3]));
    const double y = glm::length(glm::dvec3(m[0][1], m[1][1], m[2][1]));
    return 2 * std::max(w, 1e-9) / (y * std::max(eye.viewport.height, 1));
}

/// Sets the rows of crests that replace caustics if the application sets none. Their wavelengths
/// are 0.8 to 1.3 m. They run downwind and to both sides of it, with the drift speed of ripples.
/// Each row completes whole periods in a loop.
void place_crests(SceneBlock& block, const SeaFacts& sea, glm::dvec2 viewer) {
    constexpr double lengths_m[] = {1.27, 0.93, 0.81}, turns_rad[] = {0.35, 2.31, -1.52}, drift_mps = 0.3;
    const double loop = sea.time_s / sea.sea.loop_period_s;
    for (std::size_t i = 0; i < 3; ++i) {
        const double angle = sea.sea.wind_direction_rad + turns_rad[i], k = 2 * pi / lengths_m[i];
        const glm::dvec2 row = k * glm::dvec2(std::cos(angle), std::sin(angle));
        const double turns = std::round(drift_mps * sea.sea.loop_period_s / lengths_m[i]) * (loop - std::floor(loop));
        const double phase = std::remainder(glm::dot(row, viewer) - 2 * pi * turns, 2 * pi);
        block.caustic_row[i] = {row, phase, 0};
    }
}

}  // namespace

glm::ivec2 floor_cells(const SeaFloor& floor) {
    constexpr int max = 256;
    return {std::clamp(floor.columns - 1, 1, max), std::clamp(floor.rows - 1, 1, max)};
}

void place_below(SceneBlock& block, const DrawInput& input, const SeaFacts& sea, const SeaFloor& floor,
                 const CausticFacts& caustics) {
    const glm::dvec3 viewer_m = input.viewer();
    const glm::dvec2 viewer = sea.unshifted(viewer_m);  // as the floor
    // Queries cover the frame's waves but not small water, which is rendered as seen from the air
    // only.
    if (sea.surface == Surface::open) block.lens = lens_of(input);
    const bool is_field = !floor.is_even();
    // Samples are the centres of texels.
    const glm::dvec2 size = glm::dvec2(floor.columns, floor.rows) * floor.metres_per_texel;
    const glm::dvec2 corner = floor.corner_m - viewer;
    if (is_field) {
        const glm::dvec2 place = (-corner + 0.5 * floor.metres_per_texel) / size;
        block.floor_place = {place, 1.0 / size};
        block.floor_size = {size - floor.metres_per_texel, corner};
    }
    const auto in_sand_tile = [](double at) { return at - std::floor(at / sand_tile_m) * sand_tile_m; };
    const glm::ivec2 cells = floor_cells(floor);
    block.floor_mesh = {cells.x, cells.y, in_sand_tile(viewer.x), in_sand_tile(viewer.y)};
    block.floor_look = {-sea.sea.depth_m, 0.1 + 0.35 * sea.statistics.significant_wave_height_m,
                        input.eyes.empty() ? 1e-3 : pixel_of(input.eyes[0]), floor.is_sand ? 1 : 0};
    block.floor_albedo = {floor.albedo, is_field || sea.sea.depth_m < deepest_seen_floor_m ? 1 : 0};

    const glm::dvec2 in_water = sea.in_water(viewer_m);
    place_crests(block, sea, in_water);
    block.caustic_row[0].w = static_cast<float>(caustics.depth_m);
    if (const CascadeGrid& grid = caustics.grid; grid.side_m > 0) {
        const CascadeGrid::Vector at = grid.in_cascade(in_water.x, in_water.y);
        const auto fraction = [&](double value) { return value / grid.side_m - std::floor(value / grid.side_m); };
        block.caustic_place = {fraction(at.along), fraction(at.across), grid.cosine / grid.side_m,
                               grid.sine / grid.side_m};
        const auto in_noise = [&](double value) {
            const double sides = value / (caustic_noise_sides * grid.side_m);
            return sides - std::floor(sides);
        };
        block.caustic_copies = {in_noise(at.along), in_noise(at.across), 1 / caustic_noise_sides, 0};
    }
}

}  // namespace pelagic::gl
