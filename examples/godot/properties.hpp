// The properties of PelagicOcean as a table: name, kind, hint and default for the editor, and how each is read and set.
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
    /// Takes the value, or refuses it. The kind is right, but for a number of the other kind.
    std::function<void(OceanNode&, const Variant&)> set;
    std::string accepted;  ///< in words, for a value of another kind
};

/// In the order in which the editor shows them.
const std::vector<Property>& properties();

}  // namespace pelagic::godot
