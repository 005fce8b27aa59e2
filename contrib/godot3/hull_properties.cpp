#include "pelagic/contrib/godot3/hull_properties.hpp"

#include <glm/vec3.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/number_text.hpp"

namespace pelagic::godot {
namespace {

using HullProperty = PropertyOf<HullNode>;

Value value_of(const glm::dvec3& of) {
    return Value(Vector3{static_cast<float>(of.x), static_cast<float>(of.y), static_cast<float>(of.z)});
}

glm::dvec3 dvec3_of(const Variant& value) {
    const Vector3 of = vector_of(value);
    return {of.x, of.y, of.z};
}

HullProperty option(const NumericField<HullOptions>& field) {
    const std::string name(field.name), accepted(field.accepted);
    // ratio of the limits from which the editor's slider is exponential
    constexpr double wide = 1000;
    const bool is_wide = field.min > 0 && field.max > wide * field.min;
    return {name,
            type_real,
            is_wide ? hint_exp_range : hint_range,
            number_text(field.min) + "," + number_text(field.max) + (is_wide ? ",0.1" : ",0.0001"),
            [&field](const HullNode& node) { return Value(field.value_in(node.options())); },
            [=, &field](HullNode& node, const Variant& variant) {
                const double value = call(core::variant_as_real, &variant);
                if (!field.accepts(value)) throw std::invalid_argument(invalid_value_message(name, value, accepted));
                HullOptions options = node.options();
                if (value == field.value_in(options)) return;
                field.set(options, value);
                node.set_options(options);
            },
            accepted};
}

/// A vector that is null for the value that the library derives from the mesh.
HullProperty optional_vector(std::string name, std::optional<glm::dvec3> HullOptions::*member) {
    return {std::move(name),
            type_vector3,
            hint_none,
            "",
            [member](const HullNode& node) {
                const std::optional<glm::dvec3>& value = node.options().*member;
                return value ? value_of(*value) : Value();
            },
            [member](HullNode& node, const Variant& value) {
                HullOptions options = node.options();
                options.*member = call(core::variant_get_type, &value) == type_nil ? std::optional<glm::dvec3>()
                                                                                   : std::optional(dvec3_of(value));
                if (options.*member != node.options().*member) node.set_options(options);
            },
            "a Vector3 or null",
            true};
}

/// A vector of the inputs, which may change in every step. \param at  returns the vector
template <class At>
HullProperty input(std::string name, At at) {
    return {std::move(name),
            type_vector3,
            hint_none,
            "",
            [at](const HullNode& node) {
                HullInputs inputs = node.inputs();
                return value_of(at(inputs));
            },
            [at](HullNode& node, const Variant& value) {
                HullInputs inputs = node.inputs();
                at(inputs) = dvec3_of(value);
                node.set_inputs(inputs);
            },
            "a Vector3"};
}

std::vector<HullProperty> hull_property_table() {
    std::vector<HullProperty> all = {
        {"ocean", type_node_path, hint_none, "", [](const HullNode& node) { return node.ocean(); },
         [](HullNode& node, const Variant& value) { node.set_ocean(Text(value).utf8()); },
         "the path of a PelagicOcean"},
        {"mesh", type_object, hint_resource_type, "Mesh", [](const HullNode& node) { return node.mesh(); },
         [](HullNode& node, const Variant& value) { node.set_mesh(value); }, "a Mesh"},
    };
    for (const NumericField<HullOptions>& field : hull_fields()) all.push_back(option(field));
    all.push_back(optional_vector("centre_of_mass_m", &HullOptions::centre_of_mass_m));
    all.push_back(optional_vector("inertia_kgm2", &HullOptions::inertia_kgm2));
    all.push_back(input("force_n", [](HullInputs& inputs) -> glm::dvec3& { return inputs.force.force_n; }));
    all.push_back(input("torque_nm", [](HullInputs& inputs) -> glm::dvec3& { return inputs.force.torque_nm; }));
    all.push_back(input("wind_mps", [](HullInputs& inputs) -> glm::dvec3& { return inputs.wind_mps; }));
    all.push_back({"wake", type_bool, hint_none, "", [](const HullNode& node) { return Value(node.has_wake()); },
                   [](HullNode& node, const Variant& value) { node.set_wake(call(core::variant_as_bool, &value)); },
                   "true or false"});
    all.push_back(
        {"playing", type_bool, hint_none, "", [](const HullNode& node) { return Value(node.is_playing()); },
         [](HullNode& node, const Variant& value) { node.set_playing(call(core::variant_as_bool, &value)); },
         "true or false"});
    return all;
}

}  // namespace

const std::vector<HullProperty>& hull_properties() {
    static const std::vector<HullProperty> all = hull_property_table();
    return all;
}

}  // namespace pelagic::godot
