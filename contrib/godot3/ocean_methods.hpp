// Table of the methods of PelagicOcean.
#pragma once

#include <span>

#include "pelagic/contrib/godot3/ocean_node.hpp"
#include "pelagic/contrib/godot3/script_class.hpp"

namespace pelagic::godot {

std::span<const MethodOf<OceanNode>> ocean_methods();

}  // namespace pelagic::godot
