#include "pelagic/sim/spectrum/system_spectrum.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

constexpr double phillips_constant = 0.0081;       // alpha; Phillips 1958, Pierson and Moskowitz 1964
constexpr double pierson_moskowitz_beta = 0.74;    // Pierson and Moskowitz 1964
constexpr double jonswap_width_below_peak = 0.07;  // Hasselmann et al. 1973
constexpr double jonswap_width_above_peak = 0.09;
// JONSWAP's growth, Hasselmann et al. 1973: omega_p = 22 (g^2 / (U F))^(1/3) and
// alpha = 0.076 (U^2 / (F g))^0.22.
constexpr double growth_of_peak = 22, growth_of_alpha = 0.076, power_of_alpha = 0.22;
constexpr double least_variance = 1e-40;   // m^2; smaller heights have no square
constexpr double smallest_wave_m = 0.001;  // l_min of VR Ocean, equation 11

double fourth_power_of(double x) { return (x * x) * (x * x); }

/// gamma^exp(...), by which JONSWAP exceeds a fully developed sea. \param over_peak  omega / omega_p
double enhancement(double gamma, double over_peak) {
    const double width = over_peak <= 1 ? jonswap_width_below_peak : jonswap_width_above_peak;
    const double off_peak = (over_peak - 1) / width;
    return det::pow(gamma, det::exp(-0.5 * off_peak * off_peak));
}

/// Returns the integral of x^-5 exp(-1.25 x^-4) gamma^(...) over x = omega / omega_p, which is 1/5 for
/// gamma = 1: 1/5 plus the integral of the excess, by the trapezoidal rule in log x with a point at
/// the kink x = 1. Within 1e-7.
double integral_of_jonswap(double gamma) {
    constexpr double step = 0.01;
    double excess = 0;
    for (int i = -60; i <= 60; ++i) {
        const double x = det::exp(step * i), u = 1 / fourth_power_of(x);
        excess += u * det::exp(-1.25 * u) * (enhancement(gamma, x) - 1) * step;
    }
    return 0.2 + excess;
}

/// Peak and alpha of JONSWAP's shape.
struct PeakAndAlpha {
    double peak, alpha;
};

/// Returns those of a system by height, period or both. The variance is alpha g^2 I / omega_p^4. The
/// growth laws without the fetch are alpha = 0.076 (U omega_p / (22 g))^0.66.
PeakAndAlpha by_height(const WaveSystem& system, double gamma) {
    const double g2 = gravity_mps2 * gravity_mps2 * integral_of_jonswap(gamma);
    const double variance = std::max(system.height_m * system.height_m / 16, least_variance);
    const bool is_developed = system.spectrum == SpectrumModel::pierson_moskowitz;
    constexpr double power = 3 * power_of_alpha;
    const double growth =
        is_developed ? phillips_constant
                     : growth_of_alpha * det::pow(system.wind_speed_mps / (growth_of_peak * gravity_mps2), power);
    const double power_of_peak = is_developed ? 0 : power;
    const double peak = system.peak_period_s > 0 ? two_pi / system.peak_period_s
                                                 : det::pow(growth * g2 / variance, 1 / (4 - power_of_peak));
    if (system.height_m > 0) return {peak, variance * fourth_power_of(peak) / g2};
    return {peak, is_developed ? growth : growth * det::pow(peak, power)};
}

/// Returns U / c of the wind that raises waves of this alpha by JONSWAP's growth: 22 (alpha /
/// 0.076)^(1/0.66).
double inverse_wave_age_of(double alpha) {
    return growth_of_peak * det::pow(alpha / growth_of_alpha, 1 / (3 * power_of_alpha));
}

double effective_fetch_m(double wind_speed_mps, double fetch_m) {
    return std::min(fetch_m, full_development * wind_speed_mps * wind_speed_mps / gravity_mps2);
}

}  // namespace

double effective_fetch_m(const SeaState& sea) { return effective_fetch_m(sea.wind_speed_mps, sea.fetch_m); }

WaveSystem wind_sea_of(const SeaState& sea) {
    return {.spectrum = sea.spectrum,
            .spreading = sea.spreading,
            .wind_speed_mps = sea.wind_speed_mps,
            .fetch_m = sea.fetch_m,
            .height_m = sea.wave_height_m,
            .peak_period_s = sea.peak_period_s,
            .peak_enhancement = sea.peak_enhancement,
            .direction_rad = sea.wind_direction_rad};
}

// d/domega of omega^-5 exp(-b (g/(V omega))^4) is 0 at b omega^-4 = 5/4 (V/g)^4. The shape of
// phillips over wave vectors is that of b = 1.
double phillips_peak(double wind_speed_mps) { return std::sqrt(std::sqrt(0.8)) * gravity_mps2 / wind_speed_mps; }

double cutoff_length_m(const SeaState& sea, double peak) {
    // In extremely light wind the peak is NaN; std::max() then returns its first argument.
    const double longest = std::max(smallest_wave_m, 0.5 / wave_number(peak, sea.depth_m));
    return smallest_wave_m * det::pow(longest / smallest_wave_m, sea.short_wave_cutoff);
}

double short_wave_factor(double k, double cutoff_m) { return det::exp(-(k * k) * (cutoff_m * cutoff_m)); }

SystemSpectrum::SystemSpectrum(Shape shape, double direction_rad, double spread_rad)
    : shape_(shape), towards_rad_(direction_rad), given_spread_rad_(spread_rad) {
    const auto towards = det::sine_cosine_of_turns(direction_rad / two_pi);
    towards_x_ = towards.cosine;
    towards_z_ = towards.sine;
    if (spread_rad > 0) given_lobe_ = DirectionalLobe::cosine_2s(cosine_2s_exponent(spread_rad));
}

