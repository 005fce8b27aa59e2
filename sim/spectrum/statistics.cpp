#include "pelagic/sim/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <unordered_map>
#include <utility>
#include <vector>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/spectrum/amplitudes.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/spectral_peak.hpp"
#include "pelagic/sim/spectrum/system_report.hpp"
#include "pelagic/sim/spectrum/wave_list.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

/// Sums of variances over waves, m^2.
struct Moments {
    double variance = 0;
    double x = 0, z = 0;  ///< variances times the unit vector of propagation

    /// Adds a wave along (cosine_x, cosine_z) and its opposite.
    void add(double along, double against, double cosine_x, double cosine_z) {
        variance += along + against;
        x += (along - against) * cosine_x;
        z += (along - against) * cosine_z;
    }
};

// Ratio of consecutive band edges: 5 %. Bands cover the longest to the shortest wave of the grid.
constexpr double band_ratio = 1.05;

/// The sums of one wave system.
struct SystemSums {
    Moments expected, realised;
    double expected_hz2 = 0;    ///< mean over all seeds of variance times squared frequency
    std::vector<double> bands;  ///< as GridSums::bands
};

/// The sums of one pass over all cascades' grids. All statistics in this file are computed from
/// them.
struct GridSums {
    double lowest_band_hz = 0;
    Moments expected;                     ///< mean over all seeds
    std::vector<CascadeSlopes> cascades;  ///< mean over all seeds
    Moments realised;                     ///< for the sea's seed
    /// Variance per frequency band for the sea's seed, m^2. Bands are band_ratio wide, and the
    /// first begins at the frequency of the longest wave.
    std::vector<double> bands;
    std::vector<SystemSums> systems;  ///< empty if they are not separated
    /// Variance by number of periods per loop for the sea's seed, m^2.
    std::unordered_map<std::uint32_t, double> harmonics;
    /// Means over all seeds of variance times frequency, and of variance times squared frequency.
    double expected_hz = 0, expected_hz2 = 0;
    double expected_of_velocities = 0;  ///< mean over all seeds of the variance in waves with a velocity
    double expected_convergence = 0, realised_convergence = 0;  ///< variances of Dx,x + Dz,z
    double expected_level = 0, realised_level = 0;              ///< sums of Cascade::level_m

    /// Returns the number of a frequency's band.
    std::size_t band_of(double hertz) const {
        return static_cast<std::size_t>(std::max(0.0, det::log(hertz / lowest_band_hz) / det::log(band_ratio)));
    }
    static void add_to_band(std::vector<double>& bands, std::size_t band, double variance) {
        if (band >= bands.size()) bands.resize(band + 1);
        bands[band] += variance;
    }
    void add_realised(double hertz, std::uint32_t harmonic, double variance) {
        add_to_band(bands, band_of(hertz), variance);
        harmonics[harmonic] += variance;
    }
    void add_expected(double hertz, double variance) {
        expected_hz += variance * hertz;
        expected_hz2 += variance * (hertz * hertz);
    }
};

/// What a pass over the grids computes: means over all seeds, or the waves of the sea's seed, too, at
/// twice the cost.
enum class Contents { means, realised };

