#include "pelagic/sim/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/spectrum/amplitudes.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/spectral_peak.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr double two_pi = 6.28318530717958647693;

/// Calls visit(k, variance) for the waves (m, n), (-m, n), (m, -n) and (-m, -n) of each tile's lattice together, which share a
/// wave number. `variance` is the sum of variances_of(waves, m, n), two numbers: what (m, n) and its opposite hold, and what
/// (-m, n) and its opposite hold; on the axes the first alone. DC and the Nyquist row and column hold no waves.
template <class VariancesOf, class Visit>
void for_each_wave_number(const SeaState& sea, VariancesOf variances_of, Visit visit) {
    for (const TilePlan& tile : plan_tiles(sea)) {
        const TileWaves waves(sea, tile);
        const double spacing = tile.spacing();
        for (int n = 0; n < tile.resolution / 2; ++n) {
            for (int m = n == 0 ? 1 : 0; m < tile.resolution / 2; ++m) {
                const double kx = m * spacing, kz = n * spacing;
                const auto [plus, minus] = variances_of(waves, m, n);
                visit(std::sqrt(kx * kx + kz * kz), m > 0 && n > 0 ? plus + minus : plus);
            }
        }
    }
}

/// The same with the waves that this seed drew.
template <class Visit>
void for_each_drawn_wave_number(const SeaState& sea, Visit visit) {
    const auto variances_of = [](const TileWaves& waves, int m, int n) {
        const TileWaves::MirroredPair pair = waves.pair(m, n);
        return std::pair(pair.plus.drawn_square(), pair.minus.drawn_square());
    };
    for_each_wave_number(sea, variances_of, visit);
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
    const WaveSpectrum spectrum(sea, plan_tiles(sea).front());
    // Each h~(k) is h0(k) and a mirror of h0(-k), so every amplitude counts twice in the variance.
    double variance = 0;
    const auto variances_of = [](const TileWaves& waves, int m, int n) {
        const auto [plus, minus] = waves.variances(m, n);
        return std::pair(plus.along + plus.against, minus.along + minus.against);
    };
    for_each_wave_number(sea, variances_of, [&](double, double held) { variance += 2 * held; });
    const SpectralPeak peak = peak_of(spectrum, sea);
    ExpectedWaves waves{4 * std::sqrt(variance), two_pi / peak.omega, two_pi / peak.k, {}};
    if (spectrum.is_physical()) waves.model_significant_wave_height_m = 4 * std::sqrt(spectrum.variance());
    return waves;
}

double measured_significant_wave_height_m(const Frame& frame) {
    const DefaultFloatEnvironment environment;
    double variance = 0;
    for (const Tile& tile : frame.tiles) {
        const double count = static_cast<double>(tile.resolution()) * tile.resolution();
        double sum = 0, squares = 0;
        for (int j = 0; j < tile.resolution(); ++j) {
            for (int i = 0; i < tile.resolution(); ++i) {
                const double h = tile.height.at(i, j);
                sum += h;
                squares += h * h;
            }
        }
        const double mean = sum / count;
        variance += std::max(0.0, squares / count - mean * mean);
    }
    return 4 * std::sqrt(variance);
}

double measured_peak_period_s(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    // Bands 5 % wide from the longest wave of the lattice up to the shortest.
    constexpr double band_ratio = 1.05;
    const double log_ratio = det::log(band_ratio);
    const double lowest = angular_frequency(plan_tiles(sea).front().spacing(), sea.depth_m) / two_pi;
    std::vector<double> energy;
    for_each_drawn_wave_number(sea, [&](double k, double variance) {
        const double frequency = angular_frequency(k, sea.depth_m) / two_pi;
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
    std::unordered_map<std::uint32_t, double> variances;
    double all = 0;
    for_each_drawn_wave_number(sea, [&](double k, double variance) {
        variances[loop_harmonic(angular_frequency(k, sea.depth_m), sea.loop_period_s)] += variance;
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
    const TilePlan coarsest = plan_tiles(sea).front(), finest = plan_tiles(sea).back();
    const WaveSpectrum spectrum(sea, coarsest);
    const SpectralPeak peak = peak_of(spectrum, sea);
    const double peak_wavelength_m = two_pi / peak.k;
    std::vector<std::string> warnings;
    if (const double kept = spectrum.kept_by_breaking(); kept < 1) {
        const double height = highest_over_depth * sea.depth_m;
        warnings.push_back("in " + number_text(sea.depth_m) + " m of water waves break: of Hs " +
                           short_text(height / std::sqrt(kept)) + " m " + short_text(height) +
                           " m is left, 0.6 of the depth");
    }
    if (coarsest.lattice.side_m < 2 * peak_wavelength_m)
        warnings.push_back("the patch of " + number_text(coarsest.lattice.side_m) +
                           " m is shorter than two peak wavelengths (" + short_text(2 * peak_wavelength_m) +
                           " m): it holds few of the largest waves, or none, so each seed is higher or lower" +
                           height_beside_model(sea));
    if (const double shortest = 2 * finest.lattice.side_m / finest.resolution; peak_wavelength_m < 2 * shortest)
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
