// What a cascade's threshold means for the foam of its texels.
#pragma once

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

/// Half covered where J is Cascade::whitecap_jacobian, nothing and all of it half of Cascade::whitecap_ramp beyond and before.
FoamSource foam_source(const Cascade& cascade);

}  // namespace pelagic
