// The C interface, compared with the C++ interface that it wraps: equal cascades, and equal seas
// for applications of any version.
#include <gtest/gtest.h>
#include <pelagic/pelagic.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/capi/c_sea.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/slope_sum.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tests/capi_cascade_sum.h"
#include "pelagic/tests/capi_sea.hpp"

namespace pelagic::capi {
namespace {

void expect_same(const pelagic_plane& c, const PlaneView& cpp) {
    ASSERT_EQ(c.data != nullptr, cpp.data != nullptr);
    if (!c.data) return;
    ASSERT_EQ(c.resolution, cpp.resolution);
    const PlaneView view{c.data, c.resolution, c.block_columns, c.row_stride, c.block_stride};
    for (int j = 0; j < c.resolution; ++j)
        for (int i = 0; i < c.resolution; ++i) ASSERT_EQ(view.at(i, j), cpp.at(i, j));
}

template <class T>
void expect_same(const T* c, std::span<const T> cpp) {
    ASSERT_EQ(c == nullptr, cpp.empty());
    EXPECT_TRUE(std::equal(cpp.begin(), cpp.end(), c));
}

TEST(CInterfaceInside, CascadesEqualThoseOfTheCppInterface) {
    auto serial = pelagic_executor_options_make();
    serial.kind = PELAGIC_EXECUTOR_SERIAL;
    pelagic_executor* executor = nullptr;
    ASSERT_EQ(pelagic_executor_create(&serial, &executor), PELAGIC_OK);
    for (const bool has_all : {false, true}) {
        auto sea = pelagic_sea_make();
        sea.resolution = 32;
        sea.cascades = 4;
        auto options = pelagic_ocean_options_make();
        options.executor = executor;
        options.velocities = options.gradients = options.slopes = options.foam = has_all;
        pelagic_ocean* made = nullptr;
        ASSERT_EQ(pelagic_ocean_create(&sea, &options, &made), PELAGIC_OK) << pelagic_last_error();
        pelagic_frame c_frame{};
        ASSERT_EQ(pelagic_ocean_schedule(made, 7), PELAGIC_OK);
        ASSERT_EQ(pelagic_ocean_complete(made, &c_frame), PELAGIC_OK);

        Ocean ocean({.cascades = 4, .resolution = 32}, {.executor = make_serial_executor(),
                                                        .velocities = has_all ? Velocities::drawn : Velocities::none,
                                                        .gradients = has_all ? std::optional(true) : std::nullopt,
                                                        .slopes = has_all ? std::optional(true) : std::nullopt,
                                                        .foam = has_all});
        const Frame& frame = ocean.frame_at(7);
        std::uint64_t hash = 0;
        ASSERT_EQ(pelagic_ocean_frame_hash(made, 0, PELAGIC_HASH_FRAME, &hash), PELAGIC_OK);
        EXPECT_EQ(hash, hash_of(frame));
        ASSERT_EQ(c_frame.cascade_count, 4);
        EXPECT_EQ(c_frame.roughness, static_cast<float>(frame.statistics.roughness));
        EXPECT_EQ(c_frame.foam_drift_x_mps, frame.statistics.foam_drift_x_mps);
        EXPECT_EQ(c_frame.foam_drift_z_mps, frame.statistics.foam_drift_z_mps);
        ASSERT_EQ(pelagic_ocean_frame_hash(made, 0, PELAGIC_HASH_FOAM, &hash),
                  has_all ? PELAGIC_OK : PELAGIC_INVALID_ARGUMENT);
        if (has_all)
            EXPECT_EQ(hash, foam_hash_of(frame));
        else
            EXPECT_STREQ(pelagic_last_error(),
                         "the ocean has no foam: it was created without pelagic_ocean_options.foam");
        EXPECT_EQ(std::memcmp(&c_frame.bounds, &frame.bounds, sizeof c_frame.bounds), 0);
        for (std::size_t t = 0; t < 4; ++t) {
            pelagic_cascade c{};
            ASSERT_EQ(pelagic_ocean_cascade(made, static_cast<int32_t>(t), &c), PELAGIC_OK);
            const Cascade& cascade = frame.cascades[t];
            EXPECT_EQ(c.side_m, cascade.grid.side_m);
            EXPECT_EQ(c.cosine, cascade.grid.cosine);
            EXPECT_EQ(c.sine, cascade.grid.sine);
            EXPECT_EQ(c.slope_range, cascade.slope_ranges.slope);
            EXPECT_EQ(c.variance_range, cascade.slope_ranges.variance);
            EXPECT_EQ(c.compression_scale, cascade.compression_scale);
            EXPECT_EQ(c.compression_front_x, cascade.compression_front_x);
            EXPECT_EQ(c.compression_front_z, cascade.compression_front_z);
            expect_same(c.dx, cascade.dx);
            expect_same(c.height, cascade.height);
            expect_same(c.dz, cascade.dz);
            expect_same(c.velocity_x, cascade.velocity_x);
            expect_same(c.velocity_y, cascade.velocity_y);
            expect_same(c.velocity_z, cascade.velocity_z);
            expect_same(c.displacement_rgba16f, cascade.displacement_rgba16f);
            expect_same(c.gradient_rgba8, cascade.gradient_rgba8);
            expect_same(c.slopes_rgba8, cascade.slopes_rgba8);
            expect_same(c.moments_rgba8, cascade.moments_rgba8);
            expect_same(c.compression_r8, cascade.compression_r8);
            for (std::size_t image = 0; image < cascade.snapshots_rgba8.size(); ++image)
                expect_same(c.snapshots_rgba8[image], cascade.snapshots_rgba8[image]);
            EXPECT_EQ(std::memcmp(&c.bounds, &cascade.bounds, sizeof c.bounds), 0);
        }
        pelagic_ocean_destroy(made);
    }
    pelagic_executor_destroy(executor);
}

// SlopeSum and SlopeMips of slopes_test.cpp compare the texels with the exact surface.
TEST(CInterfaceInside, SlopesOfTheExampleInCAreThoseOfTheCppInterface) {
    const COcean c_ocean = ocean_of(stack_sea(2), executor_of(PELAGIC_EXECUTOR_SERIAL).get());
    complete(c_ocean, 5);
    Ocean ocean({.cascades = 2, .resolution = 32}, {.executor = make_serial_executor()});
    const Cascade& cascade = ocean.frame_at(5).cascades[1];
    pelagic_cascade c{};
    ASSERT_EQ(pelagic_ocean_cascade(c_ocean.get(), 1, &c), PELAGIC_OK);
    for (const auto& [i, j] : {std::pair{0, 0}, {7, 3}, {31, 16}}) {
        const double texel_m = c.side_m / 32;
        double sum[8] = {}, normal[3];
        add_slopes(&c, (c.cosine * i - c.sine * j) * texel_m, (c.sine * i + c.cosine * j) * texel_m, sum);
        normal_of_slopes(sum, normal);
        const std::size_t texel = static_cast<std::size_t>(32 * j + i);
        const SurfaceSlopes of =
            slopes_of_texel(cascade.slopes_rgba8[texel], cascade.moments_rgba8[texel], cascade.slope_ranges);
        const double expected[] = {of.h_x, of.h_z, of.d_xx, of.d_zz, of.d_xz, of.var_xx, of.var_zz, of.cov_xz};
        for (int part = 0; part < 8; ++part) EXPECT_NEAR(sum[part], expected[part], 1e-9) << "rounding of positions";
        EXPECT_NEAR(normal[0], normal_of(of).x, 1e-9);
        EXPECT_NEAR(normal[1], normal_of(of).y, 1e-9);
        EXPECT_NEAR(normal[2], normal_of(of).z, 1e-9);
    }
}

void expect_equal(const pelagic_system_statistics& c, const SystemReport& cpp) {
    EXPECT_EQ(c.expected_wave_height_m, cpp.significant_wave_height_m);
    EXPECT_EQ(c.realised_wave_height_m, cpp.realised_significant_wave_height_m);
    EXPECT_EQ(c.expected_peak_period_s, cpp.peak_period_s);
    EXPECT_EQ(c.realised_peak_period_s, cpp.realised_peak_period_s.value());
    EXPECT_EQ(c.expected_direction_rad, cpp.expected_directions.mean_rad);
    EXPECT_EQ(c.realised_direction_rad, cpp.realised_directions.mean_rad);
    EXPECT_EQ(c.expected_spread_rad, cpp.expected_directions.spread_rad);
    EXPECT_EQ(c.realised_spread_rad, cpp.realised_directions.spread_rad);
}

TEST(CInterfaceInside, StatisticsEqualThoseOfTheCppInterface) {
    auto sea = pelagic_sea_make();
    ASSERT_EQ(pelagic_sea_preset("swell", &sea), PELAGIC_OK);
    sea.resolution = 64;
    sea.systems[0] = pelagic_wave_system_make();
    sea.systems[0].height_m = 0.5;
    sea.systems[0].peak_period_s = 9;
    sea.system_count = 1;
    pelagic_statistics of{};
    ASSERT_EQ(pelagic_sea_statistics(&sea, &of), PELAGIC_OK) << pelagic_last_error();
    const SeaState state = sea_of(&sea);
    const SeaReport report = report_on(state);
    EXPECT_EQ(of.expected_wave_height_m, report.expected.significant_wave_height_m);
    EXPECT_EQ(of.realised_wave_height_m, report.realised_significant_wave_height_m);
    EXPECT_EQ(of.model_wave_height_m, *report.expected.model_significant_wave_height_m);
    EXPECT_EQ(of.expected_peak_period_s, report.expected.peak_period_s);
    EXPECT_EQ(of.realised_peak_period_s, report.realised_peak_period_s);
    EXPECT_EQ(of.peak_wavelength_m, report.expected.peak_wavelength_m);
    EXPECT_EQ(of.expected_tm01_s, report.expected_periods.tm01_s);
    EXPECT_EQ(of.realised_tm01_s, report.realised_periods.tm01_s);
    EXPECT_EQ(of.expected_tm02_s, report.expected_periods.tm02_s);
    EXPECT_EQ(of.realised_tm02_s, report.realised_periods.tm02_s);
    EXPECT_EQ(of.expected_direction_rad, report.expected_directions.mean_rad);
    EXPECT_EQ(of.realised_direction_rad, report.realised_directions.mean_rad);
    EXPECT_EQ(of.expected_spread_rad, report.expected_directions.spread_rad);
    EXPECT_EQ(of.realised_spread_rad, report.realised_directions.spread_rad);
    double along = 0, across = 0;
    for (const CascadeSlopes& cascade : report.cascades)
        along += cascade.slopes.upwind, across += cascade.slopes.crosswind;
    EXPECT_EQ(of.slope_variance_along_wind, along);
    EXPECT_EQ(of.slope_variance_across_wind, across);
    EXPECT_EQ(of.expected_convergence_variance, report.expected_convergence_variance);
    EXPECT_EQ(of.realised_convergence_variance, report.realised_convergence_variance);
    expect_equal(of.wind_sea, report.wind_sea.value());
    expect_equal(of.swell, report.swell.value());
    EXPECT_EQ(of.swell.expected_peak_period_s, 12);
    ASSERT_EQ(report.systems.size(), 1u);
    EXPECT_EQ(of.system_count, 1);
    expect_equal(of.systems[0], report.systems[0]);
    EXPECT_EQ(of.systems[0].expected_peak_period_s, 9);
    EXPECT_EQ(of.systems[1].expected_peak_period_s, 0);
    EXPECT_EQ(of.effective_fetch_m, report.effective_fetch_m.value());
    EXPECT_EQ(of.repeats_after_m, repeat_length_m(state));

    ASSERT_EQ(pelagic_sea_preset("pond", &sea), PELAGIC_OK);
    ASSERT_EQ(pelagic_sea_statistics(&sea, &of), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(of.swell.expected_peak_period_s, 0);
    EXPECT_EQ(of.system_count, 0);
    EXPECT_EQ(of.effective_fetch_m, 0);
    EXPECT_GT(of.expected_tm02_s, 0);

    sea.wind_speed_mps = -3;
    EXPECT_EQ(pelagic_sea_statistics(&sea, &of), PELAGIC_INVALID_ARGUMENT);
    EXPECT_NE(std::string(pelagic_last_error()).find("wind_speed_mps"), std::string::npos);
    EXPECT_EQ(pelagic_sea_statistics(nullptr, &of), PELAGIC_INVALID_ARGUMENT);
    EXPECT_EQ(pelagic_sea_statistics(&sea, nullptr), PELAGIC_INVALID_ARGUMENT);
}

TEST(CInterfaceInside, PresetsAreThoseOfTheLibrary) {
    for (const SeaPreset& preset : sea_presets()) {
        auto sea = pelagic_sea_make();
        ASSERT_EQ(pelagic_sea_preset(preset.name.data(), &sea), PELAGIC_OK);
        EXPECT_EQ(hash_of(Ocean(sea_of(&sea)).frame_at(1)), hash_of(Ocean(preset.sea).frame_at(1))) << preset.name;
    }
}

}  // namespace
}  // namespace pelagic::capi
