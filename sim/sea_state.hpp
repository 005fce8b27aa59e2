// Sea state: wind, cascades and choppiness as options with units, defaults and ranges.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "pelagic/message/enum_names.hpp"
#include "pelagic/message/numeric_field.hpp"
#include "pelagic/sim/fixed_list.hpp"

namespace pelagic {

// generated from schema/sea.toml: enumerations
/// Wave model: the spectrum of a wind; up to 64 analytic waves (analytic/analytic_sea.hpp);
/// procedural pond waves, octaves of exp(sin - 1) (analytic/pond_waves.hpp); or one regular
/// wave, exact in length and period.
enum class WaveModel { spectrum, analytic, pond, regular };
template <>
struct EnumNames<WaveModel> {
    static constexpr std::array<std::string_view, 4> all = {"spectrum", "analytic", "pond", "regular"};
};

enum class SpectrumModel {
    /// Scaled as in VR Ocean, without a swell.
    phillips_paper,
    /// Phillips' shape with a physical height.
    phillips,
    /// A fully developed sea; no fetch.
    pierson_moskowitz,
    /// A sea that grows with the fetch.
    jonswap,
    /// No wind sea: only the swell and systems; the wind still sets roughness, drift, and foam on
    /// waves that it can raise.
    none,
};
template <>
struct EnumNames<SpectrumModel> {
    static constexpr std::array<std::string_view, 5> all = {
        "phillips-paper", "phillips", "pierson-moskowitz", "jonswap", "none"};
};

/// Directional spreading around the wind. The measured models, hasselmann and donelan-banner,
/// depend on frequency and on the ratio of the wind speed to the peak's phase speed.
enum class SpreadingModel {
    /// VR Ocean, by wind_alignment.
    paper,
    /// Measured, Longuet-Higgins et al. 1963.
    cosine_2s,
    /// Measured, Hasselmann et al. 1980.
    hasselmann,
    /// Measured, Donelan et al. 1985 and Banner 1990.
    donelan_banner,
};
template <>
struct EnumNames<SpreadingModel> {
    static constexpr std::array<std::string_view, 4> all = {"paper", "cosine-2s", "hasselmann", "donelan-banner"};
};
// end of generated

/// Number of cascades that holds the waves of a sea down to a length of about 0.1 m.
inline constexpr int default_cascades = 4;

/// Waves of one origin, besides the wind sea and the swell: by a wind, as the wind sea is, or by
/// height and period. Breaking and short_wave_cutoff of the sea affect it, too.
/// wave_system_fields() lists the ranges.
struct WaveSystem {
    // generated from schema/wave_system.toml: members
    /// Spectrum: jonswap, pierson-moskowitz or phillips. By height, pierson-moskowitz is jonswap
    /// with gamma 1.
    SpectrumModel spectrum = SpectrumModel::jonswap;
    /// Directional spreading, where spread_rad is 0. Hasselmann's and cosine-2s depend on the wind;
    /// by height and period it is the wind that raises such waves in JONSWAP's growth.
    SpreadingModel spreading = SpreadingModel::donelan_banner;
    double wind_speed_mps = 12;  ///< U10 of the wind of the system; (0, 60]
    double fetch_m = 100e3;      ///< distance that it has blown over water (jonswap); (0, 2e6]
    /// Significant wave height, Hm0; (0, 30]. 0: by the wind and peak_period_s. With peak_period_s,
    /// the system has both at any depth. Of one alone, the other follows as of the wind sea.
    double height_m = 0;
    /// Peak period; [1, 40]. 0: by the wind and height_m.
    double peak_period_s = 0;
    /// Gamma, by which the spectrum is higher at its peak than a fully developed one (jonswap);
    /// [1, 10].
    double peak_enhancement = 3.3;
    /// Direction that the waves run towards, from +x towards +z; [-2 pi, 2 pi].
    double direction_rad = 0;
    /// Standard deviation of the directions; [pi/180, 4 pi/9]. 0: by spreading.
    double spread_rad = 0;
    // end of generated

