// Table of the methods of PelagicHull.
#pragma once

#include <span>

#include "pelagic/contrib/godot3/hull_node.hpp"
#include "pelagic/contrib/godot3/script_class.hpp"

namespace pelagic::godot {

std::span<const MethodOf<HullNode>> hull_methods();

}  // namespace pelagic::godot
