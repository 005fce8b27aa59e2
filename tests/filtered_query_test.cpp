// Queries that leave out waves shorter than a footprint: against Airy's theory and the exact sum over waves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "pelagic/sim/exact_water.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"
#include "pelagic/sim/water_jobs.hpp"
#include "pelagic/sim/water_query.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/oracle/sea_oracle.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;

constexpr double swell_m = 0.02, swell_s = 4, moment_s = 0.3;

/// A low wave of `texels` texels on a grid of 128, without displacement.
SeaState wave_of(double texels, double depth_m) {
    SeaState sea{.waves = WaveModel::regular, .regular_height_m = 2 * swell_m, .regular_period_s = swell_s};
    sea.resolution = 128;
    sea.depth_m = depth_m;
    sea.wind_direction_rad = 0.4;
    sea.choppiness = 0;
    sea.loop_period_s = 20 * swell_s;
    sea.patch_size_m = 128 / texels * 2 * pi / oracle::wave_number_at(2 * pi / swell_s, depth_m);
    return sea;
}

struct Places {
    std::vector<double> x, y, z;
    explicit Places(int count, double y_m = 0) : y(static_cast<std::size_t>(count), y_m) {
        for (int i = 0; i < count; ++i) {
            x.push_back(211.5 * std::sin(1.0 + 17 * i));
            z.push_back(387.25 * std::cos(3.0 * i));
        }
    }
};

struct Surface {
    std::vector<float> height, nx, ny, nz, vx, vy, vz;
    explicit Surface(std::size_t n) : height(n), nx(n), ny(n), nz(n), vx(n), vy(n), vz(n) {}
    SurfaceSamples samples() {
        return {.height_m = height,
                .normal_x = nx,
                .normal_y = ny,
                .normal_z = nz,
                .velocity_x_mps = vx,
                .velocity_y_mps = vy,
                .velocity_z_mps = vz};
    }
};

/// What remains of a wave: the quotients of sums over products with its closed form. The pressure is at a depth of a
/// tenth of the wave.
struct Remaining {
    double height, slope, along, up, pressure;
};

Remaining remaining(double texels, double depth_m, double footprint_over_wave) {
    const SeaState sea = wave_of(texels, depth_m);
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .depth = true});
    const Frame& frame = ocean.frame_at(moment_s);
    const double omega = 2 * pi / swell_s, k = oracle::wave_number_at(omega, depth_m), tanh_kd = std::tanh(k * depth_m);
    const double footprint_m = footprint_over_wave * 2 * pi / k, below_m = 0.2 * pi / k;
    const Places places(1000, -below_m);
    Surface surface(places.x.size());
    std::vector<float> pressure(places.x.size());
    const SurfaceQueryOptions options{.interpolation = Interpolation::cubic};
    SurfaceQuery(frame, options).sample({places.x, places.z, footprint_m}, surface.samples());
    WaterQuery(frame, {.surface = options})
        .sample({places.x, places.y, places.z, footprint_m}, {.pressure_pa = pressure});
    const double cosine = std::cos(sea.wind_direction_rad), sine = std::sin(sea.wind_direction_rad);
    double height = 0, slope = 0, along = 0, up = 0, head = 0, of_cosine = 0, of_sine = 0;
    for (std::size_t i = 0; i < places.x.size(); ++i) {
        const double phase = k * (places.x[i] * cosine + places.z[i] * sine) - omega * moment_s;
        const double c = std::cos(phase), s = std::sin(phase), ny = static_cast<double>(surface.ny[i]);
        height += c * static_cast<double>(surface.height[i]);
        slope += s * (static_cast<double>(surface.nx[i]) * cosine + static_cast<double>(surface.nz[i]) * sine) / ny;
        along += c * (static_cast<double>(surface.vx[i]) * cosine + static_cast<double>(surface.vz[i]) * sine);
        up += s * static_cast<double>(surface.vy[i]);
        head += c * (static_cast<double>(pressure[i]) / (1025 * gravity_mps2) - below_m);
        of_cosine += c * c, of_sine += s * s;
    }
    const double at_depth = std::cosh(k * (depth_m - below_m)) / std::cosh(k * depth_m);
    return {height / of_cosine / swell_m, slope / of_sine / (k * swell_m),
            along / of_cosine / (omega * swell_m / tanh_kd), up / of_sine / (omega * swell_m),
            head / of_cosine / (swell_m * (depth_m < 1000 ? at_depth : std::exp(-k * below_m)))};
}

