#include "pelagic/sim/spectrum/spectra.hpp"

#include <cmath>

#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

constexpr double two_pi = 6.28318530717958647693;
constexpr double euler_e = 2.71828182845904523536;

constexpr double phillips_constant = 0.0081;     // alpha; Phillips 1958, Pierson and Moskowitz 1964
constexpr double pierson_moskowitz_beta = 0.74;  // Pierson and Moskowitz 1964
constexpr double jonswap_gamma = 3.3;            // Hasselmann et al. 1973, as all of JONSWAP below
constexpr double jonswap_width_below_peak = 0.07;
constexpr double jonswap_width_above_peak = 0.09;
constexpr double smallest_wave_m = 0.001;  // l_min of VR Ocean, equation 11

double fourth_power(double x) { return (x * x) * (x * x); }

// l = l_min (L / 4 / l_min)^beta: VR Ocean, equation 11.
double cutoff_wavelength(const SeaState& sea, const TilePlan& tile) {
    const double longest = 0.25 * tile.lattice.side_m;
    return smallest_wave_m * det::pow(longest / smallest_wave_m, sea.small_waves);
}

}  // namespace

WaveSpectrum::WaveSpectrum(const SeaState& sea, const TilePlan& tile)
    : sea_(sea),
      spreading_(sea.alignment),
      largest_wave_m_(sea.wind_speed_mps * sea.wind_speed_mps / gravity_mps2),
      cutoff_m_(cutoff_wavelength(sea, tile)),
      grid_spacing_(tile.spacing()) {
    const auto wind = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
    wind_x_ = wind.cosine;
    wind_z_ = wind.sine;

    // A = A_fft^2 A_spatial^2 with A_fft = N^(-1/4), A_spatial = e / L: VR Ocean, equations 4 and 5.
    const double spatial = euler_e / tile.lattice.side_m;
    paper_scale_ = spatial * spatial / std::sqrt(static_cast<double>(tile.resolution));

    const double speed = sea.wind_speed_mps;
    jonswap_alpha_ = 0.076 * det::pow(speed * speed / (sea.fetch_m * gravity_mps2), 0.22);
    jonswap_peak_ = 22 * det::pow(gravity_mps2 * gravity_mps2 / (speed * sea.fetch_m), 1.0 / 3);
}

double WaveSpectrum::amplitude_variance(double kx, double kz) const {
    return amplitude_variances(shell(std::sqrt(kx * kx + kz * kz)), kx, kz).along;
}

WaveSpectrum::Shell WaveSpectrum::shell(double k) const {
    if (is_physical()) return {k, 0.5 * grid_spacing_ * grid_spacing_ * (radial_density(k) / k), 1};

    // Equations 3 to 13, with D once; the weight holds sigma, the square of equation 9's amplitude factor.
    const double kl = k * largest_wave_m_;
    return {k, paper_scale_ * det::exp(-1 / (kl * kl)) / fourth_power(k), small_wave_cutoff(k)};
}

DirectionalSpreading::Opposites WaveSpectrum::amplitude_variances(const Shell& shell, double kx, double kz) const {
    const double cosine = (kx * wind_x_ + kz * wind_z_) / shell.k;
    const auto spread = is_physical() ? spreading_.densities(cosine) : spreading_.weights(cosine);
    return {shell.before * spread.along * shell.after, shell.before * spread.against * shell.after};
}

double WaveSpectrum::radial_density(double k) const {
    if (sea_.spectrum == SpectrumModel::phillips) {
        // Equation 3's shape with Phillips' constant: alpha/2 k^-3 is the saturation range of alpha g^2 omega^-5.
        const double kl = k * largest_wave_m_;
        return 0.5 * phillips_constant / (k * k * k) * det::exp(-1 / (kl * kl)) * small_wave_cutoff(k);
    }
    const double omega = angular_frequency(k, sea_.depth_m);
    return frequency_density(omega) * group_velocity(k, sea_.depth_m) * small_wave_cutoff(k);
}

// S(omega) in m^2 s.
double WaveSpectrum::frequency_density(double omega) const {
    const double tail = gravity_mps2 * gravity_mps2 / (fourth_power(omega) * omega);
    if (sea_.spectrum == SpectrumModel::pierson_moskowitz) {
        const double wind_frequency = gravity_mps2 / sea_.wind_speed_mps;
        return phillips_constant * tail * det::exp(-pierson_moskowitz_beta * fourth_power(wind_frequency / omega));
    }
    const double width = omega <= jonswap_peak_ ? jonswap_width_below_peak : jonswap_width_above_peak;
    const double off_peak = (omega - jonswap_peak_) / (width * jonswap_peak_);
    const double enhancement = det::pow(jonswap_gamma, det::exp(-0.5 * off_peak * off_peak));
    return jonswap_alpha_ * tail * det::exp(-1.25 * fourth_power(jonswap_peak_ / omega)) * enhancement;
}

// VR Ocean, equation 10.
double WaveSpectrum::small_wave_cutoff(double k) const { return det::exp(-(k * k) * (cutoff_m_ * cutoff_m_)); }

}  // namespace pelagic
