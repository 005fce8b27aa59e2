#include "pelagic/sim/spectrum/wave_list.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

// Default waves: the waves of the presets, and the octaves of the default pond.
constexpr AnalyticFamily family;
constexpr double family_ratio = family.longest_m / family.shortest_m;
constexpr PondSea pond;
constexpr double pond_ratio = 45;  // pond.growth^(pond.octaves - 1)

/// Shortest wave of an analytic sea, m (analytic_wave_fields()).
constexpr double min_wave_m = 0.01;

/// Side of a pond's cascade, in units of its longest wavelength.
constexpr double pond_waves = 6;

double or_chosen(double value, double chosen) { return value > 0 ? value : chosen; }

bool is_pond(const SeaState& sea) { return sea.waves == WaveModel::pond; }

int count_of(const SeaState& sea) {
    if (sea.wave_count != 0) return sea.wave_count;
    return is_pond(sea) ? pond.octaves : family.waves;
}

/// Converts a direction to turns in [-1/2, 1/2].
double turns_of(double rad) {
    const double turns = rad / two_pi;
    return turns - std::floor(turns + 0.5);
}

/// Texels along a wavelength of a regular wave: by default, and at least.
constexpr int texels_per_regular_wave = 64, min_texels_per_regular_wave = 8;

/// Largest height of a regular wave: 0.142 of its length times tanh(k d) (Miche 1944). At order 2
/// Stokes' second harmonic is at most half of the first, because the expansion fails in shallow water.
double max_regular_height_m(const SeaState& sea, const StokesWave& wave) {
    const double t = det::tanh(wave.k * sea.depth_m), breaking_m = 0.142 * (two_pi / wave.k) * t;
    return sea.order == 1 ? breaking_m : std::min(breaking_m, 4 * (t * t * t) / (3 - t * t) / wave.k);
}

std::string check_regular(const SeaState& sea) {
    const StokesWave wave = stokes_wave_of(sea);
    if (const double max_m = max_regular_height_m(sea, wave); sea.regular_height_m > max_m)
        return invalid_value_message("regular_height_m", sea.regular_height_m,
                                     "at most " + rounded_text(max_m, 4) + " for a wave of " +
                                         rounded_text(two_pi / wave.k, 4) + " m at order " + number_text(sea.order));
    const double periods = sea.loop_period_s / sea.regular_period_s, whole = std::floor(periods + 0.5);
    if (whole < 1 || std::fabs(periods - whole) > 1e-9 * whole)
        return invalid_value_message("loop_period_s", sea.loop_period_s,
                                     "a whole number of regular_period_s, such as " +
                                         number_text(std::max(whole, 1.0) * sea.regular_period_s));
    const int max_waves = resolution_of(sea) / min_texels_per_regular_wave;
    if (regular_waves_per_side(sea) > max_waves)
        return invalid_value_message("patch_size_m", sea.patch_size_m,
                                     "at most " + rounded_text(max_waves * two_pi / wave.k, 6) +
                                         ": 8 texels in each wave");
    return {};
}

/// Returns the sum of k a^2 / 2 over the waves of a cascade, m; waves of one grid index interfere.
double level_of(const std::vector<GridWave>& waves, const CascadePlan& cascade) {
    double level_m = 0;
    for (const GridWave& wave : waves) {
        std::complex<double> all;
        for (const GridWave& other : waves)
            if (other.at == wave.at) all += other.half_amplitude();
        level_m += wave.at.steps() * cascade.spacing() * 2 * (wave.half_amplitude() * std::conj(all)).real();
    }
    return level_m;
}

std::string check_pond(const SeaState& sea) {
    const PondSea asked = pond_sea_of(sea);
    if (asked.growth > 4)
        return invalid_value_message("wave_count", asked.octaves,
                                     "more octaves from longest_wave_m " + number_text(longest_wave_of(sea)) +
                                         " to shortest_wave_m " + rounded_text(shortest_wave_of(sea), 4) +
                                         ": each at least a quarter of the one before");
    if (asked.height_m > 10)
        return invalid_value_message("wave_height_m", sea.wave_height_m,
                                     "at most " + rounded_text(sea.wave_height_m * 10 / asked.height_m, 3) +
                                         " where waves is pond with so many octaves");
    return one_line(check(asked));
}

std::string check_analytic(const SeaState& sea) {
    const PlaneWaves held = waves_of_cascades(sea);
    if (held.waves.empty())
        return invalid_value_message("longest_wave_m", longest_wave_of(sea),
                                     "longer waves: the cascades' texels hold none of these");
    if (const double steepness = steepness_of(held); steepness > max_steepness)
        return invalid_value_message(
            "steepness", rounded_text(steepness, 4),
            "at most " + number_text(max_steepness) +
                ", the sum of k A of the waves on their cascades: ask for less wave_height_m or wave_strength");
    return one_line(check(held));
}

}  // namespace

