// Definition of pelagic_hull, and conversions of what acts on hulls.
#pragma once

#include "pelagic/floating/hull.hpp"
#include "pelagic/pelagic.h"

struct pelagic_hull {
    pelagic::Hull hull;
    pelagic::HullWorkspace workspace = {};
};

namespace pelagic::capi {

/// Convert structs of the application. Throw std::invalid_argument for null and a wrong
/// struct_size; Hull::check() checks the values.
HullState hull_state_of(const pelagic_hull_state* state, const char* name);
HullInputs hull_inputs_of(const pelagic_hull_inputs* inputs, const char* name);

/// Write structs of the application. \pre struct_bytes() accepted them
void write_hull_state(const HullState& state, pelagic_hull_state* to);
void write_hull_loads(const HullLoads& loads, pelagic_hull_loads* to);

}  // namespace pelagic::capi
