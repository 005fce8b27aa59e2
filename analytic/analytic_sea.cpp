#include "pelagic/analytic/analytic_sea.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "pelagic/analytic/kernels/analytic_kernels.hpp"
#include "pelagic/message/refusal.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr double two_pi = 6.283185307179586;

constexpr std::array wave_fields = {
    NumericField<AnalyticWave>{"amplitude_m", &AnalyticWave::amplitude_m, 0, 100, "[0, 100]"},
    NumericField<AnalyticWave>{"wavelength_m", &AnalyticWave::wavelength_m, 0.01, 1000, "[0.01, 1000]"},
    NumericField<AnalyticWave>{"direction_rad", &AnalyticWave::direction_rad, -two_pi, two_pi, "[-2 pi, 2 pi]"},
    NumericField<AnalyticWave>{"phase_rad", &AnalyticWave::phase_rad, -two_pi, two_pi, "[-2 pi, 2 pi]"},
};

bool is_same_wave(const AnalyticWave& a, const AnalyticWave& b) {
    return a.wavelength_m == b.wavelength_m && a.direction_rad == b.direction_rad && a.phase_rad == b.phase_rad;
}

AnalyticWave scaled(AnalyticWave wave, double by) {
    wave.amplitude_m *= by;
    return wave;
}

void require(const AnalyticSea& sea) {
    if (const std::string reason = check(sea); !reason.empty()) throw std::invalid_argument(reason);
}

// Parts of each wave, k A, in thousandths; from the longest wave to the shortest. Calm is what a swell leaves,
// intense is chop on a storm's waves, a little below the limit.
constexpr std::size_t preset_waves = 16;
constexpr std::array<int, preset_waves> calm_steepness = {4, 6, 7, 7, 6, 4, 3, 2, 2, 1, 1, 1, 1, 1, 1, 1};
constexpr std::array<int, preset_waves> moderate_steepness = {15, 20, 23, 23, 20, 16, 13, 10, 8, 7, 6, 5, 5, 4, 4, 3};
constexpr std::array<int, preset_waves> intense_steepness = {44, 50, 48, 42, 35, 29, 24, 20,
                                                             17, 15, 13, 12, 11, 10, 9,  8};

/// Lengths fall evenly from 120 to 2 m. Directions and phases are spread by the golden ratio, as evenly as any number
/// of waves can be; shorter waves run further from the wind, which blows along +x.
AnalyticSea preset_sea(const std::array<int, preset_waves>& steepness) {
    const DefaultFloatEnvironment environment;
    constexpr double golden = 0.6180339887498949;
    AnalyticSea sea;
    for (std::size_t i = 0; i < preset_waves; ++i) {
        const double n = static_cast<double>(i), part = n / (preset_waves - 1);
        const double wavelength_m = 120 * det::pow(2.0 / 120, part);
        const double spread = 2 * (n * golden - std::floor(n * golden)) - 1, turn = n * golden * golden;
        sea.waves.push_back({.amplitude_m = steepness[i] * 1e-3 * wavelength_m / two_pi,
                             .wavelength_m = wavelength_m,
                             .direction_rad = spread * (0.35 + part),
                             .phase_rad = two_pi * (turn - std::floor(turn))});
    }
    return sea;
}

}  // namespace

double steepness_of(const AnalyticSea& sea) {
    double sum = 0;
    for (const AnalyticWave& wave : sea.waves) sum += two_pi * wave.amplitude_m / wave.wavelength_m;
    return sum;
}

double significant_height_m(const AnalyticSea& sea) {
    double squares = 0;
    for (const AnalyticWave& wave : sea.waves) squares += wave.amplitude_m * wave.amplitude_m;
    return 4 * std::sqrt(squares / 2);
}

AnalyticSea with_significant_height(AnalyticSea sea, double height_m) {
    const DefaultFloatEnvironment environment;
    const double by = height_m / significant_height_m(sea);
    for (AnalyticWave& wave : sea.waves) wave.amplitude_m *= by;
    return sea;
}

std::span<const NumericField<AnalyticWave>> analytic_wave_fields() { return wave_fields; }

std::string check(const AnalyticSea& sea) {
    if (sea.waves.empty() || sea.waves.size() > most_analytic_waves)
        return refusal("waves", sea.waves.size(), "1 to " + number_text(most_analytic_waves) + " of them");
    if (!(sea.choppiness >= 0 && sea.choppiness <= 1)) return refusal("choppiness", sea.choppiness, "[0, 1]");
    for (std::size_t i = 0; i < sea.waves.size(); ++i)
        if (const std::string reason = check_fields(sea.waves[i], wave_fields); !reason.empty())
            return one_line("waves[" + number_text(i) + "]." + reason);
    // What a sea is scaled to may round past the limit by a last digit.
    if (const double steepness = steepness_of(sea); !(steepness <= most_steepness * (1 + 1e-12)))
        return refusal("steepness", rounded_text(steepness, 6),
                       "at most " + number_text(most_steepness) + ", the sum of 2 pi amplitude_m / wavelength_m");
    return {};
}

AnalyticSea morphed(const AnalyticSea& from, const AnalyticSea& to, double u) {
    const DefaultFloatEnvironment environment;
    require(from);
    require(to);
    const double within = std::clamp(u, 0.0, 1.0), s = within * within * (3 - 2 * within);
    AnalyticSea sea;
    sea.choppiness = (1 - s) * from.choppiness + s * to.choppiness;
    for (std::size_t i = 0; i < std::max(from.waves.size(), to.waves.size()); ++i) {
        const bool has_from = i < from.waves.size(), has_to = i < to.waves.size();
        if (has_from && has_to && is_same_wave(from.waves[i], to.waves[i])) {
            sea.waves.push_back(from.waves[i]);
            sea.waves.back().amplitude_m = (1 - s) * from.waves[i].amplitude_m + s * to.waves[i].amplitude_m;
            continue;
        }
        if (has_from) sea.waves.push_back(scaled(from.waves[i], 1 - s));
        if (has_to) sea.waves.push_back(scaled(to.waves[i], s));
    }
    require(sea);
    return sea;
}

std::span<const AnalyticPreset> analytic_presets() {
    static const std::array presets = {
        AnalyticPreset{"analytic-calm", "long low waves", preset_sea(calm_steepness)},
        AnalyticPreset{"analytic-moderate", "waves of many directions", preset_sea(moderate_steepness)},
        AnalyticPreset{"analytic-intense", "a storm's waves under chop", preset_sea(intense_steepness)},
    };
    return presets;
}

const AnalyticPreset* analytic_preset_named(std::string_view name) {
    for (const AnalyticPreset& preset : analytic_presets())
        if (preset.name == name) return &preset;
    return nullptr;
}

}  // namespace pelagic