GridIndex nearest_place(const CascadeGrid& grid, double turns_per_m_x, double turns_per_m_z) {
    const auto [along, across] = grid.in_cascade(turns_per_m_x, turns_per_m_z);
    const auto nearest = [&](double turns_per_m) {
        return static_cast<int>(std::floor(turns_per_m * grid.side_m + 0.5));
    };
    return {nearest(along), nearest(across)};
}

CascadeGrid::Vector turns_per_m_of(const CascadeGrid& grid, const GridIndex& at) {
    return grid.in_world(at.m / grid.side_m, at.n / grid.side_m);
}

double GridIndex::steps() const { return std::sqrt(static_cast<double>(m) * m + static_cast<double>(n) * n); }

std::complex<double> GridWave::half_amplitude() const {
    const auto [sine, cosine] = det::sine_cosine_of_turns(phase_turns);
    return {0.5 * amplitude_m * cosine, 0.5 * amplitude_m * sine};
}

double GridOctave::height_variance() const {
    return pond_variance * (octave.height_m * octave.height_m) * (shown * shown);
}

double GridOctave::slope_variance() const {
    const double steepness = two_pi * octave.turns_per_m() * octave.height_m;
    return pond_slope_variance * (steepness * steepness);
}

double longest_wave_of(const SeaState& sea) {
    return or_chosen(sea.longest_wave_m, is_pond(sea) ? pond.wavelength_m : family.longest_m);
}

double shortest_wave_of(const SeaState& sea) {
    if (is_pond(sea)) return or_chosen(sea.shortest_wave_m, longest_wave_of(sea) / pond_ratio);
    return or_chosen(sea.shortest_wave_m, std::max(min_wave_m, longest_wave_of(sea) / family_ratio));
}

double pond_side_m(const SeaState& sea) { return pond_waves * longest_wave_of(sea); }

AnalyticSea analytic_sea_of(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    AnalyticSea asked = analytic_sea({.waves = count_of(sea),
                                      .longest_m = longest_wave_of(sea),
                                      .shortest_m = shortest_wave_of(sea),
                                      .strength = sea.wave_strength,
                                      .direction_rad = sea.wind_direction_rad});
    asked.choppiness = sea.choppiness;
    return sea.wave_height_m > 0 ? with_significant_height(std::move(asked), sea.wave_height_m) : asked;
}

StokesWave stokes_wave_of(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    StokesWave wave{.k = 0,
                    .omega = two_pi / sea.regular_period_s,
                    .amplitude_m = 0.5 * sea.regular_height_m,
                    .harmonic_m = 0};
    wave.k = wave_number(wave.omega, sea.depth_m);
    if (sea.order == 1) return wave;
    const double t = det::tanh(wave.k * sea.depth_m), square = wave.k * wave.amplitude_m * wave.amplitude_m;
    const double of_displacement = 0.5 * sea.choppiness * orbit_ratio(wave.k, sea.depth_m);
    const double lacking_m = square * ((3 - t * t) / (4 * (t * t * t)) - of_displacement);
    const double bend = sea.choppiness * orbit_ratio(2 * wave.k, sea.depth_m) * wave.k;
    wave.harmonic_m = 2 * lacking_m / (1 + std::sqrt(1 + 4 * bend * lacking_m));
    return wave;
}

int regular_waves_per_side(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    if (!(sea.patch_size_m > 0)) return std::max(1, resolution_of(sea) / texels_per_regular_wave);
    const double waves = std::floor(sea.patch_size_m * stokes_wave_of(sea).k / two_pi + 0.5);
    return static_cast<int>(std::clamp(waves, 1.0, 1e6));
}

std::vector<GridWave> grid_waves(const SeaState& sea, const CascadePlan& cascade) {
    const DefaultFloatEnvironment environment;
    if (sea.waves == WaveModel::regular) {
        const StokesWave wave = stokes_wave_of(sea);
        const int m = regular_waves_per_side(sea);
        return {{{m, 0}, wave.amplitude_m, 0}, {{2 * m, 0}, wave.harmonic_m, 0}};
    }
    const int nyquist = cascade.resolution / 2;
    std::vector<GridWave> waves;
    for (const PlaneWave& wave : plane_waves_of(analytic_sea_of(sea)).waves) {
        const double k = two_pi * wave.turns_per_m();
        if (k < cascade.min_k || k >= cascade.max_k) continue;
        const GridIndex at = nearest_place(cascade.grid, wave.turns_per_m_x, wave.turns_per_m_z);
        if (std::max(std::abs(at.m), std::abs(at.n)) >= nyquist) continue;
        waves.push_back({at, wave.amplitude_m, wave.phase_turns});
    }
    return waves;
}

