#include "pelagic/tools/options/sea_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/options/config_file.hpp"
#include "pelagic/tools/options/wave_systems.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"
#include "pelagic/tools/text/path_text.hpp"
#include "pelagic/tools/text/progress.hpp"
#include "pelagic/tools/text/typed_number.hpp"

namespace pelagic::tools {
namespace {

/// Seas on which an option has an effect.
enum class Needs {
    nothing,
    spectrum,
    jonswap,
    fetch,
    height,
    paper_spreading,
    swell,
    no_spectrum,
    analytic,
    pond,
    no_pond,
    regular
};

/// A flag and its field of SeaState.
struct SeaFlag {
    std::string_view flag;
    std::string_view field;
    std::string_view help;
    const char* group;
    Needs needs;
    std::string_view shown_default;   ///< of a derived value; empty: the field's
    std::string_view shown_accepted;  ///< empty: by the field
};

constexpr SeaFlag sea_flags[] = {
    // generated from schema/sea.toml: flags
    {"cascades", "cascades", "bands of wavelengths", help_group::sea, Needs::nothing, "4; 1 with --patch-size", ""},
    {"resolution", "resolution", "texels along a cascade's side",
     help_group::sea, Needs::nothing, "128; 256 with --patch-size", ""},
    {"patch-size", "patch_size_m", "side of a single cascade in metres",
     help_group::sea, Needs::nothing, "several cascades", ""},
    {"wind-speed", "wind_speed_mps", "wind speed at 10 m", help_group::sea, Needs::nothing, "", ""},
    {"wind-direction", "wind_direction_rad", "heading", help_group::sea, Needs::nothing, "", ""},
    {"fetch", "fetch_m", "fetch in metres (jonswap)", help_group::sea, Needs::fetch, "", ""},
    {"peak-period", "peak_period_s", "peak period of the wind sea in seconds",
     help_group::sea, Needs::height, "from the wind", ""},
    {"peak-enhancement", "peak_enhancement", "height of the spectrum's peak, gamma (jonswap)",
     help_group::sea, Needs::jonswap, "", ""},
    {"depth", "depth_m", "water depth in metres", help_group::sea, Needs::nothing, "", ""},
    {"choppiness", "choppiness", "scale of horizontal displacement", help_group::sea, Needs::no_pond, "", ""},
    {"lean", "lean", "forward displacement of crests", help_group::sea, Needs::spectrum, "wind", "[0, 0.6] or wind"},
    {"roughness", "roughness", "roughness of unresolved waves",
     help_group::sea, Needs::nothing, "wind", "[0, 1] or wind"},
    {"short-wave-cutoff", "short_wave_cutoff", "damping of short waves", help_group::sea, Needs::spectrum, "", ""},
    {"wind-alignment", "wind_alignment", "alignment of waves with the wind (--spreading paper)",
     help_group::sea, Needs::paper_spreading, "", ""},
    {"swell-height", "swell_height_m", "significant wave height in metres; 0: no swell",
     help_group::swell, Needs::spectrum, "", ""},
    {"swell-period", "swell_period_s", "peak period in seconds", help_group::swell, Needs::swell, "", ""},
    {"swell-direction", "swell_direction_rad", "heading", help_group::swell, Needs::swell, "", ""},
    {"swell-spread", "swell_spread_rad", "standard deviation of directions",
     help_group::swell, Needs::swell, "", "degrees in [1, 80]"},
    {"loop-period", "loop_period_s", "seconds until the sea repeats exactly",
     help_group::sea, Needs::nothing, "", ""},
    {"seed", "seed", "seed of phases and amplitudes", help_group::sea, Needs::spectrum, "", ""},
    {"wave-count", "wave_count", "number of waves, or octaves of a pond",
     help_group::analytic, Needs::no_spectrum, "16; pond: 24", ""},
    {"longest-wave", "longest_wave_m", "longest wavelength in metres",
     help_group::analytic, Needs::no_spectrum, "120; pond: 1.2", ""},
    {"shortest-wave", "shortest_wave_m", "shortest wavelength in metres",
     help_group::analytic, Needs::no_spectrum, "1/60 of the longest; pond: 1/45", ""},
    {"wave-strength", "wave_strength", "0 calm, 1 moderate, 2 intense",
     help_group::analytic, Needs::analytic, "", ""},
    {"wave-height", "wave_height_m", "significant wave height in metres",
     help_group::sea, Needs::height, "from the wind or --wave-strength; pond: 0.017 of the longest wave", ""},
    {"wave-drag", "wave_drag", "drift of a pond's short waves on long ones",
     help_group::analytic, Needs::pond, "", ""},
    {"regular-height", "regular_height_m", "height from trough to crest in metres",
     help_group::regular, Needs::regular, "", ""},
    {"regular-period", "regular_period_s", "period in seconds", help_group::regular, Needs::regular, "", ""},
    {"order", "order", "order of Stokes' expansion", help_group::regular, Needs::regular, "", ""},
    // end of generated
};

/// Calls visit(flag, member, help, needs) for each option that is an enumeration. The flag is also the
/// field's name.
template <class Visit>
void for_each_enumeration(const Visit& visit) {
    // generated from schema/sea.toml: named-flags
    visit("waves", &SeaState::waves, "wave model", Needs::nothing);
    visit("spectrum", &SeaState::spectrum, "wave spectrum", Needs::spectrum);
    visit("spreading", &SeaState::spreading, "directional spreading", Needs::spectrum);
    // end of generated
}

const SeaStateField& field_of(const SeaFlag& flag) {
    const auto fields = sea_state_fields();
    return *std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.name == flag.field; });
}

