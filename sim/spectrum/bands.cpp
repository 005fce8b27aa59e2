#include <algorithm>
#include <cmath>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/mean_square_slope.hpp"
#include "pelagic/sim/spectrum/spectral_peak.hpp"
#include "pelagic/sim/spectrum/wave_list.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

/// Side of the paper's single cascade, m. The scale of phillips-paper depends on it.
constexpr double papers_side_m = 250;

/// Side of the coarsest cascade, in peak wavelengths: large enough that the repetition is not
/// noticeable.
constexpr double peak_waves = 16;
/// Smallest side that holds a system as it is given, in its peak wavelengths.
constexpr double least_peak_waves = 4;
constexpr double min_side_m = 1, max_side_m = 1e5;

/// Wave number that a given system is held to, in that of its peak: the variance of omega beyond it is
/// 1.26 / 160 of a fully developed sea's, so that Tm02 is within 0.4 %.
constexpr double tail_of_peak = 160;

/// Smallest number of texels per wavelength, and distance of a cascade's longest waves from k = 0
/// in grid steps. The distance ensures enough directions.
constexpr double band_texels_per_wave = 3;
constexpr double steps_per_band = 6;

/// Smallest ratio of the sides of consecutive cascades.
constexpr double min_ratio = 1.5;

/// Shorter waves are not visible, m.
constexpr double shortest_wave_m = 0.02;

/// Largest fraction of Cox and Munk's mean square slope that cascades resolve. In light winds the
/// spectra exceed it, because their tails do not model capillary waves.
constexpr double max_of_slopes = 0.9;

/// Rotation between consecutive grids in turns: the golden ratio times a quarter turn, so that no
/// two grids are aligned.
constexpr double rotation_per_cascade = 0.25 * 0.6180339887498949;

/// Rounds a side to two significant digits. \param up  round up
double short_number(double value, bool up) {
    double unit = 1;
    while (value / unit < 10) unit /= 10;
    while (value / unit >= 100) unit *= 10;
    const double digits = up ? std::ceil(value / unit) : std::floor(value / unit + 0.5);
    return unit < 1 ? digits / std::floor(1 / unit + 0.5) : digits * unit;
}

/// Returns the wave number at which the model's mean square slope reaches max_of_slopes, rad/m. If
/// it never does, returns the wave number of the shortest wave.
double end_of_slopes(const WaveSpectrum& spectrum, const SeaState& sea) {
    const double max = max_of_slopes * measured_slopes(sea.wind_speed_mps).total();
    constexpr double ratio = 1.02;
    const double step = det::log(ratio), last = two_pi / shortest_wave_m;
    double sum = 0;
    for (double k = 1e-5; k < last; k *= ratio) {
        sum += spectrum.radial_density(k) * k * k * k * step;
        if (sum > max) return k;
    }
    return last;
}

bool is_stack(const SeaState& sea) { return !is_limited_to_one_cascade(sea); }

/// Margin that keeps an analytic sea's shortest wave resolved. Sides are rounded up, each by a
/// tenth at most.
constexpr double margin_of_shortest = 4.0 / 3;

WaveSpectrum spectrum_of_stack(const SeaState& sea) {
    return {sea, {.grid = {.side_m = papers_side_m}, .resolution = resolution_of(sea), .has_surface_tension = true}};
}

std::vector<CascadePlan> with_few_waves(std::vector<CascadePlan> cascades) {
    for (std::size_t i = 0; i + 1 < cascades.size(); ++i) {
        const double edge = std::min(cascades[i].max_k, steps_of_few_waves * cascades[i + 1].spacing());
        cascades[i].max_k = cascades[i + 1].min_k = edge;
    }
    return cascades;
}

/// Returns the longest peak and the tail of a sea's systems; zeros if none is given.
WaveReach reach_of_systems(const WaveSpectrum& spectrum, const SeaState& sea) {
    WaveReach reach;
    if (!has_given_systems(sea)) return reach;
    for (const SystemSpectrum& system : spectrum.systems()) {
        const double k = wave_number(system.peak_radps(), sea.depth_m);
        reach.extend_to({two_pi / k, 0, tail_of_peak * k});
    }
    reach.end_k = std::min(reach.tail_k, two_pi / shortest_wave_m);
    return reach;
}

/// Returns the largest wave number of a sea, rad/m.
double end_of_waves(const SeaState& sea) {
    if (sea.waves == WaveModel::analytic) return margin_of_shortest * two_pi / shortest_wave_of(sea);
    const WaveSpectrum spectrum = spectrum_of_stack(sea);
    return std::max(end_of_slopes(spectrum, sea), reach_of_systems(spectrum, sea).end_k);
}

