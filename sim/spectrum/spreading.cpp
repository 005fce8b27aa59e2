#include "pelagic/sim/spectrum/spreading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;
constexpr double sqrt_pi = 1.77245385090551602730;
constexpr double ln_10 = 2.30258509299404568402;

// Integral of |cos|^s over half a circle by the trapezoidal rule. The error is largest for s = 1:
// 1e-7.
double half_circle_integral(double exponent) {
    constexpr int steps = 4096;
    double sum = 0;
    for (int i = 1; i < steps; ++i)
        sum += det::pow(det::sine_cosine_of_turns(static_cast<double>(i) / (2 * steps)).sine, exponent);
    return sum * (pi / steps);
}

/// Keeps the last result on each thread: the cascades of a sea have one exponent.
double kept_half_circle_integral(double exponent) {
    thread_local double last_exponent = 0, last = pi;
    if (exponent != last_exponent) {
        last = half_circle_integral(exponent);
        last_exponent = exponent;
    }
    return last;
}

// Gamma(z + 1/2) / Gamma(z) = sqrt(z) (1 - 1/(8 z) + 1/(128 z^2) + 5/(1024 z^3) - 21/(32768 z^4) -
// ...) for a large z (Tricomi and Erdelyi 1951). The recurrence Gamma(x + 1) = x Gamma(x) leads
// from s to a large z. Within 1e-11.
double gamma_of_s_plus_1_over_gamma_of_s_plus_half(double s) {
    double z = s + 0.5, above = 1, below = 1;
    for (; z < 20; ++z) {
        above *= z;
        below *= z + 0.5;
    }
    const double r = 1 / z;
    const double series =
        1 + r * (-1.0 / 8 + r * (1.0 / 128 + r * (5.0 / 1024 + r * (-21.0 / 32768 - r * (399.0 / 262144)))));
    return std::sqrt(z) * series * above / below;
}

// Returns the angle in [0, pi/2] of a cosine in [0, 1]. The half angle is used, because its sine
// and cosine are accurate at both ends. A polynomial (Abramowitz and Stegun 1964, 4.4.45: within
// 7e-5) is followed by one step of cubic convergence.
double acute_angle_of(double cosine) {
    const double half_sine = std::sqrt(std::max(0.0, 0.5 * (1 - cosine)));
    const double half_cosine = std::sqrt(0.5 * (1 + cosine));
    const double c = half_cosine;
    const double near =
        std::sqrt(std::max(0.0, 1 - c)) * (1.5707288 + c * (-0.2121144 + c * (0.0742610 - c * 0.0187293)));
    const auto found = det::sine_cosine_of_turns(near / (2 * pi));
    return 2 * (near + (half_sine * found.cosine - half_cosine * found.sine));
}

double sech_squared_of(double x) {
    const double e = det::exp(-x);
    const double sech = 2 * e / (1 + e * e);
    return sech * sech;
}

/// Donelan, Hamilton and Hui 1985; from 1.6 peak frequencies on Banner 1990. Both agree there
/// within 1e-4.
double donelan_banner_beta(double over_peak) {
    if (over_peak >= 1.6) {
        const double epsilon = -0.4 + 0.8393 * det::pow(over_peak * over_peak, -0.567);
        return det::exp(ln_10 * epsilon);
    }
    if (over_peak >= 0.95) return 2.28 * det::pow(over_peak, -1.3);
    return 2.61 * det::pow(std::max(over_peak, 0.56), 1.3);  // measurements end at 0.56
}

}  // namespace

PaperSpreading::PaperSpreading(double alignment)
    : exponent_(1 + 5 * alignment * alignment),
      opposing_(0.01 + 0.49 * (1 - alignment) * (1 - alignment)),
      integral_(kept_half_circle_integral(exponent_) * (1 + opposing_)) {}

OppositeDensities PaperSpreading::weights(double cosine) const {
    const double size = std::fabs(cosine);
    if (size < 1e-12) return {0, 0};
    const double with_wind = det::pow(size, exponent_), against_wind = with_wind * opposing_;
    return cosine < 0 ? OppositeDensities{against_wind, with_wind} : OppositeDensities{with_wind, against_wind};
}

// The integral of cos(theta/2)^(2s) is 2 sqrt(pi) Gamma(s + 1/2) / Gamma(s + 1).
DirectionalLobe DirectionalLobe::cosine_2s(double s) {
    return {Shape::cosine_2s, s, gamma_of_s_plus_1_over_gamma_of_s_plus_half(s) / (2 * sqrt_pi)};
}

// The integral of sech^2 from -pi to pi is 2 tanh(beta pi) / beta.
DirectionalLobe DirectionalLobe::sech_squared(double beta) {
    return {Shape::sech_squared, beta, beta / (2 * det::tanh(beta * pi))};
}

OppositeDensities DirectionalLobe::densities(double cosine) const {
    if (shape_ == Shape::sech_squared) {
        const double angle = acute_angle_of(std::fabs(cosine));
        const double near = factor_ * sech_squared_of(narrowness_ * angle);
        const double far = cosine == 0 ? near : factor_ * sech_squared_of(narrowness_ * (pi - angle));
        return cosine < 0 ? OppositeDensities{far, near} : OppositeDensities{near, far};
    }
    const auto power = [&](double cosine_of_wave) {
        // The lower bound avoids the logarithm of 0.
        const double half_cosine_squared = std::max(0.5 * (1 + cosine_of_wave), 1e-300);
        return factor_ * det::pow(half_cosine_squared, narrowness_);
    };
    return {power(cosine), power(-cosine)};
}

DirectionalLobe DirectionalLobe::narrower(double variance_rad2) const {
    const auto reduced = [&](double variance) {
        return std::max(variance - variance_rad2, least_narrowed * least_narrowed * variance);
    };
    if (shape_ == Shape::cosine_2s) return cosine_2s(2 / reduced(2 / (narrowness_ + 1)) - 1);
    return sech_squared(pi / std::sqrt(12 * reduced(pi * pi / (12 * narrowness_ * narrowness_))));
}

double cosine_2s_exponent(double sigma_rad) { return 2 / (sigma_rad * sigma_rad) - 1; }

MeasuredSpreading::MeasuredSpreading(SpreadingModel model, double peak_radps, double inverse_wave_age)
    : model_(model),
      peak_radps_(peak_radps),
      inverse_wave_age_(std::clamp(inverse_wave_age, 0.83, 5.0)),
      largest_s_(11.5 * det::pow(inverse_wave_age_, -2.5)) {}

DirectionalLobe MeasuredSpreading::at(double omega) const {
    const double over_peak = omega / peak_radps_;
    if (model_ == SpreadingModel::donelan_banner)
        return DirectionalLobe::sech_squared(donelan_banner_beta(over_peak));
    if (model_ == SpreadingModel::cosine_2s)  // Mitsuyasu et al. 1975
        return DirectionalLobe::cosine_2s(largest_s_ * det::pow(over_peak, over_peak <= 1 ? 5 : -2.5));
    // Hasselmann, Dunckel and Ewing 1980.
    if (over_peak < 1.05) return DirectionalLobe::cosine_2s(6.97 * det::pow(over_peak, 4.06));
    return DirectionalLobe::cosine_2s(9.77 * det::pow(over_peak, -2.33 - 1.45 * (inverse_wave_age_ - 1.17)));
}

}  // namespace pelagic
