// Conversion of a cascade's whitecap threshold to the factors of the foam kernels.
#pragma once

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

/// Returns the linear ramp of foam over the Jacobian J: 1/2 at J = Cascade::whitecap_jacobian, 0 at
/// half of Cascade::whitecap_ramp above it, and 1 at half of it below.
FoamSource foam_source(const Cascade& cascade);

}  // namespace pelagic
