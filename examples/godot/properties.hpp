// Table of the properties of PelagicOcean: name, type, editor hint, default, getter and setter.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pelagic/examples/godot/ocean_node.hpp"

namespace pelagic::godot {

struct Property {
    std::string name;
    VariantType type;
    PropertyHint hint;
    std::string hint_text;
    std::function<Value(const OceanNode&)> get;
    /// Sets the value or rejects it. The value has the property's type, but may be an int for a
    /// float or vice versa.
    std::function<void(OceanNode&, const Variant&)> set;
    std::string accepted;  ///< accepted values, for the message about a wrong type
};

/// Returns the properties in the order of the editor.
const std::vector<Property>& properties();

}  // namespace pelagic::godot
