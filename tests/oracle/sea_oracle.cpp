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

// In closed form: the integral of |cos|^s over half a circle is sqrt(pi) Gamma((s + 1)/2) / Gamma(s/2 + 1).
double spreading_integral(double alpha) {
    const double s = 1 + 5 * alpha * alpha;
    const double half_circle = std::sqrt(pi) * std::tgamma((s + 1) / 2) / std::tgamma(s / 2 + 1);
    return half_circle * (1 + 0.01 + 0.49 * (1 - alpha) * (1 - alpha));
}

double small_wave_factor(const SeaState& sea, double k) {
    const double l = 0.001 * std::pow(sea.patch_size_m * 0.25 / 0.001, sea.small_waves);
    return std::exp(-k * k * l * l);
}

}  // namespace

double frequency_of(const SeaState& sea, double k) { return std::sqrt(gravity * k * std::tanh(k * sea.depth_m)); }

double frequency_density(const SeaState& sea, double w) {
    const double v = sea.wind_speed_mps;
    if (sea.spectrum == SpectrumModel::pierson_moskowitz)
        return 0.0081 * gravity * gravity * std::pow(w, -5) * std::exp(-0.74 * std::pow(gravity / (v * w), 4));
    const double alpha = 0.076 * std::pow(v * v / (sea.fetch_m * gravity), 0.22);
    const double peak = 22 * std::cbrt(gravity * gravity / (v * sea.fetch_m));
    const double sigma = w <= peak ? 0.07 : 0.09;
    const double r = std::exp(-(w - peak) * (w - peak) / (2 * sigma * sigma * peak * peak));
    return alpha * gravity * gravity * std::pow(w, -5) * std::exp(-1.25 * std::pow(peak / w, 4)) * std::pow(3.3, r);
}

double density(const SeaState& sea, double kx, double kz) {
    const double k = std::hypot(kx, kz);
    const double directional =
        spreading_weight(sea.alignment, cosine_to_wind(sea, kx, kz)) / spreading_integral(sea.alignment);
    if (sea.spectrum == SpectrumModel::phillips) {
        const double kl = k * sea.wind_speed_mps * sea.wind_speed_mps / gravity;
        return 0.0081 / 2 * std::pow(k, -4) * std::exp(-1 / (kl * kl)) * directional * small_wave_factor(sea, k);
    }
    // d omega / d k by a central difference: independent of the library's closed form.
    const double step = 1e-5 * k;
    const double slope = (frequency_of(sea, k + step) - frequency_of(sea, k - step)) / (2 * step);
    return frequency_density(sea, frequency_of(sea, k)) * slope / k * directional * small_wave_factor(sea, k);
}

Complex initial_amplitude(const SeaState& sea, int m, int n) {
    const int nyquist = sea.resolution / 2;
    if ((m == 0 && n == 0) || m == -nyquist || n == -nyquist) return 0;
    const double dk = 2 * pi / sea.patch_size_m;
    const double kx = m * dk, kz = n * dk;
    const GaussianPair xi = gaussian_pair(sea.seed, 0, m, n);
    if (sea.spectrum != SpectrumModel::phillips_paper)
        return Complex(xi.re, xi.im) / 2.0 * std::sqrt(density(sea, kx, kz)) * dk;

    const double k = std::hypot(kx, kz);
    const double kl = k * sea.wind_speed_mps * sea.wind_speed_mps / gravity;
    const double a_fft = std::pow(sea.resolution, -0.25), a_spatial = std::numbers::e / sea.patch_size_m;
    const double p =
        a_fft * a_fft * a_spatial * a_spatial * std::exp(-1 / (kl * kl)) / std::pow(k, 4) * small_wave_factor(sea, k);
    return Complex(xi.re, xi.im) / std::numbers::sqrt2 *
           std::sqrt(p * spreading_weight(sea.alignment, cosine_to_wind(sea, kx, kz)));
}

ComplexField spectrum_at(const SeaState& sea, double time_s) {
    const int n = sea.resolution;
    const std::size_t side = static_cast<std::size_t>(n);
    const double turns_of_loop = time_s / sea.loop_period_s;
    ComplexField waves(side * side);
    for (std::size_t j = 0; j < side; ++j) {
        for (std::size_t i = 0; i < side; ++i) {
            const int kx = wave_number(i, n), kz = wave_number(j, n);
            if (kx == -n / 2 || kz == -n / 2) continue;
            const double k = 2 * pi / sea.patch_size_m * std::hypot(kx, kz);
            const double q = std::max(1.0, std::floor(frequency_of(sea, k) * sea.loop_period_s / (2 * pi) + 0.5));
            const double phase = 2 * pi * std::fmod(q * std::fmod(turns_of_loop, 1.0), 1.0);
            waves[j * side + i] = initial_amplitude(sea, kx, kz) * std::polar(1.0, -phase) +
                                  std::conj(initial_amplitude(sea, -kx, -kz)) * std::polar(1.0, phase);
        }
    }
    return waves;
}

Fields fields_at(const SeaState& sea, double time_s) {
    const int n = sea.resolution;
    const std::size_t side = static_cast<std::size_t>(n);
    const ComplexField waves = spectrum_at(sea, time_s);
    ComplexField along_x(waves.size()), along_z(waves.size());
    for (std::size_t j = 0; j < side; ++j) {
        for (std::size_t i = 0; i < side; ++i) {
            const double kx = wave_number(i, n), kz = wave_number(j, n);
            const double length = std::hypot(kx, kz);
            if (length == 0) continue;
            const Complex sideways = Complex(0, sea.choppiness) * waves[j * side + i];
            along_x[j * side + i] = kx / length * sideways;
            along_z[j * side + i] = kz / length * sideways;
        }
    }
    const auto transform = n <= 64 ? naive_inverse_dft : inverse_fft;
    return {transform(waves, n), transform(along_x, n), transform(along_z, n)};
}

}  // namespace pelagic::oracle
