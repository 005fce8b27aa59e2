#include "pelagic/sim/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>
#include <vector>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/spectra.hpp"
#include "pelagic/sim/spectrum/wave_noise.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr double two_pi = 6.28318530717958647693;

/// Sums over waves of their variance, m^2.
struct Moments {
    double variance = 0;
    double x = 0, z = 0;  ///< times the unit vector in which they run

    /// A wave that runs along (cosine_x, cosine_z) and the one against it.
    void add(double along, double against, double cosine_x, double cosine_z) {
        variance += along + against;
        x += (along - against) * cosine_x;
        z += (along - against) * cosine_z;
    }
};

/// |h0|^2 of the wave (m, n) that this seed drew; both parts of the draw have variance 1, so half of E|h0|^2 belongs to each.
double drawn_square(const SeaState& sea, double expected_square, int m, int n) {
    return 0.5 * expected_square * gaussian_pair_square(sea.seed, m, n);
}

/// What one pass over the grid finds: every figure of this file comes from these.
struct GridSums {
    Moments expected;           ///< the mean over all seeds
    SlopeVariance slopes;       ///< the same
    Moments drawn;              ///< of this seed, as are the rest
    std::vector<double> bands;  ///< of frequency, band_ratio wide, from that of the grid's longest wave on; m^2
    std::unordered_map<std::uint32_t, double> harmonics;  ///< periods in a loop, m^2
};

// Bands 5 % wide from the grid's longest wave up to its shortest.
constexpr double band_ratio = 1.05;

double lowest_band_hz(const SeaState& sea) {
    return angular_frequency(two_pi / sea.patch_size_m, sea.depth_m) / two_pi;
}

enum class Draws { no, yes };

/// Waves whose numbers differ in sign or order share a wave number, and most of the work. DC and the Nyquist row and column
/// hold no waves. Without draws only `expected` is summed, which is half the work.
GridSums sums_over(const SeaState& sea, const WaveSpectrum& spectrum, Draws draws) {
    const double spacing = two_pi / sea.patch_size_m;
    const auto wind = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
    const double log_ratio = det::log(band_ratio), lowest = lowest_band_hz(sea);
    GridSums sums;

    // The wave (m, n) and the one against it; what they hold of this seed.
    const auto add_pair = [&](const WaveSpectrum::Shell& shell, int m, int n) {
        const double kx = m * spacing, kz = n * spacing;
        const auto variances = spectrum.amplitude_variances(shell, kx, kz);
        // Each h~(k) is h0(k) and a mirror of h0(-k), so every amplitude counts twice in the variance.
        sums.expected.add(2 * variances.along, 2 * variances.against, kx / shell.k, kz / shell.k);
        const double expected = 2 * (variances.along + variances.against);
        const double k_along = kx * wind.cosine + kz * wind.sine, k_across = kz * wind.cosine - kx * wind.sine;
        sums.slopes.along_wind += expected * (k_along * k_along);
        sums.slopes.across_wind += expected * (k_across * k_across);
        if (draws == Draws::no) return 0.0;
        const double along = 2 * drawn_square(sea, variances.along, m, n);
        const double against = 2 * drawn_square(sea, variances.against, -m, -n);
        sums.drawn.add(along, against, kx / shell.k, kz / shell.k);
        return along + against;
    };
    for (int n = 0; n < sea.resolution / 2; ++n) {
        for (int m = std::max(n, 1); m < sea.resolution / 2; ++m) {
            const double kx = m * spacing, kz = n * spacing;
            const WaveSpectrum::Shell shell = spectrum.shell(std::sqrt(kx * kx + kz * kz));
            double drawn = add_pair(shell, m, n);
            if (n > 0) drawn += add_pair(shell, -m, n);
            if (m > n) drawn += add_pair(shell, n, m);
            if (m > n && n > 0) drawn += add_pair(shell, -n, m);
            if (draws == Draws::no) continue;
            const double omega = angular_frequency(shell.k, sea.depth_m);
            const double rise = det::log(omega / two_pi / lowest) / log_ratio;
            const auto band = static_cast<std::size_t>(std::max(0.0, rise));
            if (band >= sums.bands.size()) sums.bands.resize(band + 1);
            sums.bands[band] += drawn;
            sums.harmonics[loop_harmonic(omega, sea.loop_period_s)] += drawn;
        }
    }
    return sums;
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
    double best = shortest_k, most = density(best);
    const auto look_at = [&](double k) {
        if (const double here = density(k); here > most) best = k, most = here;
    };
    for (double k = shortest_k; k < longest_k; k *= k_ratio) look_at(k);
    for (double step = k_ratio - 1; step > 1e-7; step *= 0.5)
        for (const double k : {best * (1 - step), best * (1 + step)}) look_at(k);
    return {best, angular_frequency(best, sea.depth_m)};
}

