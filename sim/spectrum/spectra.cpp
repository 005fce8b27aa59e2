#include "pelagic/sim/spectrum/spectra.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

constexpr double euler_e = 2.71828182845904523536;

std::vector<SystemSpectrum> systems_of(const SeaState& sea) {
    std::vector<SystemSpectrum> systems;
    if (sea.spectrum != SpectrumModel::none) systems.emplace_back(wind_sea_of(sea), sea);
    if (sea.swell_height_m > 0) systems.push_back(SystemSpectrum::swell(sea));
    for (const WaveSystem& system : sea.systems) systems.emplace_back(system, sea);
    return systems;
}

}  // namespace

WaveSpectrum::WaveSpectrum(const SeaState& sea, const CascadePlan& cascade)
    : water_(sea.depth_m, cascade.has_surface_tension ? sea_surface_tension_m3ps2 : 0),
      grid_spacing_(cascade.spacing()),
      narrows_(!cascade.is_banded() || has_given_systems(sea)),
      lean_(lean_of(sea)) {
    if (is_phillips_paper(sea)) {
        papers_ = papers_of(sea, cascade);
        return;
    }
    systems_ = systems_of(sea);
    double largest_variance = 0;
    for (const SystemSpectrum& system : systems_) largest_variance += system.largest_variance();
    if (const double largest = highest_over_depth * sea.depth_m; 16 * largest_variance > largest * largest)
        kept_ = std::min(1.0, largest * largest / (16 * variance()));
}

WaveSpectrum::Papers WaveSpectrum::papers_of(const SeaState& sea, const CascadePlan& cascade) {
    const auto wind = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
    // A = A_fft^2 A_spatial^2 with A_fft = N^(-1/4), A_spatial = e / L: VR Ocean, equations 4 and
    // 5.
    const double spatial = euler_e / cascade.grid.side_m;
    return {.scale = spatial * spatial / std::sqrt(static_cast<double>(cascade.resolution)),
            .largest_wave_m = sea.wind_speed_mps * sea.wind_speed_mps / gravity_mps2,
            .cutoff_m = cutoff_length_m(sea, phillips_peak(sea.wind_speed_mps)),
            .wind_x = wind.cosine,
            .wind_z = wind.sine,
            .spreading = PaperSpreading(sea.wind_alignment)};
}

double WaveSpectrum::amplitude_variance(double kx, double kz) const {
    return amplitude_variances(shell(std::sqrt(kx * kx + kz * kz)), kx, kz).along;
}

WaveSpectrum::Shell WaveSpectrum::shell(double k, double widening) const {
    Shell shell;
    shell.k = k;
    if (papers_) {
        // Equations 3 to 13, with one factor D. The weight includes sigma, the square of equation
        // 9's amplitude factor.
        const double kl = k * papers_->largest_wave_m;
        shell.count = 1;
        shell.systems[0].variance = papers_->scale * det::exp(-1 / (kl * kl)) / ((k * k) * (k * k));
        shell.papers_cutoff = short_wave_factor(k, papers_->cutoff_m);
        return shell;
    }
    const double per_density = 0.5 * grid_spacing_ * grid_spacing_;
    const double step_rad = grid_spacing_ / k, widening_rad2 = narrows_ ? widening * (step_rad * step_rad) : 0;
    const ShellOfWaves at(k, water_);
    for (const SystemSpectrum& system : systems_) {
        Shell::OfSystem& of = shell.systems[shell.count++];
        of.variance = per_density * (system.density(at) * kept_ / k);
        if (of.variance > 0) of.lobe = system.lobe(at.omega, widening_rad2);
    }
    return shell;
}

OppositeDensities WaveSpectrum::amplitude_variances(const Shell& shell, std::size_t system, double kx,
                                                    double kz) const {
    const double variance = shell.systems[system].variance;
    if (!(variance > 0)) return {0, 0};
    const auto spread = systems_[system].spread(shell.systems[system].lobe, kx, kz, shell.k);
    return {variance * spread.along, variance * spread.against};
}

OppositeDensities WaveSpectrum::amplitude_variances(const Shell& shell, double kx, double kz) const {
    OppositeDensities both{0, 0};
    if (papers_) {
        const double cosine = (kx * papers_->wind_x + kz * papers_->wind_z) / shell.k;
        const auto weight = papers_->spreading.weights(cosine);
        const double variance = shell.systems[0].variance;
        return {variance * weight.along * shell.papers_cutoff, variance * weight.against * shell.papers_cutoff};
    }
    for (std::size_t system = 0; system < shell.count; ++system) {
        const auto of = amplitude_variances(shell, system, kx, kz);
        both.along += of.along;
        both.against += of.against;
    }
    return both;
}

double WaveSpectrum::radial_density(double k) const {
    const ShellOfWaves at(k, water_);
    double sum = 0;
    for (const SystemSpectrum& system : systems_) sum += system.density(at) * kept_;
    return sum;
}

double WaveSpectrum::lean(double k) const {
    if (lean_ == 0 || systems_.size() <= 1) return lean_;
    const ShellOfWaves at(k, water_);
    double all = 0;
    for (const SystemSpectrum& system : systems_) all += system.density(at);
    return all > 0 ? lean_ * (systems_.front().density(at) / all) : 0;
}

double WaveSpectrum::radial_density(std::size_t system, double k) const {
    return systems_[system].density({k, water_}) * kept_;
}

double WaveSpectrum::narrowest_lobe_rad() const {
    double narrowest = 10;
    for (const SystemSpectrum& system : systems_)
        if (system.given_spread_rad() > 0) narrowest = std::min(narrowest, system.given_spread_rad());
    return narrows_ ? DirectionalLobe::least_narrowed * narrowest : narrowest;
}

// Trapezoidal rule in log k. The spectrum is smooth, so the error is far below 1e-6.
double WaveSpectrum::variance() const {
    double sum = 0;
    const double step = det::log(scanned_k_ratio);
    for (double k = min_scanned_k; k < max_scanned_k; k *= scanned_k_ratio) sum += radial_density(k) * k * step;
    return sum;
}

}  // namespace pelagic
