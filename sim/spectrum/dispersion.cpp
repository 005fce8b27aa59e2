#include "pelagic/sim/spectrum/dispersion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pelagic/sim/spectrum/wave_numbers.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {}

double angular_frequency(double k, const Water& water) {
    return std::sqrt((gravity_mps2 * k + water.tension_m3ps2 * (k * k * k)) * det::tanh(k * water.depth_m));
}

// d/dk of omega^2 = (g k + T k^3) tanh(k d): 2 omega omega' = g (t + k d (1 - t^2)) + T k^2 (3 t +
// k d (1 - t^2)).
double group_velocity(double k, const Water& water) {
    const double kd = k * water.depth_m;
    const double tanh_kd = det::tanh(kd);
    const double ground = kd * (1 - tanh_kd * tanh_kd);
    const double gravity = gravity_mps2 * (tanh_kd + ground);
    const double tension = water.tension_m3ps2 * (k * k) * (3 * tanh_kd + ground);
    const double omega = std::sqrt((gravity_mps2 * k + water.tension_m3ps2 * (k * k * k)) * tanh_kd);
    return (gravity + tension) / (2 * omega);
}

// cosh 2x / sinh^2 x = 1 + 1 / tanh^2 x.
double stokes_drift(double k, const Water& water) {
    const double tanh_kd = det::tanh(k * water.depth_m);
    return angular_frequency(k, water) * k * (1 + 1 / (tanh_kd * tanh_kd));
}

double orbit_ratio(double k, double depth_m) {
    constexpr double max = 20;
    return std::min(1 / det::tanh(k * depth_m), max);
}

// With k = omega^2 / g in deep water and t = tanh(k d) the ratio is t^3 / (t + k d (1 - t^2)).
double depth_factor(double k, double depth_m) {
    const double kd = k * depth_m;
    const double t = det::tanh(kd);
    if (t == 1) return 1;
    return t * t * t / (t + kd * (1 - t * t));
}

// Eckart's k d = x / sqrt(tanh x), x = omega^2 d / g (1952), is within 5 %. Each Newton step
// squares the error.
void wave_numbers(double omega, std::span<const double> depths_m, std::span<double> wave_numbers) {
    constexpr std::size_t together = 8;
    for (std::size_t first = 0; first < depths_m.size(); first += together) {
        const std::size_t count = std::min(together, depths_m.size() - first);
        std::array<double, together> deep_kd, kd;
        for (std::size_t i = 0; i < count; ++i) {
            deep_kd[i] = omega * omega / gravity_mps2 * depths_m[first + i];
            kd[i] = deep_kd[i] / std::sqrt(det::tanh(deep_kd[i]));
        }
        for (int step = 0; step < 4; ++step)
            for (std::size_t i = 0; i < count; ++i) {
                const double t = det::tanh(kd[i]);
                kd[i] -= (kd[i] * t - deep_kd[i]) / (t + kd[i] * (1 - t * t));
            }
        for (std::size_t i = 0; i < count; ++i) wave_numbers[first + i] = kd[i] / depths_m[first + i];
    }
}

double wave_number(double omega, double depth_m) {
    double k = 0;
    wave_numbers(omega, {&depth_m, 1}, {&k, 1});
    return k;
}

std::uint32_t loop_harmonic(double omega, double loop_period_s) {
    const double periods = std::floor(omega * loop_period_s / two_pi + 0.5);
    return periods < 1 ? 1 : static_cast<std::uint32_t>(periods);
}

// fmod is exact by IEEE 754, unlike other functions of libm. A result that rounds up to a whole
// turn wraps to 0.
LoopFraction loop_fraction(double time_s, double loop_period_s) {
    double within = std::fmod(time_s, loop_period_s);
    if (within < 0) within += loop_period_s;
    const double turns = std::floor(within / loop_period_s * 0x1p32 + 0.5);
    return {static_cast<std::uint32_t>(static_cast<std::uint64_t>(turns))};
}

}  // namespace pelagic
