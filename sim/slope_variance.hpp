// How steep a sea is.
#pragma once

namespace pelagic {

/// Mean squares of the surface's slope, of its components along the wind and across. Their sum is that of the slope.
struct SlopeVariance {
    double upwind = 0, crosswind = 0;

    double total() const { return upwind + crosswind; }
};

}  // namespace pelagic
