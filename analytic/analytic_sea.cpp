#include "pelagic/analytic/analytic_sea.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "pelagic/analytic/kernels/analytic_kernels.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr double min_wavelength_m = 0.01;

constexpr NumericField<AnalyticWave> analytic_wave_field_table[] = {
    // generated from schema/analytic_wave.toml: table
    {"amplitude_m", &AnalyticWave::amplitude_m, 0, 100, "[0, 100]"},
    {"wavelength_m", &AnalyticWave::wavelength_m, 0.01, 1000, "[0.01, 1000]"},
    {"direction_rad", &AnalyticWave::direction_rad, -two_pi, two_pi, "[-2 pi, 2 pi]"},
    {"phase_rad", &AnalyticWave::phase_rad, -two_pi, two_pi, "[-2 pi, 2 pi]"},
    // end of generated
};

bool is_same_wave(const AnalyticWave& a, const AnalyticWave& b) {
    return a.wavelength_m == b.wavelength_m && a.direction_rad == b.direction_rad && a.phase_rad == b.phase_rad;
}

AnalyticWave scaled(AnalyticWave wave, double by) {
    wave.amplitude_m *= by;
    return wave;
}

// k A of each wave, in thousandths, from the longest wave to the shortest. Calm is a decayed swell.
// Intense is a storm's waves with chop, just below max_steepness.
constexpr std::size_t preset_waves = 16;
using Steepness = std::array<int, preset_waves>;
constexpr Steepness calm_steepness = {4, 6, 7, 7, 6, 4, 3, 2, 2, 1, 1, 1, 1, 1, 1, 1};
constexpr Steepness moderate_steepness = {15, 20, 23, 23, 20, 16, 13, 10, 8, 7, 6, 5, 5, 4, 4, 3};
constexpr Steepness intense_steepness = {44, 50, 48, 42, 35, 29, 24, 20, 17, 15, 13, 12, 11, 10, 9, 8};

/// Interpolates the table at wave i of `waves`. The caller scales the values to the table's sum.
double steepness_at(const Steepness& steepness, int i, int waves) {
    if (waves == 1) return steepness.front();
    const double at = (preset_waves - 1.0) * i / (waves - 1);
    const auto before = std::min(static_cast<std::size_t>(at), preset_waves - 2);
    const double fraction = at - static_cast<double>(before);
    return (1 - fraction) * steepness[before] + fraction * steepness[before + 1];
}

/// Returns a sea whose lengths fall geometrically. The golden ratio distributes directions and
/// phases evenly for any number of waves. Shorter waves deviate more from the wind.
AnalyticSea family_sea(const AnalyticFamily& family, const Steepness& steepness) {
    constexpr double golden = 0.6180339887498949;
    double table_sum = 0, sum = 0;
    for (const int one : steepness) table_sum += one;
    for (int i = 0; i < family.waves; ++i) sum += steepness_at(steepness, i, family.waves);
    AnalyticSea sea;
    for (int i = 0; i < family.waves; ++i) {
        const double fraction = family.waves == 1 ? 0 : i / (family.waves - 1.0);
        const double wavelength_m =
            std::max(min_wavelength_m, family.longest_m * det::pow(family.shortest_m / family.longest_m, fraction));
        const double spread = 2 * (i * golden - std::floor(i * golden)) - 1, turn = i * golden * golden;
        const double k_a = steepness_at(steepness, i, family.waves) * (table_sum / sum) * 1e-3;
        double direction_rad = family.direction_rad + spread * (0.35 + fraction);
        if (std::fabs(direction_rad) > two_pi) direction_rad -= std::copysign(two_pi, direction_rad);
        sea.waves.push_back({.amplitude_m = k_a * wavelength_m / two_pi,
                             .wavelength_m = wavelength_m,
                             .direction_rad = direction_rad,
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
    const DefaultFloatEnvironment environment(height_m);
    const double by = height_m / significant_height_m(sea);
    for (AnalyticWave& wave : sea.waves) wave.amplitude_m *= by;
    return sea;
}

std::span<const NumericField<AnalyticWave>> analytic_wave_fields() { return analytic_wave_field_table; }

std::string check(const AnalyticSea& sea) {
    if (sea.waves.empty() || sea.waves.size() > max_analytic_waves)
        return invalid_value_message("waves", sea.waves.size(),
                                     "1 to " + number_text(max_analytic_waves) + " of them");
    if (!(sea.choppiness >= 0 && sea.choppiness <= 1))
        return invalid_value_message("choppiness", sea.choppiness, "[0, 1]");
    for (std::size_t i = 0; i < sea.waves.size(); ++i)
        if (const std::string reason = check_fields(sea.waves[i], analytic_wave_field_table); !reason.empty())
            return one_line("waves[" + number_text(i) + "]." + reason);
    // Scaling may exceed the limit by a rounding error.
    if (const double steepness = steepness_of(sea); !(steepness <= max_steepness * (1 + 1e-12)))
        return invalid_value_message(
            "steepness", rounded_text(steepness, 6),
            "at most " + number_text(max_steepness) + ", the sum of 2 pi amplitude_m / wavelength_m");
    return {};
}

AnalyticSea morphed(const AnalyticSea& from, const AnalyticSea& to, double u) {
    const DefaultFloatEnvironment environment(u);
    require(check(from));
    require(check(to));
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
    require(check(sea));
    return sea;
}

AnalyticSea analytic_sea(const AnalyticFamily& family) {
    const DefaultFloatEnvironment environment;
    const bool is_calmer = family.strength <= 1;
    return morphed(family_sea(family, is_calmer ? calm_steepness : moderate_steepness),
                   family_sea(family, is_calmer ? moderate_steepness : intense_steepness),
                   is_calmer ? family.strength : family.strength - 1);
}

std::span<const AnalyticPreset> analytic_presets() {
    static const std::array presets = {
        AnalyticPreset{"analytic-calm", "long low waves", analytic_sea({.strength = 0})},
        AnalyticPreset{"analytic-moderate", "waves of many directions", analytic_sea({.strength = 1})},
        AnalyticPreset{"analytic-intense", "a storm's waves under chop", analytic_sea({.strength = 2})},
    };
    return presets;
}

const AnalyticPreset* analytic_preset_named(std::string_view name) {
    for (const AnalyticPreset& preset : analytic_presets())
        if (preset.name == name) return &preset;
    return nullptr;
}

}  // namespace pelagic
