#include "pelagic/tools/options/sea_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "pelagic/tools/options/config_file.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"
#include "pelagic/tools/text/wind_text.hpp"

namespace pelagic::tools {
namespace {

constexpr double radians_per_degree = std::numbers::pi / 180;

/// A numeric flag and its field of SeaState.
struct SeaFlag {
    std::string_view flag;
    std::string_view field;
    std::string_view help;
};

constexpr std::array sea_flags = {
    SeaFlag{"cascades", "cascades", "number of cascades, each a band of wavelengths; their sides depend on the sea"},
    SeaFlag{"resolution", "resolution", "texels along a side of a cascade"},
    SeaFlag{"patch-size", "patch_size_m", "use one cascade with this side in metres; the sea repeats after it"},
    SeaFlag{"wind-speed", "wind_speed_mps", "mean wind speed 10 m above the sea"},
    SeaFlag{"wind-direction", "wind_direction_rad",
            "direction towards which the wind blows, from +x (east) towards +z (south; north is -z)"},
    SeaFlag{"fetch", "fetch_m", "fetch in metres (jonswap); more than 17,000 U^2 / g has no further effect"},
    SeaFlag{"depth", "depth_m", "water depth in metres; waves higher than 0.6 of it break"},
    SeaFlag{"choppiness", "choppiness", "scale of the horizontal displacement, which sharpens crests"},
    SeaFlag{
        "roughness", "roughness",
        "roughness of unresolved waves; wind: slope variance of a sea at this wind that the grid does not resolve"},
    SeaFlag{"short-wave-cutoff", "short_wave_cutoff",
            "damping of short waves; 1 removes waves shorter than a quarter of the peak wavelength"},
    SeaFlag{"wind-alignment", "wind_alignment",
            "alignment of the waves with the wind (spreading paper); a third of the energy runs against the wind at "
            "0, a hundredth at 1"},
    SeaFlag{"swell-height", "swell_height_m", "significant wave height of the swell in metres; 0: no swell"},
    SeaFlag{"swell-period", "swell_period_s", "peak period of the swell in seconds"},
    SeaFlag{"swell-direction", "swell_direction_rad", "direction towards which the swell runs, as --wind-direction"},
    SeaFlag{"swell-spread", "swell_spread_rad", "standard deviation of the swell's directions"},
    SeaFlag{"loop-period", "loop_period_s", "time in seconds after which the sea repeats exactly"},
    SeaFlag{"seed", "seed", "seed of the random phases and amplitudes"},
    SeaFlag{"wave-count", "wave_count", "number of analytic waves, or octaves of pond waves"},
    SeaFlag{"longest-wave", "longest_wave_m", "longest wavelength of analytic or pond waves in metres"},
    SeaFlag{"shortest-wave", "shortest_wave_m", "shortest wavelength of analytic or pond waves in metres"},
    SeaFlag{"wave-strength", "wave_strength", "strength of analytic waves: 0 calm, 1 moderate, 2 intense"},
    SeaFlag{"wave-height", "wave_height_m", "significant wave height of analytic or pond waves in metres"},
    SeaFlag{"wave-drag", "wave_drag", "displacement of a pond's short waves by its long waves"},
};

const SeaStateField& field_of(const SeaFlag& flag) {
    const auto fields = sea_state_fields();
    return *std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.name == flag.field; });
}

bool is_angle(const SeaFlag& flag) { return sea_angle(flag.field) != nullptr; }
bool is_roughness(const SeaFlag& flag) { return flag.field == "roughness"; }
bool is_direction(const SeaFlag& flag) { return flag.field.ends_with("_direction_rad"); }
bool is_speed(const SeaFlag& flag) { return flag.field == "wind_speed_mps"; }

std::string accepted_by(const SeaFlag& flag) {
    if (is_direction(flag)) return "degrees in [-360, 360], or one of 16 points such as from-NW or to-SE";
    if (is_angle(flag)) return "degrees in [1, 80]";
    if (is_roughness(flag)) return "[0, 1] or wind";
    const std::string accepted(field_of(flag).accepted);
    return is_speed(flag) ? accepted + " " + speed_units : accepted;
}

/// Returns true if a config file may contain a string for this flag, such as "20kn" or "from-NW".
bool takes_words(const SeaFlag& flag) { return is_direction(flag) || is_speed(flag) || is_roughness(flag); }

/// Parses a value in the flag's unit; the unit of angles is degrees.
std::optional<double> parse_value(const SeaFlag& flag, const std::string& text) {
    if (is_speed(flag)) return parse_speed_mps(text);
    if (is_roughness(flag) && text == "wind") return -1;
    if (is_direction(flag))
        if (const auto degrees = parse_compass_deg(text)) return degrees;
    const bool is_whole = !std::holds_alternative<double SeaState::*>(field_of(flag).member);
    if (is_whole && !parse_integer(text)) return {};
    return parse_number(text);
}