// Trapezoidal rule in log k, which the smooth spectrum makes accurate to far better than 1e-6.
double model_variance(const WaveSpectrum& spectrum) {
    double sum = 0;
    const double step = det::log(k_ratio);
    for (double k = shortest_k; k < longest_k; k *= k_ratio) sum += spectrum.radial_density(k) * k * step;
    return sum;
}

std::string short_text(double value) { return rounded_text(value, 3); }

/// What the model says, with the sums of the grid.
ExpectedWaves expected_from(const WaveSpectrum& spectrum, const Peak& peak, const GridSums& sums) {
    ExpectedWaves waves{4 * std::sqrt(sums.expected.variance), two_pi / peak.omega, two_pi / peak.k, {}};
    if (spectrum.is_physical()) waves.model_significant_wave_height_m = 4 * std::sqrt(model_variance(spectrum));
    return waves;
}

double peak_period_from(const SeaState& sea, const GridSums& sums) {
    double weight = 0, weighted_frequency = 0;
    double edge = lowest_band_hz(sea);
    for (const double energy : sums.bands) {
        const double width = edge * (band_ratio - 1);
        const double density = energy / width;
        const double fourth = density * density * density * density * width;
        weight += fourth;
        weighted_frequency += fourth * (edge + 0.5 * width);
        edge *= band_ratio;
    }
    return weight / weighted_frequency;
}

LoopFrequencies loop_frequencies_from(const GridSums& sums) {
    std::vector<double> falling;
    double all = 0;
    for (const auto& [harmonic, variance] : sums.harmonics) falling.push_back(variance);
    std::sort(falling.begin(), falling.end(), std::greater());
    for (const double variance : falling) all += variance;
    if (!(all > 0)) return {};
    LoopFrequencies found{0, falling.front() / all};
    double held = 0;
    for (const double variance : falling) {
        if (held >= 0.9) break;
        held += variance / all;
        ++found.for_90_percent;
    }
    return found;
}

/// The angle of (x, z) in (-pi, pi], the same bits everywhere: Newton's steps from the nearest quarter of a turn, each of
/// which leaves the cube of the error over six.
double angle_of(double x, double z) {
    const double length = std::sqrt(x * x + z * z);
    if (!(length > 0)) return 0;
    double turns = std::fabs(z) > std::fabs(x) ? (z > 0 ? 0.25 : -0.25) : x < 0 ? (z < 0 ? -0.5 : 0.5) : 0.0;
    for (int step = 0; step < 5; ++step) {
        const auto at = det::sine_cosine_of_turns(turns);
        turns += (z * at.cosine - x * at.sine) / length / two_pi;
    }
    return turns * two_pi;
}

WaveDirections directions_from(const Moments& moments) {
    if (!(moments.variance > 0)) return {};
    const double first = std::sqrt(moments.x * moments.x + moments.z * moments.z) / moments.variance;
    return {angle_of(moments.x, moments.z), std::sqrt(2 * std::max(0.0, 1 - first))};
}

