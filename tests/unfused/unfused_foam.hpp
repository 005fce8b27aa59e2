// Foam of breaking waves, one float at a time.
#pragma once

#include <algorithm>
#include <cmath>

#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic::unfused {

/// Returns foam in units of 1/255, rounded to integers.
inline float breaking_foam(const FoamSource& source, float jacobian) {
    return std::nearbyint(std::min(std::max(source.offset - source.scale * jacobian, 0.f), 255.f));
}

/// Returns foam without history, as it is stored in half floats, in [0, 1].
inline float foam_of(const FoamSource& source, float jacobian) {
    return breaking_foam(source, jacobian) * (1.f / 255);
}

}  // namespace pelagic::unfused
