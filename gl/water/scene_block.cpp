// Computes the uniforms in double precision and relative to the viewer.
#include "pelagic/gl/water/scene_block.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "pelagic/gl/water/detail_image.hpp"
#include "pelagic/gl/water/foam_image.hpp"
#include "pelagic/gl/water/sea_renderer.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/simd/constants.hpp"

namespace pelagic::gl {
namespace {

using std::numbers::pi;

/// Angular radius of the sun: 16 minutes of arc.
constexpr float sun_radius_rad = 0.00465f;

/// Fraction of the unresolved (subgrid) mean square slope that ripples represent. Waves of the
/// remainder are shorter than ripples.
constexpr float detail_fraction = 0.75f;
/// Least period of the longer ripples in texels of the finest cascade. The longest ripples, a third
/// of the period, are then as long as the shortest waves of the cascade.
constexpr double detail_texels = 6;
/// Shortest ripple: the wave of least phase speed (Lamb 1932, "Hydrodynamics", section 267).
constexpr double shortest_ripple_m = 0.017;
/// Period, in ripple periods, of the noise that offsets the texture coordinates of ripples.
/// scene.glsl has this number too.
constexpr double ripple_noise_tiles = 13;
constexpr double layer_turns_rad[2] = {0.21, -0.47};

/// Angle below the horizon over which the horizon is softened.
constexpr double softened_horizon_rad = 0.15 * pi / 180;
/// Period, in sides of a cascade, of the noise that varies the copies of the cascade, and of the
/// sines that displace it. The value is far from every integer.
constexpr double cascade_noise_sides = 12 * golden;

/// Illuminance of a star of magnitude 0 (Allen 1976, "Astrophysical Quantities").
constexpr float star_illuminance_lx = 2.54e-6f;

/// Returns the coordinates of a point in a rotated periodic square, [0, 1).
glm::dvec2 place_in_square(glm::dvec2 at, double angle, double tile_m) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {fraction((c * at.x + s * at.y) / tile_m), fraction((c * at.y - s * at.x) / tile_m)};
}

/// Returns the extinction of the finest spindrift at the surface. It may affect the visibility from
/// Beaufort 9 on and does so seriously at 12 (WMO 2018, "Manual on Marine Meteorological Services"). The
/// amount, a visibility of 0.8 km at 34 m/s, is chosen by eye.
double spindrift_per_m(const SeaFacts& facts) {
    constexpr double first_wind_mps = 20.8, per_wind = 0.003 / 8;
    return facts.surface == Surface::open ? per_wind * std::max(facts.sea.wind_speed_mps - first_wind_mps, 0.) : 0;
}

void place_cascades(SceneBlock& block, const SeaFacts& facts, glm::dvec2 viewer) {
    // Texel (i, j) of a cascade lies at i L/N, j L/N. The centre of the texture's texel is half a
    // texel further.
    const double half_texel = 0.5 / facts.resolution;
    for (std::size_t i = 0; i < facts.cascades.size(); ++i) {
        const CascadeFacts& cascade = facts.cascades[i];
        const double side = cascade.grid.side_m;
        const CascadeGrid::Vector at = cascade.grid.in_cascade(viewer.x, viewer.y);
        block.cascade_place[i] = {fraction(at.along / side + half_texel), fraction(at.across / side + half_texel),
                                  cascade.grid.cosine / side, cascade.grid.sine / side};
        const double noise_m = cascade_noise_sides * side;
        block.cascade_noise[i] = {fraction(at.along / noise_m), fraction(at.across / noise_m),
                                  1 / cascade_noise_sides, 0};
        // Texels of the last mip are as long as the longest waves.
        const double last_mip = std::log2(cascade.longest_wave_m / facts.texel_m(cascade));
        block.cascade_scale[i] = {1 / facts.texel_m(cascade), last_mip, side, 0};
        block.cascade_slope[i] = {cascade.ranges.slope, cascade.ranges.variance, cascade.slope_variance, 0};
    }
}

void place_details(SceneBlock& block, const SeaFacts& facts, glm::dvec2 viewer) {
    const SeaState& sea = facts.sea;
    const double texel_m = facts.texel_m(facts.finest_cascade());
    const double loop = fraction(facts.time_s / sea.loop_period_s);
    glm::dvec2 shifts[2], noise[2];
    for (int layer = 0; layer < 2; ++layer) {
        // The finer layer ends at the shortest ripple, and the other does not end below it.
        const double fine_m = DetailImage::shortest_ripple * shortest_ripple_m;
        const double tile_m = layer == 0 ? std::max(detail_texels * texel_m, fine_m) : fine_m;
        const double angle = sea.wind_direction_rad + layer_turns_rad[layer];
        // Ripples travel with the speed of deep-water waves of a tenth of the period. They cover a
        // whole number of periods in a loop.
        const double speed = std::sqrt(gravity_mps2 * tile_m / 10 / (2 * pi));
        const double repeats = std::round(speed * sea.loop_period_s / tile_m);
        noise[layer] = place_in_square(viewer, angle, ripple_noise_tiles * tile_m);
        shifts[layer] = place_in_square(viewer, angle, tile_m) - glm::dvec2(fraction(repeats * loop), 0);
        block.detail_turn[static_cast<std::size_t>(layer)] = {std::cos(angle) / tile_m, std::sin(angle) / tile_m,
                                                              std::cos(angle), std::sin(angle)};
    }
    block.detail_shift = {glm::vec2(shifts[0]), glm::vec2(shifts[1])};
    block.detail_noise = {glm::vec2(noise[0]), glm::vec2(noise[1])};
    // Periods in metres: bubbles, lace and two of gusts.
    const glm::dvec4 periods_m(FoamSizes::bubbles_m, FoamSizes::lace_m, 460, 1510);
    block.noise_scale = glm::vec4(1.0 / periods_m);
    const glm::dvec2 swapped(viewer.y, viewer.x);
    const auto placed = [](glm::dvec2 at, double period_m) { return glm::vec2(place_in_square(at, 0, period_m)); };
    block.gust_shift = {placed(viewer, periods_m.z), placed(swapped, periods_m.w)};
}

/// Sets the placement of glints. Indices of squares wrap where float no longer has all integers.
void place_glints(SceneBlock& block, glm::dvec2 viewer) {
    constexpr double square_m = 64, squares = 1 << 20;
    const glm::dvec2 square = glm::floor(viewer / square_m);
    block.glint_place = {viewer - square * square_m, square - glm::floor(square / squares) * squares};
}

/// Sets the placement of the dynamic-wave grid. World texel i lies at i texel_m and is stored in
/// column i mod N. The outermost texels are 0, and their neighbours in the texture belong to the
/// opposite side. They are excluded, as in sample() of dynamic_waves.cpp.
void place_dynamic_waves(SceneBlock& block, const DynamicWaveFacts& dynamic_waves, glm::dvec2 viewer) {
    if (dynamic_waves.resolution == 0) return;
    const double n = dynamic_waves.resolution;
    const glm::dvec2 first(static_cast<double>(dynamic_waves.first_x), static_cast<double>(dynamic_waves.first_z));
    const auto coordinate = [&](double metres) { return fraction((metres / dynamic_waves.texel_m + 0.5) / n); };
    block.dynamic_waves_place = {coordinate(viewer.x), coordinate(viewer.y), 1 / (n * dynamic_waves.texel_m),
                                 1 / dynamic_waves.texel_m};
    block.dynamic_waves_extent = {glm::vec2((first + 0.5 * (n - 1)) * dynamic_waves.texel_m - viewer),
                                  0.5 * (n - 3) * dynamic_waves.texel_m, 0};
}

/// Sets the uniforms of the moon's disc and the stars.
void place_night(SceneBlock& block, const SkyLight& sky) {
    const glm::vec3 sun = sun_direction(sky.options);
    const float lit_fraction = 0.5f - 0.5f * glm::dot(sun, sky.sun_direction);
    block.moon = {sun, sky.key_is_moon ? std::max(lit_fraction, 0.01f) : 0};
    // No stars are visible while the sun is less than 6 degrees below the horizon.
    constexpr float civil_twilight = -0.1045f;
    const float dark = glm::smoothstep(0.f, -0.05f, sun.y - civil_twilight);
    block.stars = {dark * star_illuminance_lx / (sun_illuminance_lx * sky.unit), 0, 0, 0};
}

/// Sets the placement of the clouds' shadows, which move in the world, not with the water.
void place_clouds(SceneBlock& block, const SeaFacts& facts, const SkyLight& sky, glm::dvec2 viewer) {
    const float transmittance = sky.brightest_transmittance;
    if (transmittance <= 0) return;
    const glm::dvec2 place = (viewer - cloud_drift(facts.sea, facts.time_s)) / CloudShadows::period_m + 0.5;
    block.cloud_place = {fraction(place.x), fraction(place.y), 1 / CloudShadows::period_m, 1};
    block.cloud_light = {sky.mean_sunlight, 1 / transmittance, 1, 0};
}

/// Drift of the foam structure, which moves with the foam. Along each of two directions it covers a
/// whole number of texture periods in a loop.
class FoamDrift {
   public:
    explicit FoamDrift(const SeaFacts& facts)
        : metres_a_loop_(glm::dvec2(facts.statistics.foam_drift_x_mps, facts.statistics.foam_drift_z_mps) *
                         facts.sea.loop_period_s),
          loop_(fraction(facts.time_s / facts.sea.loop_period_s)) {}

