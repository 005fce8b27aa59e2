// What the wind does to what floats.
#pragma once

#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// Along the world's axes, m/s.
struct WindDrift {
    double x_mps, z_mps;
};

/// How fast the wind alone drags the skin of the sea along, 2 % of its speed. With Stokes' drift (dispersion.hpp), 1 to 2 % of the
/// wind in seas that it has raised, that is the 3 to 4 % which drifters and slicks show (Wu 1975).
WindDrift wind_drift(const SeaState& sea);

/// With Stokes' drift, before that is known: 3.3 % of the wind's speed its way. Of the presets, and of the default sea in winds of 6 to
/// 25 m/s, it is 2.8 to 3.5 %.
WindDrift usual_foam_drift(const SeaState& sea);

}  // namespace pelagic
