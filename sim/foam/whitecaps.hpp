// How much of the sea is white: the wind says how much, the Jacobian says where.
#pragma once

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/spectrum/folding.hpp"

namespace pelagic {

/// Part of a sea that whitecaps cover: 3.84e-6 U10^3.41 (Monahan and O'Muircheartaigh 1980), at most 0.4.
double whitecap_cover(double wind_speed_mps);
/// In a sea's wind, of its waves: none of few waves, which are no steeper than 0.4 and below where waves break (k A = 0.443, Michell 1893), or
/// a pond's.
double whitecap_cover(const SeaState& sea);

/// What each of some cascades has to cover, one independent of the other, so that a part `cover` of the sea is under any of them.
double cover_of_each(double cover, int cascades);

/// Where water turns white: a texel of Jacobian J makes foam of clamp(1/2 + (jacobian - J) / ramp, 0, 1).
struct WhitecapThreshold {
    float jacobian;  ///< Cascade::no_whitecaps where nothing folds
    float ramp;      ///< from no foam to all of it; above 0
};

/// The threshold at which foam that lasts (foam_accumulation.hpp) covers that part of the sea, in the mean over time and place; crests
/// that fold most are white, whatever the choppiness. Takes microseconds.
/// \param tick_s  between two moments at which foam is made, about 0.1
/// \pre cover is in (0, 0.4]
WhitecapThreshold whitecap_threshold(const FoldMoments& moments, double choppiness, double cover, double tick_s);

}  // namespace pelagic
