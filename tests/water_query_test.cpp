// Pressure, velocity and acceleration below the surface of a frame: against Airy's theory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/exact_water.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/water_query.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/oracle/sea_oracle.hpp"
#include "pelagic/tests/test_paths.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;

constexpr double amplitude_m = 0.05;

/// A wave of `texels` texels on a grid of 128, so low that theory of the first order holds, and flat
/// enough to be drawn without displacement.
SeaState wave_of(double texels, double period_s, double depth_m, double direction_rad) {
    SeaState sea{.waves = WaveModel::regular, .regular_height_m = 2 * amplitude_m, .regular_period_s = period_s};
    sea.resolution = 128;
    sea.depth_m = depth_m;
    sea.wind_direction_rad = direction_rad;
    sea.choppiness = 0;
    sea.loop_period_s = 20 * period_s;
    sea.patch_size_m = 128 / texels * 2 * pi / oracle::wave_number_at(2 * pi / period_s, depth_m);
    return sea;
}

struct Motion {
    std::vector<float> depth, pressure, vx, vy, vz, ax, ay, az;
    explicit Motion(std::size_t n) : depth(n), pressure(n), vx(n), vy(n), vz(n), ax(n), ay(n), az(n) {}
    WaterSamples samples() { return {depth, pressure, vx, vy, vz, ax, ay, az}; }
};

struct Errors {
    double pressure = 0, velocity = 0, acceleration = 0;
};

/// Returns the largest errors, in units of the wave's amplitudes at the surface, at depths of up to a wavelength.
Errors largest_errors(double texels, double period_s, double water_m, double direction_rad, bool at_surface = false) {
    const SeaState sea = wave_of(texels, period_s, water_m, direction_rad);
    EXPECT_EQ(check(sea), "");
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .depth = true});
    const double omega = 2 * pi / period_s, k = oracle::wave_number_at(omega, water_m);
    std::vector<double> x, y, z;
    for (int i = 0; i < 4000; ++i) {
        x.push_back(211.5 * std::sin(1.0 + 17 * i));
        z.push_back(387.25 * std::cos(3.0 * i));
        const double part = (i % 400) / 400.0;
        y.push_back(at_surface ? 0 : -0.06 - part * part * std::min(water_m - 0.07, 2 * pi / k));
    }
    Motion motion(x.size());
    const double t = 0.3;
    const auto phase_at = [&](std::size_t i) {
        return k * (x[i] * std::cos(direction_rad) + z[i] * std::sin(direction_rad)) - omega * t;
    };
    if (at_surface)
        for (std::size_t i = 0; i < x.size(); ++i) y[i] = amplitude_m * std::cos(phase_at(i)) - 1e-3;
    WaterQuery(ocean.frame_at(t), {.surface = {.interpolation = Interpolation::cubic}})
        .sample({x, y, z}, motion.samples());
    Errors errors;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double phase = phase_at(i);
        const double e = amplitude_m * std::cos(phase), s = water_m * (e - y[i]) / (water_m + e);
        const double down = std::exp(-2 * k * (water_m - s)), twice = std::exp(-2 * k * water_m);
        const double head = std::exp(-k * s) * (1 + down) / (1 + twice),
                     rise = std::exp(-k * s) * (1 - down) / (1 - twice),
                     along = std::exp(-k * s) * (1 + down) / (1 - twice);
        const auto worst = [](double& so_far, double value) { so_far = std::max(so_far, std::fabs(value)); };
        const auto of = [&](const std::vector<float>& values) { return static_cast<double>(values[i]); };
        worst(errors.pressure, (of(motion.pressure) / (1025 * gravity_mps2) - (e * head - y[i])) / amplitude_m);
        const double u = omega * amplitude_m * along * std::cos(phase),
            v = omega * amplitude_m * rise * std::sin(phase);
        const double cosine = std::cos(direction_rad), sine = std::sin(direction_rad);
        const double orbit = omega * amplitude_m / std::tanh(k * water_m);
        worst(errors.velocity, (of(motion.vx) - u * cosine) / orbit);
        worst(errors.velocity, (of(motion.vz) - u * sine) / orbit);
        worst(errors.velocity, (of(motion.vy) - v) / orbit);
        const double push = gravity_mps2 * k * amplitude_m;
        worst(errors.acceleration, (of(motion.ax) - push * head * std::sin(phase) * cosine) / push);
        worst(errors.acceleration, (of(motion.az) - push * head * std::sin(phase) * sine) / push);
        worst(errors.acceleration,
              (of(motion.ay) + push * head * std::tanh(k * (water_m - s)) * std::cos(phase)) / push);
    }
    return errors;
}