    /// Returns the viewer's coordinate along a direction in a texture of period tile_m, [0, 1).
    float place(glm::dvec2 viewer, glm::dvec2 direction, double tile_m) const {
        const double repeats = std::round(glm::dot(metres_a_loop_, direction) / tile_m);
        return static_cast<float>(fraction(glm::dot(viewer, direction) / tile_m - repeats * loop_));
    }

   private:
    glm::dvec2 metres_a_loop_;
    double loop_;
};

void place_foam(SceneBlock& block, const SeaFacts& facts, glm::dvec2 viewer) {
    const SeaState& sea = facts.sea;
    const FoamDrift drift(facts);
    const glm::dvec2 x(1, 0), z(0, 1);
    block.foam_shift = {drift.place(viewer, x, FoamSizes::bubbles_m), drift.place(viewer, z, FoamSizes::bubbles_m),
                        drift.place(viewer, x, FoamSizes::lace_m), drift.place(viewer, z, FoamSizes::lace_m)};
    const double c = std::cos(sea.wind_direction_rad), s = std::sin(sea.wind_direction_rad);
    for (std::size_t i = 0; i < 2; ++i) {
        const double along_m = FoamSizes::streaks_along_m[i], across_m = FoamSizes::streaks_across_m[i];
        block.foam_streaks[i] = {1 / along_m, 1 / across_m, drift.place(viewer, {c, s}, along_m),
                                 drift.place(viewer, {-s, c}, across_m)};
    }
    for (std::size_t i = 0; i < std::min(facts.cascades.size(), block.foam_cascade.size()); ++i) {
        const CascadeFacts& cascade = facts.cascades[i];
        block.foam_cascade[i] = {glm::vec2(cascade.foam_drift), cascade.compression_scale,
                                 cascade.has_snapshots ? 1 : 0};
    }
    for (std::size_t slot = 0; slot < SnapshotFoam::slots; ++slot)
        block.foam_age[slot / 4][static_cast<int>(slot % 4)] = facts.foam.age[slot];
    for (std::size_t width = 0; width < FoamFilter::widths; ++width) {
        const FoamFilter& filter = facts.statistics.foam_filters[width];
        block.foam_filter[width] = {filter.deviation, filter.a, filter.b, filter.c};
    }
    const double level = facts.has_foam ? double{facts.foam.level} : SeaStatistics::no_foam_level;
    // Windrows form at wind speeds above 3 m/s and are narrow in a gale.
    const double order = std::clamp((sea.wind_speed_mps - 3) / 15, 0., 1.);
    // Foam is blown in streaks from Beaufort 7 on (13.9 m/s), in dense streaks from 9 on, and white
    // patches of it cover the sea at 11 (Petersen's scale, WMO 1970). The covers are a guess.
    const bool makes_foam = level < SeaStatistics::no_foam_level;
    const double film = makes_foam ? 0.2 * glm::smoothstep(13.9, 30., sea.wind_speed_mps) : 0;
    block.foam_kind = {level, 0.5 - 0.2 * order, film, order};
    block.foam_front = {facts.statistics.foam_front_x, facts.statistics.foam_front_z, 0, 0};
}

/// Sets the placement of the shore. Samples lie at corner_m + (i, j) texel_m; the centres of the
/// texture's texels are half a texel further.
void place_shore(SceneBlock& block, const ShoreFacts& shore, bool has_mips, glm::dvec2 viewer) {
    const glm::dvec2 texels(shore.columns, shore.rows);
    const glm::dvec2 place = (viewer - shore.corner_m) / shore.texel_m + 0.5;
    block.shore_place = {place / texels, 1.0 / (texels * shore.texel_m)};
    block.shore_size = {texels, 1 / shore.texel_m,
                        has_mips ? mip_levels(std::max(shore.columns, shore.rows)) - 1 : 0};
}

}  // namespace

