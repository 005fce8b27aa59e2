// The sea that is wanted: wind, grid and look, as plain options with units, defaults and ranges.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "pelagic/message/numeric_field.hpp"

namespace pelagic {

/// Which waves there are: those of a wind's spectrum; up to 64 waves of an analytic sea (analytic/analytic_sea.hpp); a pond's octaves
/// of exp(sin - 1) (analytic/pond_waves.hpp).
enum class WaveModel { spectrum, analytic, pond };

/// "spectrum", "analytic" or "pond".
std::string_view name_of(WaveModel);
std::optional<WaveModel> wave_model_named(std::string_view name);
std::span<const WaveModel> wave_models();

enum class SpectrumModel { phillips_paper, phillips, pierson_moskowitz, jonswap };

/// "phillips-paper", "phillips", "pierson-moskowitz" or "jonswap".
std::string_view name_of(SpectrumModel);
std::optional<SpectrumModel> spectrum_model_named(std::string_view name);
std::span<const SpectrumModel> spectrum_models();

/// How waves spread around the wind. The measured ones depend on frequency and on the wind's speed over the peak's.
enum class SpreadingModel { paper, cosine_2s, hasselmann, donelan_banner };

/// "paper", "cosine-2s", "hasselmann" or "donelan-banner".
std::string_view name_of(SpreadingModel);
std::optional<SpreadingModel> spreading_model_named(std::string_view name);
std::span<const SpreadingModel> spreading_models();

/// A stack of so many cascades holds the waves of a sea down to a hand's width.
inline constexpr int default_cascades = 4;

/// SI units, and each name says its unit. Ranges stand in sea_state_fields() and are checked by check().
struct SeaState {
    /// Spectrum, spreading, fetch, depth, short_wave_cutoff, wind_alignment, swell and seed are the spectrum's; the wave_ options are the
    /// others'. All have the wind, whose way is that of their waves. Whitecaps are the spectrum's alone.
    WaveModel waves = WaveModel::spectrum;
    SpectrumModel spectrum = SpectrumModel::jonswap;
    SpreadingModel spreading = SpreadingModel::paper;  ///< phillips-paper takes no other

    /// How many cascades hold its waves, each a band of them (cascade_plan.hpp); 1 to 4. 0: default_cascades, or one where the side is
    /// given or the model knows no other.
    int cascades = 0;
    /// N, texels along a side of each cascade; a power of two, 16 to 2048. 0: 128, or 256 where the side is given.
    int resolution = 0;
    /// L, the side of the one cascade, after which the sea repeats; [0.001, 1e6]. 0: sides chosen from the sea.
    double patch_size_m = 0;
    double wind_speed_mps = 12;     ///< U10, mean wind 10 m above the sea; (0, 60]
    double wind_direction_rad = 0;  ///< where the wind blows towards, from +x towards +z; [-2 pi, 2 pi]
    double fetch_m = 100e3;   ///< of the wind over water (jonswap); (0, 2e6]. More than 17,000 U10^2 / g adds nothing
    double depth_m = 4000;    ///< of the water: waves that feel it are slower and lower; [0.01, 11000]
    double choppiness = 0.8;  ///< lambda, 0 gives a height field; [0, 1]
    double roughness =
        -1;  ///< of the water between texels, for the smoothness channel; [0, 1], or -1: what the cascades
             ///< do not resolve of the slopes of a sea in this wind (SeaStatistics)
    double short_wave_cutoff = 0;  ///< 0 keeps small waves, 1 removes those below a quarter of the peak's; [0, 1]
    double wind_alignment = 0.5;  ///< alpha of equations 6 to 9, spreading `paper`: with 0 a third of the energy runs
                                  ///< against the wind and little across, with 1 a hundredth; [0, 1]
    double swell_height_m = 0;    ///< Hs of waves from elsewhere, beside those of the wind; 0: none; [0, 30]
    double swell_period_s = 12;   ///< at which the swell's spectrum peaks; [1, 40]
    double swell_direction_rad = 0;  ///< where the swell runs towards, as wind_direction_rad; [-2 pi, 2 pi]
    /// Standard deviation of the swell's directions; 1 to 80 degrees, 15 by default.
    double swell_spread_rad = 0.26179938779914943;
    double loop_period_s = 200;  ///< T, the sea repeats exactly after this time; [0.1, 86400]
    std::uint32_t seed = 1;      ///< which sea of this kind; any 32-bit number
    int wave_count = 0;          ///< waves of an analytic sea, octaves of a pond; 1 to 64. 0: 16 or 24
    double longest_wave_m = 0;   ///< [0.02, 1000]. 0: 120, of a pond 1.2
    double shortest_wave_m =
        0;                     ///< at most the longest; [0.01, 1000]. 0: a sixtieth of the longest, of a pond a 45th
    double wave_strength = 1;  ///< of an analytic sea: 0 calm, 1 moderate, 2 intense, morphed in between; [0, 2]
    double wave_height_m = 0;  ///< Hs; (0, 30]. 0: what the strength makes, of a pond 0.017 of its longest wave
    double wave_drag = 0.38;   ///< how far a pond's long waves move its short ones; 0: not at all; [0, 1]
};

/// What is chosen where a sea says 0. \pre check(sea) is empty
int cascades_of(const SeaState& sea);
int resolution_of(const SeaState& sea);
/// The side was given, or the waves know no other than one cascade. \pre the same
bool is_cascade_for_good(const SeaState& sea);
/// Its spectrum is phillips-paper, and is what makes its waves.
bool has_papers_spectrum(const SeaState& sea);

/// `name` is the key of files, too.
using SeaStateField = NumericField<SeaState>;

/// Every numeric option, in the order of the struct.
std::span<const SeaStateField> sea_state_fields();

/// Empty if usable, else the first bad field: "wind_speed_mps is -3, needs (0, 60]". phillips-paper has no physical height
/// to go with a swell, and knows no other spreading than its own. Only a spectrum has a swell. A given side is no shorter than
/// the longest wave of the others, and an analytic sea, as its cascades hold it, no steeper than 0.4 (max_steepness).
std::string check(const SeaState&);

/// Named seas for people who think in sea states, mildest first, and then the open sea of each force of wind, beaufort-0 to
/// beaufort-12. They are the files of presets/, installed as share/pelagic/presets for copying.
struct SeaPreset {
    std::string_view name;
    std::string_view summary;
    SeaState sea;
};
std::span<const SeaPreset> sea_presets();
/// Null if there is none of that name.
const SeaPreset* sea_preset_named(std::string_view name);

}  // namespace pelagic
