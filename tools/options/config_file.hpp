// A sea in a TOML file: one `key = value` a line, keys named as the flags with underscores for dashes. Or the sea of a
// sea.json, which `pelagic export` wrote.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pelagic::tools {

/// A key and its value as the command line would spell it, and where it stands.
struct ConfigEntry {
    std::string key;
    std::string value;
    std::string place;  ///< "sea.toml:3"
    bool quoted;        ///< a text in quotes, not a number
};

/// The top-level keys of a text that came from `file`. Throws InputError, one line with file and line number, for
/// malformed TOML, TOML of more than 1 MiB, 4096 bytes a line or 16 dots a line, duplicate keys, tables and arrays, and for a key that is not in `known` (it lists those).
std::vector<ConfigEntry> parse_config(std::string_view text, const std::filesystem::path& file,
                                      std::span<const std::string> known);

/// The sea of a sea.json or of `pelagic info --json`, as the same keys: "wind_speed_mps" becomes wind_speed. Numbers keep
/// every digit, so the sea is the same bit for bit. Throws InputError as parse_config() does.
std::vector<ConfigEntry> parse_sea_record(std::string_view text, const std::filesystem::path& file,
                                          std::span<const std::string> known);

/// A sea, and what it turns into one after the other: tables [[change]] of a TOML file, each with the keys `from` and `over`, in
/// seconds, `swell_from` in metres where it has one, and those of what it changes.
struct WeatherConfig {
    struct Change {
        std::string place;  ///< "weather.toml:3"
        std::vector<ConfigEntry> entries;
    };
    std::vector<ConfigEntry> first;
    std::vector<Change> changes;
};

/// The keys of a change beside those of a sea.
std::vector<std::string> change_keys();

/// Throws InputError as parse_config() does. \param known  keys of a sea
WeatherConfig parse_weather(std::string_view text, const std::filesystem::path& file,
                            std::span<const std::string> known);
/// The same of the sea.json of an export with weather.
WeatherConfig parse_weather_record(std::string_view text, const std::filesystem::path& file,
                                   std::span<const std::string> known);
/// One of the two of a file, as read_config().
WeatherConfig read_weather(const std::filesystem::path& file, std::span<const std::string> known);

inline constexpr std::size_t max_config_bytes = std::size_t{64} << 20;

/// One of the two of a file: a text that begins with { is no TOML. Throws InputError if it can't be read or is larger than
/// max_config_bytes.
std::vector<ConfigEntry> read_config(const std::filesystem::path& file, std::span<const std::string> known);

}  // namespace pelagic::tools