    bool operator==(const WaveSystem&) const = default;
};

/// Options in SI units, which the names include. sea_state_fields() lists the ranges, and check()
/// checks them.
struct SeaState {
    // generated from schema/sea.toml: members
    /// Wave model. Only a spectrum uses spectrum, spreading, fetch_m, peak_period_s, lean,
    /// short_wave_cutoff, wind_alignment, the swell, systems and seed, and only a spectrum and a
    /// regular wave depth_m. Only the other models use wave_count and the options after it but
    /// wave_height_m and systems. All models use the wind, whose direction is that of their waves.
    WaveModel waves = WaveModel::spectrum;
    SpectrumModel spectrum = SpectrumModel::jonswap;  ///< wave spectrum
    /// Directional spreading. The spectrum phillips-paper always has paper, and refuses cosine-2s
    /// and hasselmann.
    SpreadingModel spreading = SpreadingModel::donelan_banner;
    /// Number of cascades, each a band of wavelengths; 1, 2, 3 or 4. 0: four, or one if
    /// patch_size_m is set, the resolution is 16 or the model has only one. More than one excludes
    /// patch_size_m.
    int cascades = 0;
    /// N, texels along a side of each cascade; a power of two from 16 to 2048. 0: 128, or 256 if
    /// patch_size_m is set.
    int resolution = 0;
    /// L, the side of the only cascade, after which the sea repeats; [0.001, 1e6]. 0: sides derived
    /// from the sea.
    double patch_size_m = 0;
    double wind_speed_mps = 12;  ///< U10, mean wind speed 10 m above the sea; (0, 60]
    /// Direction that the wind blows towards, from +x towards +z; [-2 pi, 2 pi].
    double wind_direction_rad = 0;
    /// Distance that the wind has blown over water (jonswap), of which at most 17,000 U10^2 / g has
    /// an effect; (0, 2e6]. Excludes wave_height_m and peak_period_s.
    double fetch_m = 100e3;
    /// Peak period of the wind sea (jonswap, pierson-moskowitz); [1, 40]. 0: by wave_height_m and
    /// the wind. With wave_height_m, the wind sea has that height and period at any depth. Of one
    /// alone, the other follows from JONSWAP's growth in this wind with the fetch eliminated; of
    /// pierson-moskowitz, from its peak.
    double peak_period_s = 0;
    /// Gamma, by which the spectrum is higher at its peak than a fully developed one (jonswap);
    /// [1, 10].
    double peak_enhancement = 3.3;
    /// Depth of the water, which slows and lowers long waves; [0.01, 11000]. Waves higher than 0.6
    /// of it break.
    double depth_m = 4000;
    /// Scale of horizontal displacements; [0, 1]. 0 gives a height field.
    double choppiness = 0.8;
    /// Forward displacement of crests of the wind sea, as a fraction of the displacement that
    /// sharpens them; [0, 0.6]. -1: 0 up to 3 m/s, 0.42 at 10 m/s, 0.52 at 20 m/s; 0 for
    /// phillips-paper. It makes fronts steeper than backs. A swell and systems do not lean.
    double lean = -1;
    /// GGX roughness of unresolved waves, for the smoothness channel; [0, 1]. -1: from the slopes
    /// that the cascades do not resolve in this wind.
    double roughness = -1;
    /// 0 keeps short waves, 1 removes waves shorter than a quarter of the peak wavelength; [0, 1].
    double short_wave_cutoff = 0;
    /// Alignment of waves with the wind, alpha of equations 6 to 9, for the spreading paper;
    /// [0, 1]. With 0 a third of the energy runs against the wind and little across it; with 1 a
    /// hundredth runs against it.
    double wind_alignment = 0.5;
    /// Significant wave height of a swell, in addition to the waves of the wind; [0, 30]. 0: no
    /// swell.
    double swell_height_m = 0;
    double swell_period_s = 12;  ///< peak period of the swell; [1, 40]
    /// Direction that the swell runs towards, as wind_direction_rad; [-2 pi, 2 pi].
    double swell_direction_rad = 0;
    /// Standard deviation of the swell's directions; [pi/180, 4 pi/9]. 15 degrees by default.
    double swell_spread_rad = 0.26179938779914943;
    /// T, the period after which the sea repeats exactly; [0.1, 86400]. Waves keep their frequency
    /// within 1 / (2 T): in short loops groups of waves move in steps.
    double loop_period_s = 3600;
    std::uint32_t seed = 1;  ///< seed of the random phases and amplitudes
    /// Number of analytic waves or of pond octaves; 1 to 64. 0: 16 analytic waves, 24 pond octaves.
    int wave_count = 0;
    /// Longest wavelength of an analytic sea or a pond; [0.02, 1000]. 0: 120, of a pond 1.2.
    double longest_wave_m = 0;
    /// Shortest wavelength, at most the longest; [0.01, 1000]. 0: the longest / 60, of a pond / 45.
    double shortest_wave_m = 0;
    /// Strength of analytic waves: 0 calm, 1 moderate, 2 intense, interpolated between; [0, 2].
    double wave_strength = 1;
    /// Significant wave height of the wind sea (jonswap, pierson-moskowitz), of an analytic sea or
    /// of a pond; (0, 30]. 0: from the wind, of analytic waves from wave_strength, of a pond 0.017
    /// longest_wave_m.
    double wave_height_m = 0;
    double wave_drag = 0.38;      ///< horizontal drag of a pond's short waves by its long ones; [0, 1]
    double regular_height_m = 2;  ///< height of a regular wave from trough to crest; (0, 60]
    /// Period of a regular wave; [0.2, 60]. loop_period_s is a whole number of them.
    double regular_period_s = 8;
    /// Order of Stokes' expansion of a regular wave; 1 or 2. 2 adds the second harmonic that
    /// choppiness does not make.
    int order = 1;
    /// Wave systems, in addition to the waves of the wind and the swell; at most 8.
    FixedList<WaveSystem, 8> systems = {};
    // end of generated