// Bounds are those of WaterPoints::footprint_m. Regular waves have at least 8 texels.
TEST(FilteredQuery, KeepsLongWavesAndLeavesOutShortOnes) {
    for (const double water_m : {4000.0, 30.0})
        for (const double footprint_texels : {8.0, 10.0, 12.0, 14.0, 16.0, 20.0, 24.0, 28.0, 32.0}) {
            SCOPED_TRACE(testing::Message() << water_m << " m, " << footprint_texels << " texels");
            const Remaining longer = remaining(2 * footprint_texels, water_m, 0.5);
            for (const double kept : {longer.height, longer.slope, longer.pressure}) {
                EXPECT_GE(kept, 0.9);
                EXPECT_LE(kept, 1);
            }
            if (footprint_texels < 16) continue;
            for (const double kept : {longer.along, longer.up}) EXPECT_GE(kept, 0.9);
            const Remaining shorter = remaining(footprint_texels / 2, water_m, 2);
            for (const double kept : {shorter.height, shorter.slope, shorter.pressure, shorter.along, shorter.up})
                EXPECT_LE(std::fabs(kept), 0.14);
        }
}

SeaState windy_sea(int cascades) {
    SeaState sea{.wind_speed_mps = 11};
    sea.cascades = cascades;
    sea.resolution = cascades == 1 ? 128 : 64;
    sea.choppiness = 0;
    if (cascades == 1) sea.patch_size_m = 200;
    return sea;
}

double mean_square(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2);
    return sum / static_cast<double>(a.size());
}

// A frame has the waves of twice the footprint and longer within 10 %, none of half the footprint over 14 %, and some
// of those between.
TEST(FilteredQuery, IsBetweenTheExactSumsOfTwiceAndHalfTheFootprint) {
    for (const int cascades : {1, 4})
        for (const double footprint_m : {16.0, 24.0, 40.0}) {
            SCOPED_TRACE(testing::Message() << cascades << " cascades, " << footprint_m << " m");
            const SeaState sea = windy_sea(cascades);
            Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .depth = true});
            const ExactWater exact = ExactWater(sea).at(moment_s);
            const Places places(1500);
            const auto sum_of = [&](double shortest_m) {
                Surface surface(places.x.size());
                exact.sample_surface({places.x, places.z, shortest_m}, surface.samples());
                return surface;
            };
            const Surface all = sum_of(0), longer = sum_of(2 * footprint_m), shorter = sum_of(footprint_m / 2),
                          none(places.x.size());
            Surface frame(places.x.size());
            SurfaceQuery(ocean.frame_at(moment_s), {.interpolation = Interpolation::cubic})
                .sample({places.x, places.z, footprint_m}, frame.samples());
            const auto expect_between = [&](std::vector<float> Surface::*of) {
                const double most = mean_square(longer.*of, shorter.*of) + 0.01 * mean_square(longer.*of, none.*of) +
                                    0.02 * mean_square(shorter.*of, all.*of);
                EXPECT_LT(mean_square(frame.*of, longer.*of), most);
                EXPECT_LT(mean_square(frame.*of, shorter.*of), most);
            };
            for (const auto of : {&Surface::height, &Surface::nx, &Surface::nz}) expect_between(of);
            // stacks have no velocities of waves of 3 to 4 texels, which a cascade has below each footprint
            if (cascades == 1)
                for (const auto of : {&Surface::vx, &Surface::vy, &Surface::vz}) expect_between(of);
        }
}