/// Adds the waves of a cascade.
class CascadeSums {
   public:
    CascadeSums(const SeaState& sea, const CascadePlan& cascade, Contents contents, GridSums& sums)
        : sea_(sea),
          cascade_(cascade),
          waves_(sea, cascade),
          is_realised_(contents == Contents::realised),
          wind_(det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi)),
          sums_(sums) {}

    // (m, n) and (-m, n) share a wave number and therefore most of the computation. DC and the Nyquist
    // row and column hold no waves.
    void add() {
        for (int n = 0; n < cascade_.resolution / 2; ++n)
            for (int m = n == 0 ? 1 : 0; m < cascade_.resolution / 2; ++m) add_shell(m, n);
        sums_.cascades.push_back({cascade_.grid.side_m, cascade_.resolution, slopes_});
    }

   private:
    struct Variances {
        double expected = 0, realised = 0;
    };

    void add_shell(int m, int n) {
        k_ = cascade_.spacing() * std::sqrt(static_cast<double>(m) * m + static_cast<double>(n) * n);
        const bool is_by_system = !sums_.systems.empty();
        if (is_by_system) by_system_ = waves_.variances_by_system(m, n);
        const CascadeWaves::MirroredVariances variances = is_by_system ? sum_of(by_system_) : waves_.variances(m, n);
        const bool has_mirrored = m > 0 && n > 0;
        Variances here;
        add_pair(variances.plus, m, n, here);
        if (has_mirrored) add_pair(variances.minus, -m, n, here);
        if (!(here.expected > 0)) return;
        const Water& water = waves_.water();
        const double omega = waves_.frequency(k_);
        const double horizontal = sea_.choppiness * orbit_ratio(k_, water.depth_m) * k_;
        sums_.add_expected(omega / two_pi, here.expected);
        if (k_ * WaterLevels::shortest_velocity_texels * cascade_.grid.side_m <= two_pi * cascade_.resolution)
            sums_.expected_of_velocities += here.expected;
        sums_.expected_convergence += here.expected * (horizontal * horizontal);
        const double lean = waves_.lean(k_), sharpening = horizontal / std::sqrt(1 + lean * lean);
        sums_.expected_level += here.expected * sharpening;
        if (is_by_system) add_systems(m, n, has_mirrored, omega / two_pi);
        if (!(here.realised > 0)) return;
        sums_.realised_convergence += here.realised * (horizontal * horizontal);
        sums_.realised_level += here.realised * sharpening;
        sums_.add_realised(omega / two_pi, loop_harmonic(omega, sea_.loop_period_s), here.realised);
    }

    // Adds the wave (m, n) and its opposite, with expected and realised variances. Each h~(k) is the
    // sum of h0(k) and the mirrored h0(-k), so every amplitude counts twice in the variance.
    void add_pair(const OppositeDensities& variances, int m, int n, Variances& of_shell) {
        const auto [kx, kz] = cascade_.grid.in_world(m * cascade_.spacing(), n * cascade_.spacing());
        sums_.expected.add(2 * variances.along, 2 * variances.against, kx / k_, kz / k_);
        const double expected = 2 * (variances.along + variances.against);
        const double k_along = kx * wind_.cosine + kz * wind_.sine, k_across = kz * wind_.cosine - kx * wind_.sine;
        slopes_.upwind += expected * (k_along * k_along);
        slopes_.crosswind += expected * (k_across * k_across);
        of_shell.expected += expected;
        if (!is_realised_) return;
        const double along = 2 * waves_.realised_square(variances.along, m, n);
        const double against = 2 * waves_.realised_square(variances.against, -m, -n);
        sums_.realised.add(along, against, kx / k_, kz / k_);
        of_shell.realised += along + against;
    }

    /// Adds the contribution of each system to a shell. A drawn wave is divided as its variance is.
    void add_systems(int m, int n, bool has_mirrored, double hertz) {
        const std::size_t band = sums_.band_of(hertz);
        for (std::size_t system = 0; system < sums_.systems.size(); ++system) {
            SystemSums& sums = sums_.systems[system];
            Variances here = add_to_system(sums, by_system_[system].plus, m, n);
            if (has_mirrored) {
                const Variances mirrored = add_to_system(sums, by_system_[system].minus, -m, n);
                here.expected += mirrored.expected;
                here.realised += mirrored.realised;
            }
            sums.expected_hz2 += here.expected * (hertz * hertz);
            if (here.realised > 0) GridSums::add_to_band(sums.bands, band, here.realised);
        }
    }

    static CascadeWaves::MirroredVariances sum_of(const CascadeWaves::VariancesBySystem& of) {
        CascadeWaves::MirroredVariances sum{};
        for (const auto& [plus, minus] : of) {
            sum.plus.along += plus.along;
            sum.plus.against += plus.against;
            sum.minus.along += minus.along;
            sum.minus.against += minus.against;
        }
        return sum;
    }

    Variances add_to_system(SystemSums& sums, const OppositeDensities& variances, int m, int n) {
        const auto [kx, kz] = cascade_.grid.in_world(m * cascade_.spacing(), n * cascade_.spacing());
        sums.expected.add(2 * variances.along, 2 * variances.against, kx / k_, kz / k_);
        Variances of{.expected = 2 * (variances.along + variances.against)};
        if (!is_realised_) return of;
        const double along = 2 * waves_.realised_square(variances.along, m, n);
        const double against = 2 * waves_.realised_square(variances.against, -m, -n);
        sums.realised.add(along, against, kx / k_, kz / k_);
        of.realised = along + against;
        return of;
    }

    const SeaState& sea_;
    const CascadePlan& cascade_;
    const CascadeWaves waves_;
    const bool is_realised_;
    const det::SineCosine wind_;
    GridSums& sums_;
    SlopeVariance slopes_;
    double k_ = 0;                                 ///< of the shell, rad/m
    CascadeWaves::VariancesBySystem by_system_{};  ///< of the shell
};

