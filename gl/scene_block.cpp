// Everything that the shaders are told, computed in double and relative to the viewer.
#include "pelagic/gl/scene_block.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "pelagic/gl/sea_renderer.hpp"

namespace pelagic::gl {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double gravity_mps2 = 9.81;
/// The sun seen from the earth: 16 minutes of arc.
constexpr float sun_radius_rad = 0.00465f;

// Sea water for 680, 550 and 440 nm. Absorption: pure water (Pope and Fry 1997; 0.465, 0.0565, 0.0064 1/m) and what lives
// and is dissolved in it where chlorophyll is 0.3 mg/m^3 (Bricaud et al. 1995). Scattering backwards: water's own (Morel
// 1974: half of 0.0007, 0.0019, 0.0049 1/m) and particles' (0.006 1/m).
constexpr glm::vec3 absorption_per_m{0.470f, 0.064f, 0.036f};
constexpr glm::vec3 backscattering_per_m{0.0063f, 0.0070f, 0.0085f};

/// Ripples stand for this part of the roughness that the sea has between its texels; the rest is too fine even for them.
constexpr float detail_part = 0.75f;
/// A tile of ripples in texels of the sea: its longest waves, a third of it, are as long as the sea's shortest.
constexpr double detail_texels = 6;
/// Layers have no period in common: their sizes stand in powers of the golden ratio.
constexpr double golden = 1.6180339887;
constexpr double layer_turns_rad[2] = {0.21, -0.47};

/// The horizon softens over this angle below it.
constexpr double softened_horizon_rad = 0.25 * pi / 180;
constexpr double second_turn_rad = 0.3648;  // sea.frag.glsl: the turn of the second copy of the waves

double fraction(double value) { return value - std::floor(value); }

/// Where the viewer is in a tile that is turned and repeats, [0, 1).
glm::dvec2 place_in_tile(glm::dvec2 at, double angle, double tile_m) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {fraction((c * at.x + s * at.y) / tile_m), fraction((c * at.y - s * at.x) / tile_m)};
}

void place_tiles(SceneBlock& block, const SeaFacts& facts, glm::dvec2 viewer) {
    const SeaState& sea = facts.sea;
    const double texel_m = sea.patch_size_m / sea.resolution;
    const double loop = fraction(facts.time_s / sea.loop_period_s);
    glm::dvec2 shifts[2];
    for (int layer = 0; layer < 2; ++layer) {
        const double tile_m = detail_texels * texel_m / (layer == 0 ? 1 : golden * golden * golden);
        const double angle = sea.wind_direction_rad + layer_turns_rad[layer];
        // Ripples travel as waves of a tenth of the tile do in deep water; the way in a loop is whole tiles.
        const double speed = std::sqrt(gravity_mps2 * tile_m / 10 / (2 * pi));
        const double tiles = std::round(speed * sea.loop_period_s / tile_m);
        shifts[layer] = place_in_tile(viewer, angle, tile_m) - glm::dvec2(fraction(tiles * loop), 0);
        block.detail_turn[static_cast<std::size_t>(layer)] = {std::cos(angle) / tile_m, std::sin(angle) / tile_m,
                                                              std::cos(angle), std::sin(angle)};
    }
    block.detail_shift = {glm::vec2(shifts[0]), glm::vec2(shifts[1])};
    // As the shader turns it: the other way than place_in_tile.
    block.second_shift = {glm::vec2(place_in_tile(viewer, -second_turn_rad, sea.patch_size_m * golden)), 0, 0};
    // Lace is as large as the waves that make it: tiles of 5 m in a calm, of 20 m in a storm.
    const double foam_m = 5 + 1.8 * block.waves.x;
    const glm::dvec4 tiles(foam_m, foam_m / golden / 1.1, 460, 1510);  // gusts: metres
    block.noise_scale = glm::vec4(1.0 / tiles);
    const glm::dvec2 turned(viewer.y, viewer.x);
    const auto placed = [](glm::dvec2 at, double tile) { return glm::vec2(place_in_tile(at, 0, tile)); };
    block.foam_shift = {placed(viewer, tiles.x), placed(turned, tiles.y)};
    block.gust_shift = {placed(viewer, tiles.z), placed(turned, tiles.w)};
}

}  // namespace

SceneBlock scene_block_of(const DrawInput& input, const SeaFacts& facts, const SkyLight& sky) {
    const SeaState& sea = facts.sea;
    SceneBlock block;
    const QuadtreeGrid& grid = input.list->grid;
    const glm::dvec2 viewer(input.viewer_m.x, input.viewer_m.z);
    const double patch_m = sea.patch_size_m;
    for (std::size_t i = 0; i < input.eyes.size(); ++i) {
        const glm::dmat4 clip = glm::translate(input.eyes[i].clip_from_world, input.viewer_m);
        block.clip_from_viewer[i] = glm::mat4(clip);
        block.viewer_from_clip[i] = glm::mat4(glm::inverse(clip));
        block.eye[i] = glm::vec4(glm::vec3(input.eyes[i].position_m - input.viewer_m), 0);
    }
    const auto to_float = [](glm::dvec2 v) { return glm::vec2(v); };
    // Texel (i, j) stands at i L/N, j L/N; a texture's texel has its middle half a texel further.
    const double half_texel = 0.5 / sea.resolution;
    block.viewer = {fraction(viewer.x / patch_m + half_texel), fraction(viewer.y / patch_m + half_texel),
                    input.viewer_m.y, 1 / patch_m};
    block.grid = {to_float(glm::dvec2(grid.corner) * grid.step_m - viewer), grid.step_m, grid.vertices};
    block.fade = {to_float(grid.fade_centre - viewer), grid.fade_end_m, 1 / (grid.fade_end_m - grid.fade_start_m)};
    block.mesh = {1 / (input.lod_scale * grid.vertices), grid.step_m,
                  facts.has_displacement_mips ? mip_levels(sea.resolution) - 1 : 0, sea.resolution / patch_m};
    block.skirt = {to_float((glm::dvec2(grid.corner) + 0.5 * grid.side) * grid.step_m - viewer), grid.side,
                   grid.deepest_level};
    block.sun = {sky.sun_direction, sun_radius_rad};
    block.sun_irradiance = {sky.sun_irradiance, sky.exposure};
    block.sky_irradiance = {sky.sky_irradiance, sky.levels - 1};
    const double height = std::max(1.5, std::abs(input.viewer_m.y));
    block.haze = {sky.haze_per_m, height / std::tan(softened_horizon_rad)};
    block.water_absorption = {absorption_per_m, sea.depth_m};
    block.output_kind.y = facts.whitecap_jacobian + input.more_foam;
    const float alpha = static_cast<float>(facts.figures.roughness);
    const float detail_square = detail_part * alpha * alpha;
    block.water_scattering = {backscattering_per_m, detail_square};
    const double wind = sea.wind_direction_rad;
    block.waves = {std::max(0.05, facts.figures.significant_wave_height_m), alpha, std::cos(wind), std::sin(wind)};
    place_tiles(block, facts, viewer);
    block.output_kind.x = facts.framebuffer_is_srgb ? 0 : 1;
    return block;
}

}  // namespace pelagic::gl
