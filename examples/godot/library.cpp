// Entry points of the library: initialisation and registration of its class.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/examples/godot/dictionary_options.hpp"
#include "pelagic/examples/godot/ocean_node.hpp"
#include "pelagic/examples/godot/properties.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/one_line.hpp"

namespace pelagic::godot {
namespace {

constexpr const char* class_name = "PelagicOcean";

const NativeScriptApi* nativescript = nullptr;

/// Catches exceptions and prints them, because no exception may leave the library.
template <class Work>
auto guarded(OceanNode& node, const Work& work) -> decltype(work()) {
    try {
        return work();
    } catch (const std::exception& error) {
        node.reject(one_line(error.what()));
    }
    return decltype(work())();
}

OceanNode& node_of(void* instance) { return *static_cast<OceanNode*>(instance); }

bool is_number(VariantType type) { return type == type_int || type == type_real; }

void set_property(Object*, void* data, void* instance, Variant* value) {
    const auto& property = *static_cast<const Property*>(data);
    OceanNode& node = node_of(instance);
    guarded(node, [&] {
        const VariantType type = call(core::variant_get_type, value);
        const bool fits = type == property.type || (is_number(type) && is_number(property.type)) ||
                          (type == type_nil && property.type == type_object);
        if (!fits) return node.reject(invalid_value_message(property.name, Text(*value).utf8(), property.accepted));
        property.set(node, *value);
    });
}

Variant get_property(Object*, void* data, void* instance) {
    return static_cast<const Property*>(data)->get(node_of(instance)).handed_over();
}

/// A method for scripts. Returns nil if the call fails.
struct ScriptMethod {
    const char* name;
    std::vector<VariantType> arguments;
    const char* usage;
    Value (*call)(OceanNode& node, std::span<Variant* const> arguments);
};

Vector3 vector_of(const Variant& value) {
    const Vector3Bytes bytes = call(core::variant_as_vector3, &value);
    Vector3 vector;
    std::memcpy(&vector, &bytes, sizeof vector);
    return vector;
}

Value value_of(const std::unique_ptr<Table>& table) { return table ? Value(table->dictionary()) : Value(); }

Value query(OceanNode& node, const Variant& places) {
    return value_of(node.query(PoolElements<Vector3>(places).all()));
}

/// Returns 16 hexadecimal digits, as the command line prints hashes.
Value value_of(const std::optional<std::uint64_t>& hash) {
    if (!hash) return Value();
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(*hash));
    return Value(text);
}

std::uint32_t source_number_of(const Variant& value) {
    const double number = call(core::variant_as_real, &value);
    if (!(number >= 0 && number <= UINT32_MAX && number == std::floor(number)))
        throw std::invalid_argument(invalid_value_message("number", number, "a number that add_source() returned"));
    return static_cast<std::uint32_t>(number);
}

Value add_source(OceanNode& node, const Variant& source) {
    const Disturbance ours = disturbance_of(source);
    DynamicWaves* const waves = node.dynamic_waves();
    return waves ? Value(static_cast<std::int64_t>(waves->add_source(ours))) : Value();
}

Value save_state(OceanNode& node) {
    const DynamicWaves* const waves = node.dynamic_waves_between_frames();
    if (!waves) return Value();
    const std::vector<std::uint8_t> saved = waves->save_state();
    return Pool<std::uint8_t>(std::span<const std::uint8_t>(saved)).value();
}

/// Calls `use` with the node's dynamic waves, if it has an ocean. Returns nil.
template <class Use>
Value with_waves(OceanNode& node, const Use& use) {
    if (DynamicWaves* const waves = node.dynamic_waves()) use(*waves);
    return Value();
}

const ScriptMethod script_methods[] = {
    {"_enter_tree", {}, "()", [](OceanNode& node, std::span<Variant* const>) { return node.enter_tree(), Value(); }},
    {"_exit_tree", {}, "()", [](OceanNode& node, std::span<Variant* const>) { return node.exit_tree(), Value(); }},
    {"_process",
     {type_real},
     "(delta)",
     [](OceanNode& node, std::span<Variant* const> arguments) {
         return node.process(call(core::variant_as_real, arguments[0])), Value();
     }},
    {"hash", {}, "()", [](OceanNode& node, std::span<Variant* const>) { return value_of(node.hash()); }},
    {"significant_wave_height",
     {},
     "()",
     [](OceanNode& node, std::span<Variant* const>) {
         const auto height_m = node.significant_wave_height_m();
         return height_m ? Value(*height_m) : Value();
     }},
    {"height_at",
     {type_vector3},
     "(place)",
     [](OceanNode& node, std::span<Variant* const> arguments) {
         const auto height_m = node.height_at(vector_of(*arguments[0]));
         return height_m ? Value(static_cast<double>(*height_m)) : Value();
     }},
    {"query",
     {type_pool_vector3_array},
     "(places)",
     [](OceanNode& node, std::span<Variant* const> arguments) { return query(node, *arguments[0]); }},
    {"first_hit",
     {type_vector3, type_vector3, type_real},
     "(origin, direction, reach_m)",
     [](OceanNode& node, std::span<Variant* const> arguments) {
         return value_of(node.first_hit(vector_of(*arguments[0]), vector_of(*arguments[1]),
                                        call(core::variant_as_real, arguments[2])));
     }},
    {"add_impulse",
     {type_dictionary},
     "(disturbance)",
     [](OceanNode& node, std::span<Variant* const> arguments) {
         const Disturbance ours = disturbance_of(*arguments[0]);
         return with_waves(node, [&](DynamicWaves& waves) { waves.add_impulse(ours); });
     }},
    {"add_source",
     {type_dictionary},
     "(source)",
     [](OceanNode& node, std::span<Variant* const> arguments) { return add_source(node, *arguments[0]); }},
    {"set_source",
     {type_int, type_dictionary},
     "(number, source)",
     [](OceanNode& node, std::span<Variant* const> arguments) {
         const std::uint32_t number = source_number_of(*arguments[0]);
         const Disturbance ours = disturbance_of(*arguments[1]);
         return with_waves(node, [&](DynamicWaves& waves) { waves.set_source(number, ours); });
     }},
    {"remove_source",
     {type_int},
     "(number)",
     [](OceanNode& node, std::span<Variant* const> arguments) {
         const std::uint32_t number = source_number_of(*arguments[0]);
         return with_waves(node, [&](DynamicWaves& waves) { waves.remove_source(number); });
     }},
    {"set_center",
     {type_vector3},
     "(place)",
     [](OceanNode& node, std::span<Variant* const> arguments) {
         const Vector3 place = vector_of(*arguments[0]);
         return with_waves(node, [&](DynamicWaves& waves) {
             waves.set_center(static_cast<double>(place.x), static_cast<double>(place.z));
         });
     }},
    {"set_rain",
     {type_dictionary},
     "(rain)",
     [](OceanNode& node, std::span<Variant* const> arguments) {
         const Rain ours = rain_of(*arguments[0]);
         return with_waves(node, [&](DynamicWaves& waves) { waves.set_rain(ours); });
     }},
    {"save_state", {}, "()", [](OceanNode& node, std::span<Variant* const>) { return save_state(node); }},
    {"restore_state",
     {type_pool_byte_array},
     "(saved)",
     [](OceanNode& node, std::span<Variant* const> arguments) {
         if (DynamicWaves* const waves = node.dynamic_waves_between_frames())
             waves->restore_state(PoolElements<std::uint8_t>(*arguments[0]).all());
         return Value();
     }},
    {"dynamic_waves_hash",
     {},
     "()",
     [](OceanNode& node, std::span<Variant* const>) { return value_of(node.dynamic_waves_hash()); }},
};

bool are_right(const ScriptMethod& method, std::span<Variant* const> arguments) {
    if (arguments.size() != method.arguments.size()) return false;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const VariantType type = call(core::variant_get_type, arguments[i]);
        if (type != method.arguments[i] && !(is_number(type) && is_number(method.arguments[i]))) return false;
    }
    return true;
}