/// Adds a pond's octaves, as independent waves with phases of their own.
void add_pond(const SeaState& sea, const CascadePlan& cascade, GridSums& sums) {
    const auto wind = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
    SlopeVariance slopes;
    for (const GridOctave& moved : grid_octaves(sea, cascade)) {
        const PondOctave& octave = moved.octave;
        const double x = octave.turns_per_m_x / octave.turns_per_m(), z = octave.turns_per_m_z / octave.turns_per_m();
        const double variance = moved.height_variance();
        if (!(variance > 0)) continue;
        sums.expected.add(variance, 0, x, z);
        sums.realised.add(variance, 0, x, z);
        sums.add_expected(octave.frequency_hz, variance);
        sums.add_realised(octave.frequency_hz, moved.harmonic, variance);
        const double along = x * wind.cosine + z * wind.sine;
        const double steep = moved.shown * moved.shown * moved.slope_variance();
        slopes.upwind += steep * (along * along);
        slopes.crosswind += steep * (1 - along * along);
    }
    sums.cascades.push_back({cascade.grid.side_m, cascade.resolution, slopes});
}

/// \param systems  number of systems whose sums are separated
GridSums sums_over(const SeaState& sea, std::span<const CascadePlan> plan, Contents contents, std::size_t systems) {
    GridSums sums;
    sums.systems.resize(systems);
    if (sea.waves == WaveModel::pond) {
        sums.lowest_band_hz = ripple_frequency_hz(1 / plan.front().grid.side_m);
        add_pond(sea, plan.front(), sums);
        return sums;
    }
    sums.lowest_band_hz = angular_frequency(plan.front().spacing(), sea.depth_m) / two_pi;
    for (const CascadePlan& cascade : plan) CascadeSums(sea, cascade, contents, sums).add();
    return sums;
}

std::string short_text(double value) { return rounded_text(value, 3); }

/// The waves of the model, without the limits of the cascades.
struct ModelWaves {
    SpectralPeak peak;
    std::optional<double> significant_wave_height_m;  ///< empty for phillips-paper
    double kept_after_breaking = 1;
    /// The systems, unless the wind sea of a wind is the only one.
    std::vector<ModelOfSystem> systems = {};
    int omitted = 0;  ///< number of listed waves that no cascade holds
};