bool takes_wind(const SeaFlag& flag) { return flag.shown_accepted.ends_with(" or wind"); }

std::string accepted_by(const SeaFlag& flag) {
    return flag.shown_accepted.empty() ? accepted_when_typed(field_of(flag)) : std::string(flag.shown_accepted);
}

/// Returns the field of a flag: "wind_speed_mps" for "wind-speed".
std::string_view field_of_flag(std::string_view flag) {
    for (const SeaFlag& number : sea_flags)
        if (number.flag == flag) return number.field;
    return flag;
}

std::string default_of(const SeaFlag& flag) {
    if (!flag.shown_default.empty()) return std::string(flag.shown_default);
    const SeaAngle* const angle = sea_angle(flag.field);
    return number_text(angle ? ResolvedSea{}.*angle->degrees : field_of(flag).value_in({}));
}

std::string config_key(std::string_view flag) {
    std::string key(flag);
    std::replace(key.begin(), key.end(), '-', '_');
    return key;
}

bool is_force(const SeaPreset& preset) { return preset.name.starts_with("beaufort-"); }

/// Returns "pond, calm ... or beaufort-0 to beaufort-12".
std::string names_of_presets() {
    std::string names;
    for (const SeaPreset& preset : sea_presets())
        if (!is_force(preset)) names.append(preset.name).append(", ");
    return names + "or beaufort-0 to beaufort-12";
}

/// Returns the values that a flag accepts, as short as a line of help needs.
std::string accepted_in_help(const SeaFlag& flag) {
    if (is_direction(flag.field)) return "degrees from +x (east) to +z (south), or from-NW";
    if (is_speed(flag.field)) return std::string(field_of(flag).accepted) + " m/s or 20kn, 40km/h, bft6";
    if (is_duration(flag.field)) return std::string(field_of(flag).accepted);
    const std::string accepted = accepted_by(flag);
    constexpr std::string_view whole = "a whole number from ";
    return accepted.starts_with(whole) ? accepted.substr(whole.size()) : accepted;
}

