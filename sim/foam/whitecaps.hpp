// Whitecap cover: its amount is a function of the wind, and its place a function of the Jacobian.
#pragma once

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/spectrum/folding.hpp"

namespace pelagic {

/// Returns the fraction of the sea that whitecaps cover: 3.84e-6 U10^3.41, at most 0.4 (Monahan and
/// O'Muircheartaigh 1980). \param wind_speed_mps  U10, m/s
double whitecap_cover(double wind_speed_mps);
/// Returns the whitecap cover of a sea. It is 0 for pond waves, and for analytic waves, whose
/// steepness of at most 0.4 is below the breaking limit k A = 0.443 (Michell 1893).
double whitecap_cover(const SeaState& sea);

/// Whitecap threshold: a texel with Jacobian J generates the foam clamp(1/2 + (jacobian - J) /
/// ramp, 0, 1).
struct WhitecapThreshold {
    float jacobian;  ///< Cascade::no_whitecaps if there are none
    float ramp;      ///< range of J from no foam to full foam, above 0
};

/// Returns the threshold for which accumulated foam (accumulation.hpp) covers the fraction `cover`
/// of the sea, in the mean over time and space. At any choppiness, the crests with the lowest
/// Jacobians are white. Takes microseconds.
/// \param cover   in (0, 0.4]
/// \param tick_s  time between two ticks of foam, seconds; about 0.1
WhitecapThreshold whitecap_threshold(const FoldMoments& moments, double choppiness, double cover, double tick_s);

}  // namespace pelagic
