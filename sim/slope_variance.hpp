// How steep a sea is.
#pragma once

namespace pelagic {

/// Mean squares of the surface's slope, of its components along the wind and across. Their sum is that of the slope.
struct SlopeVariance {
    double upwind = 0, crosswind = 0;

    double total() const { return upwind + crosswind; }
};

/// Of a clean sea, from the sun's glitter: 0.00316 U up- and 0.003 + 0.00192 U crosswind, within 0.004 and 0.002, measured
/// from 1 to 14 m/s (Cox and Munk 1954). Their wind was that of 12.5 m; as there, U at 10 m is 2 % less and put in unchanged.
SlopeVariance measured_slopes(double wind_speed_mps);

}  // namespace pelagic