void apply_preset(ResolvedSea& resolved, const std::string& name, const std::string& option) {
    if (const SeaPreset* preset = sea_preset_named(name)) {
        resolved = {};
        // An angle that the preset does not change keeps the digits of its default.
        for (const SeaAngle& angle : sea_angles())
            if (preset->sea.*angle.radians != resolved.sea.*angle.radians)
                resolved.*angle.degrees = degrees_of(preset->sea.*angle.radians);
        resolved.sea = preset->sea;
        resolved.preset = name;
        return;
    }
    std::vector<std::string> all, few;
    for (const SeaPreset& preset : sea_presets()) {
        all.emplace_back(preset.name);
        if (!is_force(preset)) few.push_back(all.back());
    }
    few.push_back("beaufort-0 to beaufort-12");
    throw bad_value(option, name, list_of(few) + nearest_hint(name, all));
}

/// \param is_recorded  accepts the field's value for "derived", such as 0, too
void apply_number(ResolvedSea& resolved, const SeaFlag& flag, const std::string& text, const std::string& option,
                  bool is_recorded) {
    const SeaStateField& field = field_of(flag);
    if (takes_wind(flag) && text == "wind") return field.set(resolved.sea, *field.also);
    const double number = set_typed(resolved.sea, field, text, option, accepted_by(flag), is_recorded);
    // Height and period replace the fetch of a preset; require_effect() rejects a fetch beside them.
    const bool is_height = flag.field == "wave_height_m" || flag.field == "peak_period_s";
    if (is_height && number > 0) resolved.sea.fetch_m = SeaState{}.fetch_m;
    if (flag.field == "loop_period_s") resolved.has_loop_period = true;
    if (const SeaAngle* const angle = sea_angle(flag.field)) resolved.*angle->degrees = number;
}

/// Applies one option other than the preset. \param name  name of the flag
void apply(ResolvedSea& resolved, std::string_view name, const std::string& text, const std::string& option,
           bool is_recorded = false) {
    for_each_enumeration([&]<class Enum>(std::string_view flag, Enum SeaState::*member, auto...) {
        if (name == flag) resolved.sea.*member = one_of<Enum>(option, text);
    });
    for (const SeaFlag& flag : sea_flags)
        if (flag.flag == name) apply_number(resolved, flag, text, option, is_recorded);
}

/// Applies --regular "height=2 period=8 direction=30", short for --waves regular and these options.
void apply_regular(ResolvedSea& resolved, const std::string& text) {
    constexpr const char* accepted = "words of height=METRES, period=SECONDS and direction=HEADING";
    constexpr std::array flags = {std::pair("height", "regular-height"), std::pair("period", "regular-period"),
                                  std::pair("direction", "wind-direction")};
    apply(resolved, "waves", "regular", "--regular");
    std::istringstream words(text);
    int count = 0;
    for (std::string word; words >> word; ++count) {
        const std::size_t equals = word.find('=');
        const auto found = std::find_if(flags.begin(), flags.end(),
                                        [&](const auto& flag) { return word.substr(0, equals) == flag.first; });
        if (equals == std::string::npos || found == flags.end()) throw bad_value("--regular", word, accepted);
        apply(resolved, found->second, word.substr(equals + 1), "--regular " + std::string(found->first));
    }
    if (count == 0) throw bad_value("--regular", text, accepted);
}

/// Sets the loop to whole periods of a regular wave, as near as possible to the default.
void fit_loop(ResolvedSea& resolved) {
    SeaState& sea = resolved.sea;
    if (sea.waves != WaveModel::regular || resolved.has_loop_period) return;
    sea.loop_period_s = std::max(1.0, std::round(sea.loop_period_s / sea.regular_period_s)) * sea.regular_period_s;
}

/// Returns the names of the flags that a config file may contain, the preset first.
std::vector<std::string> configurable_flags() {
    std::vector<std::string> flags = {"preset"};
    for_each_enumeration([&](std::string_view flag, auto...) { flags.emplace_back(flag); });
    for (const SeaFlag& flag : sea_flags) flags.emplace_back(flag.flag);
    flags.emplace_back(list_key);
    return flags;
}

