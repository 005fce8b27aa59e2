// How much of the sea is white: the wind says how much, the Jacobian says where.
#pragma once

#include "pelagic/sim/frame.hpp"

namespace pelagic::gl {

/// Part of a sea that whitecaps cover: 3.84e-6 U10^3.41 (Monahan and O'Muircheartaigh 1980), at most 0.4.
double whitecap_cover(double wind_speed_mps);

/// The Jacobian below which that part of the frame lies, so that the crests that fold most are white and the cover is
/// the one observed at sea, whatever the choppiness. It hardly changes from frame to frame: once a sea is enough.
float whitecap_jacobian(const Frame& frame, double wind_speed_mps);

}  // namespace pelagic::gl
