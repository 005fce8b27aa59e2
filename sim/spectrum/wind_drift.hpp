// Drift of floating matter by the wind.
#pragma once

#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// A drift velocity along the world's axes, m/s.
struct WindDrift {
    double x_mps, z_mps;
};

/// Returns the surface drift that the wind causes, without Stokes drift: 2 % of the wind speed.
/// Stokes drift (dispersion.hpp) is 1 to 2 % of the wind speed in a wind sea. The sum agrees with
/// the 3 to 4 % measured with drifters and slicks (Wu 1975).
WindDrift wind_drift(const SeaState& sea);

/// Returns an estimate of wind drift plus Stokes drift, for use before the Stokes drift is
/// computed: 3.3 % of the wind speed along the wind. The exact value is 2.8 to 3.5 % for the
/// presets, and for the default sea in winds of 6 to 25 m/s.
WindDrift usual_foam_drift(const SeaState& sea);

}  // namespace pelagic