    /// Returns whether all values are equal.
    bool operator==(const SeaState&) const = default;
};

/// Largest number of wave systems besides the wind sea and the swell.
inline constexpr std::size_t max_wave_systems = decltype(SeaState::systems)::max_size();

/// Return the option, or the value derived for 0. \pre check(sea) is empty
int cascades_of(const SeaState& sea);
/// Returns the texels along a side of a cascade, N.
int resolution_of(const SeaState& sea);
/// Returns the option; paper for the spectrum phillips-paper.
SpreadingModel spreading_of(const SeaState& sea);
/// Returns the lean of the wind sea; 0 for listed waves. By default it grows with the wind, as the
/// skewness of slopes measured in glitter does (Cox and Munk 1954).
double lean_of(const SeaState& sea);
/// Returns whether the sea has one cascade because patch_size_m is set or its model has only one.
/// \pre check(sea) is empty
bool is_limited_to_one_cascade(const SeaState& sea);
/// Returns whether the waves are a pond's or a regular wave: an ocean of these takes no sea of
/// another model, and they have no transitions.
bool is_of_fixed_model(const SeaState& sea);
/// Returns whether the waves are those of the spectrum phillips-paper.
bool is_phillips_paper(const SeaState& sea);

/// `name` is also the key in files.
using SeaStateField = NumericField<SeaState>;

/// Returns every numeric option, in the order of the struct.
std::span<const SeaStateField> sea_state_fields();
/// Returns every numeric option of a wave system, in the order of the struct.
std::span<const NumericField<WaveSystem>> wave_system_fields();

/// Returns an empty string for usable options of a system, else a message about the first invalid
/// field.
std::string check_wave_system(const WaveSystem& system);

/// Returns an empty string for a usable sea, else a message about the first invalid field:
/// "wind_speed_mps -3 is out of range (0, 60]".
///
/// phillips-paper has no physical height for a swell or systems to be added to, and only its own
/// spreading. Only a spectrum has a swell and systems, and `none` needs one of them. A height or a
/// period needs jonswap or pierson-moskowitz, and the default fetch. For the other models
/// patch_size_m must be at least the longest wavelength. Analytic waves, as the cascades hold them,
/// must not be steeper than 0.4 (max_steepness). The loop holds whole periods of a regular wave, which
/// is no higher than breaking (Miche 1944); at order 2 its second harmonic is at most half of the
/// first.
std::string check(const SeaState&);

/// A named sea: sea states, mildest first, and then the open sea of each wind force, beaufort-0 to
/// beaufort-12. They are the files of presets/, installed as share/pelagic/presets for copying.
struct SeaPreset {
    std::string_view name;
    std::string_view summary;
    SeaState sea;
};
/// Returns all presets: named ones and beaufort-0 to beaufort-12.
std::span<const SeaPreset> sea_presets();
/// Returns null for an unknown name.
const SeaPreset* sea_preset_named(std::string_view name);

}  // namespace pelagic
