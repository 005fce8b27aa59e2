#include "pelagic/web/bindings/light_options.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/gl/sky/light_presets.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/web/bindings/named_options.hpp"

using emscripten::val;

namespace pelagic::web {
namespace {

Light preset_of(const val& options) {
    if (options["preset"].isUndefined()) return {};
    std::vector<std::string> names;
    for (const gl::LightPreset& preset : gl::light_presets()) names.emplace_back(preset.name);
    const gl::LightPreset& preset = *gl::light_preset_named(word_of("preset", options["preset"], names));
    return {preset.sky, preset.bias_stops};
}

void set_option(Light& light, const std::string& name, const val& value) {
    if (name == "placesMoon") {
        light.sky.places_moon = flag_of(name, value);
        return;
    }
    if (name == "stops") {
        const auto accepts = [](double stops) { return std::abs(stops) <= double{gl::max_bias_stops}; };
        light.stops = static_cast<float>(number_of(name, value, accepts, "[-5, 5]"));
        return;
    }
    for (const NumericField<gl::SkyOptions>& field : gl::sky_fields()) {
        if (camel_case(field.name) != name) continue;
        set_field(light.sky, field, name, value);
        return;
    }
    throw std::invalid_argument(one_line("light has no option " + name));
}

}  // namespace

Light light_with(const val& options) {
    if (options.isUndefined()) return {};
    Light light = preset_of(options);
    for (const std::string& name : keys_of(options))
        if (name != "preset" && !options[name].isUndefined()) set_option(light, name, options[name]);
    return light;
}

}  // namespace pelagic::web
