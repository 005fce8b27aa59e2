// A sea of a few waves in closed form: the waves themselves, seas by name, and the way from one to another.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/message/numeric_field.hpp"

namespace pelagic {

/// height = amplitude cos(k.x - w t + phase), w^2 = g k: deep water. Ranges stand in analytic_wave_fields().
struct AnalyticWave {
    double amplitude_m = 0;    ///< [0, 100]
    double wavelength_m = 10;  ///< [0.01, 1000]
    double direction_rad = 0;  ///< where it runs towards, from +x towards +z; [-2 pi, 2 pi]
    double phase_rad = 0;      ///< at x = z = t = 0, a crest by default; [-2 pi, 2 pi]
};

struct AnalyticSea {
    std::vector<AnalyticWave> waves;  ///< 1 to 64
    double choppiness = 1;            ///< 1: water goes round in circles, as Gerstner's; 0: a height field; [0, 1]
};

/// The largest sum of k A. No crest folds below 1; up to here each step of a search takes off three fifths of its
/// error.
inline constexpr double max_steepness = 0.4;

/// Sum of k A over the waves.
double steepness_of(const AnalyticSea& sea);

/// 4 sqrt(variance of the height), m.
double significant_height_m(const AnalyticSea& sea);

/// The same sea with all amplitudes scaled so that its significant wave height is as asked. \pre it has waves that
/// are not flat
AnalyticSea with_significant_height(AnalyticSea sea, double height_m);

std::span<const NumericField<AnalyticWave>> analytic_wave_fields();

/// Empty if usable, else one line: "steepness is 0.52, needs at most 0.4, the sum of 2 pi amplitude_m /
/// wavelength_m", "waves[3].wavelength_m is -1, needs [0.01, 1000]".
std::string check(const AnalyticSea& sea);

/// The sea on the way from one (u = 0) to another (u = 1; outside it stays there). Amplitudes and choppiness go
/// linearly with s = u^2 (3 - 2u), so that nothing snaps; a wave keeps its length, direction and phase, so that
/// nothing jumps, spins or slides. Waves that both have at the same place of their lists are one; others come and go.
/// The steepness is between the two seas'.
/// Throws std::invalid_argument if more than 64 waves meet, or a sea is refused by check().
AnalyticSea morphed(const AnalyticSea& from, const AnalyticSea& to, double u);

/// Seas of any number of waves in the presets' manner: lengths fall evenly from the longest to the shortest, directions lie
/// around the wind's, further from it the shorter the wave, and the sum of k A is the presets', whatever the lengths.
struct AnalyticFamily {
    int waves = 16;                          ///< 1 to 64
    double longest_m = 120, shortest_m = 2;  ///< [0.01, 1000]
    double strength = 1;                     ///< 0 calm, 1 moderate, 2 intense, morphed in between; [0, 2]
    double direction_rad = 0;                ///< of the wind; [-2 pi, 2 pi]
};
/// Throws std::invalid_argument as morphed().
AnalyticSea analytic_sea(const AnalyticFamily& family);

/// "analytic-calm", "analytic-moderate", "analytic-intense". All have the same sixteen waves from 120 to 2 m, each of
/// them higher in the later, so that any two morph with Hs between theirs.
struct AnalyticPreset {
    std::string_view name;
    std::string_view summary;
    AnalyticSea sea;
};
std::span<const AnalyticPreset> analytic_presets();
/// Null if there is none of that name.
const AnalyticPreset* analytic_preset_named(std::string_view name);

}  // namespace pelagic
