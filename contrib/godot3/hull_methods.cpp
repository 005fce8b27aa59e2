#include "pelagic/contrib/godot3/hull_methods.hpp"

#include <cstdint>
#include <vector>

namespace pelagic::godot {
namespace {

using Arguments = std::span<Variant* const>;

Value save_state(HullNode& hull) {
    const std::vector<std::uint8_t> saved = hull.save_state();
    return Pool<std::uint8_t>(std::span<const std::uint8_t>(saved)).value();
}

const MethodOf<HullNode> hull_method_list[] = {
    {"_physics_process",
     {type_real},
     "(delta)",
     [](HullNode& hull, Arguments arguments) {
         return hull.physics_process(call(core::variant_as_real, arguments[0])), Value();
     }},
    {"_exit_tree", {}, "()", [](HullNode& hull, Arguments) { return hull.leave_waves(), Value(); }},
    {"launch", {}, "()", [](HullNode& hull, Arguments) { return hull.launch(), Value(); }},
    {"step",
     {type_real},
     "(step_s)",
     [](HullNode& hull, Arguments arguments) {
         return Value(hull.step(call(core::variant_as_real, arguments[0])));
     }},
    {"shift",
     {type_real, type_real},
     "(x_m, z_m)",
     [](HullNode& hull, Arguments arguments) {
         const double x_m = call(core::variant_as_real, arguments[0]), z_m = call(core::variant_as_real, arguments[1]);
         return hull.shift(x_m, z_m), Value();
     }},
    {"info", {}, "()", [](HullNode& hull, Arguments) { return Value(hull.info()->dictionary()); }},
    {"state", {}, "()", [](HullNode& hull, Arguments) { return Value(hull.state()->dictionary()); }},
    {"save_state", {}, "()", [](HullNode& hull, Arguments) { return save_state(hull); }},
    {"restore_state",
     {type_pool_byte_array},
     "(saved)",
     [](HullNode& hull, Arguments arguments) {
         return hull.restore_state(PoolElements<std::uint8_t>(*arguments[0]).all()), Value();
     }},
};

}  // namespace

std::span<const MethodOf<HullNode>> hull_methods() { return hull_method_list; }

}  // namespace pelagic::godot