std::vector<CascadePlan> plan_stack(const SeaState& sea, const WaveReach& reach, double end_k) {
    const int count = cascades_of(sea), n = resolution_of(sea);
    double coarsest_m = std::clamp(short_number(std::clamp(peak_waves * reach.peak_m, min_side_m, max_side_m), false),
                                   min_side_m, max_side_m);

    const double widest = n / (band_texels_per_wave * steps_per_band);
    double held_k = two_pi * n / (band_texels_per_wave * coarsest_m);
    for (int number = 1; number < count; ++number) held_k *= widest;
    if (reach.tail_k > held_k)
        coarsest_m =
            std::min(coarsest_m, short_number(std::max(coarsest_m * held_k / reach.tail_k,
                                                       std::max(min_side_m, least_peak_waves * reach.peak_m)),
                                              true));
    double ratio = widest;
    if (count > 1) {
        const double finest_m = two_pi / reach.end_k * n / band_texels_per_wave;
        const double wanted = det::pow(std::max(1.0, coarsest_m / finest_m), 1.0 / (count - 1));
        ratio = std::clamp(wanted, min_ratio, widest);
    }

    std::vector<CascadePlan> cascades;
    double side_m = coarsest_m, min_k = 0;
    for (int number = 0; number < count; ++number) {
        const det::SineCosine turn = det::sine_cosine_of_turns(rotation_per_cascade * number);
        const double max_k = two_pi * n / (band_texels_per_wave * side_m);
        cascades.push_back({.grid = {.side_m = side_m, .cosine = turn.cosine, .sine = turn.sine},
                            .resolution = n,
                            .number = number,
                            .min_k = min_k,
                            .max_k = number + 1 == count ? std::min(max_k, end_k) : max_k,
                            .has_surface_tension = true});
        min_k = max_k;
        side_m = short_number(side_m / ratio, true);
    }
    return cascades;
}

}  // namespace

WaveReach WaveReach::of(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    if (!is_stack(sea)) return {};
    if (sea.waves == WaveModel::analytic)
        return environment.result(WaveReach{longest_wave_of(sea), end_of_waves(sea)});
    const WaveSpectrum spectrum = spectrum_of_stack(sea);
    WaveReach reach{two_pi / peak_of(spectrum, sea).k, end_of_slopes(spectrum, sea)};
    reach.extend_to(reach_of_systems(spectrum, sea));
    return environment.result(WaveReach{reach});
}

WaveReach& WaveReach::extend_to(const WaveReach& other) {
    peak_m = std::max(peak_m, other.peak_m);
    end_k = std::max(end_k, other.end_k);
    tail_k = std::max(tail_k, other.tail_k);
    return *this;
}

double CascadePlan::foam_weight() const {
    const DefaultFloatEnvironment environment;
    constexpr double full_weight_m = 5.7;
    if (min_k >= two_pi || number >= max_foam_cascades) return 0;
    const double longest_m = min_k > 0 ? two_pi / min_k : grid.side_m;
    const double shortest_m = band_texels_per_wave * grid.side_m / resolution;
    return environment.result(std::min(1.0, std::sqrt(std::sqrt(longest_m * shortest_m) / full_weight_m)));
}

std::vector<CascadePlan> plan_cascades(const SeaState& sea, const WaveReach& reach) {
    return plan_cascades(sea, reach, {.peak_m = 0, .end_k = is_stack(sea) ? end_of_waves(sea) : 0});
}

std::vector<CascadePlan> plan_cascades(const SeaState& sea, const WaveReach& reach, const WaveReach& own) {
    const DefaultFloatEnvironment environment;
    if (is_stack(sea) && sea.waves == WaveModel::analytic) return with_few_waves(plan_stack(sea, reach, own.end_k));
    if (is_stack(sea)) return plan_stack(sea, reach, own.end_k);
    if (sea.waves == WaveModel::regular) {
        const auto along = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
        return {{.grid = {.side_m = regular_waves_per_side(sea) * two_pi / stokes_wave_of(sea).k,
                          .cosine = along.cosine,
                          .sine = along.sine},
                 .resolution = resolution_of(sea)}};
    }
    const double chosen_m = sea.waves == WaveModel::pond ? pond_side_m(sea) : papers_side_m;
    return {
        {.grid = {.side_m = sea.patch_size_m > 0 ? sea.patch_size_m : chosen_m}, .resolution = resolution_of(sea)}};
}

std::vector<CascadePlan> plan_cascades(const SeaState& sea) {
    const WaveReach own = WaveReach::of(sea);
    return plan_cascades(sea, own, own);
}

}  // namespace pelagic
