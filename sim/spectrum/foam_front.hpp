// Foam on the front faces of waves.
#pragma once

#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// Factors of the slopes along the world's axes in the compression of foam, at choppiness 1.
struct FoamFront {
    double x, z;
};

/// Returns the factors with which foam follows fronts: water breaks where it contracts and its slope
/// along the wind falls. They are along the wind and at most tan 10 degrees, from a lean of 0.4 on:
/// they move foam forward by at most 10 degrees of a wave's phase, in addition to its lean.
FoamFront foam_front(const SeaState& sea);

}  // namespace pelagic