std::vector<std::string> config_keys() {
    std::vector<std::string> keys;
    for (const std::string& flag : configurable_flags()) keys.push_back(config_key(flag));
    return keys;
}

/// Applies all keys but the preset, in the order of flags.
void apply_config(ResolvedSea& resolved, const std::vector<ConfigEntry>& config) {
    for (const std::string& flag : configurable_flags())
        for (const ConfigEntry& entry : config) {
            if (flag == "preset" || entry.key != config_key(flag)) continue;
            const std::string option = entry.location + ": " + entry.key;
            for (const SeaFlag& number : sea_flags)
                if (number.flag == flag && entry.quoted &&
                    (parse_number(entry.value) || !(takes_words(number.field) || takes_wind(number))))
                    throw bad_value(option, '"' + entry.value + '"',
                                    "a number without quotes: " + accepted_by(number));
            if (flag == list_key)
                resolved.sea.systems = wave_systems_of(entry);
            else
                apply(resolved, flag, entry.value, option, entry.is_recorded);
        }
}

/// Throws InputError if the option has no effect on any of the seas.
void require_effect(std::string_view flag, const std::string& option, const std::string& value,
                    const std::vector<SeaState>& seas) {
    std::string_view required;
    for (const SeaState& sea : seas) {
        required = requirement_of(field_of_flag(flag), sea);
        if (required.empty()) return;
    }
    throw InputError(option + " is " + value + "; it requires " + std::string(required));
}

void require_effects(const std::vector<ConfigEntry>& entries, const std::vector<SeaState>& seas) {
    for (const ConfigEntry& entry : entries) {
        if (entry.is_recorded) continue;
        for (const std::string& flag : configurable_flags())
            if (entry.key == config_key(flag))
                require_effect(flag, entry.location + ": " + entry.key, entry.value, seas);
    }
}

/// Replaces the name of a field in a reason of check(). One word, such as "cascades", is a name only
/// at the beginning.
void rename_field(std::string& reason, std::string_view field, const std::string& name) {
    const bool is_word = field.find('_') == std::string_view::npos;
    for (std::size_t at = 0; (at = reason.find(field, at)) != std::string::npos; at += name.size()) {
        if (is_word && at > 0) break;
        reason.replace(at, field.size(), name);
    }
}

/// Names fields by their flags: --wave-height for wave_height_m.
std::string named_as_flags(std::string reason) {
    for (const SeaFlag& flag : sea_flags) rename_field(reason, flag.field, "--" + std::string(flag.flag));
    rename_field(reason, "systems", "--system");
    return reason;
}

/// Names fields by their keys in a TOML file: wave_height for wave_height_m.
std::string named_as_keys(std::string reason) {
    for (const SeaFlag& flag : sea_flags) rename_field(reason, flag.field, config_key(flag.flag));
    rename_field(reason, "systems", std::string(list_key));
    for (const std::string& key : change_keys()) rename_field(reason, key + (key == "swell_from" ? "_m" : "_s"), key);
    return reason;
}

/// Stores the default cascades, resolution and spreading explicitly, so that files do not depend on
/// the defaults of a version.
void store_defaults(SeaState& sea) {
    sea.spreading = spreading_of(sea);
    const int cascades = cascades_of(sea), resolution = resolution_of(sea);
    sea.cascades = cascades;
    sea.resolution = resolution;
}

constexpr double max_time_s = 1e9;
/// Cascades are planned for all seas of a forecast, some milliseconds each before the first frame.
constexpr std::size_t max_changes = 1000;
constexpr double max_swell_from_m = 2e7;

constexpr std::array angle_fields = {
    SeaAngle{"wind_direction_rad", "wind_direction_deg", &SeaState::wind_direction_rad,
             &ResolvedSea::wind_direction_deg},
    SeaAngle{"swell_direction_rad", "swell_direction_deg", &SeaState::swell_direction_rad,
             &ResolvedSea::swell_direction_deg},
    SeaAngle{"swell_spread_rad", "swell_spread_deg", &SeaState::swell_spread_rad, &ResolvedSea::swell_spread_deg},
};