// Against the Fourier transform of the heights with all waves, in double precision.
TEST(FilteredQuery, TheExactSumLeavesOutExactlyTheShorterWaves) {
    constexpr int n = 16;
    constexpr double side_m = 60;
    SeaState sea{.patch_size_m = side_m, .wind_speed_mps = 8};
    sea.resolution = n;
    sea.depth_m = 12;
    const ExactWater water = ExactWater(sea).at(7.5);
    std::vector<double> x, z;
    for (int i = 0; i < n * n; ++i) {
        x.push_back(i % n * side_m / n);
        z.push_back(i / n * side_m / n);
    }
    std::vector<float> all(x.size()), some(x.size());
    water.sample_surface({x, z}, {.height_m = all});
    std::vector<std::complex<double>> waves(x.size());
    const auto turn = [&](int m, int k, std::size_t i) {
        return std::polar(1.0, 2 * pi * (m * x[i] + k * z[i]) / side_m);
    };
    for (int m = -n / 2; m < n / 2; ++m)
        for (int k = -n / 2; k < n / 2; ++k) {
            std::complex<double>& wave = waves[static_cast<std::size_t>((m + n / 2) * n + k + n / 2)];
            for (std::size_t i = 0; i < x.size(); ++i)
                wave += static_cast<double>(all[i]) * std::conj(turn(m, k, i)) / (n * n * 1.0);
        }
    for (const double footprint_m : {9.0, side_m / 5, 30.1}) {  // waves of (3, 4) and (5, 0) have side / 5
        water.sample_surface({x, z, footprint_m}, {.height_m = some});
        double variance = 0, worst = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            std::complex<double> sum = 0;
            for (int m = -n / 2; m < n / 2; ++m)
                for (int k = -n / 2; k < n / 2; ++k)
                    if (std::hypot(m, k) <= side_m / footprint_m + 1e-9)
                        sum += waves[static_cast<std::size_t>((m + n / 2) * n + k + n / 2)] * turn(m, k, i);
            variance += std::pow(static_cast<double>(all[i]), 2) / (n * n);
            worst = std::max(worst, std::fabs(static_cast<double>(some[i]) - sum.real()));
        }
        // heights are floats
        EXPECT_LT(worst, 2e-6 * std::sqrt(variance)) << footprint_m;
    }
}

// Velocities and pressures of the exact sum have the waves of its heights.
TEST(FilteredQuery, TheExactSumHasAWaveOrNot) {
    const SeaState sea = wave_of(32, 20);
    const double wave_m = 2 * pi / oracle::wave_number_at(2 * pi / swell_s, sea.depth_m);
    const ExactWater water = ExactWater(sea).at(moment_s);
    const Places places(100, -1);
    std::vector<float> pressure(100), vx(100), all_pressure(100), all_vx(100);
    water.sample({places.x, places.y, places.z}, {.pressure_pa = all_pressure, .velocity_x_mps = all_vx});
    water.sample({places.x, places.y, places.z, 0.99 * wave_m}, {.pressure_pa = pressure, .velocity_x_mps = vx});
    EXPECT_EQ(mean_square(pressure, all_pressure), 0);
    EXPECT_EQ(mean_square(vx, all_vx), 0);
    water.sample({places.x, places.y, places.z, 1.01 * wave_m}, {.pressure_pa = pressure, .velocity_x_mps = vx});
    for (std::size_t i = 0; i < vx.size(); ++i) {
        EXPECT_FLOAT_EQ(pressure[i], static_cast<float>(1025 * gravity_mps2));
        EXPECT_EQ(vx[i], 0);
    }
}