ModelWaves model_waves_of_list(const SeaState& sea) {
    if (sea.waves == WaveModel::pond) {
        double squares = 0;
        const std::vector<PondOctave> octaves = octaves_of(pond_sea_of(sea));
        for (const PondOctave& octave : octaves) squares += octave.height_m * octave.height_m;
        const PondOctave& first = octaves.front();
        return {.peak = {two_pi * first.turns_per_m(), two_pi * first.frequency_hz},
                .significant_wave_height_m = 4 * std::sqrt(pond_variance * squares)};
    }
    if (sea.waves == WaveModel::regular) {
        const StokesWave wave = stokes_wave_of(sea);
        const double squares = wave.amplitude_m * wave.amplitude_m + wave.harmonic_m * wave.harmonic_m;
        return {.peak = {wave.k, wave.omega}, .significant_wave_height_m = 4 * std::sqrt(squares / 2)};
    }
    const PlaneWaves asked = plane_waves_of(analytic_sea_of(sea));
    const auto highest =
        std::max_element(asked.waves.begin(), asked.waves.end(),
                         [](const PlaneWave& a, const PlaneWave& b) { return a.amplitude_m < b.amplitude_m; });
    return {.peak = {two_pi * highest->turns_per_m(), two_pi * highest->frequency_hz},
            .significant_wave_height_m = significant_height_m(asked),
            .omitted = static_cast<int>(asked.waves.size() - waves_of_cascades(sea).waves.size())};
}

ModelWaves model_waves_of(const SeaState& sea, std::span<const CascadePlan> plan, bool with_systems) {
    if (sea.waves != WaveModel::spectrum) return model_waves_of_list(sea);
    const WaveSpectrum spectrum(sea, plan.front());
    ModelWaves asked{.peak = peak_of(spectrum, sea),
                     .significant_wave_height_m = {},
                     .kept_after_breaking = spectrum.kept_after_breaking()};
    if (!spectrum.is_physical()) return asked;
    asked.significant_wave_height_m = 4 * std::sqrt(spectrum.variance());
    if (with_systems &&
        (spectrum.systems().size() > 1 || spectrum.systems().front().is_at_depth() || !sea.systems.empty()))
        for (std::size_t system = 0; system < spectrum.systems().size(); ++system)
            asked.systems.push_back(model_of_system(spectrum, system));
    return asked;
}

/// Combines the model's waves with the sums of the grid.
ExpectedWaves expected_from(const ModelWaves& asked, const GridSums& sums) {
    return {4 * std::sqrt(sums.expected.variance), two_pi / asked.peak.omega, two_pi / asked.peak.k,
            asked.significant_wave_height_m};
}

/// Returns the peak period of bands that are band_ratio wide. Returns NaN if all bands are empty.
/// \param edge_hz  lower edge of the first band
double peak_period_of(const std::vector<double>& bands, double edge_hz) {
    double weight = 0, weighted_frequency = 0;
    for (const double energy : bands) {
        const double width = edge_hz * (band_ratio - 1);
        const double density = energy / width;
        const double fourth = density * density * density * density * width;
        weight += fourth;
        weighted_frequency += fourth * (edge_hz + 0.5 * width);
        edge_hz *= band_ratio;
    }
    return weight / weighted_frequency;
}

MeanPeriods periods_of(double variance, double hz, double hz2) {
    if (!(variance > 0)) return {};
    return {variance / hz, std::sqrt(variance / hz2)};
}

MeanPeriods realised_periods_from(const GridSums& sums, double loop_period_s) {
    GridSums looped;
    double variance = 0;
    // Add in the order of frequencies: the result of a floating-point sum depends on the order.
    for (const auto& [harmonic, of_harmonic] : std::map(sums.harmonics.begin(), sums.harmonics.end())) {
        looped.add_expected(harmonic / loop_period_s, of_harmonic);
        variance += of_harmonic;
    }
    return periods_of(variance, looped.expected_hz, looped.expected_hz2);
}

/// Returns the angle of (x, z) in (-pi, pi], bit-identical on every machine. Uses Newton steps from
/// the nearest quarter turn; each step reduces an error e to e^3 / 6.
double direction_rad(double x, double z) {
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
    return directions_of_moment(moments.x / moments.variance, moments.z / moments.variance);
}

