#include "pelagic/contrib/godot3/ocean_methods.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "pelagic/contrib/godot3/dictionary_options.hpp"
#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic::godot {
namespace {

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

Value save_spray(OceanNode& node) {
    const Ocean* const ocean = node.ocean_with_spray_between_frames();
    if (!ocean) return Value();
    const std::vector<std::uint8_t> saved = ocean->save_spray();
    return Pool<std::uint8_t>(std::span<const std::uint8_t>(saved)).value();
}

/// Calls `use` with the node's dynamic waves, if it has an ocean. Returns nil.
template <class Use>
Value with_waves(OceanNode& node, const Use& use) {
    if (DynamicWaves* const waves = node.dynamic_waves()) use(*waves);
    return Value();
}

const MethodOf<OceanNode> ocean_method_list[] = {
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
    {"sample_water",
     {type_pool_vector3_array},
     "(places)",
     [](OceanNode& node, std::span<Variant* const> arguments) {
         return value_of(node.sample_water(PoolElements<Vector3>(*arguments[0]).all()));
     }},
    {"set_origin",
     {type_real, type_real},
     "(x_m, z_m)",
     [](OceanNode& node, std::span<Variant* const> arguments) {
         return node.set_origin(call(core::variant_as_real, arguments[0]), call(core::variant_as_real, arguments[1])),
                Value();
     }},
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
         return node.restore_dynamic_waves(PoolElements<std::uint8_t>(*arguments[0]).all()), Value();
     }},
    {"dynamic_waves_hash",
     {},
     "()",
     [](OceanNode& node, std::span<Variant* const>) { return value_of(node.dynamic_waves_hash()); }},
    {"set_spray_center",
     {type_vector3},
     "(place)",
     [](OceanNode& node, std::span<Variant* const> arguments) {
         return node.set_spray_center(vector_of(*arguments[0])), Value();
     }},
    {"emit_spray",
     {type_dictionary},
     "(emitter)",
     [](OceanNode& node, std::span<Variant* const> arguments) {
         const SprayEmitter emitter = emitter_of(*arguments[0]);
         if (Ocean* const ocean = node.ocean_with_spray()) ocean->emit({&emitter, 1});
         return Value();
     }},
    {"droplets", {}, "()", [](OceanNode& node, std::span<Variant* const>) { return value_of(node.droplets()); }},
    {"spray_hash", {}, "()", [](OceanNode& node, std::span<Variant* const>) { return value_of(node.spray_hash()); }},
    {"save_spray", {}, "()", [](OceanNode& node, std::span<Variant* const>) { return save_spray(node); }},
    {"restore_spray",
     {type_pool_byte_array},
     "(saved)",
     [](OceanNode& node, std::span<Variant* const> arguments) {
         if (Ocean* const ocean = node.ocean_with_spray_between_frames())
             ocean->restore_spray(PoolElements<std::uint8_t>(*arguments[0]).all());
         return Value();
     }},
};

}  // namespace

std::span<const MethodOf<OceanNode>> ocean_methods() { return ocean_method_list; }

}  // namespace pelagic::godot
