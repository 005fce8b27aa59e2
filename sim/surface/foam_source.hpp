// What a tile's threshold means for the foam of its texels.
#pragma once

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/tile.hpp"

namespace pelagic {

/// Half covered where J is Tile::whitecap_jacobian, nothing and all of it half of Tile::whitecap_ramp beyond and before.
FoamSource foam_source(const Tile& tile);

}  // namespace pelagic
