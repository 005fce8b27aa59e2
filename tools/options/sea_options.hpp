// [sea] of the command line: presets, a config file and flags, in this order of precedence, become a SeaState.
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

namespace pelagic::tools {

/// A sea as resolved; angles are kept in degrees as typed, so that files show the same number.
struct ResolvedChange;
struct ResolvedSea {
    SeaState sea;
    double wind_direction_deg = 0;
    double swell_direction_deg = 0;
    double swell_spread_deg = 15;
    std::string preset;                   ///< empty if none was named
    bool has_loop_period = false;         ///< a flag or a file gave one
    std::vector<ResolvedChange> changes;  ///< of --weather
};

/// What it turns into, from when, and how long that takes.
struct ResolvedChange {
    ResolvedSea sea;
    double from_s = 0, over_s = 0, swell_from_m = 0;
};

inline Forecast forecast_of(const ResolvedSea& sea) {
    Forecast forecast{.first = sea.sea};
    for (const ResolvedChange& change : sea.changes)
        forecast.changes.push_back({.sea = change.sea.sea,
                                    .from_s = change.from_s,
                                    .over_s = change.over_s,
                                    .swell_from_m = change.swell_from_m});
    return forecast;
}

/// An option that is radians in a SeaState, and degrees on the command line and in files.
struct SeaAngle {
    std::string_view field;    ///< "wind_direction_rad"
    std::string_view in_file;  ///< "wind_direction_deg"
    double SeaState::*radians;
    double ResolvedSea::*degrees;
};
std::span<const SeaAngle> sea_angles();
/// Null for what is no angle. \param field  of sea_state_fields()
const SeaAngle* sea_angle(std::string_view field);

class SeaOptions {
   public:
    /// Declares --preset, --config, --waves, --spectrum, --spreading and a flag for each numeric field, with units, ranges and defaults.
    void add_to(CLI::App& app);

    /// And --weather, for a command whose frames have times.
    void add_weather_to(CLI::App& app);

    /// Defaults < preset < config file < flags. Throws InputError, one line that names option, value and range.
    ResolvedSea resolve() const;

    /// True if any of them was typed.
    bool is_given() const;

    /// The sea of a sea.json's text, and its weather, which came from `file`. Throws InputError likewise.
    static ResolvedSea of_record(std::string_view text, const std::filesystem::path& file);

   private:
    ResolvedSea resolve_with(const std::vector<ConfigEntry>& config) const;
    static void add_changes(ResolvedSea& first, const WeatherConfig& weather, const std::filesystem::path& file);
    std::optional<std::string> typed(const std::string& flag) const;

    std::map<std::string, std::optional<std::string>> typed_;  ///< by flag name, where it was given
};

}  // namespace pelagic::tools
