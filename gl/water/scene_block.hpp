// Uniform block of gl/shaders/scene.glsl. That file documents each member. The layout is std140 and
// has matrices and vec4 only.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "pelagic/gl/sky/sky.hpp"
#include "pelagic/gl/water/exclusions.hpp"
#include "pelagic/gl/water/sea_floor.hpp"
#include "pelagic/gl/water/small_water.hpp"
#include "pelagic/gl/water/water_optics.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic::gl {

/// Maximum number of cascades that the shaders support.
inline constexpr std::size_t max_cascades = 4;

/// Golden ratio. Sizes and angles that it relates have no common period.
inline constexpr double golden = 1.6180339887;

/// Returns the fractional part, [0, 1).
inline double fraction(double value) { return value - std::floor(value); }

struct SceneBlock {
    std::array<glm::mat4, 2> clip_from_viewer{}, viewer_from_clip{};
    std::array<glm::vec4, 2> eye{};
    std::array<glm::vec4, max_cascades> cascade_place{}, cascade_scale{}, cascade_slope{}, cascade_noise{};
    glm::vec4 viewer{}, grid{}, fade{}, mesh{}, skirt{};
    glm::vec4 sun{}, sun_irradiance{}, sky_irradiance{}, haze{};
    glm::vec4 water_absorption{}, water_backscattering{}, crest_ray{}, crest_sun{}, crest_sky{}, waves{};
    std::array<glm::vec4, 2> detail_turn{};
    glm::vec4 detail_shift{}, detail_noise{}, noise_scale{}, foam_shift{}, gust_shift{};
    // Values for rendering below the surface.
    glm::vec4 lens{}, floor_place{}, floor_size{}, floor_mesh{}, floor_look{}, floor_albedo{}, caustic_place{};
    glm::vec4 caustic_copies{};
    std::array<glm::vec4, 3> caustic_row{};
    std::array<glm::vec4, 3> foam_cascade{};
    std::array<glm::vec4, 4> foam_age{};
    std::array<glm::vec4, FoamFilter::widths> foam_filter{};
    std::array<glm::vec4, 2> foam_streaks{};
    glm::vec4 foam_kind{}, foam_front{};
    std::array<glm::vec4, 8> bump_grid{}, bump_place{};
    std::array<glm::vec4, 2> bump_turn{};
    glm::vec4 bump_kind{};
    std::array<glm::vec4, 24> pond_wave{};
    glm::vec4 flow_place{}, flow_cycle{}, flow_jump{};
    glm::vec4 output_kind{};
    glm::vec4 moon{}, stars{};
    glm::vec4 shore_place{}, shore_size{};
    glm::vec4 dynamic_waves_place{}, dynamic_waves_extent{};
    glm::vec4 glint_place{};
    glm::vec4 cloud_place{}, cloud_light{1, 0, 1, 0};
    // Only programs with EXCLUSIONS have these members.
    std::array<glm::vec4, 3 * max_exclusions> exclusion_box{};
    std::array<glm::vec4, max_exclusions> exclusion_map{};
};

/// Parameters of a cascade that the renderer keeps after the upload.
struct CascadeFacts {
    CascadeGrid grid;
    SlopeRanges ranges;
    double longest_wave_m = 0;
    /// Slope variance of all its waves, summed over both axes. The last mip has averaged away all
    /// of it.
    float slope_variance = 0;
    float compression_scale = 0;  ///< Cascade::compression_scale
    bool has_snapshots = false;
    glm::dvec2 foam_drift{};  ///< of the snapshots, sides of the cascade
};

/// Parameters of a frame's shore that the renderer keeps after the upload.
struct ShoreFacts {
    int columns = 0, rows = 0;  ///< 0 if the frame has no shore
    double texel_m = 1;
    glm::dvec2 corner_m{};
};

/// Parameters of a dynamic-wave grid that the renderer keeps after the upload.
struct DynamicWaveFacts {
    int resolution = 0;  ///< 0 if the frame has no dynamic-wave grid
    double texel_m = 0;
    std::int64_t first_x = 0, first_z = 0;
};

/// Parameters of the uploaded frame, its textures and the framebuffer.
struct SeaFacts {
    SeaState sea;
    SeaStatistics statistics;
    int resolution = 0;
    std::vector<CascadeFacts> cascades;
    double time_s = 0;
    WaterFrame water_frame;
    SnapshotFoam foam;
    bool has_displacement_mips = false;
    bool has_foam = false;
    bool framebuffer_is_srgb = false;
    bool writes_radiance = false;
    Surface surface = Surface::open;
    FlowExtent flow{};
    ShoreFacts shore{};
    bool shore_has_mips = false;
    DynamicWaveFacts dynamic_waves{};

    /// Returns x and z of a position in the water's frame.
    glm::dvec2 in_water(const glm::dvec3& world_m) const {
        const WaterFrame::Origin origin = water_frame.origin_at(time_s);
        return {world_m.x - origin.x_m, world_m.z - origin.z_m};
    }
    /// Returns x and z of a position in a world without a shift of its origin.
    glm::dvec2 unshifted(const glm::dvec3& world_m) const {
        return {world_m.x + water_frame.origin_x_m, world_m.z + water_frame.origin_z_m};
    }
    const CascadeFacts& finest_cascade() const { return cascades.back(); }
    double texel_m(const CascadeFacts& cascade) const { return cascade.grid.side_m / resolution; }
};

/// Returns the parameters that depend on the frame alone; the others keep their defaults.
SeaFacts facts_of(const Frame& frame);

/// Parameters of caustics that the renderer keeps after the upload.
struct CausticFacts {
    CascadeGrid grid;  ///< side_m is 0 if the application has set no caustics
    double depth_m = 6;
};

/// Returns the number of cells along x and z of the floor mesh, without the far cells around them.
glm::ivec2 floor_cells(const SeaFloor& floor);

/// Returns how far the clouds, and their shadows, have moved since time 0: x and z in metres. They
/// cover a whole number of periods of CloudShadows in a loop, so they stand still in short loops.
glm::dvec2 cloud_drift(const SeaState& sea, double time_s);

struct DrawInput;
/// Computes the uniform block, except for the members that place_below() sets.
SceneBlock scene_block_of(const DrawInput& input, const SeaFacts& sea, const WaterOptics& water, const SkyLight& sky);
/// Sets the light through crests, from sun and sky of the block.
/// \param gain  factor; 1 is true to nature
void place_crest_light(SceneBlock& block, float gain);
/// Sets the members for rendering below the surface: lens, floor (without its heights) and caustics.
void place_below(SceneBlock& block, const DrawInput& input, const SeaFacts& sea, const SeaFloor& floor,
                 const CausticFacts& caustics);
/// Sets the members for the interiors of hulls, from the exclusions of the input.
/// \pre check(input.exclusions, maps.size()) is empty
void place_exclusions(SceneBlock& block, const DrawInput& input, std::span<const ExclusionMap> maps);

}  // namespace pelagic::gl
