#include "pelagic/tools/options/wave_systems.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <variant>

#include "pelagic/message/number_text.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"
#include "pelagic/tools/text/typed_number.hpp"

namespace pelagic::tools {
namespace {

constexpr const char* example_of_system = "words such as height=1.2 period=12 from=W spread=15";

/// Calls visit(key, member, accepted) for each option. \param accepted  empty: by the field
template <class Visit>
void for_each_key(const Visit& visit) {
    // generated from schema/wave_system.toml: record-keys
    visit("spectrum", &WaveSystem::spectrum, "");
    visit("spreading", &WaveSystem::spreading, "");
    visit("wind_speed", &WaveSystem::wind_speed_mps, "");
    visit("fetch", &WaveSystem::fetch_m, "");
    visit("height", &WaveSystem::height_m, "");
    visit("period", &WaveSystem::peak_period_s, "");
    visit("peak_enhancement", &WaveSystem::peak_enhancement, "");
    visit("direction", &WaveSystem::direction_rad, "");
    visit("spread", &WaveSystem::spread_rad, "degrees in [1, 80]");
    // end of generated
}

const NumericField<WaveSystem>& field_of(double WaveSystem::*member) {
    const auto fields = wave_system_fields();
    return *std::find_if(fields.begin(), fields.end(),
                         [&](const auto& field) { return std::get<double WaveSystem::*>(field.member) == member; });
}

/// The key of a sea.json, which has units: "direction_deg".
std::string recorded_key(std::string_view field) {
    return is_angle(field) ? std::string(field.substr(0, field.size() - 3)) + "deg" : std::string(field);
}

/// Parses `from=W` or `towards=90`: a compass point, or degrees. Returns degrees towards which the
/// waves run, or none.
std::optional<double> parse_run_deg(std::string_view key, const std::string& text) {
    const bool comes_from = key == "from";
    if (is_compass_point(text)) return parse_compass_deg((comes_from ? "from-" : "to-") + text);
    const std::optional<double> degrees = parse_number(text);
    if (!degrees || *degrees < -360 || *degrees > 360) return {};
    return comes_from ? *degrees - (*degrees > 0 ? 180 : -180) : *degrees;
}

/// Applies one entry. Returns false if the system has no such key.
bool apply_to_system(WaveSystem& system, const ConfigEntry& entry) {
    const std::string option = entry.location + ": " + entry.key;
    if (!entry.is_recorded && (entry.key == "from" || entry.key == "towards")) {
        const std::optional<double> degrees = parse_run_deg(entry.key, entry.value);
        if (!degrees) throw bad_value(option, entry.value, "degrees in [-360, 360], or one of 16 points such as NW");
        system.direction_rad = *degrees * radians_per_degree;
        return true;
    }
    bool is_known = false;
    for_each_key([&]<class Value>(std::string_view key, Value WaveSystem::*member, std::string_view shown) {
        if constexpr (std::is_enum_v<Value>) {
            if (key != entry.key) return;
            system.*member = one_of<Value>(option, entry.value);
        } else {
            const NumericField<WaveSystem>& field = field_of(member);
            if (entry.key != (entry.is_recorded ? recorded_key(field.name) : key)) return;
            const std::string accepted = shown.empty() ? accepted_when_typed(field) : std::string(shown);
            if (entry.quoted && (parse_number(entry.value) || !takes_words(field.name)))
                throw bad_value(option, '"' + entry.value + '"', "a number without quotes: " + accepted);
            set_typed(system, field, entry.value, option, accepted, entry.is_recorded);
        }
        is_known = true;
    });
    return is_known;
}

/// Returns the keys of a system. \param is_recorded  of a sea.json
std::vector<std::string> keys_of_system(bool is_recorded) {
    std::vector<std::string> keys;
    for_each_key([&]<class Value>(std::string_view key, Value WaveSystem::*member, std::string_view) {
        if constexpr (!std::is_enum_v<Value>)
            if (is_recorded) return keys.push_back(recorded_key(field_of(member).name));
        keys.emplace_back(key);
    });
    if (!is_recorded) keys.insert(keys.end(), {"from", "towards"});
    return keys;
}

/// Returns the option that a key sets: three keys set the direction.
std::string_view target_of(std::string_view key) { return key == "from" || key == "towards" ? "direction" : key; }

WaveSystem wave_system_of(const std::vector<ConfigEntry>& entries) {
    WaveSystem system;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const ConfigEntry& entry = entries[i];
        for (std::size_t j = 0; j < i; ++j)
            if (target_of(entries[j].key) == target_of(entry.key))
                throw InputError(entry.location + ": " + entry.key + " is given after " + entries[j].key +
                                 ", expected one of the two");
        if (apply_to_system(system, entry)) continue;
        const std::vector<std::string> keys = keys_of_system(entry.is_recorded);
        throw InputError(entry.location + ": unknown key " + entry.key + ", expected " + list_of(keys) +
                         nearest_hint(entry.key, keys));
    }
    return system;
}

/// Returns the entries of "height=1.2 from=W".
std::vector<ConfigEntry> entries_of_text(const std::string& text) {
    std::vector<ConfigEntry> entries;
    const std::string location = "--system \"" + text + '"';
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const std::size_t at = word.find('=');
        if (at == std::string::npos)
            throw InputError(location + ": " + word + " has no value, expected " + example_of_system);
        std::string key = word.substr(0, at);
        std::replace(key.begin(), key.end(), '-', '_');
        entries.push_back({.key = key, .value = word.substr(at + 1), .location = location, .quoted = false});
    }
    if (entries.empty()) throw InputError(location + " is empty, expected " + example_of_system);
    return entries;
}

void require_few_systems(const std::string& option, std::size_t count) {
    if (count > max_wave_systems)
        throw InputError(option + " is given " + number_text(count) + " times, expected at most " +
                         number_text(max_wave_systems));
}

}  // namespace

std::vector<WaveSystem> parse_wave_systems(const std::vector<std::string>& texts) {
    require_few_systems("--system", texts.size());
    std::vector<WaveSystem> systems;
    for (const std::string& text : texts) systems.push_back(wave_system_of(entries_of_text(text)));
    return systems;
}

std::vector<WaveSystem> wave_systems_of(const ConfigEntry& entry) {
    require_few_systems(entry.location + ": " + entry.key, entry.records.size());
    std::vector<WaveSystem> systems;
    for (const std::vector<ConfigEntry>& record : entry.records) systems.push_back(wave_system_of(record));
    return systems;
}

std::string help_of_system() {
    return "add a wave system, such as \"height=1.2 period=12 from=W spread=15\"; may be repeated; keys: " +
           list_of(keys_of_system(false));
}

std::string text_of(const WaveSystem& system) {
    std::string text;
    for_each_key([&]<class Value>(std::string_view key, Value WaveSystem::*member, std::string_view) {
        if (system.*member == WaveSystem{}.*member) return;
        text.append(text.empty() ? "" : " ").append(key).append("=");
        if constexpr (std::is_enum_v<Value>)
            text += name_of(system.*member);
        else
            text += number_text(is_angle(field_of(member).name) ? degrees_of(system.*member) : system.*member);
    });
    return text.empty() ? "spectrum=" + std::string(name_of(system.spectrum)) : text;
}

}  // namespace pelagic::tools
