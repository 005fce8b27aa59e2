#include "pelagic/sim/spectrum/spectra.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

constexpr double euler_e = 2.71828182845904523536;

constexpr double phillips_constant = 0.0081;     // alpha; Phillips 1958, Pierson and Moskowitz 1964
constexpr double pierson_moskowitz_beta = 0.74;  // Pierson and Moskowitz 1964
constexpr double jonswap_width_below_peak = 0.07;  // Hasselmann et al. 1973
constexpr double jonswap_width_above_peak = 0.09;
constexpr double smallest_wave_m = 0.001;  // l_min of VR Ocean, equation 11

double fourth_power(double x) { return (x * x) * (x * x); }

/// Returns the peak of S(omega) in deep water, rad/s: d/domega of omega^-5 exp(-b (g/(V omega))^4)
/// is 0 at b omega^-4 = 5/4 (V/g)^4. The shape of phillips over wave vectors is that of b = 1; its
/// peak is that of the spectrum integrated over all directions.
double deep_peak(const SeaState& sea) {
    const double speed = sea.wind_speed_mps;
    switch (sea.spectrum) {
        case SpectrumModel::jonswap:
            return 22 * det::pow(gravity_mps2 * gravity_mps2 / (speed * effective_fetch_m(sea)), 1.0 / 3);
        case SpectrumModel::pierson_moskowitz:
            return std::sqrt(std::sqrt(0.8 * pierson_moskowitz_beta)) * gravity_mps2 / speed;
        default: return std::sqrt(std::sqrt(0.8)) * gravity_mps2 / speed;
    }
}

/// Returns l = l_min (l_max / l_min)^beta with l_max = 1/(2 k_p). In VR Ocean, equation 11, l_max
/// is a quarter of the patch (errata). At beta = 1, a wave of a quarter of the peak wavelength
/// keeps a fraction exp(-4) of its energy, and a wave of the peak wavelength keeps 0.78.
double cutoff_length(const SeaState& sea, double peak) {
    // In extremely light wind the peak is NaN; std::max() then returns its first argument.
    const double longest = std::max(smallest_wave_m, 0.5 / wave_number(peak, sea.depth_m));
    return smallest_wave_m * det::pow(longest / smallest_wave_m, sea.short_wave_cutoff);
}

}  // namespace

double effective_fetch_m(const SeaState& sea) {
    return std::min(sea.fetch_m, full_development * sea.wind_speed_mps * sea.wind_speed_mps / gravity_mps2);
}

WaveSpectrum::WaveSpectrum(const SeaState& sea, const CascadePlan& cascade)
    : sea_(sea),
      water_(sea.depth_m, cascade.has_surface_tension ? sea_surface_tension_m3ps2 : 0),
      paper_spreading_(sea.wind_alignment),
      largest_wave_m_(sea.wind_speed_mps * sea.wind_speed_mps / gravity_mps2),
      grid_spacing_(cascade.spacing()),
      peak_(deep_peak(sea)),
      cutoff_m_(cutoff_length(sea, peak_)),
      lean_(lean_of(sea)),
      swell_variance_(sea.swell_height_m * sea.swell_height_m / 16),
      swell_peak_(two_pi / sea.swell_period_s),
      swell_lobe_(DirectionalLobe::cosine_2s(cosine_2s_exponent(sea.swell_spread_rad))) {
    const auto wind = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
    wind_x_ = wind.cosine;
    wind_z_ = wind.sine;
    const auto swell = det::sine_cosine_of_turns(sea.swell_direction_rad / two_pi);
    swell_x_ = swell.cosine;
    swell_z_ = swell.sine;

    // A = A_fft^2 A_spatial^2 with A_fft = N^(-1/4), A_spatial = e / L: VR Ocean, equations 4 and
    // 5.
    const double spatial = euler_e / cascade.grid.side_m;
    paper_scale_ = spatial * spatial / std::sqrt(static_cast<double>(cascade.resolution));

    const double speed = sea.wind_speed_mps;
    jonswap_alpha_ = 0.076 * det::pow(speed * speed / (effective_fetch_m(sea) * gravity_mps2), 0.22);
    if (spreading_of(sea) != SpreadingModel::paper)
        measured_spreading_.emplace(sea.spreading, peak_, speed * peak_ / gravity_mps2);

    if (const double largest = highest_over_depth * sea.depth_m;
        is_physical() && 16 * largest_variance() > largest * largest)
        kept_ = std::min(1.0, largest * largest / (16 * variance()));
}

double WaveSpectrum::amplitude_variance(double kx, double kz) const {
    return amplitude_variances(shell(std::sqrt(kx * kx + kz * kz)), kx, kz).along;
}

WaveSpectrum::Shell WaveSpectrum::shell(double k) const {
    if (is_physical()) {
        const double per_density = 0.5 * grid_spacing_ * grid_spacing_;
        Shell shell{k, per_density * (wind_density(k) / k), 1, 0, {}};
        if (swell_variance_ > 0) shell.swell = per_density * (swell_density(k) / k);
        if (measured_spreading_) shell.lobe = measured_spreading_->at(angular_frequency(k, water_));
        return shell;
    }
    // Equations 3 to 13, with one factor D. The weight includes sigma, the square of equation 9's
    // amplitude factor.
    const double kl = k * largest_wave_m_;
    return {k, paper_scale_ * det::exp(-1 / (kl * kl)) / fourth_power(k), small_wave_cutoff(k), 0, {}};
}