void place_crest_light(SceneBlock& block, float gain) {
    // The back of a wave faces the sun. Its slope and the factor of the path fit
    // docs/images/reference/crest_light.csv. The path is longer than that to the face, because the
    // ray from the eye descends. The skylight fits sums of crest_light.py over suns in all
    // directions.
    constexpr float back_slope = 0.25f, path_factor = 1.75f, skylight = 0.056f;
    constexpr float index = 1.333f;  // water_index of water_light.glsl
    const glm::vec3 sun(block.sun);
    const float across = std::max(std::hypot(sun.x, sun.z), 1e-6f);
    const glm::vec3 back = glm::normalize(glm::vec3(back_slope * sun.x / across, 1, back_slope * sun.z / across));
    const float cosine = std::max(glm::dot(back, sun), 0.01f);
    const glm::vec3 ray = glm::refract(-sun, back, 1 / index);
    const float inner = -glm::dot(ray, back);
    // Fresnel's reflectance of unpolarised light.
    const float s = (cosine - index * inner) / (cosine + index * inner);
    const float p = (index * cosine - inner) / (index * cosine + inner);
    const float entering = (1 - 0.5f * (s * s + p * p)) * cosine / inner;
    block.crest_ray = {ray, path_factor / ray.y};
    block.crest_sun = glm::vec4(glm::vec3(block.sun_irradiance) * (gain * entering / (index * index)), 0);
    block.crest_sky = glm::vec4(glm::vec3(block.sky_irradiance) * (gain * skylight), 0);
}

