#include "pelagic/sim/foam/foam_source.hpp"

namespace pelagic {

FoamSource foam_source(const Cascade& cascade) {
    if (cascade.whitecap_jacobian == Cascade::no_whitecaps) return {};
    const float scale = 255 / cascade.whitecap_ramp;
    return {127.5f + scale * cascade.whitecap_jacobian, scale};
}

}  // namespace pelagic
