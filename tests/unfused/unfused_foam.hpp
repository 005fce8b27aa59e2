// Foam where water breaks, one float at a time.
#pragma once

#include <algorithm>
#include <cmath>

#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic::unfused {

/// In parts of a byte, whole ones.
inline float breaking_foam(const FoamSource& source, float jacobian) {
    return std::nearbyint(std::min(std::max(source.offset - source.scale * jacobian, 0.f), 255.f));
}

/// As a half float holds it, nothing being remembered.
inline float foam_of(const FoamSource& source, float jacobian) {
    return breaking_foam(source, jacobian) * (1.f / 255);
}

}  // namespace pelagic::unfused
