#include "pelagic/contrib/godot3/properties.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic::godot {
namespace {

double number(const Variant& value) { return call(core::variant_as_real, &value); }

/// A numeric property whose values `accepts` checks.
OceanProperty number_property(std::string name, VariantType type, std::string range, PropertyHint hint,
                         std::function<double(const OceanSettings&)> get,
                         std::function<void(OceanSettings&, double)> set, std::function<bool(double)> accepts,
                         std::string accepted) {
    const auto value_of = [type, get](const OceanNode& node) {
        const double value = get(node.settings());
        return type == type_int ? Value(static_cast<std::int64_t>(value)) : Value(value);
    };
    const auto take = [=](OceanNode& node, const Variant& variant) {
        const double value = number(variant);
        if (value == get(node.settings())) return;
        if (!accepts(value)) return node.reject(invalid_value_message(name, value, accepted));
        node.change([&](OceanSettings& settings) { set(settings, value); });
    };
    return {name, type, hint, std::move(range), value_of, take, accepted};
}

template <class Options>
bool is_whole(const NumericField<Options>& field) {
    return !std::holds_alternative<double Options::*>(field.member) &&
           !std::holds_alternative<float Options::*>(field.member);
}

/// A property of a numeric field of options, which the setting `member` holds.
template <class Options>
OceanProperty field_property(std::string name, Options OceanSettings::*member, const NumericField<Options>& field,
                        std::string range, PropertyHint hint) {
    return number_property(
        std::move(name), is_whole(field) ? type_int : type_real, std::move(range), hint,
        [member, &field](const OceanSettings& settings) { return field.value_in(settings.*member); },
        [member, &field](OceanSettings& settings, double value) { field.set(settings.*member, value); },
        [&field](double value) { return field.accepts(value) && (!is_whole(field) || value == std::floor(value)); },
        std::string(field.accepted));
}

/// Appends a property for each field of a table. Its name is the prefix and the field's name.
template <class Options>
void add_fields(std::vector<OceanProperty>& all, const std::string& prefix, Options OceanSettings::*member,
                std::span<const NumericField<Options>> fields) {
    // ratio of the limits from which the editor's slider is exponential
    constexpr double wide = 1000;
    for (const NumericField<Options>& field : fields) {
        const double min = field.also ? std::min(*field.also, field.min) : field.min;
        const bool is_wide = min > 0 && field.max > wide * min;
        all.push_back(
            field_property(prefix + std::string(field.name), member, field,
                           number_text(min) + "," + number_text(field.max) + (is_whole(field) ? ",1" : ",0.001"),
                           is_wide ? hint_exp_range : hint_range));
    }
}

OceanProperty ranged(std::string name, VariantType type, double min, double max, std::string range,
                     std::string accepted, std::function<double(const OceanSettings&)> get,
                     std::function<void(OceanSettings&, double)> set) {
    return number_property(
        std::move(name), type, std::move(range), hint_range, std::move(get), std::move(set),
        [=](double value) {
            return value >= min && value <= max && (type != type_int || value == std::floor(value));
        },
        std::move(accepted));
}

OceanProperty flag(std::string name, bool OceanSettings::*member) {
    return {name,
            type_bool,
            hint_none,
            "",
            [member](const OceanNode& node) { return Value(node.settings().*member); },
            [member](OceanNode& node, const Variant& value) {
                const bool wanted = call(core::variant_as_bool, &value);
                if (wanted == node.settings().*member) return;
                node.change([&](OceanSettings& settings) { settings.*member = wanted; });
            },
            "true or false"};
}

/// A property with a list of names.
OceanProperty choice(std::string name, std::string names, std::string OceanSettings::*member,
                std::function<bool(std::string_view)> is_one) {
    return {name,
            type_string,
            hint_enum,
            names,
            [member](const OceanNode& node) { return Value(std::string_view(node.settings().*member)); },
            [=](OceanNode& node, const Variant& value) {
                const std::string wanted = Text(value).utf8();
                if (!is_one(wanted)) return node.reject(invalid_value_message(name, wanted, "one of " + names));
                if (wanted == node.settings().*member) return;
                node.change([&](OceanSettings& settings) { settings.*member = wanted; });
            },
            "one of " + names};
}

std::string preset_names() {
    std::string names(no_preset);
    for (const SeaPreset& preset : sea_presets()) names.append(",").append(preset.name);
    return names;
}

/// A property of the sea level or of the current, which may change in every frame.
OceanProperty water_property(const NumericField<WaterFrame>& field) {
    const std::string name(field.name), accepted(field.accepted);
    return {name,
            type_real,
            hint_range,
            number_text(field.min) + "," + number_text(field.max) + ",0.001",
            [&field](const OceanNode& node) { return Value(field.value_in(node.water_frame())); },
            [=, &field](OceanNode& node, const Variant& variant) {
                const double value = number(variant);
                if (!field.accepts(value)) return node.reject(invalid_value_message(name, value, accepted));
                WaterFrame water = node.water_frame();
                field.set(water, value);
                node.set_water_frame(water);
            },
            accepted};
}

/// The step of dynamic waves, by its name.
OceanProperty step_property() {
    static constexpr std::array<std::string_view, 2> names = {"spectral", "verlet"};
    return {"dynamic_waves_step",
            type_string,
            hint_enum,
            "spectral,verlet",
            [](const OceanNode& node) {
                return Value(names[static_cast<std::size_t>(node.settings().dynamic_waves_options.step)]);
            },
            [](OceanNode& node, const Variant& value) {
                const std::string wanted = Text(value).utf8();
                const auto found = std::find(names.begin(), names.end(), wanted);
                if (found == names.end())
                    return node.reject(invalid_value_message("dynamic_waves_step", wanted, "spectral or verlet"));
                const auto step = static_cast<DynamicWavesStep>(found - names.begin());
                if (step == node.settings().dynamic_waves_options.step) return;
                node.change([&](OceanSettings& settings) { settings.dynamic_waves_options.step = step; });
            },
            "spectral or verlet"};
}

OceanProperty shore_heights_property() {
    return {"shore_heights_m",
            type_pool_real_array,
            hint_none,
            "",
            [](const OceanNode& node) {
                return Pool<float>(std::span<const float>(node.settings().shore.heights_m)).value();
            },
            [](OceanNode& node, const Variant& value) {
                const PoolElements<float> elements(value);
                const std::span<const float> heights = elements.all();
                const std::vector<float>& now = node.settings().shore.heights_m;
                if (std::equal(heights.begin(), heights.end(), now.begin(), now.end())) return;
                node.change([&](OceanSettings& settings) {
                    settings.shore.heights_m.assign(heights.begin(), heights.end());
                });
            },
            "a PoolRealArray"};
}

/// The options of the sea: each number of sea_state_fields(), and directions in degrees.
void add_sea(std::vector<OceanProperty>& all) {
    const auto direction = [&](std::string name, double OceanSettings::*member) {
        all.push_back(ranged(
            std::move(name), type_real, -360, 360, "-360,360,1", "[-360, 360]",
            [member](const OceanSettings& settings) { return settings.*member; },
            [member](OceanSettings& settings, double value) { settings.*member = value; }));
    };
    static const std::vector<NumericField<SeaState>> fields = [] {
        std::vector<NumericField<SeaState>> in_own_unit;
        for (const SeaStateField& field : sea_state_fields())
            if (!field.name.ends_with("_rad")) in_own_unit.push_back(field);
        return in_own_unit;
    }();
    add_fields<SeaState>(all, "", &OceanSettings::sea, fields);
    direction("wind_direction_deg", &OceanSettings::wind_direction_deg);
    direction("swell_direction_deg", &OceanSettings::swell_direction_deg);
}

std::vector<OceanProperty> ocean_property_table() {
    std::vector<OceanProperty> all = {
        choice("preset", preset_names(), &OceanSettings::preset,
               [](std::string_view name) { return name == no_preset || sea_preset_named(name); })};
    add_sea(all);
    const std::vector<OceanProperty> others = {
        flag("foam", &OceanSettings::foam),
        flag("velocities", &OceanSettings::velocities),
        flag("depth", &OceanSettings::depth),
        choice("interpolation", "linear,cubic", &OceanSettings::interpolation,
               [](std::string_view name) { return value_named<Interpolation>(name).has_value(); }),
        ranged(
            "footprint_m", type_real, 0, 1000, "0,1000,0.1", "[0, 1000]",
            [](const OceanSettings& settings) { return settings.footprint_m; },
            [](OceanSettings& settings, double value) { settings.footprint_m = value; }),
        ranged(
            "threads", type_int, 0, 1024, "0,1024,1", "a whole number from 0 to 1024",
            [](const OceanSettings& settings) { return static_cast<double>(settings.threads); },
            [](OceanSettings& settings, double value) { settings.threads = static_cast<int>(value); }),
        choice("quality", "low,medium,high,ultra", &OceanSettings::quality, is_quality),
        ranged(
            "size_m", type_real, 256, 8192, "256,8192,256", "[256, 8192]",
            [](const OceanSettings& settings) { return settings.size_m; },
            [](OceanSettings& settings, double value) { settings.size_m = value; }),
        {"time_s", type_real, hint_none, "", [](const OceanNode& node) { return Value(node.time_s()); },
         [](OceanNode& node, const Variant& value) { node.set_time(number(value)); }, "[-1e9, 1e9]"},
        {"playing", type_bool, hint_none, "", [](const OceanNode& node) { return Value(node.is_playing()); },
         [](OceanNode& node, const Variant& value) { node.set_playing(call(core::variant_as_bool, &value)); },
         "true or false"},
        {"material", type_object, hint_resource_type, "ShaderMaterial",
         [](const OceanNode& node) { return node.material(); },
         [](OceanNode& node, const Variant& value) { node.set_material(value); }, "a ShaderMaterial"},
        flag("dynamic_waves", &OceanSettings::dynamic_waves),
        step_property(),
    };
    all.insert(all.end(), others.begin(), others.end());
    add_fields(all, "dynamic_waves_", &OceanSettings::dynamic_waves_options, dynamic_waves_fields());
    all.push_back(flag("spray", &OceanSettings::spray));
    add_fields(all, "spray_", &OceanSettings::spray_options, spray_fields());
    for (const NumericField<WaterFrame>& field : water_frame_fields()) all.push_back(water_property(field));
    all.push_back(shore_heights_property());
    add_fields(all, "shore_", &OceanSettings::shore, shore_fields());
    return all;
}

}  // namespace

const std::vector<OceanProperty>& properties() {
    static const std::vector<OceanProperty> all = ocean_property_table();
    return all;
}

}  // namespace pelagic::godot