PlaneWaves waves_of_cascades(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    PlaneWaves held{.waves = {}, .choppiness = sea.choppiness};
    for (const CascadePlan& cascade : plan_cascades(sea)) {
        const std::vector<GridWave> waves = grid_waves(sea, cascade);
        held.level_m += sea.choppiness * level_of(waves, cascade);
        for (const GridWave& wave : waves) {
            const auto [x, z] = turns_per_m_of(cascade.grid, wave.at);
            const double omega = angular_frequency(wave.at.steps() * cascade.spacing(), deep_water);
            held.waves.push_back({.amplitude_m = wave.amplitude_m,
                                  .turns_per_m_x = x,
                                  .turns_per_m_z = z,
                                  .frequency_hz = loop_harmonic(omega, sea.loop_period_s) / sea.loop_period_s,
                                  .phase_turns = wave.phase_turns});
        }
    }
    return held;
}

PondSea pond_sea_of(const SeaState& sea) {
    const DefaultFloatEnvironment environment;
    const double longest_m = longest_wave_of(sea), ratio = longest_m / shortest_wave_of(sea);
    PondSea asked{.octaves = count_of(sea),
                  .height_m = pond.height_m / pond.wavelength_m * longest_m,
                  .wavelength_m = longest_m,
                  .direction_rad = two_pi * turns_of(sea.wind_direction_rad),
                  .growth = 1,
                  .drag = sea.wave_drag};
    if (asked.octaves > 1) asked.growth = det::pow(ratio, 1.0 / (asked.octaves - 1));
    if (sea.wave_height_m > 0) {
        double squares = 0;
        for (const PondOctave& octave : octaves_of(asked)) squares += octave.height_m * octave.height_m;
        asked.height_m *= sea.wave_height_m / (4 * std::sqrt(pond_variance * squares));
    }
    return asked;
}

std::vector<GridOctave> grid_octaves(const SeaState& sea, const CascadePlan& cascade) {
    const DefaultFloatEnvironment environment;
    const double texel_m = cascade.grid.side_m / cascade.resolution;
    std::vector<GridOctave> octaves;
    for (const PondOctave& asked : octaves_of(pond_sea_of(sea))) {
        const GridIndex at = nearest_place(cascade.grid, asked.turns_per_m_x, asked.turns_per_m_z);
        GridOctave moved{.at = at, .harmonic = 0, .octave = asked, .shown = 0};
        const auto [x, z] = turns_per_m_of(cascade.grid, at);
        moved.octave.turns_per_m_x = x;
        moved.octave.turns_per_m_z = z;
        const double per_m = moved.octave.turns_per_m();
        moved.harmonic = loop_harmonic(two_pi * ripple_frequency_hz(per_m), sea.loop_period_s);
        moved.octave.frequency_hz = moved.harmonic / sea.loop_period_s;
        moved.shown = footprint_weight(1 / per_m, texel_m);
        octaves.push_back(moved);
    }
    return octaves;
}

std::vector<PondOctave> octaves_of_cascade(const SeaState& sea) {
    std::vector<PondOctave> octaves;
    for (const GridOctave& moved : grid_octaves(sea, plan_cascades(sea).front())) octaves.push_back(moved.octave);
    return octaves;
}

SlopeVariance hidden_slopes(const SeaState& sea, std::span<const GridOctave> octaves) {
    const auto [sine, cosine] = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
    SlopeVariance hidden;
    for (const GridOctave& moved : octaves) {
        const PondOctave& octave = moved.octave;
        const double hidden_variance = (1 - moved.shown * moved.shown) * moved.slope_variance();
        const double along = (octave.turns_per_m_x * cosine + octave.turns_per_m_z * sine) / octave.turns_per_m();
        hidden.upwind += hidden_variance * (along * along);
        hidden.crosswind += hidden_variance * (1 - along * along);
    }
    return hidden;
}

std::string check_wave_list(const SeaState& sea) {
    const std::string waves = " where waves is " + std::string(name_of(sea.waves));
    if (sea.swell_height_m != 0) return invalid_value_message("swell_height_m", sea.swell_height_m, "0" + waves);
    if (sea.peak_period_s != 0) return invalid_value_message("peak_period_s", sea.peak_period_s, "0" + waves);
    if (!sea.systems.empty()) return invalid_value_message("the number of systems", sea.systems.size(), "0" + waves);
    if (sea.waves == WaveModel::regular) return check_regular(sea);
    const double longest_m = longest_wave_of(sea);
    if (sea.shortest_wave_m > longest_m)
        return invalid_value_message("shortest_wave_m", sea.shortest_wave_m,
                                     "at most longest_wave_m, " + number_text(longest_m));
    if (sea.patch_size_m > 0 && sea.patch_size_m < longest_m)
        return invalid_value_message("patch_size_m", sea.patch_size_m,
                                     "at least longest_wave_m, " + number_text(longest_m) + "," + waves);
    return is_pond(sea) ? check_pond(sea) : check_analytic(sea);
}

}  // namespace pelagic