/// Returns the option that a sea lacks, "--spectrum jonswap", or an empty text.
std::string_view missing_for(Needs needs, const SeaState& sea) {
    const bool is_spectrum = sea.waves == WaveModel::spectrum, is_pond = sea.waves == WaveModel::pond;
    const bool is_analytic = sea.waves == WaveModel::analytic;
    const auto unless = [](bool applies, std::string_view required) { return applies ? "" : required; };
    switch (needs) {
        case Needs::nothing: return "";
        case Needs::no_spectrum: return unless(is_analytic || is_pond, "--waves analytic or pond");
        case Needs::analytic: return unless(is_analytic, "--waves analytic");
        case Needs::pond: return unless(is_pond, "--waves pond");
        case Needs::no_pond: return unless(!is_pond, "--waves spectrum, analytic or regular");
        case Needs::regular: return unless(sea.waves == WaveModel::regular, "--waves regular");
        case Needs::height:
            if (!is_spectrum) return unless(sea.waves != WaveModel::regular, "--waves spectrum, analytic or pond");
            return unless(sea.spectrum == SpectrumModel::jonswap || sea.spectrum == SpectrumModel::pierson_moskowitz,
                          "--spectrum jonswap or pierson-moskowitz");
        default: break;
    }
    if (!is_spectrum) return "--waves spectrum";
    switch (needs) {
        case Needs::jonswap: return unless(sea.spectrum == SpectrumModel::jonswap, "--spectrum jonswap");
        case Needs::fetch:
            if (sea.wave_height_m > 0 || sea.peak_period_s > 0) return "no --wave-height and no --peak-period";
            return unless(sea.spectrum == SpectrumModel::jonswap, "--spectrum jonswap");
        case Needs::paper_spreading: return unless(spreading_of(sea) == SpreadingModel::paper, "--spreading paper");
        case Needs::swell: return unless(sea.swell_height_m > 0, "--swell-height");
        default: return "";
    }
}

}  // namespace

std::string_view requirement_of(std::string_view field, const SeaState& sea) {
    for (const SeaAngle& angle : sea_angles())
        if (angle.in_file == field) field = angle.field;
    Needs needs = Needs::nothing;
    for (const SeaFlag& flag : sea_flags)
        if (flag.field == field) needs = flag.needs;
    for_each_enumeration([&](std::string_view name, auto, auto, Needs of_name) {
        if (name == field) needs = of_name;
    });
    return missing_for(needs, sea);
}

std::string warning_about_weather(const ResolvedSea& sea) {
    return sea.changes.empty() ? std::string() : warning_about(forecast_of(sea));
}

void print_weather_note(const ResolvedSea& sea) {
    if (const std::string warning = warning_about_weather(sea); !warning.empty()) print_note(warning);
}

void SeaOptions::add_to(CLI::App& app, PresetName preset) {
    const auto add = [&](std::string_view flag, const std::string& type, const std::string& help, const char* group,
                         const char* positional = "") {
        const std::string name(flag);
        app.add_option("--" + name + positional, typed_[name], help)->type_name(type)->group(group);
    };
    add("preset", "PRESET", "start from a preset: " + names_of_presets(), help_group::sea,
        preset == PresetName::positional_too ? ",PRESET" : "");
    add("config", "FILE.toml|json", "read sea options from a file; options override it", help_group::sea);
    for_each_enumeration([&]<class Enum>(std::string_view flag, Enum SeaState::*member, const char* help, Needs) {
        add(flag, alternatives(names_of<Enum>()),
            std::string(help) + " (default: " + std::string(name_of(SeaState{}.*member)) + ")", help_group::sea);
    });
    add("regular", "\"height=2 period=8 direction=30\"",
        "one regular wave: metres, seconds and heading; short for --waves regular", help_group::regular);
    for (const SeaFlag& flag : sea_flags)
        add(flag.flag,
            is_direction(flag.field) ? "HEADING"
            : is_speed(flag.field)   ? "SPEED"
                                     : "NUMBER",
            std::string(flag.help) + "; " + accepted_in_help(flag) + " (default: " +
                (flag.field == "loop_period_s" ? number_text(loop_period_s_) : default_of(flag)) + ")",
            flag.group);
    app.add_option("--system", typed_systems_, help_of_system())
        ->type_name("SYSTEM")
        ->group(help_group::swell)
        ->expected(1)
        ->take_all();
}

