// Table of the properties of PelagicHull.
#pragma once

#include <vector>

#include "pelagic/contrib/godot3/hull_node.hpp"
#include "pelagic/contrib/godot3/script_class.hpp"

namespace pelagic::godot {

/// Returns the properties in the order of the editor.
const std::vector<PropertyOf<HullNode>>& hull_properties();

}  // namespace pelagic::godot