Variant call_method(Object*, void* data, void* instance, int count, Variant** arguments) {
    const auto& method = *static_cast<const ScriptMethod*>(data);
    OceanNode& node = node_of(instance);
    const std::span<Variant* const> all(arguments, static_cast<std::size_t>(count));
    std::optional<Variant> answer;
    guarded(node, [&] {
        if (!are_right(method, all))
            return node.reject(std::string(method.name) + " is called as " + method.name + method.usage);
        answer = method.call(node, all).handed_over();
    });
    return answer ? *answer : Value().handed_over();
}

void register_properties(void* library) {
    const OceanNode defaults(nullptr);
    for (const Property& property : properties()) {
        const Text hint(property.hint_text);
        const Value value = property.get(defaults);
        PropertyAttributes attributes{0, property.type, property.hint, hint.string(), usage_default, value.variant()};
        void* data = const_cast<Property*>(&property);
        nativescript->register_property(library, class_name, property.name.c_str(), &attributes,
                                        {set_property, data, nullptr}, {get_property, data, nullptr});
    }
}

void register_signals(void* library) {
    const Text name("refused"), argument("why"), no_hint("");
    const Value nothing;
    SignalArgument why{argument.string(), type_string, hint_none, no_hint.string(), usage_default, nothing.variant()};
    const Signal refused{name.string(), 1, &why, 0, nullptr};
    nativescript->register_signal(library, class_name, &refused);
}

}  // namespace
}  // namespace pelagic::godot

#define PELAGIC_GODOT_EXPORT extern "C" __attribute__((visibility("default")))

PELAGIC_GODOT_EXPORT void godot_gdnative_init(pelagic::godot::InitOptions* options) {
    using namespace pelagic::godot;
    const ApiVersion have = options->api->table.version;
    if (have.major != 1) return options->report_version_mismatch(options->library, "Core", {1, 0}, have);
    set_core_api(options->api);
    for (unsigned i = 0; i < options->api->extension_count; ++i)
        if (options->api->extensions[i]->type == nativescript_api)
            nativescript = reinterpret_cast<const NativeScriptApi*>(options->api->extensions[i]);
}

PELAGIC_GODOT_EXPORT void godot_gdnative_terminate(void*) {}

PELAGIC_GODOT_EXPORT void godot_nativescript_init(void* library) {
    using namespace pelagic::godot;
    if (!nativescript) return;  // godot_gdnative_init() has reported the reason
    const auto create = [](Object* self, void*) -> void* { return new OceanNode(self); };
    const auto destroy = [](Object*, void*, void* instance) { delete static_cast<OceanNode*>(instance); };
    nativescript->register_class(library, class_name, "Spatial", {create, nullptr, nullptr},
                                 {destroy, nullptr, nullptr});
    for (const ScriptMethod& method : script_methods)
        nativescript->register_method(library, class_name, method.name, {0},
                                      {call_method, const_cast<ScriptMethod*>(&method), nullptr});
    register_properties(library);
    register_signals(library);
}