SystemReport system_report(const SystemSums& sums, const ModelOfSystem& model, double lowest_band_hz) {
    const double realised = sums.realised.variance;
    return {.significant_wave_height_m = 4 * std::sqrt(sums.expected.variance),
            .realised_significant_wave_height_m = 4 * std::sqrt(realised),
            .peak_period_s = two_pi / model.peak_radps,
            .realised_peak_period_s =
                realised > 0 ? std::optional(peak_period_of(sums.bands, lowest_band_hz)) : std::nullopt,
            .expected_directions = directions_from(sums.expected),
            .realised_directions = directions_from(sums.realised)};
}

/// Returns a note about the systems of which the grid holds other waves than are given, or an empty
/// string.
std::string deviations_from(std::span<const SystemReport> systems, const ModelWaves& asked, const GridSums& sums,
                            std::span<const std::string> names) {
    std::string all;
    for (std::size_t i = 0; i < systems.size(); ++i) {
        const double tm02_s = periods_of(sums.systems[i].expected.variance, 1, sums.systems[i].expected_hz2).tm02_s;
        const std::string text = deviation_of(systems[i], tm02_s, asked.systems[i]);
        if (!text.empty()) all += (all.empty() ? "" : "; ") + names[i] + " " + text;
    }
    return all.empty() ? all : "the waves of the grid differ from those given: " + all;
}

