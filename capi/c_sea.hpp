// A sea as C spells it.
#pragma once

#include "pelagic/pelagic.h"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic::capi {

/// Throws std::invalid_argument for null and a wrong struct_size. Values are for check().
SeaState sea_of(const pelagic_sea* sea);

}  // namespace pelagic::capi
