// Table of the properties of PelagicOcean: name, type, editor hint, default, getter and setter.
#pragma once

#include <vector>

#include "pelagic/contrib/godot3/ocean_node.hpp"
#include "pelagic/contrib/godot3/script_class.hpp"

namespace pelagic::godot {

using OceanProperty = PropertyOf<OceanNode>;

/// Returns the properties in the order of the editor.
const std::vector<OceanProperty>& properties();

}  // namespace pelagic::godot