// Waves from 8 texels on for the pressure, and from 16 for velocities, in deep and shallow water, on a
// grid that lies askew to the waves.
TEST(WaterQuery, PressureAndVelocityAreAirysAtEachDepth) {
    for (const double water_m : {4000.0, 20.0, 5.0})
        for (const double texels : {8.0, 16.0, 32.0, 64.0, 128.0}) {
            const Errors errors = largest_errors(texels, 6, water_m, 0.4);
            SCOPED_TRACE(testing::Message() << water_m << " m, " << texels << " texels");
            EXPECT_LT(errors.pressure, 0.03);
            if (texels < 16) continue;
            EXPECT_LT(errors.velocity, 0.03);
            EXPECT_LT(errors.acceleration, 0.1);  // -grad(p) / rho, by derivatives of the fit between depths
        }
}

TEST(WaterQuery, VelocityAtTheSurfaceIsAirys) {
    for (const double water_m : {4000.0, 20.0, 5.0})
        for (const double texels : {8.0, 16.0, 32.0, 128.0})
            EXPECT_LT(largest_errors(texels, 6, water_m, 0.4, true).velocity, texels < 16 ? 0.03 : 0.01)
                << water_m << " m, " << texels << " texels";
}

/// Returns the errors against the exact sum over waves at a depth, in percent of the amplitudes at the surface, as
/// "pressure / velocity".
std::string percents_at(double texels, double depth_over_wave) {
    const SeaState sea = wave_of(texels, 6, 4000, 0.4);
    const double omega = 2 * pi / 6, k = oracle::wave_number_at(omega, sea.depth_m);
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .depth = true});
    const ExactWater exact = ExactWater(sea).at(0.3);
    std::vector<double> x, z;
    for (int i = 0; i < 400; ++i) {
        x.push_back(211.5 * std::sin(1.0 + 17 * i));
        z.push_back(387.25 * std::cos(3.0 * i));
    }
    std::vector<float> heights(x.size());
    exact.sample_surface({x, z}, {.height_m = heights});
    std::vector<double> y;
    for (const float height : heights) y.push_back(static_cast<double>(height) - depth_over_wave * 2 * pi / k);
    Motion frame(x.size()), sum(x.size());
    WaterQuery(ocean.frame_at(0.3), {.surface = {.interpolation = Interpolation::cubic}})
        .sample({x, y, z}, frame.samples());
    exact.sample({x, y, z}, sum.samples());
    const auto percent = [&](const std::vector<float> Motion::*of, double unit) {
        double worst = 0;
        for (std::size_t i = 0; i < x.size(); ++i)
            worst = std::max(worst, std::fabs(static_cast<double>((frame.*of)[i]) - static_cast<double>((sum.*of)[i])));
        return std::round(1000 * worst / unit) / 10;
    };
    const double orbit = omega * amplitude_m;
    const double velocity =
        std::max({percent(&Motion::vx, orbit), percent(&Motion::vy, orbit), percent(&Motion::vz, orbit)});
    char text[64];
    std::snprintf(text, sizeof text, "%.1f / %.1f", percent(&Motion::pressure, 1025 * gravity_mps2 * amplitude_m),
                  velocity);
    return text;
}

// The rows of the table in docs/queries.md.
TEST(WaterQuery, ErrorsByDepthAndWavelengthAreThoseOfTheDocumentation) {
    std::ifstream page(in_sources("docs/queries.md"));
    const std::string text{std::istreambuf_iterator<char>(page), {}};
    for (const int texels : {8, 12, 16, 32, 64}) {
        std::string row = "| " + std::to_string(texels);
        for (const double depth : {0.0, 1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2}) row += " | " + percents_at(texels, depth);
        EXPECT_NE(text.find(row + " |\n"), std::string::npos) << row << " |";
    }
}