SystemSpectrum SystemSpectrum::swell(const SeaState& sea) {
    SystemSpectrum swell(Shape::ochi_hubble, sea.swell_direction_rad, sea.swell_spread_rad);
    swell.is_at_depth_ = true;
    swell.variance_ = sea.swell_height_m * sea.swell_height_m / 16;
    swell.peak_ = two_pi / sea.swell_period_s;
    return swell;
}

SystemSpectrum::SystemSpectrum(const WaveSystem& system, const SeaState& sea)
    : SystemSpectrum(Shape::jonswap, system.direction_rad, system.spread_rad) {
    const double speed = system.wind_speed_mps;
    depth_m_ = sea.depth_m;
    wind_frequency_ = gravity_mps2 / speed;
    largest_wave_m_ = speed * speed / gravity_mps2;
    is_at_depth_ = is_by_height(system);
    double inverse_wave_age = 0;
    if (is_at_depth_) {
        gamma_ = system.spectrum == SpectrumModel::jonswap ? system.peak_enhancement : 1;
        const PeakAndAlpha found = by_height(system, gamma_);
        peak_ = found.peak;
        alpha_ = found.alpha;
        inverse_wave_age = inverse_wave_age_of(alpha_);
    } else {
        if (system.spectrum == SpectrumModel::jonswap) {
            const double fetch_m = effective_fetch_m(speed, system.fetch_m);
            gamma_ = system.peak_enhancement;
            peak_ = growth_of_peak * det::pow(gravity_mps2 * gravity_mps2 / (speed * fetch_m), 1.0 / 3);
            alpha_ = growth_of_alpha * det::pow(speed * speed / (fetch_m * gravity_mps2), power_of_alpha);
        } else if (system.spectrum == SpectrumModel::pierson_moskowitz) {
            shape_ = Shape::pierson_moskowitz;
            peak_ = std::sqrt(std::sqrt(0.8 * pierson_moskowitz_beta)) * gravity_mps2 / speed;
        } else {
            shape_ = Shape::phillips;
            peak_ = phillips_peak(speed);
        }
        inverse_wave_age = speed * peak_ / gravity_mps2;
    }
    cutoff_m_ = cutoff_length_m(sea, peak_);
    if (system.spread_rad > 0) return;
    if (system.spreading == SpreadingModel::paper)
        paper_.emplace(sea.wind_alignment);
    else
        measured_.emplace(system.spreading, peak_, inverse_wave_age);
}

double SystemSpectrum::density(const ShellOfWaves& shell) const {
    const double k = shell.k;
    if (shape_ == Shape::phillips) {
        // The shape of equation 3 with Phillips' constant: alpha/2 k^-3 is the saturation range of
        // alpha g^2 omega^-5 at any depth. The shape is evaluated at omega^2 / g, which is k in
        // deep water; this is equivalent to Kitaigorodskii's factor.
        const double kl = k * largest_wave_m_ * det::tanh(k * depth_m_);
        return 0.5 * phillips_constant / (k * k * k) * det::exp(-1 / (kl * kl)) * short_wave_factor(k);
    }
    const double density = frequency_density(shell.omega) * shell.group_velocity;
    if (shape_ == Shape::ochi_hubble) return density;
    const double longer = density * short_wave_factor(k);
    return is_at_depth_ ? longer : longer * depth_factor(k, depth_m_);
}

// S(omega) in m^2 s.
double SystemSpectrum::frequency_density(double omega) const {
    if (shape_ == Shape::ochi_hubble) {
        // Ochi and Hubble 1976 with lambda = 3, the low frequencies of their most probable sea:
        //   S(omega) = Hs^2/16 4 u^lambda e^-u / (Gamma(lambda) omega),
        //   u = (lambda + 1/4) (omega_p / omega)^4.
        const double u = 3.25 * fourth_power_of(peak_ / omega);
        return 2 * variance_ * (u * u * u) * det::exp(-u) / omega;
    }
    const double tail = gravity_mps2 * gravity_mps2 / (fourth_power_of(omega) * omega);
    if (shape_ == Shape::pierson_moskowitz)
        return phillips_constant * tail *
               det::exp(-pierson_moskowitz_beta * fourth_power_of(wind_frequency_ / omega));
    const double width = omega <= peak_ ? jonswap_width_below_peak : jonswap_width_above_peak;
    const double off_peak = (omega - peak_) / (width * peak_);
    const double higher = det::pow(gamma_, det::exp(-0.5 * off_peak * off_peak));
    return alpha_ * tail * det::exp(-1.25 * fourth_power_of(peak_ / omega)) * higher;
}

// For jonswap the enhancement of the peak is applied to all frequencies.
double SystemSpectrum::largest_variance() const {
    switch (shape_) {
        case Shape::ochi_hubble: return variance_;
        case Shape::jonswap: return gamma_ * alpha_ * gravity_mps2 * gravity_mps2 / (5 * fourth_power_of(peak_));
        case Shape::pierson_moskowitz:
            return phillips_constant * (largest_wave_m_ * largest_wave_m_) / (4 * pierson_moskowitz_beta);
        default: return phillips_constant * (largest_wave_m_ * largest_wave_m_) / 4;
    }
}

double SystemSpectrum::short_wave_factor(double k) const { return pelagic::short_wave_factor(k, cutoff_m_); }

DirectionalLobe SystemSpectrum::lobe(double omega, double widening) const {
    const DirectionalLobe lobe = measured_ ? measured_->at(omega) : given_lobe_;
    return widening > 0 && !paper_ ? lobe.narrower(widening) : lobe;
}

}  // namespace pelagic
