// Foam drift, from the wind and the Stokes drift of the waves, in whole texels.
#pragma once

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic {

/// Drift along a cascade's axes, in texels of either sign.
struct DriftTexels {
    int x, z;
};

/// Returns the drift in a loop, rounded to whole texels, so that foam repeats with the loop.
DriftTexels drift_per_loop(const SeaStatistics& statistics, const CascadeGrid& grid, int resolution,
                           const TickClock& clock);

}  // namespace pelagic