// Stokes (1847): (ka)^2 c of the second order; those of the third are ka of it.
TEST(WaterQuery, WaterThatFollowsVelocitiesDriftsAsStokes) {
    constexpr double period_s = 4, ka = 0.04;
    constexpr int periods = 6, steps = 48, count = 24;
    const double omega = 2 * pi / period_s, k = oracle::wave_number_at(omega, 4000), c = omega / k;
    for (const double choppiness : {0.0, 0.5, 1.0}) {
        SeaState sea = wave_of(32, period_s, 4000, 0);
        sea.choppiness = choppiness;
        sea.regular_height_m = 2 * ka / k;
        Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .velocities = Velocities::water});
        std::vector<double> x(count), z(count);
        for (int i = 0; i < count; ++i) x[static_cast<std::size_t>(i)] = 2 * pi / k * i / count;
        const std::vector<double> begin = x;
        std::vector<float> speed(count);
        const double step_s = period_s / steps;
        for (int step = 0; step < periods * steps; ++step) {
            const std::vector<double> before = x;
            for (const double part : {0.5, 1.0}) {  // by the midpoint
                const Frame& frame = ocean.frame_at((step + (part == 1 ? 0.5 : 0)) * step_s);
                SurfaceQuery(frame, {.interpolation = Interpolation::cubic})
                    .sample({x, z}, {.velocity_x_mps = speed});
                for (std::size_t i = 0; i < x.size(); ++i)
                    x[i] = before[i] + part * step_s * static_cast<double>(speed[i]);
            }
        }
        double drift_mps = 0;
        for (std::size_t i = 0; i < x.size(); ++i) drift_mps += (x[i] - begin[i]) / (count * periods * period_s);
        EXPECT_NEAR(drift_mps / (ka * ka * c), 1, 0.06) << choppiness;
    }
}

/// Points around the surface of a steep sea.
struct Points {
    std::vector<double> x, y, z;
    explicit Points(int count) {
        for (int i = 0; i < count; ++i) {
            x.push_back(97 * std::sin(1.0 + i));
            y.push_back(2.0 - 0.02 * (i % 700));
            z.push_back(131 * std::cos(3.0 * i));
        }
    }
    WaterPoints all() const { return {x, y, z}; }
};

SeaState steep_sea(int cascades) {
    SeaState sea{.wind_speed_mps = 14};
    sea.cascades = cascades;
    sea.resolution = cascades == 1 ? 128 : 64;
    if (cascades == 1) sea.patch_size_m = 300;
    return sea;
}

