#include "pelagic/web/bindings/ocean_options.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/web/bindings/named_options.hpp"
#include "pelagic/web/bindings/object_reader.hpp"

namespace pelagic::web {
namespace {

using emscripten::val;

AnalyticSea gerstner_waves_of(const std::string& name, const val& object) {
    ObjectReader reader(name, name + ".", object);
    const val waves = reader.take("waves"), choppiness = reader.take("choppiness");
    reader.end();
    if (!waves.isArray())
        throw std::invalid_argument(invalid_value_message(name + ".waves", text_of(waves), "an array"));
    AnalyticSea sea;
    if (!choppiness.isUndefined())
        sea.choppiness = number_of(
            name + ".choppiness", choppiness, [](double c) { return c >= 0 && c <= 1; }, "[0, 1]");
    for (int i = 0, count = waves["length"].as<int>(); i < count; ++i) {
        const std::string wave_name = name + ".waves[" + number_text(i) + "]";
        const val wave = waves[i];
        ObjectReader wave_reader(wave_name, wave_name + ".", wave);
        wave_reader.take_fields(sea.waves.emplace_back(), analytic_wave_fields());
        wave_reader.end();
    }
    if (!sea.waves.empty()) require_valid(name + ".", check(sea));
    return sea;
}

Ripple ripple_of(const std::string& name, const val& object) {
    ObjectReader reader(name, name + ".", object);
    const val rings = reader.take("ripple");
    reader.end();
    const std::string ripple_name = name + ".ripple";
    ObjectReader ripple_reader(ripple_name, ripple_name + ".", rings);
    Ripple ripple;
    ripple_reader.take_fields(ripple, ripple_fields());
    ripple_reader.end();
    require_valid(ripple_name + ".", check(ripple));
    return ripple;
}

/// Adds the rows of the table's fields to an array.
template <class Options>
val table_of(std::span<const NumericField<Options>> fields, val table = val::array()) {
    for (const NumericField<Options>& field : fields) table.call<void>("push", option_row(field));
    return table;
}

}  // namespace

DynamicWavesOptions dynamic_waves_options_of(const val& object) {
    ObjectReader reader("dynamicWaves", "dynamicWaves.", object);
    DynamicWavesOptions options;
    reader.take_word(options.step, "step");
    reader.take_fields(options, dynamic_waves_fields());
    reader.end();
    require_valid("dynamicWaves.", check(options));
    return options;
}

val options_of(const DynamicWavesOptions& options) {
    val object = val::object();
    object.set("step", std::string(name_of(options.step)));
    for (const NumericField<DynamicWavesOptions>& field : dynamic_waves_fields())
        object.set(camel_case(field.name), field.value_in(options));
    return object;
}

Disturbance disturbance_of(const val& object) {
    ObjectReader reader("disturbance", "", object);
    Disturbance disturbance;
    reader.take_word(disturbance.shape, "shape");
    reader.take_word(disturbance.mode, "mode");
    reader.take_fields(disturbance, disturbance_fields());
    reader.end();
    require_valid("", check(disturbance));
    return disturbance;
}

WaterFrame water_frame_of(const val& object) {
    ObjectReader reader("water", "", object);
    WaterFrame water;
    reader.take_fields(water, water_frame_fields());
    reader.end();
    require_valid("", check(water));
    return water;
}

Rain rain_of(const val& object, const DynamicWavesOptions& options) {
    ObjectReader reader("rain", "", object);
    Rain rain;
    reader.take_fields(rain, rain_fields());
    reader.end();
    require_valid("", check(rain, options));
    return rain;
}

SprayOptions spray_options_of(const val& object) {
    ObjectReader reader("spray", "spray.", object);
    SprayOptions options;
    reader.take_fields(options, spray_fields());
    reader.end();
    return options;
}

SprayEmitter emitter_of(const std::string& name, const val& object) {
    ObjectReader reader(name, name + ".", object);
    SprayEmitter emitter;
    reader.take_fields(emitter, spray_emitter_fields());
    reader.end();
    return emitter;
}

ShoreOptions shore_options_of(const val& object, const SeaState& sea) {
    ObjectReader reader("shore", "shore.", object);
    ShoreOptions options;
    reader.take_fields(options, shore_fields());
    const val heights = reader.take("heightsM");
    reader.end();
    if (!heights.isArray() && !val::global("ArrayBuffer").call<bool>("isView", heights))
        throw std::invalid_argument(invalid_value_message("shore.heightsM", text_of(heights), "an array of numbers"));
    options.heights_m = emscripten::convertJSArrayToNumberVector<float>(heights);
    require_valid("shore.", check(options));
    require_valid("", check(options, sea));
    return options;
}

OceanInput input_of(const std::string& name, const val& object) {
    if (is_object(object) && !object["waves"].isUndefined())
        return {.waves = std::make_shared<GerstnerInput>(gerstner_waves_of(name, object))};
    if (is_object(object) && !object["ripple"].isUndefined())
        return {.ripple = std::make_shared<RippleInput>(ripple_of(name, object))};
    throw std::invalid_argument(invalid_value_message(name, text_of(object), "{waves, choppiness} or {ripple}"));
}

void set_input(OceanInput& input, const std::string& name, const val& object) {
    if (input.waves)
        input.waves->set(gerstner_waves_of(name, object));
    else
        input.ripple->set(ripple_of(name, object));
}

val ocean_option_tables() {
    val grid = val::array(), disturbance = val::array();
    grid.call<void>(
        "push", option_row("step", std::string(name_of(DynamicWavesOptions{}.step)), words_of<DynamicWavesStep>()));
    disturbance.call<void>(
        "push", option_row("shape", std::string(name_of(Disturbance{}.shape)), words_of<Disturbance::Shape>()));
    disturbance.call<void>(
        "push", option_row("mode", std::string(name_of(Disturbance{}.mode)), words_of<Disturbance::Mode>()));
    val tables = val::object();
    tables.set("dynamicWaves", table_of(dynamic_waves_fields(), grid));
    tables.set("disturbance", table_of(disturbance_fields(), disturbance));
    tables.set("rain", table_of(rain_fields()));
    tables.set("shore", table_of(shore_fields()));
    tables.set("spray", table_of(spray_fields()));
    tables.set("sprayEmitter", table_of(spray_emitter_fields()));
    tables.set("analyticWave", table_of(analytic_wave_fields()));
    tables.set("ripple", table_of(ripple_fields()));
    tables.set("waterFrame", table_of(water_frame_fields()));
    return tables;
}

}  // namespace pelagic::web
