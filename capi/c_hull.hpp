// Definition of pelagic_hull, and conversions of what acts on hulls.
#pragma once

#include "pelagic/floating/hull.hpp"
#include "pelagic/pelagic.h"

struct pelagic_hull {
    pelagic::Hull hull;
    pelagic::HullWorkspace workspace = {};
};

namespace pelagic::capi {

/// Convert structs of the application. Throw std::invalid_argument for null and a wrong struct_size;
/// Hull checks the values.
HullOptions hull_options_of(const pelagic_hull_options* options);
HullState hull_state_of(const pelagic_hull_state* state, const char* name);
HullInputs hull_inputs_of(const pelagic_hull_inputs* inputs, const char* name);

pelagic_hull_state c_hull_state_of(const HullState& state);
pelagic_hull_loads c_hull_loads_of(const HullLoads& loads);

}  // namespace pelagic::capi
