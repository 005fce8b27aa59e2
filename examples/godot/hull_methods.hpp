// Table of the methods of PelagicHull.
#pragma once

#include <span>

#include "pelagic/examples/godot/hull_node.hpp"
#include "pelagic/examples/godot/script_class.hpp"

namespace pelagic::godot {

std::span<const MethodOf<HullNode>> hull_methods();

}  // namespace pelagic::godot
