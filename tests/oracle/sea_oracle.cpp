#include "pelagic/tests/oracle/sea_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "pelagic/sim/spectrum/wave_noise.hpp"

namespace pelagic::oracle {
namespace {

using std::numbers::pi;

double cosine_to_wind(const SeaState& sea, double kx, double kz) {
    return std::cos(std::atan2(kz, kx) - sea.wind_direction_rad);
}

double spreading_weight(double alpha, double cosine) {
    const double along = std::pow(std::fabs(cosine), 1 + 5 * alpha * alpha);
    return cosine < 0 ? along * (0.01 + 0.49 * (1 - alpha) * (1 - alpha)) : along;
}

// Analytic solution: the integral of |cos|^s over half a circle is
// sqrt(pi) Gamma((s + 1)/2) / Gamma(s/2 + 1).
double spreading_integral(double alpha) {
    const double s = 1 + 5 * alpha * alpha;
    const double half_circle = std::sqrt(pi) * std::tgamma((s + 1) / 2) / std::tgamma(s / 2 + 1);
    return half_circle * (1 + 0.01 + 0.49 * (1 - alpha) * (1 - alpha));
}

/// Returns d omega / d k by a central difference, independent of the library's formula.
double slope_of_frequency(double k, double depth_m) {
    const auto omega = [&](double at) { return std::sqrt(gravity * at * std::tanh(at * depth_m)); };
    const double step = 1e-5 * k;
    return (omega(k + step) - omega(k - step)) / (2 * step);
}

/// Kitaigorodskii's depth factor by definition: k^-3 dk/domega at the depth, divided by its value
/// in deep water.
double depth_factor(double k, double depth_m) {
    const double deep_k = k * std::tanh(k * depth_m);
    const double ratio = deep_k / k;
    return ratio * ratio * ratio * slope_of_frequency(deep_k, 1e9) / slope_of_frequency(k, depth_m);
}

/// The fetch, in m, limited to g F / V^2 = 17000, where wind waves stop growing.
double grown_fetch_m(const SeaState& sea) {
    const double grown = 17000 * sea.wind_speed_mps * sea.wind_speed_mps / gravity;
    return sea.fetch_m < grown ? sea.fetch_m : grown;
}

/// Peak omega of each model's frequency spectrum in deep water, in rad/s.
double peak_frequency(const SeaState& sea) {
    if (sea.spectrum == SpectrumModel::jonswap)
        return 22 * std::cbrt(gravity * gravity / (sea.wind_speed_mps * grown_fetch_m(sea)));
    const double beta = sea.spectrum == SpectrumModel::pierson_moskowitz ? 0.74 : 1;
    return std::pow(0.8 * beta, 0.25) * gravity / sea.wind_speed_mps;
}

/// Returns the wave number of a frequency, by bisection.
double wave_number_of(double omega, double depth_m) {
    double low = 1e-9, high = 1e9;
    while (high / low > 1 + 1e-14) {
        const double middle = std::sqrt(low * high);
        (gravity * middle * std::tanh(middle * depth_m) < omega * omega ? low : high) = middle;
    }
    return low;
}

double small_wave_factor(const SeaState& sea, double k) {
    if (sea.short_wave_cutoff == 0) return std::exp(-k * k * 1e-6);
    const double longest = 0.5 / wave_number_of(peak_frequency(sea), sea.depth_m);
    const double l = 0.001 * std::pow(longest / 0.001, sea.short_wave_cutoff);
    return std::exp(-k * k * l * l);
}

/// Returns cos(theta/2)^(2s), normalised by its analytic integral.
double cosine_2s(double s, double angle) {
    const double integral = 2 * std::sqrt(pi) * std::exp(std::lgamma(s + 0.5) - std::lgamma(s + 1));
    return std::pow(std::fabs(std::cos(angle / 2)), 2 * s) / integral;
}

/// A variance of directions without that of a cell, at least a quarter.
double narrowed(double variance, double of_cell) { return std::max(variance - of_cell, variance / 4); }
double narrowed_s(double s, double of_cell) { return 2 / narrowed(2 / (s + 1), of_cell) - 1; }

/// \param of_cell  variance of directions by which lobes are narrower
double wind_directional(const SeaState& sea, double k, double angle, double of_cell) {
    if (sea.spreading == SpreadingModel::paper)
        return spreading_weight(sea.wind_alignment, std::cos(angle)) / spreading_integral(sea.wind_alignment);
    const double over_peak = frequency_of(sea, k) / peak_frequency(sea);
    const double age = std::min(5.0, std::max(0.83, sea.wind_speed_mps * peak_frequency(sea) / gravity));
    if (sea.spreading == SpreadingModel::cosine_2s)
        return cosine_2s(
            narrowed_s(11.5 * std::pow(age, -2.5) * std::pow(over_peak, over_peak <= 1 ? 5 : -2.5), of_cell), angle);
    if (sea.spreading == SpreadingModel::hasselmann)
        return cosine_2s(narrowed_s(over_peak < 1.05 ? 6.97 * std::pow(over_peak, 4.06)
                                                     : 9.77 * std::pow(over_peak, -2.33 - 1.45 * (age - 1.17)),
                                    of_cell),
                         angle);
    const double given = over_peak >= 1.6
                             ? std::pow(10, -0.4 + 0.8393 * std::exp(-0.567 * std::log(over_peak * over_peak)))
                         : over_peak >= 0.95 ? 2.28 * std::pow(over_peak, -1.3)
                                             : 2.61 * std::pow(std::max(over_peak, 0.56), 1.3);
    const double beta = pi / std::sqrt(12 * narrowed(pi * pi / (12 * given * given), of_cell));
    const double wrapped = std::remainder(angle, 2 * pi);
    return beta / (2 * std::tanh(beta * pi)) * std::pow(std::cosh(beta * wrapped), -2);
}

/// Energy density by wave number, without breaking.
double wind_radial(const SeaState& sea, double k) {
    const double all = slope_of_frequency(k, sea.depth_m) * depth_factor(k, sea.depth_m) * small_wave_factor(sea, k);
    const double omega = frequency_of(sea, k);
    // in deep water the shape of equation 3, see docs/theory.md
    if (sea.spectrum == SpectrumModel::phillips)
        return 0.0081 * gravity * gravity * std::pow(omega, -5) *
               std::exp(-std::pow(gravity / (sea.wind_speed_mps * omega), 4)) * all;
    return frequency_density(sea, omega) * all;
}

double swell_radial(const SeaState& sea, double k) {
    const double peak = 2 * pi / sea.swell_period_s, lambda = 3, omega = frequency_of(sea, k);
    // Ochi and Hubble 1976, in their notation.
    return 0.25 * std::pow((4 * lambda + 1) / 4 * std::pow(peak, 4), lambda) / std::tgamma(lambda) *
           sea.swell_height_m * sea.swell_height_m / std::pow(omega, 4 * lambda + 1) *
           std::exp(-(4 * lambda + 1) / 4 * std::pow(peak / omega, 4)) * slope_of_frequency(k, sea.depth_m);
}

/// Returns the factor in (0, 1] by which breaking reduces the variance: Simpson's rule over log k,
/// at depths where it can be below 1.
double breaking_factor(const SeaState& sea) {
    if (sea.depth_m > 100 || sea.spectrum == SpectrumModel::phillips_paper) return 1;
    const double first = std::log(1e-4), last = std::log(1e4);
    constexpr int steps = 2000;
    double variance = 0;
    for (int i = 0; i <= steps; ++i) {
        const double k = std::exp(first + (last - first) * i / steps);
        const double weight = i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2;
        variance += weight * (wind_radial(sea, k) + swell_radial(sea, k)) * k * (last - first) / steps / 3;
    }
    return std::min(1.0, std::pow(0.6 * sea.depth_m / 4, 2) / variance);
}

double unbroken_density(const SeaState& sea, double kx, double kz, double of_cell) {
    const double k = std::hypot(kx, kz), direction = std::atan2(kz, kx);
    const double s = narrowed_s(2 / (sea.swell_spread_rad * sea.swell_spread_rad) - 1, of_cell);
    return (wind_radial(sea, k) * wind_directional(sea, k, direction - sea.wind_direction_rad, of_cell) +
            swell_radial(sea, k) * cosine_2s(s, direction - sea.swell_direction_rad)) /
           k;
}

/// The mean density of the cell around (m, n) over points, as sim/spectrum/amplitudes.cpp has it: 4 x 4
/// within 16 steps of k = 0, more where the swell is narrow. The cell's energy runs in the direction of
/// its centre, so lobes are narrower by the variance of its points' directions.
double unbroken_cell(const SeaState& sea, int m, int n) {
    const double steps = std::sqrt(static_cast<double>(m) * m + static_cast<double>(n) * n);
    const double narrowest = sea.swell_height_m > 0 ? sea.swell_spread_rad / 2 : 10;
    const int points =
        std::max(steps < 16 ? 4 : 1, static_cast<int>(std::ceil(std::min(64.0, 0.8 / (steps * narrowest)))));
    const double dk = 2 * pi / sea.patch_size_m, widening = (1 - 1.0 / (points * points)) / 12;
    double sum = 0;
    for (int row = 0; row < points; ++row)
        for (int column = 0; column < points; ++column) {
            const double x = m + (column + 0.5) / points - 0.5, z = n + (row + 0.5) / points - 0.5;
            sum += unbroken_density(sea, x * dk, z * dk, widening / (x * x + z * z));
        }
    return sum / (points * points);
}

/// \param attenuation value of breaking_factor(sea)
Complex amplitude(const SeaState& sea, double attenuation, int m, int n) {
    const int nyquist = sea.resolution / 2;
    if ((m == 0 && n == 0) || m == -nyquist || n == -nyquist) return 0;
    const double dk = 2 * pi / sea.patch_size_m;
    const double kx = m * dk, kz = n * dk;
    const GaussianPair xi = gaussian_pair(sea.seed, 0, m, n);
    if (sea.spectrum != SpectrumModel::phillips_paper)
        return Complex(xi.re, xi.im) / 2.0 * std::sqrt(attenuation * unbroken_cell(sea, m, n)) * dk;

    const double k = std::hypot(kx, kz);
    const double kl = k * sea.wind_speed_mps * sea.wind_speed_mps / gravity;
    const double a_fft = std::pow(sea.resolution, -0.25), a_spatial = std::numbers::e / sea.patch_size_m;
    const double p =
        a_fft * a_fft * a_spatial * a_spatial * std::exp(-1 / (kl * kl)) / std::pow(k, 4) * small_wave_factor(sea, k);
    return Complex(xi.re, xi.im) / std::numbers::sqrt2 *
           std::sqrt(p * spreading_weight(sea.wind_alignment, cosine_to_wind(sea, kx, kz)));
}

}  // namespace

double frequency_of(const SeaState& sea, double k) { return std::sqrt(gravity * k * std::tanh(k * sea.depth_m)); }

double frequency_density(const SeaState& sea, double w) {
    const double v = sea.wind_speed_mps;
    if (sea.spectrum == SpectrumModel::pierson_moskowitz)
        return 0.0081 * gravity * gravity * std::pow(w, -5) * std::exp(-0.74 * std::pow(gravity / (v * w), 4));
    const double alpha = 0.076 * std::pow(v * v / (grown_fetch_m(sea) * gravity), 0.22);
    const double peak = 22 * std::cbrt(gravity * gravity / (v * grown_fetch_m(sea)));
    const double sigma = w <= peak ? 0.07 : 0.09;
    const double r = std::exp(-(w - peak) * (w - peak) / (2 * sigma * sigma * peak * peak));
    return alpha * gravity * gravity * std::pow(w, -5) * std::exp(-1.25 * std::pow(peak / w, 4)) *
           std::pow(sea.peak_enhancement, r);
}

double density(const SeaState& sea, double kx, double kz) {
    return breaking_factor(sea) * unbroken_density(sea, kx, kz, 0);
}

double cell_density(const SeaState& sea, int m, int n) { return breaking_factor(sea) * unbroken_cell(sea, m, n); }

Complex initial_amplitude(const SeaState& sea, int m, int n) { return amplitude(sea, breaking_factor(sea), m, n); }

namespace {

/// The parts of h~(k, t) that run along k and against it.
struct RunningWave {
    Complex along, against;
};

std::vector<RunningWave> running_waves_at(const SeaState& sea, double time_s) {
    const int n = sea.resolution;
    const std::size_t side = static_cast<std::size_t>(n);
    const double turns_of_loop = time_s / sea.loop_period_s;
    const double attenuation = breaking_factor(sea);
    std::vector<RunningWave> waves(side * side);
    for (std::size_t j = 0; j < side; ++j) {
        for (std::size_t i = 0; i < side; ++i) {
            const int kx = wave_number(i, n), kz = wave_number(j, n);
            if (kx == -n / 2 || kz == -n / 2) continue;
            const double k = 2 * pi / sea.patch_size_m * std::hypot(kx, kz);
            const double q = std::max(1.0, std::floor(frequency_of(sea, k) * sea.loop_period_s / (2 * pi) + 0.5));
            const double phase = 2 * pi * std::fmod(q * std::fmod(turns_of_loop, 1.0), 1.0);
            waves[j * side + i] = {amplitude(sea, attenuation, kx, kz) * std::polar(1.0, -phase),
                                   std::conj(amplitude(sea, attenuation, -kx, -kz)) * std::polar(1.0, phase)};
        }
    }
    return waves;
}

/// Returns the lean of the wind sea: by default cubic from 3 to 10 m/s, with slopes of 0 at 3 m/s.
double wind_lean(const SeaState& sea) {
    if (sea.lean >= 0) return sea.lean;
    const double v = sea.wind_speed_mps;
    if (sea.spectrum == SpectrumModel::phillips_paper || v < 3) return 0;
    const double full = std::fmin(0.32 + v / 100, 0.6);
    return v > 10 ? full : full * (v - 3) * (v - 3) * (27 - 2 * v) / 343;
}

/// Returns the angle of the lean: that of the wind sea's energy among all of this wave number.
double lean_rad(const SeaState& sea, double k) {
    if (sea.swell_height_m == 0) return std::atan(wind_lean(sea));
    const double wind = wind_radial(sea, k), swell = swell_radial(sea, k);
    return std::atan(wind_lean(sea) * (wind + swell > 0 ? wind / (wind + swell) : 0));
}

}  // namespace

double mean_level(const SeaState& sea) {
    const int n = sea.resolution;
    const double attenuation = breaking_factor(sea);
    double sum = 0;
    for (int kz = -n / 2; kz < n / 2; ++kz)
        for (int kx = -n / 2; kx < n / 2; ++kx) {
            if (kx == 0 && kz == 0) continue;
            const double k = 2 * pi / sea.patch_size_m * std::hypot(kx, kz);
            const double a = 2 * std::abs(amplitude(sea, attenuation, kx, kz));  // h = a cos(k.x - w t)
            sum += std::cos(lean_rad(sea, k)) * k * std::min(20.0, 1 / std::tanh(k * sea.depth_m)) * a * a / 2;
        }
    return sea.choppiness * sum;
}

ComplexField spectrum_at(const SeaState& sea, double time_s) {
    ComplexField waves;
    for (const RunningWave& wave : running_waves_at(sea, time_s)) waves.push_back(wave.along + wave.against);
    return waves;
}

// A wave a cos(phase) is displaced along its own direction by
// choppiness (cos b (-sin(phase)) + sin b cos(phase)) a, where b is the angle of the lean.
Fields fields_at(const SeaState& sea, double time_s) {
    const int n = sea.resolution;
    const std::size_t side = static_cast<std::size_t>(n);
    const std::vector<RunningWave> waves = running_waves_at(sea, time_s);
    ComplexField heights(waves.size()), along_x(waves.size()), along_z(waves.size());
    for (std::size_t j = 0; j < side; ++j) {
        for (std::size_t i = 0; i < side; ++i) {
            const double kx = wave_number(i, n), kz = wave_number(j, n);
            const double length = std::hypot(kx, kz);
            if (length == 0) continue;
            const double k = 2 * pi / sea.patch_size_m * length;
            // Airy theory: ratio of horizontal to vertical displacement
            const double orbit = std::min(20.0, 1 / std::tanh(k * sea.depth_m)), b = lean_rad(sea, k);
            const auto [along, against] = waves[j * side + i];
            const Complex forward =
                sea.choppiness * orbit *
                (std::cos(b) * Complex(0, 1) * (along + against) + std::sin(b) * (along - against));
            heights[j * side + i] = along + against;
            along_x[j * side + i] = kx / length * forward;
            along_z[j * side + i] = kz / length * forward;
        }
    }
    heights[0] = mean_level(sea);
    const auto transform = n <= 64 ? naive_inverse_dft : inverse_fft;
    return {transform(heights, n), transform(along_x, n), transform(along_z, n)};
}

}  // namespace pelagic::oracle
