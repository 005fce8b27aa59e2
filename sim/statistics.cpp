#include "pelagic/sim/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>
#include <vector>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/sources/packed_spectrum.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/spectra.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr double two_pi = 6.28318530717958647693;

/// Calls visit(shell, variance) for the waves (m, n), (-m, n), (m, -n) and (-m, -n) of the grid together, which share a wave
/// number. `variance` is the sum of variance_of(shell, m, n), what a wave and its opposite hold, over what of them there is:
/// on the axes two. DC and the Nyquist row and column hold no waves.
template <class VarianceOf, class Visit>
void for_each_shell(const SeaState& sea, const WaveSpectrum& spectrum, VarianceOf variance_of, Visit visit) {
    const double spacing = two_pi / sea.patch_size_m;
    for (int n = 0; n < sea.resolution / 2; ++n) {
        for (int m = n == 0 ? 1 : 0; m < sea.resolution / 2; ++m) {
            const double kx = m * spacing, kz = n * spacing;
            const WaveSpectrum::Shell shell = spectrum.shell(std::sqrt(kx * kx + kz * kz));
            double variance = variance_of(shell, m, n);
            if (m > 0 && n > 0) variance += variance_of(shell, -m, n);
            visit(shell, variance);
        }
    }
}

/// The same with the waves that this seed drew.
template <class Visit>
void for_each_drawn_shell(const SeaState& sea, const WaveSpectrum& spectrum, Visit visit) {
    const auto variance_of = [&](const WaveSpectrum::Shell& shell, int m, int n) {
        return drawn_variance(sea, spectrum, shell, m, n);
    };
    for_each_shell(sea, spectrum, variance_of, visit);
}

/// The model's energy over wave number, whatever its scale, m^3.
double radial_energy(const WaveSpectrum& spectrum, const SeaState& sea, double k) {
    if (spectrum.is_physical()) return spectrum.radial_density(k);
    // Along the wind the paper's spectrum has the shape of the whole: its spreading does not depend on k.
    const auto wind = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
    return k * spectrum.amplitude_variance(k * wind.cosine, k * wind.sine);
}

// Wave numbers to look at: from ten times the longest wave of the wind to a tenth of a millimetre, 2 % apart.
constexpr double shortest_k = 1e-5;
constexpr double longest_k = 6e4;
constexpr double k_ratio = 1.02;

struct Peak {
    double k, omega;
};

// The largest S(omega) = S(k) / (d omega / d k), refined by halving steps around the best of the coarse grid.
Peak peak_of(const WaveSpectrum& spectrum, const SeaState& sea) {
    const auto density = [&](double k) { return radial_energy(spectrum, sea, k) / group_velocity(k, sea.depth_m); };
    double best = shortest_k;
    for (double k = shortest_k; k < longest_k; k *= k_ratio)
        if (density(k) > density(best)) best = k;
    for (double step = k_ratio - 1; step > 1e-7; step *= 0.5)
        for (const double k : {best * (1 - step), best * (1 + step)})
            if (density(k) > density(best)) best = k;
    return {best, angular_frequency(best, sea.depth_m)};
}

std::string short_text(double value) { return rounded_text(value, 3); }

/// What a patch does to the height, over all seeds: one seed's own may as well be above the model's.
std::string height_beside_model(const SeaState& sea) {
    const ExpectedWaves waves = expected_waves(sea);
    if (!waves.model_significant_wave_height_m) return {};
    return ", over all seeds Hs " + short_text(waves.significant_wave_height_m) + " m, where this wind makes " +
           short_text(*waves.model_significant_wave_height_m) + " m";
}

}  // namespace

ExpectedWaves expected_waves(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    const WaveSpectrum spectrum(sea);
    const double spacing = two_pi / sea.patch_size_m;
    // Each h~(k) is h0(k) and a mirror of h0(-k), so every amplitude counts twice in the variance.
    double variance = 0;
    const auto variance_of = [&](const WaveSpectrum::Shell& shell, int m, int n) {
        const auto waves = spectrum.amplitude_variances(shell, m * spacing, n * spacing);
        return waves.along + waves.against;
    };
    for_each_shell(sea, spectrum, variance_of, [&](const auto&, double held) { variance += 2 * held; });
    const Peak peak = peak_of(spectrum, sea);
    ExpectedWaves waves{4 * std::sqrt(variance), two_pi / peak.omega, two_pi / peak.k, {}};
    if (spectrum.is_physical()) waves.model_significant_wave_height_m = 4 * std::sqrt(spectrum.variance());
    return waves;
}