/// Adds the statistics of the systems and returns deviations_from(). The realised peak period of the
/// whole sea is that of the system which has the model's peak.
std::string add_systems(const SeaState& sea, const ModelWaves& asked, const GridSums& sums, SeaReport& report) {
    std::vector<SystemReport> all;
    for (std::size_t i = 0; i < sums.systems.size(); ++i)
        all.push_back(system_report(sums.systems[i], asked.systems[i], sums.lowest_band_hz));
    const double peak_s = report.expected.peak_period_s;
    const auto nearest = std::min_element(all.begin(), all.end(), [&](const SystemReport& a, const SystemReport& b) {
        return std::fabs(a.peak_period_s - peak_s) < std::fabs(b.peak_period_s - peak_s);
    });
    report.realised_peak_period_s = nearest->realised_peak_period_s.value_or(0);
    std::vector<std::string> names;
    for (const SystemReport& system : all) {
        const std::size_t number = names.size();
        if (number == 0 && sea.spectrum != SpectrumModel::none) {
            names.emplace_back("wind sea");
            if (all.size() > 1) report.wind_sea = system;
        } else if (!report.swell && sea.swell_height_m > 0) {
            names.emplace_back("swell");
            report.swell = system;
        } else {
            report.systems.push_back(system);
            names.push_back("system " + number_text(report.systems.size()));
        }
    }
    return deviations_from(all, asked, sums, names);
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

/// Returns whether the loop is so short that its waves may have few frequencies, which only the
/// realised waves show. Listed waves always have few frequencies. In a longer loop, few frequencies
/// are caused by a narrow swell or by a grid that holds few waves, for which other warnings exist.
bool is_short_loop(const SeaState& sea, double ten_peaks_s) {
    return sea.waves == WaveModel::spectrum && sea.loop_period_s < ten_peaks_s;
}

double ten_peak_periods_s(const ModelWaves& asked) { return 10 * (two_pi / asked.peak.omega); }

std::vector<std::string> warnings_from(const SeaState& sea, std::span<const CascadePlan> plan,
                                       const ModelWaves& asked, const ExpectedWaves& waves,
                                       const LoopFrequencies& found) {
    const SpectralPeak& peak = asked.peak;
    const CascadePlan &coarsest = plan.front(), &finest = plan.back();
    const double peak_wavelength_m = waves.peak_wavelength_m;
    // The effect of the patch size on the height is a mean over all seeds: the height of one seed
    // may also exceed the model's.
    const auto height_beside_model = [&]() -> std::string {
        if (!waves.model_significant_wave_height_m || sea.waves != WaveModel::spectrum) return {};
        const std::string of_model = has_given_systems(sea) ? " m, where the model has " : " m, where this wind makes ";
        return ", over all seeds Hs " + short_text(waves.significant_wave_height_m) + of_model +
               short_text(*waves.model_significant_wave_height_m) + " m";
    };
    std::vector<std::string> warnings;
    if (const double kept = asked.kept_after_breaking; kept < 1) {
        const double height = highest_over_depth * sea.depth_m;
        warnings.push_back("waves break in " + number_text(sea.depth_m) + " m of water: Hs is limited to " +
                           short_text(height) + " m (0.6 of the depth) instead of " +
                           short_text(height / std::sqrt(kept)) + " m");
    }
    if (asked.omitted > 0)
        warnings.push_back(number_text(asked.omitted) +
                           " of the sea's waves are too short for the cascades and are omitted; Hs is " +
                           short_text(waves.significant_wave_height_m) + " m instead of " +
                           short_text(*waves.model_significant_wave_height_m) + " m: raise the resolution");
    if (coarsest.grid.side_m < 2 * peak_wavelength_m)
        warnings.push_back("the patch of " + number_text(coarsest.grid.side_m) +
                           " m is shorter than two peak wavelengths (" + short_text(2 * peak_wavelength_m) +
                           " m): it holds few of the largest waves, or none, so each seed is higher or lower" +
                           height_beside_model());
    if (const double shortest = 2 * finest.grid.side_m / finest.resolution; peak_wavelength_m < 2 * shortest)
        warnings.push_back("the grid's shortest wave of " + short_text(shortest) +
                           " m is longer than half the peak wavelength (" + short_text(peak_wavelength_m) +
                           " m): raise the resolution or shrink the patch");
    const double looped = loop_harmonic(peak.omega, sea.loop_period_s) * two_pi / sea.loop_period_s;
    if (std::fabs(looped / peak.omega - 1) > 0.1)
        warnings.push_back("a loop of " + number_text(sea.loop_period_s) + " s changes the peak period by " +
                           number_text(std::round(100 * std::fabs(peak.omega / looped - 1))) +
                           " %, to " + short_text(two_pi / looped) +
                           " s: each wave has a whole number of periods per loop");
    const double ten_peaks_s = ten_peak_periods_s(asked);
    if (is_short_loop(sea, ten_peaks_s) && found.largest_share > 0 && found.for_90_percent < fewest_loop_frequencies)
        warnings.push_back("a loop of " + number_text(sea.loop_period_s) +
                           " s is short for this sea: " + number_text(found.for_90_percent) +
                           " of its frequencies hold 90 % of the energy, so waves rise and fall in step; ten peak "
                           "periods, " +
                           number_text(std::round(ten_peaks_s)) + " s, leave about ten");
    return warnings;
}

SeaReport report_from(const SeaState& sea, std::span<const CascadePlan> plan, const ModelWaves& asked,
                      Contents contents) {
    GridSums sums = sums_over(sea, plan, contents, asked.systems.size());
    SeaReport report;
    report.expected = expected_from(asked, sums);
    report.realised_significant_wave_height_m = 4 * std::sqrt(sums.realised.variance);
    if (contents == Contents::realised)
        report.realised_peak_period_s = peak_period_of(sums.bands, sums.lowest_band_hz);
    std::string deviations;
    if (!asked.systems.empty()) deviations = add_systems(sea, asked, sums, report);
    report.expected_periods = periods_of(sums.expected.variance, sums.expected_hz, sums.expected_hz2);
    report.realised_periods = realised_periods_from(sums, sea.loop_period_s);
    report.expected_convergence_variance = sums.expected_convergence;
    report.realised_convergence_variance = sums.realised_convergence;
    report.expected_level_m = sums.expected_level;
    if (sums.expected.variance > 0) report.velocity_share = sums.expected_of_velocities / sums.expected.variance;
    report.realised_level_m = sums.realised_level;
    report.expected_directions = directions_from(sums.expected);
    report.realised_directions = directions_from(sums.realised);
    if (sea.waves == WaveModel::spectrum && sea.spectrum == SpectrumModel::jonswap && !is_by_height(wind_sea_of(sea)))
        report.effective_fetch_m = effective_fetch_m(sea);
    report.cascades = std::move(sums.cascades);
    report.loop_frequencies = loop_frequencies_from(sums);
    report.warnings = warnings_from(sea, plan, asked, report.expected, report.loop_frequencies);
    if (!deviations.empty()) report.warnings.push_back(deviations);
    return report;
}

}  // namespace

