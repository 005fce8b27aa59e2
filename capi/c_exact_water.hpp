// Conversion of pelagic_exact_water_options.
#pragma once

#include "pelagic/pelagic.h"
#include "pelagic/sim/exact_water.hpp"

namespace pelagic::capi {

/// Converts options that read_struct() has read. Throws std::invalid_argument. ExactWater checks the
/// values.
ExactWaterOptions exact_water_options_of(const pelagic_exact_water_options& options);

}  // namespace pelagic::capi
