// The structs that pelagic_..._make() returns are the default options of C++, by the conversions
// that the library uses. Tables of fields and structured bindings have each member, so that a new one is
// compared.
#include <gtest/gtest.h>

#include <tuple>

#include "pelagic/capi/c_dynamic_waves.hpp"
#include "pelagic/capi/c_exact_water.hpp"
#include "pelagic/capi/c_hull.hpp"
#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_sea.hpp"
#include "pelagic/capi/c_wave_input.hpp"

namespace pelagic::capi {
namespace {

/// Compares each number of a table.
template <class Options, class Fields>
void expect_equal(const Options& c, const Options& cpp, const Fields& fields) {
    for (const NumericField<Options>& field : fields) EXPECT_EQ(field.value_in(c), field.value_in(cpp)) << field.name;
}

auto members(const OceanOptions& options) {
    const auto& [executor, isa, trace, queries, velocities, depth, gradients, slopes, foam, dynamic_waves, shore, spray,
                 inputs, planes, memory] = options;
    return std::make_tuple(executor != nullptr, isa, trace, queries, velocities, depth, gradients, slopes, foam,
                           dynamic_waves.has_value(), shore.has_value(), spray.has_value(), inputs, planes,
                           memory.user, memory.allocate, memory.release);
}

TEST(CInterfaceDefaults, AreThoseOfTheCppInterface) {
    const pelagic_sea c_sea = pelagic_sea_make();
    const SeaState sea = sea_of(&c_sea), usual;
    expect_equal(sea, usual, sea_state_fields());
    EXPECT_EQ(std::tie(sea.waves, sea.spectrum, sea.spreading), std::tie(usual.waves, usual.spectrum, usual.spreading));
    EXPECT_EQ(wave_system_of(pelagic_wave_system_make(), ""), WaveSystem{});
    EXPECT_TRUE(sea.systems.empty());
    const pelagic_dynamic_waves_options waves = pelagic_dynamic_waves_options_make();
    expect_equal(dynamic_waves_options_of(&waves), DynamicWavesOptions{}, dynamic_waves_fields());
    EXPECT_EQ(dynamic_waves_options_of(&waves).step, DynamicWavesOptions{}.step);
    const pelagic_disturbance c_disturbance = pelagic_disturbance_make();
    const Disturbance disturbance = disturbance_of(&c_disturbance, "disturbance");
    expect_equal(disturbance, Disturbance{}, disturbance_fields());
    EXPECT_EQ(disturbance.shape, Disturbance{}.shape);
    EXPECT_EQ(disturbance.mode, Disturbance{}.mode);
    const pelagic_rain rain = pelagic_rain_make();
    expect_equal(rain_of(&rain), Rain{}, rain_fields());
    const pelagic_spray_options spray = pelagic_spray_options_make();
    expect_equal(spray_options_of(&spray), SprayOptions{}, spray_fields());
    expect_equal(emitter_of(pelagic_spray_emitter_make()), SprayEmitter{}, spray_emitter_fields());
    const pelagic_ripple ripple = pelagic_ripple_make();
    expect_equal(ripple_of(&ripple), Ripple{}, ripple_fields());
    const pelagic_waves gerstner = pelagic_waves_make();
    EXPECT_EQ(waves_of(&gerstner).choppiness, AnalyticSea{}.choppiness);
    const pelagic_hull_options c_hull = pelagic_hull_options_make();
    const HullOptions hull = hull_options_of(&c_hull);
    expect_equal(hull, HullOptions{}, hull_fields());
    EXPECT_FALSE(hull.centre_of_mass_m || hull.inertia_kgm2 || hull.added_mass);
    EXPECT_EQ(members(ocean_options_of(pelagic_ocean_options_make())), members(OceanOptions{}));
    const pelagic_water_frame water = pelagic_water_frame_make();
    EXPECT_EQ(water_frame_of(&water), WaterFrame{});
    const ExactWaterOptions exact = exact_water_options_of(pelagic_exact_water_options_make());
    expect_equal(exact, ExactWaterOptions{}, exact_water_fields());
    EXPECT_TRUE(exact.water_frame == WaterFrame{} && !exact.executor && !exact.isa);
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
    expect_equal(shore_options_of(&c), cpp, shore_fields());
    EXPECT_EQ(shore_options_of(&c).heights_m, cpp.heights_m);
}

}  // namespace
}  // namespace pelagic::capi
