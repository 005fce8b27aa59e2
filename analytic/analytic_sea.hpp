// An analytic sea of a few waves: its parameters, presets, and interpolation between two seas.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/message/numeric_field.hpp"

namespace pelagic {

/// A wave in deep water: height = amplitude cos(k.x - w t + phase), w^2 = g k.
/// analytic_wave_fields() has the ranges.
struct AnalyticWave {
    // generated from schema/analytic_wave.toml: members
    /// Amplitude; the sum of 2 pi amplitude_m / wavelength_m over the waves is at most 0.4;
    /// [0, 100].
    double amplitude_m = 0;
    double wavelength_m = 10;  ///< wavelength; [0.01, 1000]
    double direction_rad = 0;  ///< direction of travel, from +x towards +z; [-2 pi, 2 pi]
    double phase_rad = 0;      ///< phase at x = z = t = 0, a crest by default; [-2 pi, 2 pi]
    // end of generated
};

struct AnalyticSea {
    std::vector<AnalyticWave> waves;  ///< 1 to 64
    double choppiness = 1;            ///< 1: circular orbits (Gerstner); 0: a height field; [0, 1]
};

/// Largest sum of k A. No crest overturns below 1. Up to 0.4, each step of the search for a
/// reference point reduces its error by 60 % or more.
inline constexpr double max_steepness = 0.4;

/// Returns the sum of k A over the waves.
double steepness_of(const AnalyticSea& sea);

/// Returns 4 sqrt(variance of the height), m.
double significant_height_m(const AnalyticSea& sea);

/// Returns the sea with its amplitudes scaled to a significant wave height, m. \pre some amplitude
/// is not 0
AnalyticSea with_significant_height(AnalyticSea sea, double height_m);

/// Returns the numeric fields of a wave, with names and ranges.
std::span<const NumericField<AnalyticWave>> analytic_wave_fields();

/// Returns an empty string if the sea is valid, otherwise one line: "steepness is 0.52, expected at
/// most 0.4, the sum of 2 pi amplitude_m / wavelength_m", "waves[3].wavelength_m -1 is out of
/// range [0.01, 1000]".
std::string check(const AnalyticSea& sea);

/// Interpolates between two seas. Amplitudes and choppiness are linear in s = u^2 (3 - 2u), so that
/// their rates are continuous. Each wave keeps its length, direction and phase. Waves that are
/// equal at one index of both lists are merged; the amplitudes of others grow or decay. The
/// steepness is between those of the seas.
/// \param u  0: `from`, 1: `to`; clamped to [0, 1]
/// \throws std::invalid_argument if the result has more than 64 waves, or check() rejects a sea
AnalyticSea morphed(const AnalyticSea& from, const AnalyticSea& to, double u);

/// Parameters of a sea like the presets, with any number of waves. Lengths fall geometrically from
/// the longest to the shortest. Directions spread around the wind's, more for shorter waves. The
/// sum of k A is that of the presets, for any lengths.
struct AnalyticFamily {
    int waves = 16;                          ///< 1 to 64
    double longest_m = 120, shortest_m = 2;  ///< [0.01, 1000]
    /// 0 calm, 1 moderate, 2 intense, interpolated between; [0, 2].
    double strength = 1;
    double direction_rad = 0;  ///< of the wind; [-2 pi, 2 pi]
};
/// Returns the sea of a family.
/// \throws std::invalid_argument if the parameters give a sea that check() rejects
AnalyticSea analytic_sea(const AnalyticFamily& family);

/// A named sea: "analytic-calm", "analytic-moderate" or "analytic-intense". All have sixteen waves
/// of equal lengths, from 120 to 2 m. Each wave's amplitude increases from preset to preset, so Hs
/// of an interpolated sea is between those of the two presets.
struct AnalyticPreset {
    std::string_view name;
    std::string_view summary;
    AnalyticSea sea;
};
/// Returns all presets: analytic-calm, analytic-moderate, analytic-intense.
std::span<const AnalyticPreset> analytic_presets();
/// Returns a preset, or null if there is none of that name.
const AnalyticPreset* analytic_preset_named(std::string_view name);

}  // namespace pelagic
