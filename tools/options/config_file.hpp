// Reading of sea options from a TOML file or from the sea.json of `pelagic export`. A TOML file has
// one `key = value` per line. Keys are the names of flags with underscores instead of dashes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pelagic::tools {

/// A key, its value as on the command line, and its location in the file.
struct ConfigEntry {
    std::string key;
    std::string value;
    std::string location;  ///< "sea.toml:3"
    bool quoted;           ///< true for a quoted string, false for a number
    /// Of a sea.json, which holds every option: those that do not apply, and 0 for a derived value.
    bool is_recorded = false;
    /// Of the key list_key: the keys of each table.
    std::vector<std::vector<ConfigEntry>> records = {};
};

/// The key of tables [[system]], of which a sea has several.
inline constexpr std::string_view list_key = "system";

/// Returns the top-level keys of a TOML text.
/// \param file   the file's name, for messages
/// \param known  the accepted keys, which the message about an unknown key lists
/// \throws InputError  on one line with file and line number, for malformed TOML, more than 1 MiB,
///                     more than 4096 bytes or 16 dots on a line, duplicate keys, tables and
///                     arrays but those of list_key, and unknown keys
std::vector<ConfigEntry> parse_config(std::string_view text, const std::filesystem::path& file,
                                      std::span<const std::string> known);

/// Returns the sea of a sea.json or of the output of `pelagic info --json` with the keys of
/// parse_config(): "wind_speed_mps" becomes wind_speed. Numbers keep all digits, so the sea is
/// bit-identical.
/// \throws InputError  as parse_config() does
std::vector<ConfigEntry> parse_sea_record(std::string_view text, const std::filesystem::path& file,
                                          std::span<const std::string> known);

/// A sea and its sea-state transitions in order. Each transition is a table [[change]] of a TOML
/// file with the keys `from` and `over` in seconds, optionally `swell_from` in metres, and the keys
/// of the values that change.
struct WeatherConfig {
    struct Change {
        std::string location;  ///< "weather.toml:3"
        std::vector<ConfigEntry> entries;
    };
    std::vector<ConfigEntry> first;
    std::vector<Change> changes;
};

/// Returns the keys of a change that are not keys of a sea.
std::vector<std::string> change_keys();

/// Reads a sea and its transitions from a TOML text.
/// \param known  the keys of a sea
/// \throws InputError  as parse_config() does
WeatherConfig parse_weather(std::string_view text, const std::filesystem::path& file,
                            std::span<const std::string> known);
/// Reads a sea and its transitions from the sea.json of an export with --weather.
/// \throws InputError  as parse_config() does
WeatherConfig parse_weather_record(std::string_view text, const std::filesystem::path& file,
                                   std::span<const std::string> known);
/// Reads a file with parse_weather_record() if its text begins with {, else with parse_weather().
/// \throws InputError  also if the file cannot be read or is larger than max_config_bytes
WeatherConfig read_weather(const std::filesystem::path& file, std::span<const std::string> known);

inline constexpr std::size_t max_config_bytes = std::size_t{64} << 20;

/// Reads a file with parse_sea_record() if its text begins with {, else with parse_config().
/// \throws InputError  also if the file cannot be read or is larger than max_config_bytes
std::vector<ConfigEntry> read_config(const std::filesystem::path& file, std::span<const std::string> known);

}  // namespace pelagic::tools
