// Fit of the decrease of waves with depth by that at three depths.
#pragma once

#include <array>

#include "pelagic/sim/water_levels.hpp"

namespace pelagic {

/// Decrease of a wave from the surface to a depth, in water of a finite depth (Airy 1845).
struct DepthFactors {
    double head;        ///< cosh k(d - y) / cosh k d, of pressure
    double rise;        ///< sinh k(d - y) / sinh k d, of vertical velocity
    double along_rise;  ///< cosh k(d - y) / sinh k d, of horizontal velocity
};

/// \param k        rad/m, above 0
/// \param depth_m  y in [0, 2 water_m]
DepthFactors depth_factors(double k, double depth_m, double water_m);

/// Fills in the weights of a ladder with depths. They make the sum of the levels' factors closest to the factors in
/// between, in the mean square over the waves; their derivatives are closest in the mean square of relative errors.
/// \param min_k, max_k  the waves, rad/m
void fit_weights(DepthLadder& ladder, double min_k, double max_k, double water_m);

/// Fills in the filter of a ladder with depths. It makes the sum of the levels' factors closest to a function of the
/// wave number, in the mean square over the waves. Weights are kept small, because levels have errors.
/// \param min_k, max_k  the waves, rad/m
void fit_filter(DepthLadder& ladder, double min_k, double max_k, double water_m);

}  // namespace pelagic
