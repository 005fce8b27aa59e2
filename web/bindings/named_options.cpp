#include "pelagic/web/bindings/named_options.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <stdexcept>
#include <vector>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/near_names.hpp"
#include "pelagic/sim/forecast.hpp"
#include "pelagic/web/bindings/object_reader.hpp"

namespace pelagic::web {
namespace {

using emscripten::val;

bool is_of_type(const val& value, std::string_view type) { return value.typeOf().as<std::string>() == type; }

/// An option whose values are words.
struct WordOption {
    std::string name;
    std::vector<std::string> words;
    void (*set)(SeaState&, std::string_view word);  ///< \pre `word` is one of `words`
    std::string_view (*word_in)(const SeaState&);
};

template <NamedEnum Enum, Enum SeaState::*member>
WordOption word_option(std::string name) {
    return {std::move(name),
            {names_of<Enum>().begin(), names_of<Enum>().end()},
            [](SeaState& sea, std::string_view word) { sea.*member = *value_named<Enum>(word); },
            [](const SeaState& sea) { return name_of(sea.*member); }};
}

const std::vector<WordOption>& word_options() {
    static const std::vector<WordOption> all = {
        // generated from schema/sea.toml: word-options
        word_option<WaveModel, &SeaState::waves>("waves"),
        word_option<SpectrumModel, &SeaState::spectrum>("spectrum"),
        word_option<SpreadingModel, &SeaState::spreading>("spreading"),
        // end of generated
    };
    return all;
}

std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    for (const SeaPreset& preset : sea_presets()) names.emplace_back(preset.name);
    return names;
}

[[noreturn]] void reject(std::string_view name, const val& value, std::string_view accepted) {
    throw std::invalid_argument(invalid_value_message(name, text_of(value), accepted));
}

WaveSystem wave_system_of(const std::string& name, const val& object) {
    ObjectReader reader(name, name + ".", object);
    WaveSystem system;
    reader.take_word(system.spectrum, "spectrum");
    reader.take_word(system.spreading, "spreading");
    reader.take_fields(system, wave_system_fields());
    reader.end();
    return system;
}

std::vector<WaveSystem> wave_systems_of(const std::string& name, const val& list) {
    if (!list.isArray()) reject(name, list, "an array");
    const int count = list["length"].as<int>();
    if (count > static_cast<int>(max_wave_systems))
        throw std::invalid_argument(name + " has " + number_text(count) + " elements, expected 0 to " +
                                    number_text(max_wave_systems));
    std::vector<WaveSystem> systems;
    for (int i = 0; i < count; ++i)
        systems.push_back(wave_system_of(name + "[" + number_text(i) + "]", list[i]));
    return systems;
}

val object_of(const WaveSystem& system) {
    val object = val::object();
    object.set("spectrum", std::string(name_of(system.spectrum)));
    object.set("spreading", std::string(name_of(system.spreading)));
    for (const NumericField<WaveSystem>& field : wave_system_fields())
        object.set(camel_case(field.name), field.value_in(system));
    return object;
}

/// Returns false if the sea has no option of that name.
bool set_option(SeaState& sea, const std::string& name, const val& value) {
    for (const WordOption& option : word_options())
        if (option.name == name) {
            option.set(sea, word_of(name, value, option.words));
            return true;
        }
    for (const SeaStateField& field : sea_state_fields())
        if (camel_case(field.name) == name) {
            set_field(sea, field, name, value);
            return true;
        }
    if (name != "systems") return false;
    sea.systems = wave_systems_of(name, value);
    return true;
}

std::vector<std::string> option_names(std::span<const std::string_view> others) {
    std::vector<std::string> names(others.begin(), others.end());
    names.emplace_back("preset");
    for (const WordOption& option : word_options()) names.push_back(option.name);
    for (const SeaStateField& field : sea_state_fields()) names.push_back(camel_case(field.name));
    names.emplace_back("systems");
    return names;
}

val array_of(const std::vector<std::string>& words) {
    val array = val::array();
    for (const std::string& word : words) array.call<void>("push", word);
    return array;
}

}  // namespace

std::string camel_case(std::string_view text) {
    std::string camel;
    const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_joint = text[i] == '_' && i > 0 && i + 1 < text.size() && is_letter(text[i + 1]);
        camel += is_joint ? static_cast<char>(text[++i] - 'a' + 'A') : text[i];
    }
    return camel;
}

