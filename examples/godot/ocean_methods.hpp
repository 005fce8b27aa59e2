// Table of the methods of PelagicOcean.
#pragma once

#include <span>

#include "pelagic/examples/godot/ocean_node.hpp"
#include "pelagic/examples/godot/script_class.hpp"

namespace pelagic::godot {

std::span<const MethodOf<OceanNode>> ocean_methods();

}  // namespace pelagic::godot