std::vector<std::string> warnings_from(const SeaState& sea, const Peak& peak, const ExpectedWaves& waves,
                                       const LoopFrequencies& found) {
    std::vector<std::string> warnings;
    // What a patch does to the height, over all seeds: one seed's own may as well be above the model's.
    const auto height_beside_model = [&]() -> std::string {
        if (!waves.model_significant_wave_height_m) return {};
        return ", over all seeds Hs " + short_text(waves.significant_wave_height_m) + " m, where this wind makes " +
               short_text(*waves.model_significant_wave_height_m) + " m";
    };
    const double peak_wavelength_m = waves.peak_wavelength_m;
    if (sea.patch_size_m < 2 * peak_wavelength_m)
        warnings.push_back("the patch of " + number_text(sea.patch_size_m) +
                           " m is shorter than two peak wavelengths (" + short_text(2 * peak_wavelength_m) +
                           " m): it holds few of the largest waves, or none, so each seed is higher or lower" +
                           height_beside_model());
    if (const double shortest = 2 * sea.patch_size_m / sea.resolution; peak_wavelength_m < 2 * shortest)
        warnings.push_back("the grid's shortest wave of " + short_text(shortest) +
                           " m is longer than half the peak wavelength (" + short_text(peak_wavelength_m) +
                           " m): raise the resolution or shrink the patch");
    const double looped = loop_harmonic(peak.omega, sea.loop_period_s) * two_pi / sea.loop_period_s;
    if (std::fabs(looped / peak.omega - 1) > 0.1)
        warnings.push_back("a loop of " + number_text(sea.loop_period_s) + " s bends the peak's period by " +
                           number_text(std::round(100 * std::fabs(peak.omega / looped - 1))) +
                           " %: waves of a loop run a whole number of periods");
    if (found.largest_share > 0 && found.for_90_percent < fewest_loop_frequencies)
        warnings.push_back("a loop of " + number_text(sea.loop_period_s) +
                           " s is short for this sea: " + number_text(found.for_90_percent) +
                           " of its frequencies hold 90 % of the energy, so waves rise and fall in step; ten peak "
                           "periods, " +
                           number_text(std::round(10 * two_pi / peak.omega)) + " s, leave about ten");
    return warnings;
}

}  // namespace

SeaReport report_on(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    const WaveSpectrum spectrum(sea);
    const Peak peak = peak_of(spectrum, sea);
    const GridSums sums = sums_over(sea, spectrum, Draws::yes);
    SeaReport report;
    report.expected = expected_from(spectrum, peak, sums);
    report.drawn_peak_period_s = peak_period_from(sea, sums);
    report.expected_directions = directions_from(sums.expected);
    report.drawn_directions = directions_from(sums.drawn);
    report.tiles = {{sea.patch_size_m, sea.resolution, sums.slopes}};
    report.loop_frequencies = loop_frequencies_from(sums);
    report.warnings = warnings_from(sea, peak, report.expected, report.loop_frequencies);
    return report;
}

// W was measured 12.5 m above the sea, where wind blows 2 % faster than at 10 m: less than the formula is sure of.
SlopeVariance cox_and_munk_slopes(double wind_speed_mps) {
    return {0.00316 * wind_speed_mps, 0.003 + 0.00192 * wind_speed_mps};
}

ExpectedWaves expected_waves(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    const WaveSpectrum spectrum(sea);
    return expected_from(spectrum, peak_of(spectrum, sea), sums_over(sea, spectrum, Draws::no));
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

double measured_peak_period_s(const SeaState& sea) { return report_on(sea).drawn_peak_period_s; }

LoopFrequencies loop_frequencies(const SeaState& sea) { return report_on(sea).loop_frequencies; }

std::vector<std::string> warnings_about(const SeaState& sea) { return report_on(sea).warnings; }

}  // namespace pelagic
