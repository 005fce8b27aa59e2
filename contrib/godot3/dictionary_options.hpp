// Options that scripts pass as dictionaries.
#pragma once

#include "pelagic/contrib/godot3/engine.hpp"
#include "pelagic/sim/disturbance.hpp"
#include "pelagic/sim/rain.hpp"
#include "pelagic/sim/spray.hpp"

namespace pelagic::godot {

/// Reads {"x_m": 3, "radius_m": 2, "height_m": 0.4, "mode": "impulse"}: the names of
/// disturbance_fields(), and "shape" and "mode". Fields without a key have their defaults.
/// \param dictionary  a Dictionary
/// \throws std::invalid_argument  for unknown keys and invalid values
Disturbance disturbance_of(const Variant& dictionary);

/// Reads the names of rain_fields(), as disturbance_of() does. The ranges of the values depend on
/// the grid, and DynamicWaves::set_rain() checks them.
Rain rain_of(const Variant& dictionary);

/// Reads the names of spray_emitter_fields(), as disturbance_of() does.
SprayEmitter emitter_of(const Variant& dictionary);

}  // namespace pelagic::godot
