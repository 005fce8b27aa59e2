#include "pelagic/sim/spectrum/dispersion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pelagic/sim/spectrum/wave_numbers.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/det_math_batch.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr int newton_steps = 4;

double newton_change(double kd, double tanh_kd, double deep_kd) {
    return (kd * tanh_kd - deep_kd) / (tanh_kd + kd * (1 - tanh_kd * tanh_kd));
}

// d/dk of omega^2 = (g k + T k^3) tanh(k d): 2 omega omega' = g (t + k d (1 - t^2)) + T k^2 (3 t +
// k d (1 - t^2)).
double group_velocity_from(double tanh_kd, double k, const Water& water) {
    const double ground = k * water.depth_m * (1 - tanh_kd * tanh_kd);
    const double gravity = gravity_mps2 * (tanh_kd + ground);
    const double tension = water.tension_m3ps2 * (k * k) * (3 * tanh_kd + ground);
    const double omega = std::sqrt((gravity_mps2 * k + water.tension_m3ps2 * (k * k * k)) * tanh_kd);
    return (gravity + tension) / (2 * omega);
}

/// Calls visit(first, count) for consecutive batches of `size` values.
template <class Visit>
void for_batches(std::size_t size, Visit visit) {
    for (std::size_t first = 0; first < size; first += det::batch_size)
        visit(first, std::min(det::batch_size, size - first));
}

}  // namespace

double angular_frequency(double k, const Water& water) {
    const DefaultFloatEnvironment environment;
    return std::sqrt((gravity_mps2 * k + water.tension_m3ps2 * (k * k * k)) * det::tanh(k * water.depth_m));
}

double group_velocity(double k, const Water& water) {
    return group_velocity_from(det::tanh(k * water.depth_m), k, water);
}

void group_velocities(std::span<const double> wave_numbers, std::span<const double> depths_m,
                      std::span<double> velocities) {
    for_batches(wave_numbers.size(), [&](std::size_t first, std::size_t count) {
        std::array<double, det::batch_size> tanh_kd{};
        for (std::size_t i = 0; i < count; ++i) tanh_kd[i] = wave_numbers[first + i] * depths_m[first + i];
        det::tanh(tanh_kd);
        for (std::size_t i = 0; i < count; ++i)
            velocities[first + i] = group_velocity_from(tanh_kd[i], wave_numbers[first + i], depths_m[first + i]);
    });
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
double wave_number(double omega, double depth_m) {
    const DefaultFloatEnvironment environment;
    const double deep_kd = omega * omega / gravity_mps2 * depth_m;
    double kd = deep_kd / std::sqrt(det::tanh(deep_kd));
    for (int step = 0; step < newton_steps; ++step) kd -= newton_change(kd, det::tanh(kd), deep_kd);
    return kd / depth_m;
}

void wave_numbers(double omega, std::span<const double> depths_m, std::span<double> wave_numbers) {
    for_batches(depths_m.size(), [&](std::size_t first, std::size_t count) {
        // Values after the last are those of the last one.
        std::array<double, det::batch_size> deep_kd, kd, tanh_kd;
        for (std::size_t i = 0; i < det::batch_size; ++i)
            tanh_kd[i] = deep_kd[i] = omega * omega / gravity_mps2 * depths_m[first + std::min(i, count - 1)];
        det::tanh(tanh_kd);
        for (std::size_t i = 0; i < det::batch_size; ++i) kd[i] = deep_kd[i] / std::sqrt(tanh_kd[i]);
        for (int step = 0; step < newton_steps; ++step) {
            tanh_kd = kd;
            det::tanh(tanh_kd);
            for (std::size_t i = 0; i < det::batch_size; ++i) kd[i] -= newton_change(kd[i], tanh_kd[i], deep_kd[i]);
        }
        for (std::size_t i = 0; i < count; ++i) wave_numbers[first + i] = kd[i] / depths_m[first + i];
    });
}

std::uint32_t loop_harmonic(double omega, double loop_period_s) {
    const DefaultFloatEnvironment environment;
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
