// The sea options of the command line. Presets, a config file and flags, in increasing precedence,
// define a SeaState.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/sim/forecast.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/tools/options/config_file.hpp"
#include "pelagic/tools/text/typed_number.hpp"

namespace pelagic::tools {

struct ResolvedChange;
/// A sea with all options applied. Angles are also stored in degrees as given, so that files show
/// equal numbers.
struct ResolvedSea {
    SeaState sea;
    double wind_direction_deg = 0;
    double swell_direction_deg = 0;
    double swell_spread_deg = 15;
    std::string preset;                   ///< name of the preset; empty without one
    bool has_loop_period = false;         ///< true if a flag or a file sets the loop period
    std::vector<ResolvedChange> changes;  ///< sea-state transitions of --weather
};

/// One sea-state transition.
struct ResolvedChange {
    ResolvedSea sea;  ///< the sea after the transition
    double from_s = 0, over_s = 0;         ///< start and duration
    std::optional<double> swell_from_m = {};  ///< SeaChange::swell_from_m
};

/// Returns the forecast of the sea and its transitions.
inline Forecast forecast_of(const ResolvedSea& sea) {
    Forecast forecast{.first = sea.sea};
    for (const ResolvedChange& change : sea.changes)
        forecast.changes.push_back({.sea = change.sea.sea,
                                    .from_s = change.from_s,
                                    .over_s = change.over_s,
                                    .swell_from_m = change.swell_from_m});
    return forecast;
}

/// An angle, in radians in a SeaState and in degrees on the command line and in files.
struct SeaAngle {
    std::string_view field;    ///< "wind_direction_rad"
    std::string_view in_file;  ///< "wind_direction_deg"
    double SeaState::*radians;
    double ResolvedSea::*degrees;
};
std::span<const SeaAngle> sea_angles();
/// Returns null if the field is not an angle. \param field  a name of sea_state_fields()
const SeaAngle* sea_angle(std::string_view field);

/// Returns the option without which a field of SeaState has no effect on this sea, as on the command
/// line: "--spectrum jonswap". Returns an empty string if the field has an effect. The depth always
/// has one: dynamic waves and sea floors use it, too.
/// \param field  a name of sea_state_fields(), or as in files: "swell_spread_deg", "spectrum"
std::string_view requirement_of(std::string_view field, const SeaState& sea);

/// Returns a warning if the transitions of --weather leave out short waves of the first sea, else an
/// empty text.
std::string warning_about_weather(const ResolvedSea& sea);
/// Prints this warning as a note.
void print_weather_note(const ResolvedSea& sea);

/// The loop period of VR Ocean, the default of exports, which write a loop.
inline constexpr double paper_loop_period_s = 200;

class SeaOptions {
   public:
    enum class PresetName { option, positional_too };

    SeaOptions() = default;
    /// \param loop_period_s  default of the loop period, instead of the library's
    explicit SeaOptions(double loop_period_s) : loop_period_s_(loop_period_s) {}

    /// Declares --preset, --config, --waves, --spectrum, --spreading, --system and a flag for each
    /// numeric field, with units, ranges and defaults.
    /// \param preset  positional_too: the command line's first word names the preset, too
    void add_to(CLI::App& app, PresetName preset = PresetName::option);
    /// Returns a heading and one line per preset; the presets of Beaufort forces share a line.
    static std::string description_of_presets();

    /// Declares --weather, for commands with times of frames.
    void add_weather_to(CLI::App& app);

    /// Applies the options in increasing precedence: defaults, preset, config file, flags.
    /// \throws InputError  on one line with option, value and range
    ResolvedSea resolve() const;

    /// Returns true if any of the options is on the command line.
    bool is_given() const;

    /// Returns the sea and the transitions of a sea.json.
    /// \param file  the file's name, for messages
    /// \throws InputError  as resolve() does
    static ResolvedSea of_record(std::string_view text, const std::filesystem::path& file);

   private:
    /// \param of_file  receives the sea without flags
    ResolvedSea resolve_with(const std::vector<ConfigEntry>& config, SeaState& of_file) const;
    /// Throws InputError for a flag or an entry of a file that has no effect. Entries may have an
    /// effect on the sea of the file alone, which flags override.
    void require_effects_in(const WeatherConfig& weather, const ResolvedSea& sea, const SeaState& of_file) const;
    static void add_changes(ResolvedSea& first, const WeatherConfig& weather, const std::filesystem::path& file);
    std::optional<std::string> typed(const std::string& flag) const;

    double loop_period_s_ = SeaState{}.loop_period_s;
    std::map<std::string, std::optional<std::string>> typed_;  ///< command-line values by flag
    std::vector<std::string> typed_systems_;                   ///< of --system
};

/// Returns "6.6 s", or "6.6 s, in this loop 4 s" if a loop of whole periods changes it by more than a
/// tenth, of which warnings_about() warns.
std::string peak_period_text(double period_s, double loop_period_s, int digits);

}  // namespace pelagic::tools