glm::dvec2 cloud_drift(const SeaState& sea, double time_s) {
    // Over the sea the wind rises as log(z / 0.2 mm) to the top of the surface layer at 100 m, and
    // hardly further up to the clouds.
    constexpr double aloft = 1.21;
    const double periods = aloft * sea.wind_speed_mps * sea.loop_period_s / CloudShadows::period_m;
    const glm::dvec2 a_loop = glm::round(
        periods * glm::dvec2(std::cos(double{sea.wind_direction_rad}), std::sin(double{sea.wind_direction_rad})));
    return CloudShadows::period_m * a_loop * (time_s / sea.loop_period_s);
}

SeaFacts facts_of(const Frame& frame) {
    SeaFacts facts{.sea = frame.sea,
                   .statistics = frame.statistics,
                   .resolution = frame.cascades[0].resolution(),
                   .cascades = {},
                   .time_s = frame.time_s,
                   .water_frame = frame.water_frame,
                   .foam = frame.foam,
                   .dynamic_waves = {.resolution = frame.dynamic_waves.resolution,
                                     .texel_m = frame.dynamic_waves.texel_m,
                                     .first_x = frame.dynamic_waves.first_x,
                                     .first_z = frame.dynamic_waves.first_z}};
    // A finer cascade holds waves shorter than three texels of the coarser cascade
    // (sim/spectrum/bands.cpp). With few analytic waves it also takes longer ones
    // (sim/cascade_plan.hpp).
    double longest_wave_m = frame.cascades[0].grid.side_m;
    for (const Cascade& cascade : frame.cascades) {
        if (frame.sea.waves == WaveModel::analytic && !facts.cascades.empty())
            longest_wave_m = std::max(longest_wave_m, cascade.grid.side_m / steps_of_few_waves);
        facts.cascades.push_back({.grid = cascade.grid,
                                  .ranges = cascade.slope_ranges,
                                  .longest_wave_m = longest_wave_m,
                                  .slope_variance = static_cast<float>(cascade.slope_variance),
                                  .compression_scale = cascade.compression_scale,
                                  .has_snapshots = !cascade.snapshots_rgba8[0].empty(),
                                  .foam_drift = glm::dvec2(cascade.drift_columns, cascade.drift_rows) /
                                                static_cast<double>(cascade.resolution())});
        longest_wave_m = 3 * cascade.texel_m();
    }
    if (const ShoreSurface& shore = frame.shore)
        facts.shore = {shore.columns, shore.rows, shore.texel_m, {shore.x_m, shore.z_m}};
    return facts;
}