OppositeDensities WaveSpectrum::amplitude_variances(const Shell& shell, double kx, double kz) const {
    const double cosine = (kx * wind_x_ + kz * wind_z_) / shell.k;
    const auto spread = measured_spreading_ ? shell.lobe.densities(cosine)
                        : is_physical()     ? paper_spreading_.densities(cosine)
                                            : paper_spreading_.weights(cosine);
    OppositeDensities both{shell.before * spread.along * shell.after, shell.before * spread.against * shell.after};
    if (shell.swell > 0) {
        const auto swell = swell_lobe_.densities((kx * swell_x_ + kz * swell_z_) / shell.k);
        both.along += shell.swell * swell.along;
        both.against += shell.swell * swell.against;
    }
    return both;
}

double WaveSpectrum::radial_density(double k) const {
    return swell_variance_ > 0 ? wind_density(k) + swell_density(k) : wind_density(k);
}

double WaveSpectrum::lean(double k) const {
    if (lean_ == 0 || swell_variance_ == 0) return lean_;
    const double wind = wind_density(k), all = wind + swell_density(k);
    return all > 0 ? lean_ * (wind / all) : 0;
}

double WaveSpectrum::wind_density(double k) const {
    if (sea_.spectrum == SpectrumModel::phillips) {
        // The shape of equation 3 with Phillips' constant: alpha/2 k^-3 is the saturation range of
        // alpha g^2 omega^-5 at any depth. The shape is evaluated at omega^2 / g, which is k in
        // deep water; this is equivalent to Kitaigorodskii's factor.
        const double kl = k * largest_wave_m_ * det::tanh(k * water_.depth_m);
        return 0.5 * phillips_constant / (k * k * k) * det::exp(-1 / (kl * kl)) * small_wave_cutoff(k) * kept_;
    }
    const double omega = angular_frequency(k, water_);
    return frequency_density(omega) * group_velocity(k, water_) * small_wave_cutoff(k) *
           depth_factor(k, water_.depth_m) * kept_;
}

// Ochi and Hubble 1976 with lambda = 3, the low frequencies of their most probable sea:
//   S(omega) = Hs^2/16 4 u^lambda e^-u / (Gamma(lambda) omega),
//   u = (lambda + 1/4) (omega_p / omega)^4.
// swell_height_m is the height at the sea's depth, so only breaking attenuates the swell.
double WaveSpectrum::swell_density(double k) const {
    const double omega = angular_frequency(k, water_);
    const double u = 3.25 * fourth_power(swell_peak_ / omega);
    const double density = 2 * swell_variance_ * (u * u * u) * det::exp(-u) / omega;
    return density * group_velocity(k, water_) * kept_;
}

// Trapezoidal rule in log k. The spectrum is smooth, so the error is far below 1e-6.
double WaveSpectrum::variance() const {
    double sum = 0;
    const double step = det::log(scanned_k_ratio);
    for (double k = min_scanned_k; k < max_scanned_k; k *= scanned_k_ratio) sum += radial_density(k) * k * step;
    return sum;
}

/// Returns an upper bound of variance() in closed form: in deep water, without short-wave cutoff.
/// For jonswap the enhancement of the peak is applied to all frequencies.
double WaveSpectrum::largest_variance() const {
    const double scale = largest_wave_m_ * largest_wave_m_;  // V^4 / g^2
    switch (sea_.spectrum) {
        case SpectrumModel::jonswap:
            return sea_.peak_enhancement * jonswap_alpha_ * gravity_mps2 * gravity_mps2 / (5 * fourth_power(peak_)) +
                   swell_variance_;
        case SpectrumModel::pierson_moskowitz:
            return phillips_constant * scale / (4 * pierson_moskowitz_beta) + swell_variance_;
        default: return phillips_constant * scale / 4 + swell_variance_;
    }
}

// S(omega) in m^2 s.
double WaveSpectrum::frequency_density(double omega) const {
    const double tail = gravity_mps2 * gravity_mps2 / (fourth_power(omega) * omega);
    if (sea_.spectrum == SpectrumModel::pierson_moskowitz) {
        const double wind_frequency = gravity_mps2 / sea_.wind_speed_mps;
        return phillips_constant * tail * det::exp(-pierson_moskowitz_beta * fourth_power(wind_frequency / omega));
    }
    const double width = omega <= peak_ ? jonswap_width_below_peak : jonswap_width_above_peak;
    const double off_peak = (omega - peak_) / (width * peak_);
    const double enhancement = det::pow(sea_.peak_enhancement, det::exp(-0.5 * off_peak * off_peak));
    return jonswap_alpha_ * tail * det::exp(-1.25 * fourth_power(peak_ / omega)) * enhancement;
}

// VR Ocean, equation 10.
double WaveSpectrum::small_wave_cutoff(double k) const { return det::exp(-(k * k) * (cutoff_m_ * cutoff_m_)); }

}  // namespace pelagic