class WaterQueryOnEachIsa : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(Isas, WaterQueryOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

// On the surface that is queried, the pressure is 0, and it grows by the weight of the water above.
TEST_P(WaterQueryOnEachIsa, PressureIsZeroAtTheDrawnSurface) {
    for (const int cascades : {1, 4}) {
        Ocean ocean(steep_sea(cascades), {.executor = make_serial_executor(), .isa = GetParam(), .queries = true,
                                          .depth = true});
        const Frame& frame = ocean.frame_at(12.5);
        const WaterQuery water(frame);
        Points points(700);
        std::vector<float> heights(points.x.size());
        water.surface().sample({points.x, points.z}, {.height_m = heights});
        for (const double below_m : {0.0, 1e-3, 0.05}) {
            for (std::size_t i = 0; i < heights.size(); ++i) points.y[i] = static_cast<double>(heights[i]) - below_m;
            Motion motion(points.x.size());
            water.sample(points.all(), motion.samples());
            for (std::size_t i = 0; i < heights.size(); ++i) {
                EXPECT_NEAR(motion.depth[i], below_m, 1e-6);
                // waves of 3 texels, the shortest, fade over 4 cm
                EXPECT_NEAR(motion.pressure[i] / (1025 * gravity_mps2), below_m, 1e-5 + 0.9 * below_m) << i;
            }
        }
    }
}

/// Returns the bytes of all results.
std::string bytes_of(const Motion& motion) {
    std::string bytes;
    for (const auto* values :
         {&motion.depth, &motion.pressure, &motion.vx, &motion.vy, &motion.vz, &motion.ax, &motion.ay, &motion.az})
        bytes.append(reinterpret_cast<const char*>(values->data()), values->size() * sizeof(float));
    return bytes;
}

TEST(WaterQuery, ResultsAreBitIdentical) {
    for (const int cascades : {1, 4}) {
        std::string first;
        for (const Isa isa : isas_here())
            for (const bool has_threads : {false, true}) {
                Ocean ocean(steep_sea(cascades),
                            {.executor = has_threads ? make_thread_executor(3) : make_serial_executor(),
                             .isa = isa,
                             .queries = true,
                             .velocities = has_threads ? Velocities::water : Velocities::none,
                             .depth = true});
                const Points points(900);
                Motion motion(points.x.size());
                WaterQuery(ocean.frame_at(3.25)).sample(points.all(), motion.samples());
                if (first.empty()) first = bytes_of(motion);
                EXPECT_TRUE(bytes_of(motion) == first) << name_of(isa) << cascades;
            }
    }
}

// A frame's levels are functions of the sea and the time, whatever was shown before.
TEST(WaterQuery, ASeaThatReplacesAnotherIsThatOfANewOcean) {
    SeaState shallow = steep_sea(1);
    shallow.depth_m = 9;
    const OceanOptions options{.executor = make_serial_executor(), .queries = true, .depth = true};
    Ocean changed(steep_sea(1), options), made(shallow, options);
    changed.frame_at(1);
    changed.schedule_sea(shallow);
    changed.complete_sea();
    Points points(900);
    for (double& y : points.y) y = std::max(y, -9.0);
    Motion motion(points.x.size()), expected(points.x.size());
    WaterQuery(changed.frame_at(7)).sample(points.all(), motion.samples());
    WaterQuery(made.frame_at(7)).sample(points.all(), expected.samples());
    EXPECT_TRUE(bytes_of(motion) == bytes_of(expected));
}

// During a change the energies of the waves blend, at a depth as at the surface.
TEST(WaterQuery, LevelsBlendDuringAChange) {
    SeaState calm = steep_sea(1), rough = calm;
    calm.wind_speed_mps = 8;
    calm.choppiness = rough.choppiness = 0;
    const OceanOptions options{.executor = make_serial_executor(), .queries = true, .depth = true};
    Ocean changing(Forecast{.first = calm, .changes = {{.sea = rough, .from_s = 10, .over_s = 20}}}, options);
    Ocean before(calm, options), after(rough, options);
    std::vector<double> x, y, z;
    for (int i = 0; i < 4096; ++i) {
        x.push_back(i % 64 * 300.0 / 64);
        y.push_back(-6);
        z.push_back(i / 64 * 300.0 / 64);
    }
    const auto mean_square = [&](Ocean& ocean, double time_s) {
        Motion motion(x.size());
        WaterQuery(ocean.frame_at(time_s)).sample({x, y, z}, motion.samples());
        double sum = 0;
        for (const float pressure : motion.pressure)
            sum += std::pow(static_cast<double>(pressure) / (1025 * gravity_mps2) - 6, 2);
        return sum / 4096;
    };
    for (const double weight : {0.0, 0.5, 1.0}) {  // of a smooth step
        const double time_s = 10 + 20 * weight;
        const double expected =
            (1 - weight) * mean_square(before, time_s) + weight * mean_square(after, time_s);
        EXPECT_NEAR(mean_square(changing, time_s) / expected, 1, 0.05) << weight;
    }
}

TEST(WaterQuery, APondIsHydrostatic) {
    Ocean ocean({.waves = WaveModel::pond}, {.executor = make_serial_executor(), .queries = true, .depth = true});
    const WaterQuery water(ocean.frame_at(2));
    const Points points(200);
    Motion motion(points.x.size());
    water.sample(points.all(), motion.samples());
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        EXPECT_NEAR(motion.pressure[i] / (1025 * gravity_mps2), static_cast<double>(motion.depth[i]), 1e-5);
        EXPECT_EQ(motion.vy[i], 0);
    }
}

TEST(WaterQuery, RefusesWhatItCannotSampleInOneLine) {
    Ocean ocean(steep_sea(1), {.executor = make_serial_executor(), .queries = true});
    const Frame& frame = ocean.frame_at(0);
    EXPECT_EQ(message_of([&] { WaterQuery water(frame); }),
              "the frame has no water below its surface: the ocean was created without OceanOptions::depth");
    SeaState shallow = steep_sea(1);
    shallow.depth_m = 50;
    Ocean deep(shallow, {.executor = make_serial_executor(), .queries = true, .depth = true});
    const Frame& with_depth = deep.frame_at(0);
    EXPECT_EQ(message_of([&] { WaterQuery water(with_depth, {.water_density_kgpm3 = 1}); }),
              "water_density_kgpm3 1 is out of range [500, 2000]");
    const WaterQuery water(with_depth);
    const std::vector<double> x = {0, 1}, y = {-1, -60}, z = {0, 0};
    std::vector<float> out(2), three(3);
    EXPECT_EQ(message_of([&] { water.sample({x, y, z}, {.pressure_pa = out}); }),
              "y[1] is -60, expected at least -50, the sea floor");
    EXPECT_EQ(message_of([&] { water.sample({x, x, z}, {.pressure_pa = three}); }),
              "pressure_pa has 3 elements, expected 2 or none");
    EXPECT_EQ(message_of([] {
                  Ocean pond({.waves = WaveModel::pond},
                             {.executor = make_serial_executor(), .velocities = Velocities::water});
              }),
              "velocities water cannot be combined with waves pond, which have no motion of their own");
}

}  // namespace
}  // namespace pelagic
