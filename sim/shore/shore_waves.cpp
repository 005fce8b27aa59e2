#include "pelagic/sim/shore/shore_waves.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/spectra.hpp"
#include "pelagic/sim/spectrum/wave_list.hpp"
#include "pelagic/sim/spectrum/wave_noise.hpp"
#include "pelagic/sim/spectrum/wave_numbers.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

// Numerical resolution: logarithmic shells of a band of wave numbers, and directions of a circle.
constexpr int shells = 256, directions = 180;

// Eighths of the energy over direction, one for each wave in turn. The order gives waves of similar
// frequency different directions.
constexpr std::array quantiles = {3, 6, 0, 5, 2, 7, 1, 4};

// Cascade number of the random draws; no cascade of a stack has it.
constexpr int shore_draws = 1000;

/// Range of wave numbers of a cascade: its band, limited to its grid.
struct Reach {
    double min_k, max_k;
    explicit Reach(const CascadePlan& cascade)
        : min_k(std::max(cascade.min_k, 0.5 * cascade.spacing())),
          max_k(std::min(cascade.max_k, 0.5 * cascade.resolution * cascade.spacing())) {}
};

/// Calls visit(k, energy of the shell) for each shell, from long waves to short ones.
template <class Visit>
void for_shells(const WaveSpectrum& spectrum, const CascadePlan& cascade, Visit visit) {
    const Reach reach(cascade);
    const double ratio = det::pow(reach.max_k / reach.min_k, 1.0 / shells), step = det::log(ratio);
    double k = reach.min_k * std::sqrt(ratio);
    for (int shell = 0; shell < shells; ++shell, k *= ratio) visit(k, spectrum.radial_density(k) * k * step);
}

/// Returns the direction, in turns, that is a quantile of the energy of a wave number over
/// direction. Directions are counted from the one against the wind. \param quantile  in [0, 1]
double direction_turns(const WaveSpectrum& spectrum, double k, double wind_turns, double quantile) {
    const WaveSpectrum::Shell shell = spectrum.shell(k);
    std::array<double, directions> energy;
    double sum = 0;
    for (int i = 0; i < directions; ++i) {
        const auto [sine, cosine] = det::sine_cosine_of_turns(wind_turns - 0.5 + (i + 0.5) / directions);
        energy[static_cast<std::size_t>(i)] = spectrum.amplitude_variances(shell, k * cosine, k * sine).along;
        sum += energy[static_cast<std::size_t>(i)];
    }
    double below = 0;
    for (int i = 0; i < directions; ++i) {
        const double here = energy[static_cast<std::size_t>(i)];
        if (below + here >= quantile * sum && here > 0)
            return wind_turns - 0.5 + (i + (quantile * sum - below) / here) / directions;
        below += here;
    }
    return wind_turns;
}

std::vector<ShoreWave> realised_waves(const SeaState& sea, const CascadePlan& coarsest) {
    const WaveSpectrum spectrum(sea, coarsest);
    double all = 0;
    for_shells(spectrum, coarsest, [&](double, double energy) { all += energy; });
    if (!(all > 0)) return {};

    constexpr double count = max_shore_waves;
    std::vector<ShoreWave> waves;
    double below = 0, share = 0, share_k = 0;
    // Returns a uniform number in (0, 1]: the probability of a longer Gaussian draw.
    const auto evenly = [&](int number, int which) {
        return det::exp(-0.5 * gaussian_pair_square(sea.seed, shore_draws, number, which));
    };
    const auto add_wave = [&] {
        const int number = static_cast<int>(waves.size());
        const double k = share_k / share;
        const std::uint32_t harmonic = loop_harmonic(angular_frequency(k, spectrum.water()), sea.loop_period_s);
        const double quantile = (quantiles[static_cast<std::size_t>(number) % quantiles.size()] + evenly(number, 1)) /
                                static_cast<double>(quantiles.size());
        const auto [sine, cosine] =
            det::sine_cosine_of_turns(direction_turns(spectrum, k, sea.wind_direction_rad / two_pi, quantile));
        waves.push_back({.amplitude_m = std::sqrt(2 * all / count),
                         .harmonic = harmonic,
                         .omega = two_pi * harmonic / sea.loop_period_s,
                         .along_x = cosine,
                         .along_z = sine,
                         .phase_turns = evenly(number, 0)});
        share = share_k = 0;
    };
    for_shells(spectrum, coarsest, [&](double k, double energy) {
        // A shell at the boundary of two waves' bands is divided between them.
        while (energy > 0) {
            const double end = all * static_cast<double>(waves.size() + 1) / count;
            const double taken = waves.size() + 1 < max_shore_waves ? std::min(energy, end - below) : energy;
            share += taken;
            share_k += taken * k;
            below += taken;
            energy -= taken;
            if (waves.size() + 1 < max_shore_waves && below >= end) add_wave();
            if (!(taken > 0)) break;
        }
    });
    if (share > 0) add_wave();
    return waves;
}

