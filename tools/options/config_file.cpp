#include "pelagic/tools/options/config_file.hpp"

#include <algorithm>
#include <sstream>

// toml++ 3.3 asserts that a key follows the opening bracket of a table header, which "[ *"
// violates. Without assertions the behaviour is undefined. TOML_ASSERT is redefined, so that such a
// text is reported as malformed.
namespace pelagic::tools {
struct NotToml {};
constexpr void require_toml(bool condition) {
    if (!condition) throw NotToml();
}
}  // namespace pelagic::tools
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expr) ::pelagic::tools::require_toml(static_cast<bool>(expr))
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include "pelagic/tools/files/input_file.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

std::string location_of(const std::filesystem::path& file, const toml::source_region& source) {
    return file.string() + ":" + number_text(source.begin.line);
}

std::string toml_value_text(const toml::node& node, const std::string& location, std::string_view key) {
    if (const auto* text = node.as_string()) return text->get();
    if (const auto* whole = node.as_integer()) return number_text(whole->get());
    if (const auto* number = node.as_floating_point()) return number_text(number->get());
    std::ostringstream type;
    type << node.type();
    throw InputError(location + ": " + std::string(key) + " is of type " + type.str() +
                     ", expected a number or a text");
}

/// Returns the line without its comment. A line with a quote is returned whole, because a # may be
/// part of a string, and the string may have begun on an earlier line.
std::string_view without_comment(std::string_view line) {
    return line.find_first_of("\"'") == std::string_view::npos ? line.substr(0, line.find('#')) : line;
}

/// Limits the length of lines and the dots in a line. toml++ recurses on the stack for each
/// component of a dotted key, and when it frees tables. It limits nested values to 256 levels, each
/// of which may add a dotted key. With the limits of this function it uses less than 2 MiB of
/// stack.
void require_few_levels(std::string_view text, const std::filesystem::path& file) {
    constexpr std::size_t max_bytes = std::size_t{1} << 20;
    constexpr std::size_t max_line = 4096;
    constexpr std::ptrdiff_t max_dots = 16;
    const auto reject = [&](std::size_t line, const std::string& what) {
        throw InputError(file.string() + ":" + number_text(line) + ": " + what +
                         ", expected lines such as wind_speed = 9.0");
    };
    if (text.size() > max_bytes) reject(1, "TOML of more than 1 MiB");
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        const std::string_view data = without_comment(line);
        if (line.size() > max_line) reject(number, "a line of more than " + number_text(max_line) + " bytes");
        if (std::count(data.begin(), data.end(), '.') > max_dots)
            reject(number, "a line with more than " + number_text(max_dots) + " dots");
    }
}

toml::table parsed_toml(std::string_view text, const std::filesystem::path& file) {
    require_few_levels(text, file);
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        throw InputError(location_of(file, error.source()) + ": " + std::string(error.description()) +
                         ", expected lines such as wind_speed = 9.0");
    } catch (const NotToml&) {
        throw InputError(file.string() + ": malformed table, expected lines such as wind_speed = 9.0");
    }
}

/// Returns the entry of tables [[system]].
ConfigEntry entry_of_list(const std::string& key, const toml::node& node, const std::filesystem::path& file) {
    ConfigEntry entry{.key = key, .value = "", .location = location_of(file, node.source()), .quoted = false};
    if (!node.is_array_of_tables() && !(node.is_array() && node.as_array()->empty()))
        throw InputError(entry.location + ": " + key + " is no table, expected lines [[" + key + "]]");
    for (const toml::node& record : *node.as_array()) {
        std::vector<ConfigEntry>& values = entry.records.emplace_back();
        for (const auto& [name, value] : *record.as_table()) {
            const std::string place = location_of(file, value.source());
            values.push_back({.key = std::string(name.str()),
                              .value = toml_value_text(value, place, name.str()),
                              .location = place,
                              .quoted = value.is_string()});
        }
    }
    return entry;
}

std::vector<ConfigEntry> entries_of_table(const toml::table& table, const std::filesystem::path& file,
                                          std::span<const std::string> known) {
    std::vector<ConfigEntry> entries;
    for (const auto& [name, node] : table) {
        const std::string key(name.str());
        const std::string location = location_of(file, node.source());
        if (node.is_table() && key != list_key)
            throw InputError(location + ": " + key +
                             " is a table, expected known keys at the top level, such as wind_speed = 9.0");
        if (std::find(known.begin(), known.end(), key) == known.end())
            throw InputError(location + ": unknown key " + key + ", expected " + list_of(known) +
                             nearest_hint(key, known));
        if (key == list_key)
            entries.push_back(entry_of_list(key, node, file));
        else
            entries.push_back({key, toml_value_text(node, location, key), location, node.is_string()});
    }
    return entries;
}

bool is_json(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && text[first] == '{';
}

}  // namespace

std::vector<std::string> change_keys() { return {"from", "over", "swell_from"}; }

std::vector<ConfigEntry> parse_config(std::string_view text, const std::filesystem::path& file,
                                      std::span<const std::string> known) {
    return entries_of_table(parsed_toml(text, file), file, known);
}

WeatherConfig parse_weather(std::string_view text, const std::filesystem::path& file,
                            std::span<const std::string> known) {
    constexpr std::string_view change_key = "change";
    toml::table table = parsed_toml(text, file);
    WeatherConfig weather;
    if (const toml::node* changes = table.get(change_key)) {
        if (!changes->is_array_of_tables())
            throw InputError(location_of(file, changes->source()) + ": change is no table, expected lines [[change]]");
        std::vector<std::string> keys = change_keys();
        keys.insert(keys.end(), known.begin(), known.end());
        for (const toml::node& change : *changes->as_array())
            weather.changes.push_back(
                {location_of(file, change.source()), entries_of_table(*change.as_table(), file, keys)});
        table.erase(change_key);
    }
    weather.first = entries_of_table(table, file, known);
    return weather;
}

WeatherConfig read_weather(const std::filesystem::path& file, std::span<const std::string> known) {
    const std::string text = InputFile("--weather", file, "a TOML file or a sea.json").read_all(max_config_bytes);
    return is_json(text) ? parse_weather_record(text, file, known) : parse_weather(text, file, known);
}

std::vector<ConfigEntry> read_config(const std::filesystem::path& file, std::span<const std::string> known) {
    const std::string text = InputFile("--config", file, "a TOML file or a sea.json").read_all(max_config_bytes);
    return is_json(text) ? parse_sea_record(text, file, known) : parse_config(text, file, known);
}

}  // namespace pelagic::tools