std::string SeaOptions::description_of_presets() {
    std::string text = "Presets:\n";
    for (const SeaPreset& preset : sea_presets()) {
        if (is_force(preset)) continue;
        const std::string name = "  " + std::string(preset.name);
        text.append(name).append(22 - name.size(), ' ').append(preset.summary).append("\n");
    }
    return text + "  beaufort-0 to -12   open sea of this Beaufort force, Hs 0 to 14 m";
}

bool SeaOptions::is_given() const {
    return !typed_systems_.empty() ||
           std::any_of(typed_.begin(), typed_.end(), [](const auto& flag) { return flag.second.has_value(); });
}

void SeaOptions::add_weather_to(CLI::App& app) {
    app.add_option("--weather", typed_["weather"], "read a sea and its transitions from a file; excludes --config")
        ->type_name("FILE.toml|json")
        ->group(help_group::sea);
}

ResolvedSea SeaOptions::resolve() const {
    const auto file = typed("config"), weather_file = typed("weather");
    if (weather_file && file)
        throw InputError("--config is " + *file + " and --weather is " + *weather_file +
                         "; give one of the two: the first sea stands in both");
    WeatherConfig weather;
    if (weather_file) weather = read_weather(path_of(*weather_file), config_keys());
    if (file) weather.first = read_config(path_of(*file), config_keys());
    SeaState of_file;
    ResolvedSea sea = resolve_with(weather.first, of_file);
    if (weather_file) add_changes(sea, weather, path_of(*weather_file));
    require_effects_in(weather, sea, of_file);
    return sea;
}

ResolvedSea SeaOptions::of_record(std::string_view text, const std::filesystem::path& file) {
    const WeatherConfig weather = parse_weather_record(text, file, config_keys());
    SeaState of_file;
    ResolvedSea sea = SeaOptions().resolve_with(weather.first, of_file);
    add_changes(sea, weather, file);
    return sea;
}

/// Adds transitions. Each starts from the sea before it or from a preset, and keeps the first sea's
/// cascades.
void SeaOptions::add_changes(ResolvedSea& first, const WeatherConfig& weather, const std::filesystem::path& file) {
    if (weather.changes.size() > max_changes)
        throw bad_value(file.string(), "a forecast of " + number_text(weather.changes.size()) + " changes",
                        "at most " + number_text(max_changes));
    for (const WeatherConfig::Change& config : weather.changes) {
        ResolvedChange change{.sea = first.changes.empty() ? first : first.changes.back().sea};
        change.sea.changes.clear();
        change.sea.preset.clear();
        std::optional<double> from_s, over_s;
        std::vector<ConfigEntry> of_sea;
        for (const ConfigEntry& entry : config.entries) {
            const std::string option = entry.location + ": " + entry.key;
            const auto number = [&](double min, double max, const std::string& accepted) {
                if (entry.quoted)
                    throw bad_value(option, '"' + entry.value + '"', "a number without quotes: " + accepted);
                return number_in(option, entry.value, min, max, accepted);
            };
            if (entry.key == "from")
                from_s = number(-max_time_s, max_time_s, "seconds in [-1e9, 1e9]");
            else if (entry.key == "over")
                over_s = number(0, max_time_s, "seconds in (0, 1e9]");
            else if (entry.key == "swell_from") {
                const double distance_m = number(0, max_swell_from_m, "metres in [1e3, 2e7], or 0");
                if (distance_m > 0) change.swell_from_m = distance_m;
            } else if (entry.key == "preset") {
                apply_preset(change.sea, entry.value, option);
                keep_constant_fields(change.sea.sea, first.sea);
            } else {
                of_sea.push_back(entry);
            }
        }
        if (!from_s)
            throw InputError(config.location + ": from is missing: the time when the change begins, in seconds");
        if (!over_s)
            throw InputError(config.location + ": over is missing, expected how long the change takes, in seconds");
        change.from_s = *from_s;
        change.over_s = *over_s;
        apply_config(change.sea, of_sea);
        store_defaults(change.sea.sea);
        first.changes.push_back(std::move(change));
    }
    if (first.changes.empty()) return;
    const bool is_record = weather.changes.front().entries.front().is_recorded;  // whose keys are the fields' names
    if (const std::string reason = check(forecast_of(first)); !reason.empty())
        throw InputError(file.string() + ": " + (is_record ? reason : named_as_keys(reason)));
}