std::vector<ShoreWave> listed_waves(const SeaState& sea, const CascadePlan& coarsest) {
    std::vector<ShoreWave> waves;
    for (const GridWave& wave : grid_waves(sea, coarsest)) {
        const double length = wave.at.steps();
        if (!(length > 0)) continue;
        const auto [x, z] = coarsest.grid.in_world(wave.at.m / length, wave.at.n / length);
        const std::uint32_t harmonic =
            loop_harmonic(angular_frequency(length * coarsest.spacing(), deep_water), sea.loop_period_s);
        waves.push_back({.amplitude_m = wave.amplitude_m,
                         .harmonic = harmonic,
                         .omega = two_pi * harmonic / sea.loop_period_s,
                         .along_x = x,
                         .along_z = z,
                         .phase_turns = wave.phase_turns});
    }
    std::stable_sort(waves.begin(), waves.end(),
                     [](const ShoreWave& a, const ShoreWave& b) { return a.amplitude_m > b.amplitude_m; });
    if (waves.size() > max_shore_waves) waves.resize(max_shore_waves);
    std::stable_sort(waves.begin(), waves.end(),
                     [](const ShoreWave& a, const ShoreWave& b) { return a.harmonic < b.harmonic; });
    return waves;
}

}  // namespace

std::vector<ShoreWave> shore_waves(const SeaState& sea, const CascadePlan& coarsest) {
    return sea.waves == WaveModel::analytic ? listed_waves(sea, coarsest) : realised_waves(sea, coarsest);
}

DepthAttenuation::DepthAttenuation(const SeaState& sea, const CascadePlan& cascade) {
    if (sea.waves == WaveModel::analytic) {
        for (const GridWave& wave : grid_waves(sea, cascade))
            if (const double k = wave.at.steps() * cascade.spacing(); k > 0)
                bands_.push_back({angular_frequency(k, deep_water), 0.5 * wave.amplitude_m * wave.amplitude_m, 1});
    } else {
        const WaveSpectrum spectrum(sea, cascade);
        for_shells(spectrum, cascade, [&](double k, double energy) {
            if (energy > 0)
                bands_.push_back({angular_frequency(k, spectrum.water().depth_m), energy,
                                  depth_factor(k, spectrum.water().depth_m)});
        });
    }
    for (const Band& band : bands_) variance_ += band.variance;
}

std::vector<double> DepthAttenuation::at(std::span<const double> depths_m) const {
    std::vector<double> water_m, remaining(depths_m.size()), k(depths_m.size()), factors;
    for (const double depth_m : depths_m) water_m.push_back(depth_m > 0 ? depth_m : 1);
    for (const Band& band : bands_) {
        wave_numbers(band.omega, water_m, k);
        for (std::size_t i = 0; i < k.size(); ++i)
            remaining[i] += band.variance * std::min(1.0, depth_factor(k[i], water_m[i]) / band.factor);
    }
    for (std::size_t i = 0; i < depths_m.size(); ++i) {
        const double highest_m = highest_over_depth * depths_m[i], height_m = 4 * std::sqrt(remaining[i]);
        const bool has_waves = depths_m[i] > 0 && !bands_.empty();
        factors.push_back(has_waves ? std::sqrt(remaining[i] / variance_) * std::min(1.0, highest_m / height_m) : 0);
    }
    return factors;
}

}  // namespace pelagic