TEST(FilteredQuery, ASmallFootprintHasNoEffect) {
    Ocean ocean(windy_sea(4), {.executor = make_serial_executor(), .queries = true, .depth = true});
    const Frame& frame = ocean.frame_at(moment_s);
    const Places places(500);
    Surface all(places.x.size()), some(places.x.size());
    SurfaceQuery(frame).sample({places.x, places.z}, all.samples());
    SurfaceQuery(frame).sample({places.x, places.z, 1e-3}, some.samples());
    // the price of weights
    EXPECT_LT(mean_square(all.height, some.height), 1e-6 * mean_square(all.height, Surface(places.x.size()).height));
    EXPECT_LT(mean_square(all.vy, some.vy), 1e-6 * mean_square(all.vy, Surface(places.x.size()).vy));
}

class FilteredQueryOnEachIsa : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(Isas, FilteredQueryOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

TEST_P(FilteredQueryOnEachIsa, HasTheBitsOfTheFirstAndOfAnyThreads) {
    const auto sample = [](Isa isa, const std::shared_ptr<Executor>& executor) {
        Ocean ocean(windy_sea(4), {.executor = executor, .isa = isa, .queries = true, .depth = true});
        const Frame& frame = ocean.frame_at(moment_s);
        const Places places(3000, -2);
        std::vector<std::vector<float>> all(15, std::vector<float>(places.x.size()));
        SurfaceQueryJobs(executor).sample(SurfaceQuery(frame), {places.x, places.z, 12},
                                          {.height_m = all[0],
                                           .normal_x = all[1],
                                           .normal_y = all[2],
                                           .normal_z = all[3],
                                           .velocity_x_mps = all[4],
                                           .velocity_y_mps = all[5],
                                           .velocity_z_mps = all[6]});
        WaterJobs(executor).sample(WaterQuery(frame), {places.x, places.y, places.z, 12},
                                   {all[7], all[8], all[9], all[10], all[11], all[12], all[13], all[14]});
        const ExactWater exact(windy_sea(4), {.isa = isa});
        for (const auto& values : all)
            for (const float value : values) EXPECT_TRUE(std::isfinite(value));
        all.emplace_back(100);
        exact.sample_surface({std::span(places.x).first(100), std::span(places.z).first(100), 12},
                             {.height_m = all.back()});
        return all;
    };
    EXPECT_EQ(sample(GetParam(), make_thread_executor(3)), sample(isas_here().front(), make_serial_executor()));
}

TEST(FilteredQuery, RejectsWhatItCannotLeaveOut) {
    Ocean shallow(windy_sea(1), {.executor = make_serial_executor(), .queries = true, .depth = true}),
        surface_only(windy_sea(1), {.executor = make_serial_executor(), .queries = true});
    const SurfaceQuery deep(shallow.frame_at(0)), flat(surface_only.frame_at(0));
    const Places places(1);
    std::vector<float> height(1);
    const auto message = [&](const SurfaceQuery& query, double footprint_m) {
        return message_of([&] { query.sample({places.x, places.z, footprint_m}, {.height_m = height}); });
    };
    EXPECT_EQ(message(deep, -1), "footprint_m is -1, expected 0 or more");
    EXPECT_EQ(message(flat, 5),
              "footprint_m needs water below the surface: the ocean was created without OceanOptions::depth");
    EXPECT_EQ(message_of([&] {
                  WaterQuery(deep.frame()).sample({places.x, places.y, places.z, -2}, {.depth_m = height});
              }),
              "footprint_m is -2, expected 0 or more");
    EXPECT_EQ(message_of([&] {
                  ExactWater(windy_sea(1)).sample_surface({places.x, places.z, -3}, {.height_m = height});
              }),
              "footprint_m is -3, expected 0 or more");
    // the water of a pond rests, and its waves remain
    Ocean pond({.waves = WaveModel::pond}, {.executor = make_serial_executor(), .queries = true, .depth = true});
    const SurfaceQuery pond_water(pond.frame_at(2));
    std::vector<float> all(1);
    pond_water.sample({places.x, places.z}, {.height_m = all});
    EXPECT_EQ(message(pond_water, 1), "");
    EXPECT_EQ(height, all);
}

}  // namespace
}  // namespace pelagic
