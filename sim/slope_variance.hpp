// Slope variances of a sea.
#pragma once

namespace pelagic {

/// Mean squares of the surface's slope components along and across the wind. Their sum is the mean
/// square of the slope.
struct SlopeVariance {
    double upwind = 0, crosswind = 0;

    /// Returns the sum of both variances.
    double total() const { return upwind + crosswind; }
};

/// Returns the measured slope variances of a clean sea, from the sun's glitter: 0.00316 U upwind
/// and 0.003 + 0.00192 U crosswind, within 0.004 and 0.002, measured from 1 to 14 m/s (Cox and Munk
/// 1954).
///
/// Their wind was measured at 12.5 m. U at 10 m is 2 % less and is used without correction.
/// \param wind_speed_mps  U, m/s
SlopeVariance measured_slopes(double wind_speed_mps);

}  // namespace pelagic