double measured_significant_wave_height_m(const Frame& frame) {
    const DefaultFloatEnvironment environment;
    const double count = static_cast<double>(frame.resolution()) * frame.resolution();
    double sum = 0, squares = 0;
    for (int j = 0; j < frame.resolution(); ++j) {
        for (int i = 0; i < frame.resolution(); ++i) {
            const double h = frame.height.at(i, j);
            sum += h;
            squares += h * h;
        }
    }
    const double mean = sum / count;
    return 4 * std::sqrt(std::max(0.0, squares / count - mean * mean));
}

double measured_peak_period_s(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    const WaveSpectrum spectrum(sea);
    const double spacing = two_pi / sea.patch_size_m;

    // Bands 5 % wide from the grid's longest wave up to its shortest.
    constexpr double band_ratio = 1.05;
    const double log_ratio = det::log(band_ratio);
    const double lowest = angular_frequency(spacing, sea.depth_m) / two_pi;
    std::vector<double> energy;
    for_each_drawn_shell(sea, spectrum, [&](const WaveSpectrum::Shell& shell, double variance) {
        const double frequency = angular_frequency(shell.k, sea.depth_m) / two_pi;
        const auto band = static_cast<std::size_t>(std::max(0.0, det::log(frequency / lowest) / log_ratio));
        if (band >= energy.size()) energy.resize(band + 1);
        energy[band] += variance;
    });

    double weight = 0, weighted_frequency = 0;
    double edge = lowest;
    for (const double e : energy) {
        const double width = edge * (band_ratio - 1);
        const double density = e / width;
        const double fourth = density * density * density * density * width;
        weight += fourth;
        weighted_frequency += fourth * (edge + 0.5 * width);
        edge *= band_ratio;
    }
    return weight / weighted_frequency;
}

LoopFrequencies loop_frequencies(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    const WaveSpectrum spectrum(sea);
    std::unordered_map<std::uint32_t, double> variances;
    double all = 0;
    for_each_drawn_shell(sea, spectrum, [&](const WaveSpectrum::Shell& shell, double variance) {
        variances[loop_harmonic(angular_frequency(shell.k, sea.depth_m), sea.loop_period_s)] += variance;
        all += variance;
    });
    if (!(all > 0)) return {};

    std::vector<double> falling;
    for (const auto& [harmonic, variance] : variances) falling.push_back(variance / all);
    std::sort(falling.begin(), falling.end(), std::greater());
    LoopFrequencies found{0, falling.front()};
    double held = 0;
    for (const double share : falling) {
        if (held >= 0.9) break;
        held += share;
        ++found.for_90_percent;
    }
    return found;
}

std::vector<std::string> warnings_about(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    const WaveSpectrum spectrum(sea);
    const Peak peak = peak_of(spectrum, sea);
    const double peak_wavelength_m = two_pi / peak.k;
    std::vector<std::string> warnings;
    if (const double kept = spectrum.kept_by_breaking(); kept < 1) {
        const double height = highest_over_depth * sea.depth_m;
        warnings.push_back("in " + number_text(sea.depth_m) + " m of water waves break: of Hs " +
                           short_text(height / std::sqrt(kept)) + " m " + short_text(height) +
                           " m is left, 0.6 of the depth");
    }
    if (sea.patch_size_m < 2 * peak_wavelength_m)
        warnings.push_back("the patch of " + number_text(sea.patch_size_m) +
                           " m is shorter than two peak wavelengths (" + short_text(2 * peak_wavelength_m) +
                           " m): it holds few of the largest waves, or none, so each seed is higher or lower" +
                           height_beside_model(sea));
    if (const double shortest = 2 * sea.patch_size_m / sea.resolution; peak_wavelength_m < 2 * shortest)
        warnings.push_back("the grid's shortest wave of " + short_text(shortest) +
                           " m is longer than half the peak wavelength (" + short_text(peak_wavelength_m) +
                           " m): raise the resolution or shrink the patch");
    const double looped = loop_harmonic(peak.omega, sea.loop_period_s) * two_pi / sea.loop_period_s;
    if (std::fabs(looped / peak.omega - 1) > 0.1)
        warnings.push_back("a loop of " + number_text(sea.loop_period_s) + " s bends the peak's period by " +
                           number_text(std::round(100 * std::fabs(peak.omega / looped - 1))) +
                           " %: waves of a loop run a whole number of periods");
    if (const LoopFrequencies found = loop_frequencies(sea);
        found.largest_share > 0 && found.for_90_percent < fewest_loop_frequencies)
        warnings.push_back("a loop of " + number_text(sea.loop_period_s) +
                           " s is short for this sea: " + number_text(found.for_90_percent) +
                           " of its frequencies hold 90 % of the energy, so waves rise and fall in step; ten peak "
                           "periods, " +
                           number_text(std::round(10 * two_pi / peak.omega)) + " s, leave about ten");
    return warnings;
}

}  // namespace pelagic
