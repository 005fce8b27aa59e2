// Pressure, velocity and acceleration below the surface of a frame: against Airy's theory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/water_query.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/oracle/sea_oracle.hpp"

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
        const double u = omega * amplitude_m * along * std::cos(phase), v = omega * amplitude_m * rise * std::sin(phase);
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

TEST(WaterQuery, Prints) {
    for (const double water_m : {4000.0, 20.0, 5.0})
        for (const double texels : {8.0, 16.0, 32.0, 64.0, 128.0}) {
            const Errors errors = largest_errors(texels, 6, water_m, 0.4);
            const Errors top = largest_errors(texels, 6, water_m, 0.4, true);
            std::printf("%6.0f m %4.0f texels: p %.4f v %.4f a %.4f  surface p %.4f v %.4f a %.4f\n", water_m, texels, errors.pressure,
                        errors.velocity, errors.acceleration, top.pressure, top.velocity, top.acceleration);
        }
}

}  // namespace
}  // namespace pelagic