std::string text_of(const val& value) {
    if (is_of_type(value, "string")) return '"' + value.as<std::string>() + '"';
    if (value.isArray()) return "an array";
    if (is_object(value)) return "an object";
    return val::global("String")(value).as<std::string>();
}

bool is_number(const val& value) { return is_of_type(value, "number"); }

bool is_object(const val& value) { return !value.isNull() && !value.isArray() && is_of_type(value, "object"); }

std::vector<std::string> keys_of(const val& object) {
    return emscripten::vecFromJSArray<std::string>(val::global("Object").call<val>("keys", object));
}

bool flag_of(const std::string& name, const val& value) {
    if (!value.isTrue() && !value.isFalse()) reject(name, value, "true or false");
    return value.isTrue();
}

std::string word_of(std::string_view name, const val& value, const std::vector<std::string>& words) {
    if (!is_of_type(value, "string")) reject(name, value, list_of(words));
    const auto word = value.as<std::string>();
    if (std::find(words.begin(), words.end(), word) == words.end())
        throw std::invalid_argument(
            invalid_value_message(name, text_of(value), list_of(words) + nearest_hint(word, words)));
    return word;
}

double number_of(std::string_view name, const val& value, bool (*accepts)(double), std::string_view accepted) {
    if (!is_number(value) || !accepts(value.as<double>())) reject(name, value, accepted);
    return value.as<double>();
}

void reject_name(const std::string& name, std::span<const std::string> known) {
    // An option without its unit: "windspeed", "wind_speed" and "wind" are windSpeedMps.
    const std::string slip = camel_case(name);
    const auto is_begun = [&](const std::string& option) {
        return option.size() >= slip.size() &&
               std::equal(slip.begin(), slip.end(), option.begin(), [](char a, char b) {
                   return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
               });
    };
    const auto begun = std::find_if(known.begin(), known.end(), is_begun);
    const auto near = begun != known.end() && slip.size() > 3 ? *begun : near_name(slip, known);
    throw std::invalid_argument(
        one_line("there is no option " + name + ", expected " + (near ? *near : "one of " + list_of(known))));
}

SeaState sea_with(const SeaState& sea, const val& options, std::span<const std::string_view> others) {
    if (options.isUndefined()) return sea;
    if (!is_object(options)) reject("options", options, "an object such as {windSpeedMps: 9}");

    SeaState changed = sea;
    if (const val preset = options["preset"]; !preset.isUndefined())
        changed = sea_preset_named(word_of("preset", preset, preset_names()))->sea;
    keep_constant_fields(changed, sea);
    for (const std::string& name : keys_of(options)) {
        const val value = options[name];
        if (value.isUndefined() || name == "preset" || std::find(others.begin(), others.end(), name) != others.end())
            continue;
        if (!set_option(changed, name, value)) reject_name(name, option_names(others));
    }
    // So far each option was checked by itself.
    if (const std::string reason = check(changed); !reason.empty()) throw std::invalid_argument(camel_case(reason));
    return changed;
}

val options_of(const SeaState& sea) {
    val options = val::object();
    for (const WordOption& option : word_options()) options.set(option.name, std::string(option.word_in(sea)));
    for (const SeaStateField& field : sea_state_fields()) options.set(camel_case(field.name), field.value_in(sea));
    if (sea.systems.empty()) return options;
    val systems = val::array();
    for (const WaveSystem& system : sea.systems) systems.call<void>("push", object_of(system));
    options.set("systems", systems);
    return options;
}

val option_row(const std::string& name, const std::string& default_word, const std::vector<std::string>& words) {
    val row = val::object();
    row.set("name", name);
    row.set("default", default_word);
    row.set("accepted", list_of(words));
    row.set("words", array_of(words));
    return row;
}

val sea_option_table() {
    val table = val::array();
    for (const WordOption& option : word_options())
        table.call<void>("push", option_row(option.name, std::string(option.word_in({})), option.words));
    for (const SeaStateField& field : sea_state_fields()) table.call<void>("push", option_row(field));
    return table;
}

val preset_table() {
    val table = val::array();
    for (const SeaPreset& preset : sea_presets()) {
        val row = val::object();
        row.set("name", std::string(preset.name));
        row.set("summary", std::string(preset.summary));
        row.set("sea", options_of(preset.sea));
        table.call<void>("push", row);
    }
    return table;
}

}  // namespace pelagic::web
