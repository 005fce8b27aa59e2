// Registration of a C++ class as a node: its properties, methods and the signal `refused`.
//
// A class has reject(line), which reports an invalid value and calls report_invalid().
#pragma once

#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pelagic/contrib/godot3/engine.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/one_line.hpp"

namespace pelagic::godot {

template <class Node>
struct PropertyOf {
    std::string name;
    VariantType type;
    PropertyHint hint;
    std::string hint_text;
    std::function<Value(const Node&)> get;
    /// Sets the value, or rejects it, or throws std::invalid_argument. The value has the property's
    /// type, but may be an int for a float or vice versa, null for an object, and a String for a
    /// NodePath.
    std::function<void(Node&, const Variant&)> set;
    std::string accepted;      ///< accepted values, for the message about a wrong type
    bool is_optional = false;  ///< whether the value may be null
};

/// A method for scripts. Returns nil if the call fails.
template <class Node>
struct MethodOf {
    const char* name;
    std::vector<VariantType> arguments;
    const char* usage;
    Value (*call)(Node& node, std::span<Variant* const> arguments);
};

inline bool is_number(VariantType type) { return type == type_int || type == type_real; }

/// Catches exceptions and reports them, because no exception may leave the library.
template <class Node, class Work>
auto guarded(Node& node, const Work& work) -> decltype(work()) {
    try {
        return work();
    } catch (const std::exception& error) {
        node.reject(one_line(error.what()));
    }
    return decltype(work())();
}

template <class Node>
void set_property(Object*, void* data, void* instance, Variant* value) {
    const auto& property = *static_cast<const PropertyOf<Node>*>(data);
    Node& node = *static_cast<Node*>(instance);
    guarded(node, [&] {
        const VariantType type = call(core::variant_get_type, value);
        const bool fits = type == property.type || (is_number(type) && is_number(property.type)) ||
                          (type == type_string && property.type == type_node_path) ||
                          (type == type_nil && (property.is_optional || property.type == type_object));
        if (!fits) return node.reject(invalid_value_message(property.name, Text(*value).utf8(), property.accepted));
        property.set(node, *value);
    });
}

template <class Node>
Variant get_property(Object*, void* data, void* instance) {
    return static_cast<const PropertyOf<Node>*>(data)->get(*static_cast<Node*>(instance)).handed_over();
}

/// Returns whether a method is called with arguments of the right types.
template <class Node>
bool are_right(const MethodOf<Node>& method, std::span<Variant* const> arguments) {
    if (arguments.size() != method.arguments.size()) return false;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const VariantType type = call(core::variant_get_type, arguments[i]);
        if (type != method.arguments[i] && !(is_number(type) && is_number(method.arguments[i]))) return false;
    }
    return true;
}

template <class Node>
Variant call_method(Object*, void* data, void* instance, int count, Variant** arguments) {
    const auto& method = *static_cast<const MethodOf<Node>*>(data);
    Node& node = *static_cast<Node*>(instance);
    const std::span<Variant* const> all(arguments, static_cast<std::size_t>(count));
    std::optional<Variant> answer;
    guarded(node, [&] {
        if (!are_right(method, all))
            return node.reject(std::string(method.name) + " is called as " + method.name + method.usage);
        answer = method.call(node, all).handed_over();
    });
    return answer ? *answer : Value().handed_over();
}

/// Registers a class that extends Spatial. Properties and methods outlive the library's use.
template <class Node>
void register_node(const NativeScriptApi& api, void* library, const char* class_name,
                   std::span<const PropertyOf<Node>> properties, std::span<const MethodOf<Node>> methods) {
    const auto create = [](Object* self, void*) -> void* { return new Node(self); };
    const auto destroy = [](Object*, void*, void* instance) { delete static_cast<Node*>(instance); };
    api.register_class(library, class_name, "Spatial", {create, nullptr, nullptr}, {destroy, nullptr, nullptr});
    for (const MethodOf<Node>& method : methods)
        api.register_method(library, class_name, method.name, {0},
                            {call_method<Node>, const_cast<MethodOf<Node>*>(&method), nullptr});
    const Node defaults(nullptr);
    for (const PropertyOf<Node>& property : properties) {
        const Text hint(property.hint_text);
        const Value value = property.get(defaults);
        PropertyAttributes attributes{0, property.type, property.hint, hint.string(), usage_default, value.variant()};
        void* data = const_cast<PropertyOf<Node>*>(&property);
        api.register_property(library, class_name, property.name.c_str(), &attributes,
                              {set_property<Node>, data, nullptr}, {get_property<Node>, data, nullptr});
    }
    const Text name("refused"), argument("why"), no_hint("");
    const Value nothing;
    SignalArgument why{argument.string(), type_string, hint_none, no_hint.string(), usage_default, nothing.variant()};
    const Signal refused{name.string(), 1, &why, 0, nullptr};
    api.register_signal(library, class_name, &refused);
}

}  // namespace pelagic::godot
