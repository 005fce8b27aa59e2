#include "pelagic/sim/surface/foam_source.hpp"

namespace pelagic {

FoamSource foam_source(const Tile& tile) {
    if (tile.whitecap_jacobian == Tile::no_whitecaps) return {};
    const float scale = 255 / tile.whitecap_ramp;
    return {127.5f + scale * tile.whitecap_jacobian, scale};
}

}  // namespace pelagic