SceneBlock scene_block_of(const DrawInput& input, const SeaFacts& facts, const WaterOptics& water,
                          const SkyLight& sky) {
    const SeaState& sea = facts.sea;
    SceneBlock block;
    const QuadtreeGrid& grid = input.list->grid;
    const glm::dvec3 viewer_m = input.viewer();
    const glm::dvec2 viewer(viewer_m.x, viewer_m.z), in_water = facts.in_water(viewer_m);
    const double sea_level_m = facts.water_frame.sea_level_m, above_m = viewer_m.y - sea_level_m;
    for (std::size_t i = 0; i < input.eyes.size(); ++i) {
        const glm::dmat4 clip = glm::translate(input.eyes[i].clip_from_world, viewer_m);
        block.clip_from_viewer[i] = glm::mat4(clip);
        block.viewer_from_clip[i] = glm::mat4(glm::inverse(clip));
        block.eye[i] = glm::vec4(glm::vec3(input.eyes[i].position_m - viewer_m), 0);
    }
    const auto to_float = [](glm::dvec2 v) { return glm::vec2(v); };
    block.viewer = {input.draws_sky ? 1 : 0, spindrift_per_m(facts), above_m, sea_level_m};
    block.grid = {to_float(glm::dvec2(grid.corner) * grid.step_m - viewer), grid.step_m, grid.vertices};
    block.fade = {to_float(grid.fade_centre - viewer), grid.fade_end_m, 1 / (grid.fade_end_m - grid.fade_start_m)};
    block.mesh = {1 / (input.list->lod_scale * grid.vertices), grid.step_m,
                  facts.has_displacement_mips ? mip_levels(facts.resolution) - 1 : 0, 0};
    block.skirt = {to_float((glm::dvec2(grid.corner) + 0.5 * grid.side) * grid.step_m - viewer), grid.side,
                   grid.deepest_level};
    block.sun = {sky.sun_direction, sun_radius_rad};
    const float exposure = input.exposure.value_or(sky.exposure);
    block.sun_irradiance = {sky.sun_irradiance, exposure};
    block.sky_irradiance = {sky.sky_irradiance, sky.levels - 1};
    const double height = std::max(1.5, std::abs(above_m));
    block.haze = {sky.haze_per_m, height / std::tan(softened_horizon_rad)};
    block.water_absorption = {water.absorption_per_m, sea.depth_m};
    const float alpha = static_cast<float>(facts.statistics.roughness);
    const float detail_square = detail_fraction * alpha * alpha;
    block.water_backscattering = {water.backscattering_per_m, detail_square};
    place_crest_light(block, input.crest_glow);
    const double wind = sea.wind_direction_rad;
    block.waves = {std::max(0.05, facts.statistics.significant_wave_height_m), alpha, std::cos(wind), std::sin(wind)};
    place_cascades(block, facts, in_water);
    place_details(block, facts, in_water);
    place_glints(block, in_water);
    place_dynamic_waves(block, facts.dynamic_waves, in_water);
    block.output_kind = {facts.framebuffer_is_srgb ? 0 : 1, facts.writes_radiance ? 1 : 0,
                         input.weighs_samples ? exposure : 0, sky.unit * sun_illuminance_lx};
    place_night(block, sky);
    place_clouds(block, facts, sky, facts.unshifted(viewer_m));
    place_foam(block, facts, in_water);
    if (facts.surface != Surface::open) place_small_water(block, facts, in_water, facts.unshifted(viewer_m));
    if (facts.shore.columns > 0) place_shore(block, facts.shore, facts.shore_has_mips, facts.unshifted(viewer_m));
    return block;
}

}  // namespace pelagic::gl