std::optional<std::string> SeaOptions::typed(const std::string& flag) const {
    const auto found = typed_.find(flag);
    return found == typed_.end() ? std::nullopt : found->second;
}

void SeaOptions::require_effects_in(const WeatherConfig& weather, const ResolvedSea& sea,
                                    const SeaState& of_file) const {
    std::vector<SeaState> seas = {sea.sea};
    for (const ResolvedChange& change : sea.changes) seas.push_back(change.sea.sea);
    for (const auto& [flag, value] : typed_)
        if (value) require_effect(flag, "--" + flag, *value, seas);
    seas.push_back(of_file);
    require_effects(weather.first, seas);
    for (const WeatherConfig::Change& change : weather.changes) require_effects(change.entries, seas);
}

ResolvedSea SeaOptions::resolve_with(const std::vector<ConfigEntry>& config, SeaState& of_file) const {
    ResolvedSea resolved;
    if (const auto preset = typed("preset")) {
        apply_preset(resolved, *preset, "--preset");
    } else {
        for (const ConfigEntry& entry : config)
            if (entry.key == "preset") apply_preset(resolved, entry.value, entry.location + ": preset");
    }
    apply_config(resolved, config);
    of_file = resolved.sea;
    if (const auto regular = typed("regular")) {
        if (typed("waves")) throw InputError("--regular cannot be combined with --waves");
        apply_regular(resolved, *regular);
    }
    for (const std::string& flag : configurable_flags())
        if (const auto value = typed(flag); value && flag != "preset") apply(resolved, flag, *value, "--" + flag);
    if (!resolved.has_loop_period) resolved.sea.loop_period_s = loop_period_s_;
    if (!typed_systems_.empty()) resolved.sea.systems = parse_wave_systems(typed_systems_);
    fit_loop(resolved);
    // Checks combinations; each option has been checked individually.
    if (const std::string reason = check(resolved.sea); !reason.empty()) throw InputError(named_as_flags(reason));
    store_defaults(resolved.sea);
    return resolved;
}

std::string peak_period_text(double period_s, double loop_period_s, int digits) {
    const double looped_s = period_in_loop_s(period_s, loop_period_s);
    const std::string text = rounded_text(period_s, digits) + " s";
    return std::fabs(period_s / looped_s - 1) > 0.1 ? text + ", in this loop " + rounded_text(looped_s, digits) + " s"
                                                    : text;
}

std::span<const SeaAngle> sea_angles() { return angle_fields; }

const SeaAngle* sea_angle(std::string_view field) {
    const auto found = std::find_if(angle_fields.begin(), angle_fields.end(),
                                    [&](const auto& angle) { return angle.field == field; });
    return found == angle_fields.end() ? nullptr : found;
}

}  // namespace pelagic::tools