std::string default_of(const SeaFlag& flag) {
    if (is_roughness(flag)) return "wind";
    if (flag.field == "cascades") return number_text(default_cascades) + "; 1 with --patch-size";
    if (flag.field == "resolution") return "128; 256 with --patch-size";
    if (flag.field == "patch_size_m") return "several cascades";
    if (flag.field == "wave_count") return "16; pond: 24";
    if (flag.field == "longest_wave_m") return "120; pond: 1.2";
    if (flag.field == "shortest_wave_m") return "1/60 of the longest; pond: 1/45";
    if (flag.field == "wave_height_m") return "depends on --wave-strength; pond: 0.017 of the longest wave";
    const SeaAngle* const angle = sea_angle(flag.field);
    return number_text(angle ? ResolvedSea{}.*angle->degrees : field_of(flag).value_in({}));
}

std::string config_key(std::string_view flag) {
    std::string key(flag);
    std::replace(key.begin(), key.end(), '-', '_');
    return key;
}

bool is_force(const SeaPreset& preset) { return preset.name.starts_with("beaufort-"); }

/// Returns one line per preset. The thirteen presets of Beaufort forces share one line.
std::string help_of_presets() {
    std::string help = "sea preset:";
    for (const SeaPreset& preset : sea_presets())
        if (!is_force(preset)) help.append("\n").append(preset.name).append(": ").append(preset.summary);
    return help + "\nbeaufort-0 to beaufort-12: open sea of this Beaufort force, Hs 0 to 14 m";
}

/// Returns degrees rounded to 1e-6 if they convert to exactly these radians: 30, not
/// 29.999999999999996.
double degrees_of(double radians) {
    const double degrees = radians / radians_per_degree, typed = std::round(1e6 * degrees) / 1e6;
    return typed * radians_per_degree == radians ? typed : degrees;
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

void apply_number(ResolvedSea& resolved, const SeaFlag& flag, const std::string& text, const std::string& option) {
    const SeaStateField& field = field_of(flag);
    const std::optional<double> number = parse_value(flag, text);
    if (is_direction(flag) && is_compass_point(text))
        throw bad_value(
            option, text,
            "from-" + text + " or to-" + text + ": winds are named for where they come from, seas by where they go");
    const SeaAngle* const angle = sea_angle(flag.field);
    const double value = number ? (angle ? *number * radians_per_degree : *number) : 0;
    if (!number || !field.accepts(value)) throw bad_value(option, text, accepted_by(flag));

    field.set(resolved.sea, value);
    if (flag.field == "loop_period_s") resolved.has_loop_period = true;
    if (angle) resolved.*angle->degrees = *number;
}

/// Applies one option other than the preset. \param name  name of the flag
void apply(ResolvedSea& resolved, std::string_view name, const std::string& text, const std::string& option) {
    const auto set = [&]<class Enum>(std::string_view flag, Enum SeaState::*member) {
        if (name == flag) resolved.sea.*member = one_of<Enum>(option, text);
    };
    set("waves", &SeaState::waves);
    set("spectrum", &SeaState::spectrum);
    set("spreading", &SeaState::spreading);
    for (const SeaFlag& flag : sea_flags)
        if (flag.flag == name) apply_number(resolved, flag, text, option);
}

/// Returns the names of the flags that a config file may contain, the preset first.
std::vector<std::string> configurable_flags() {
    std::vector<std::string> flags = {"preset", "waves", "spectrum", "spreading"};
    for (const SeaFlag& flag : sea_flags) flags.emplace_back(flag.flag);
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
            const std::string place = entry.place + ": " + entry.key;
            for (const SeaFlag& number : sea_flags)
                if (number.flag == flag && entry.quoted && (parse_number(entry.value) || !takes_words(number)))
                    throw bad_value(place, '"' + entry.value + '"',
                                    "a number without quotes: " + accepted_by(number));
            apply(resolved, flag, entry.value, place);
        }
}

/// Stores the default cascades and resolution explicitly, so that files do not depend on the
/// defaults of a version.
void store_defaults(SeaState& sea) {
    const int cascades = cascades_of(sea), resolution = resolution_of(sea);
    sea.cascades = cascades;
    sea.resolution = resolution;
}

constexpr double max_time_s = 1e9;
/// Cascades are planned for all seas of a forecast, some milliseconds each before the first frame.
constexpr std::size_t max_changes = 1000;
constexpr double max_swell_from_m = 2e7;

}  // namespace

