// The structs that pelagic_..._make() returns are the default options of C++, by the conversions
// that the library uses. Structured bindings name each member, so that a new one does not compile
// before it is compared.
#include <gtest/gtest.h>

#include <tuple>

#include "pelagic/capi/c_dynamic_waves.hpp"
#include "pelagic/capi/c_hull.hpp"
#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_sea.hpp"
#include "pelagic/capi/c_wave_input.hpp"

namespace pelagic::capi {
namespace {

auto members(const SeaState& sea) {
    const auto& [waves, spectrum, spreading, cascades, resolution, patch_size_m, wind_speed_mps, wind_direction_rad,
                 fetch_m, depth_m, choppiness, roughness, short_wave_cutoff, wind_alignment, swell_height_m,
                 swell_period_s, swell_direction_rad, swell_spread_rad, loop_period_s, seed, wave_count,
                 longest_wave_m, shortest_wave_m, wave_strength, wave_height_m, wave_drag] = sea;
    return std::make_tuple(waves, spectrum, spreading, cascades, resolution, patch_size_m, wind_speed_mps,
                           wind_direction_rad, fetch_m, depth_m, choppiness, roughness, short_wave_cutoff,
                           wind_alignment, swell_height_m, swell_period_s, swell_direction_rad, swell_spread_rad,
                           loop_period_s, seed, wave_count, longest_wave_m, shortest_wave_m, wave_strength,
                           wave_height_m, wave_drag);
}

auto members(const DynamicWavesOptions& options) {
    const auto& [step, resolution, side_m, ticks_per_s, border_m, depth_m, viscosity_m2ps, wave_speed_mps,
                 decay_per_s, foam_height_m] = options;
    return std::make_tuple(step, resolution, side_m, ticks_per_s, border_m, depth_m, viscosity_m2ps, wave_speed_mps,
                           decay_per_s, foam_height_m);
}

auto members(const Disturbance& disturbance) {
    const auto& [shape, mode, x_m, z_m, radius_m, length_m, heading_rad, height_m, rate_per_s, velocity_x_mps,
                 velocity_z_mps] = disturbance;
    return std::make_tuple(shape, mode, x_m, z_m, radius_m, length_m, heading_rad, height_m, rate_per_s,
                           velocity_x_mps, velocity_z_mps);
}

auto members(const Rain& rain) {
    const auto& [drops_per_m2_s, radius_m, height_m, seed] = rain;
    return std::make_tuple(drops_per_m2_s, radius_m, height_m, seed);
}

auto members(const SprayOptions& options) {
    const auto& [reach_m, amount, seed] = options;
    return std::make_tuple(reach_m, amount, seed);
}

auto members(const SprayEmitter& emitter) {
    const auto& [time_s, x_m, y_m, z_m, extent_m, velocity_x_mps, velocity_y_mps, velocity_z_mps, spread_mps,
                 radius_m, drop_mm, count] = emitter;
    return std::make_tuple(time_s, x_m, y_m, z_m, extent_m, velocity_x_mps, velocity_y_mps, velocity_z_mps,
                           spread_mps, radius_m, drop_mm, count);
}

auto members(const ShoreOptions& options) {
    const auto& [columns, rows, heights_m, corner_x_m, corner_z_m, metres_per_sample, resolution, fade_m, swash_m] =
        options;
    return std::make_tuple(columns, rows, heights_m, corner_x_m, corner_z_m, metres_per_sample, resolution, fade_m,
                           swash_m);
}

auto members(const Ripple& ripple) {
    const auto& [x_m, z_m, wavelength_m, amplitude_m, reach_m, phase_rad] = ripple;
    return std::make_tuple(x_m, z_m, wavelength_m, amplitude_m, reach_m, phase_rad);
}

auto members(const HullOptions& options) {
    const auto& [mass_kg, centre_of_mass_m, inertia_kgm2, added_mass, heave_damping, roll_damping,
                 pressure_coefficient, suction_coefficient, friction_coefficient, air_coefficient,
                 water_density_kgpm3, air_density_kgpm3, skeg_m2, skeg_x_m, skeg_y_m] = options;
    return std::make_tuple(mass_kg, centre_of_mass_m.has_value(), inertia_kgm2.has_value(), added_mass.has_value(),
                           heave_damping, roll_damping, pressure_coefficient, suction_coefficient,
                           friction_coefficient, air_coefficient, water_density_kgpm3, air_density_kgpm3, skeg_m2,
                           skeg_x_m, skeg_y_m);
}

auto members(const OceanOptions& options) {
    const auto& [executor, isa, trace, queries, velocities, gradients, slopes, foam, dynamic_waves, shore, spray,
                 inputs, planes, memory] = options;
    return std::make_tuple(executor != nullptr, isa, trace, queries, velocities, gradients, slopes, foam,
                           dynamic_waves.has_value(), shore.has_value(), spray.has_value(), inputs, planes,
                           memory.user, memory.allocate, memory.release);
}

TEST(CInterfaceDefaults, AreThoseOfTheCppInterface) {
    const pelagic_sea sea = pelagic_sea_make();
    EXPECT_EQ(members(sea_of(&sea)), members(SeaState{}));
    const pelagic_dynamic_waves_options waves = pelagic_dynamic_waves_options_make();
    EXPECT_EQ(members(dynamic_waves_options_of(&waves)), members(DynamicWavesOptions{}));
    const pelagic_disturbance disturbance = pelagic_disturbance_make();
    EXPECT_EQ(members(disturbance_of(&disturbance, "disturbance")), members(Disturbance{}));
    const pelagic_rain rain = pelagic_rain_make();
    EXPECT_EQ(members(rain_of(&rain)), members(Rain{}));
    const pelagic_spray_options spray = pelagic_spray_options_make();
    EXPECT_EQ(members(spray_options_of(&spray)), members(SprayOptions{}));
    EXPECT_EQ(members(emitter_of(pelagic_spray_emitter_make())), members(SprayEmitter{}));
    const pelagic_ripple ripple = pelagic_ripple_make();
    EXPECT_EQ(members(ripple_of(&ripple)), members(Ripple{}));
    const pelagic_waves gerstner = pelagic_waves_make();
    EXPECT_EQ(waves_of(&gerstner).choppiness, AnalyticSea{}.choppiness);
    const pelagic_hull_options hull = pelagic_hull_options_make();
    EXPECT_EQ(members(hull_options_of(&hull)), members(HullOptions{}));
    EXPECT_EQ(members(ocean_options_of(pelagic_ocean_options_make())), members(OceanOptions{}));
    const pelagic_water_frame water = pelagic_water_frame_make();
    EXPECT_EQ(water_frame_of(&water), WaterFrame{});
}

// Without samples a shore is invalid, so it has two by two.
TEST(CInterfaceDefaults, OfAShoreAreThoseOfTheCppInterface) {
    const float floor[] = {-9, 1, -8, 2};
    pelagic_shore_options c = pelagic_shore_options_make();
    c.columns = c.rows = 2;
    c.metres_per_sample = 100;
    c.heights_m = floor;
    ShoreOptions cpp{.columns = 2, .rows = 2, .heights_m = {-9, 1, -8, 2}};
    EXPECT_EQ(pelagic_shore_options_make().metres_per_sample, cpp.metres_per_sample);
    cpp.metres_per_sample = 100;
    EXPECT_EQ(members(shore_options_of(&c)), members(cpp));
}

}  // namespace
}  // namespace pelagic::capi
