// Reading of a sea.json as a config file, see config_file.hpp.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "pelagic/tools/options/config_file.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string key_without_unit(std::string key) {
    for (const std::string_view unit : {"_mps", "_deg", "_m", "_s"})
        if (key.ends_with(unit)) return key.substr(0, key.size() - unit.size());
    return key;
}

OrderedJson parse(std::string_view text, const std::filesystem::path& file) {
    try {
        return OrderedJson::parse(text);
    } catch (const OrderedJson::parse_error& error) {
        const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
        throw InputError(file.string() + ":" + number_text(1 + std::count(text.begin(), end, '\n')) +
                         ": malformed JSON, expected a sea.json of pelagic export");
    } catch (const OrderedJson::exception&) {  // for instance a number that exceeds the range of double
        throw InputError(file.string() + ": malformed JSON, expected a sea.json of pelagic export");
    }
}

/// \param key  by which the sea has the value. \throws InputError  unless it is a number or a text
ConfigEntry entry_of(const std::string& key, const std::string& name, const OrderedJson& value,
                     const std::string& location) {
    if (!value.is_number() && !value.is_string())
        throw InputError(location + ": " + name + " is of type " + value.type_name() +
                         ", expected a number or a text");
    return {key, value.is_string() ? value.get<std::string>() : value.dump(), location, value.is_string(), true};
}

/// Returns the entry of a list of objects, which keep the names of their values.
ConfigEntry entry_of_list(const OrderedJson& list, const std::string& name, const std::string& location) {
    ConfigEntry entry{.key = std::string(list_key), .value = "", .location = location, .quoted = false};
    const auto reject = [&] {
        throw InputError(location + ": " + name + " is no list of objects, expected a sea.json of pelagic export");
    };
    if (!list.is_array()) reject();
    for (const OrderedJson& record : list) {
        if (!record.is_object()) reject();
        std::vector<ConfigEntry>& values = entry.records.emplace_back();
        for (const auto& [key, value] : record.items())
            values.push_back(entry_of(key, key, value, location + "." + name));
    }
    return entry;
}

std::vector<ConfigEntry> entries_of_sea(const OrderedJson& sea, const std::string& location,
                                        std::span<const std::string> known) {
    std::vector<ConfigEntry> entries;
    const bool has_lists = std::find(known.begin(), known.end(), list_key) != known.end();
    for (const auto& [name, value] : sea.items()) {
        if (has_lists && name == "systems") {
            entries.push_back(entry_of_list(value, name, location));
            continue;
        }
        const std::string key = key_without_unit(name);
        if (key == list_key || std::find(known.begin(), known.end(), key) == known.end())
            throw InputError(location + ": unknown key " + name + ", expected " + list_of(known) +
                             nearest_hint(key, known));
        entries.push_back(entry_of(key, name, value, location));
    }
    return entries;
}

std::vector<ConfigEntry> sea_of(const OrderedJson& record, const std::filesystem::path& file,
                                std::span<const std::string> known) {
    const auto sea = record.find("sea");
    if (sea == record.end() || !sea->is_object())
        throw InputError(file.string() + " holds no sea, expected a sea.json of pelagic export");
    return entries_of_sea(*sea, file.string() + ": sea", known);
}

}  // namespace

std::vector<ConfigEntry> parse_sea_record(std::string_view text, const std::filesystem::path& file,
                                          std::span<const std::string> known) {
    return sea_of(parse(text, file), file, known);
}

WeatherConfig parse_weather_record(std::string_view text, const std::filesystem::path& file,
                                   std::span<const std::string> known) {
    const OrderedJson record = parse(text, file);
    WeatherConfig weather{sea_of(record, file, known), {}};
    const auto changes = record.find("weather");
    if (changes == record.end()) return weather;
    const std::string location = file.string() + ": weather";
    if (!changes->is_array()) throw InputError(location + " is no list, expected a sea.json of pelagic export");
    for (const OrderedJson& change : *changes) {
        if (!change.is_object() || !change.contains("sea") || !change["sea"].is_object())
            throw InputError(location + " has a change without a sea, expected a sea.json of pelagic export");
        OrderedJson times = change;
        times.erase("sea");
        weather.changes.push_back({location, entries_of_sea(times, location, change_keys())});
        for (ConfigEntry& entry : entries_of_sea(change["sea"], location, known))
            weather.changes.back().entries.push_back(std::move(entry));
    }
    return weather;
}

}  // namespace pelagic::tools