void SeaOptions::add_to(CLI::App& app) {
    const auto add = [&](std::string_view flag, const std::string& type, const std::string& help) {
        const std::string name(flag);
        app.add_option("--" + name, typed_[name], help)->type_name(type)->group("Sea");
    };
    add("preset", "NAME", help_of_presets());
    const auto with_default = [](const std::string& text, std::string_view value) {
        return text + " (default: " + std::string(value) + ")";
    };
    add("config", "FILE",
        "read sea options from a TOML file, whose keys are the names of these flags with underscores, or from a "
        "sea.json of export; flags override the file");
    add("waves", "NAME",
        with_default("wave model: " + list_of(names_of<WaveModel>()) +
                         "; a wind-wave spectrum, up to 64 analytic waves between calm and storm, or pond waves",
                     name_of(SeaState{}.waves)));
    add("spectrum", "NAME",
        with_default("wave spectrum: " + list_of(names_of<SpectrumModel>()), name_of(SeaState{}.spectrum)));
    add("spreading", "NAME",
        with_default("directional spreading of the waves: " + list_of(names_of<SpreadingModel>()),
                     name_of(SeaState{}.spreading)));
    for (const SeaFlag& flag : sea_flags)
        add(flag.flag, is_direction(flag) || is_speed(flag) ? "WIND" : "NUMBER",
            with_default(std::string(flag.help) + "; " + accepted_by(flag), default_of(flag)));
}

bool SeaOptions::is_given() const {
    return std::any_of(typed_.begin(), typed_.end(), [](const auto& flag) { return flag.second.has_value(); });
}

void SeaOptions::add_weather_to(CLI::App& app) {
    app.add_option(
           "--weather", typed_["weather"],
           "read a sea and its transitions from a TOML file as for --config, with a table [[change]] for each "
           "transition: keys from and over in seconds, swell_from in metres for a swell from a distance, and "
           "the options that change, such as preset; or from a sea.json of an export with --weather")
        ->type_name("FILE")
        ->group("Sea");
}

ResolvedSea SeaOptions::resolve() const {
    const auto file = typed("config"), weather_file = typed("weather");
    if (!weather_file) return resolve_with(file ? read_config(*file, config_keys()) : std::vector<ConfigEntry>());
    if (file)
        throw InputError("--config is " + *file + " and --weather is " + *weather_file +
                         "; give one of the two: the first sea stands in both");
    const WeatherConfig weather = read_weather(*weather_file, config_keys());
    ResolvedSea sea = resolve_with(weather.first);
    add_changes(sea, weather, *weather_file);
    return sea;
}

ResolvedSea SeaOptions::of_record(std::string_view text, const std::filesystem::path& file) {
    const WeatherConfig weather = parse_weather_record(text, file, config_keys());
    ResolvedSea sea = SeaOptions().resolve_with(weather.first);
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
            const std::string option = entry.place + ": " + entry.key;
            const auto number = [&](double min, double max, const std::string& accepted) {
                if (entry.quoted)
                    throw bad_value(option, '"' + entry.value + '"', "a number without quotes: " + accepted);
                return number_in(option, entry.value, min, max, accepted);
            };
            if (entry.key == "from")
                from_s = number(-max_time_s, max_time_s, "seconds in [-1e9, 1e9]");
            else if (entry.key == "over")
                over_s = number(0, max_time_s, "seconds in (0, 1e9]");
            else if (entry.key == "swell_from")
                change.swell_from_m = number(0, max_swell_from_m, "metres in [1e3, 2e7], or 0");
            else if (entry.key == "preset") {
                apply_preset(change.sea, entry.value, option);
                keep_constant_fields(change.sea.sea, first.sea);
            } else {
                of_sea.push_back(entry);
            }
        }
        if (!from_s)
            throw InputError(config.place + ": from is missing: the time when the change begins, in seconds");
        if (!over_s)
            throw InputError(config.place + ": over is missing, expected how long the change takes, in seconds");
        change.from_s = *from_s;
        change.over_s = *over_s;
        apply_config(change.sea, of_sea);
        store_defaults(change.sea.sea);
        first.changes.push_back(std::move(change));
    }
    if (first.changes.empty()) return;
    if (const std::string reason = check(forecast_of(first)); !reason.empty())
        throw InputError(file.string() + ": " + reason);
}

std::optional<std::string> SeaOptions::typed(const std::string& flag) const {
    const auto found = typed_.find(flag);
    return found == typed_.end() ? std::nullopt : found->second;
}

ResolvedSea SeaOptions::resolve_with(const std::vector<ConfigEntry>& config) const {
    ResolvedSea resolved;
    if (const auto preset = typed("preset")) {
        apply_preset(resolved, *preset, "--preset");
    } else {
        for (const ConfigEntry& entry : config)
            if (entry.key == "preset") apply_preset(resolved, entry.value, entry.place + ": preset");
    }
    apply_config(resolved, config);
    for (const std::string& flag : configurable_flags())
        if (const auto value = typed(flag); value && flag != "preset") apply(resolved, flag, *value, "--" + flag);
    // Checks combinations; each option has been checked individually.
    if (const std::string reason = check(resolved.sea); !reason.empty()) throw InputError(reason);
    store_defaults(resolved.sea);
    return resolved;
}

}  // namespace pelagic::tools
