// Option tables and checks for the panel and share link of a page, in the module `pelagic_view`:
//
//   pageTables()         {seaOptions, seaPresets, lightOptions, lightPresets, seaSliders,
//                        lightSliders, qualities, shadings}, with the sliders of the native viewer
//   checkSea(options)    {value: every option of the sea} or {error: one line}
//   checkLight(options)  {value: every option of the light, with `stops`} or {error: one line}
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "pelagic/gl/sky/light_presets.hpp"
#include "pelagic/gl/sky/sky.hpp"
#include "pelagic/gl/water/shading.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/quadtree/quadtree_options.hpp"
#include "pelagic/viewer/sliders.hpp"
#include "pelagic/web/bindings/light_options.hpp"
#include "pelagic/web/bindings/named_options.hpp"

namespace pelagic::web {
namespace {

using emscripten::val;
using SkyField = NumericField<gl::SkyOptions>;

/// Returns the double of a float's shortest decimals: 0.6, not 0.6000000238418579.
double short_number(float value) { return std::stod(number_text(value)); }

double number_in(const SkyField& field, const gl::SkyOptions& sky) {
    if (const auto* member = std::get_if<float gl::SkyOptions::*>(&field.member)) return short_number(sky.*(*member));
    return field.value_in(sky);
}

val light_object(const gl::SkyOptions& sky, float stops) {
    val light = val::object();
    for (const SkyField& field : gl::sky_fields()) light.set(camel_case(field.name), number_in(field, sky));
    light.set("placesMoon", sky.places_moon);
    light.set("stops", short_number(stops));
    return light;
}

val light_option_table() {
    val table = val::array();
    const auto add = [&](const std::string& name, val value, const std::string& accepted, val min, val max) {
        val row = val::object();
        row.set("name", name);
        row.set("default", value);
        row.set("accepted", accepted);
        row.set("least", min);
        row.set("most", max);
        table.call<void>("push", row);
    };
    const gl::SkyOptions defaults;
    for (const SkyField& field : gl::sky_fields())
        add(camel_case(field.name), val(number_in(field, defaults)), std::string(field.accepted), val(field.min),
            val(field.max));
    add("placesMoon", val(defaults.places_moon), "true or false", val::undefined(), val::undefined());
    add("stops", val(0), "[-5, 5]", val(-gl::max_bias_stops), val(gl::max_bias_stops));
    return table;
}

val light_preset_table() {
    val table = val::array();
    for (const gl::LightPreset& preset : gl::light_presets()) {
        val row = val::object();
        row.set("name", std::string(preset.name));
        row.set("summary", std::string(preset.meaning));
        row.set("light", light_object(preset.sky, preset.bias_stops));
        table.call<void>("push", row);
    }
    return table;
}

val slider_table(std::span<const viewer::Slider> sliders) {
    val table = val::array();
    for (const viewer::Slider& slider : sliders) {
        val row = val::object();
        row.set("label", std::string(slider.label));
        row.set("option", slider.option == "bias_stops" ? "stops" : camel_case(slider.option));
        row.set("least", slider.min);
        row.set("most", slider.max);
        row.set("format", std::string(slider.format));
        table.call<void>("push", row);
    }
    return table;
}

template <class Names>
val name_table(const Names& names) {
    val table = val::array();
    for (const auto& name : names) table.call<void>("push", std::string(name));
    return table;
}

val page_tables() {
    val qualities = val::array();
    for (const QuadtreePreset& preset : quadtree_presets()) qualities.call<void>("push", std::string(preset.name));
    val tables = val::object();
    tables.set("seaOptions", sea_option_table());
    tables.set("seaPresets", preset_table());
    tables.set("lightOptions", light_option_table());
    tables.set("lightPresets", light_preset_table());
    tables.set("seaSliders", slider_table(viewer::sliders::sea));
    tables.set("lightSliders", slider_table(viewer::sliders::light));
    tables.set("qualities", qualities);
    tables.set("shadings", name_table(names_of<gl::Shading>()));
    return tables;
}

val check_sea(val options) {
    return answer_of([&] { return options_of(sea_with({}, options)); });
}

val check_light(val options) {
    return answer_of([&] {
        const Light light = light_with(options);
        return light_object(light.sky, light.stops);
    });
}

}  // namespace

EMSCRIPTEN_BINDINGS(pelagic_page) {
    emscripten::function("pageTables", &page_tables);
    emscripten::function("checkSea", &check_sea);
    emscripten::function("checkLight", &check_light);
}

}  // namespace pelagic::web