SeaReport report_on(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    const std::vector<CascadePlan> plan = plan_cascades(sea);
    return report_from(sea, plan, model_waves_of(sea, plan, true), Contents::realised);
}

SeaReport expected_report_on(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    const std::vector<CascadePlan> plan = plan_cascades(sea);
    const ModelWaves asked = model_waves_of(sea, plan, true);
    const bool needs_draws = is_short_loop(sea, ten_peak_periods_s(asked));
    return report_from(sea, plan, asked, needs_draws ? Contents::realised : Contents::means);
}

double period_in_loop_s(double period_s, double loop_period_s) {
    const DefaultFloatEnvironment environment(period_s, loop_period_s);
    return environment.result(loop_period_s / loop_harmonic(two_pi / period_s, loop_period_s));
}

double repeat_length_m(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    return environment.result(double{plan_cascades(sea).front().grid.side_m});
}

WaveDirections directions_of_moment(double a, double b) {
    return {direction_rad(a, b), std::sqrt(2 * std::max(0.0, 1 - std::sqrt(a * a + b * b)))};
}

std::vector<double> model_by_frequency(const SeaState& sea, std::span<const double> frequencies_hz) {
    const DefaultFloatEnvironment environment;
    if (sea.waves != WaveModel::spectrum) return std::vector<double>(frequencies_hz.size());
    const WaveSpectrum spectrum(sea, plan_cascades(sea).front());
    std::vector<double> densities;
    for (const double hertz : frequencies_hz) {
        const double k = wave_number(two_pi * hertz, sea.depth_m);
        densities.push_back(two_pi * radial_energy(spectrum, sea, k) / group_velocity(k, sea.depth_m));
    }
    return densities;
}

std::vector<double> model_by_wave_number(const SeaState& sea, std::span<const double> wave_numbers) {
    const DefaultFloatEnvironment environment;
    if (sea.waves != WaveModel::spectrum) return std::vector<double>(wave_numbers.size());
    const WaveSpectrum spectrum(sea, plan_cascades(sea).front());
    std::vector<double> densities;
    for (const double k : wave_numbers) densities.push_back(radial_energy(spectrum, sea, k));
    return densities;
}

ExpectedWaves expected_waves(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    const std::vector<CascadePlan> plan = plan_cascades(sea);
    return expected_from(model_waves_of(sea, plan, false), sums_over(sea, plan, Contents::means, 0));
}

double measured_significant_wave_height_m(const Frame& frame) {
    if (!frame.cascades.front().height.data)
        throw std::invalid_argument("wave heights cannot be measured in a frame without planes");
    const DefaultFloatEnvironment environment;
    double variance = 0;
    for (const Cascade& cascade : frame.cascades) {
        const double count = static_cast<double>(cascade.resolution()) * cascade.resolution();
        double sum = 0, squares = 0;
        for (int j = 0; j < cascade.resolution(); ++j) {
            for (int i = 0; i < cascade.resolution(); ++i) {
                const double h = cascade.height.at(i, j);
                sum += h;
                squares += h * h;
            }
        }
        const double mean = sum / count;
        variance += std::max(0.0, squares / count - mean * mean);
    }
    return environment.result(4 * std::sqrt(variance));
}

double measured_peak_period_s(const SeaState& sea) { return report_on(sea).realised_peak_period_s; }

LoopFrequencies loop_frequencies(const SeaState& sea) { return report_on(sea).loop_frequencies; }

std::vector<std::string> warnings_about(const SeaState& sea) { return report_on(sea).warnings; }

}  // namespace pelagic
