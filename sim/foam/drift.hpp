// Foam drift, from the wind and the Stokes drift of the waves, in whole texels.
#pragma once

#include <cstdint>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic {

/// Drift along a cascade's axes, in texels of either sign.
struct DriftTexels {
    int x, z;
};

/// Returns the drift in a loop, rounded to whole texels, so that foam repeats with the loop.
DriftTexels drift_a_loop(const SeaStatistics& statistics, const CascadeGrid& grid, int resolution,
                         const TickClock& clock);

/// Returns the drift from tick number - 1 to `number`: round(n r) - round((n - 1) r), where r is
/// the loop's drift divided by its ticks, and n the tick's number in the loop. The result depends
/// on no other tick, and the drifts of a loop's ticks add up to drift_a_loop().
DriftTexels drift_of(const SeaStatistics& statistics, const CascadeGrid& grid, int resolution, const TickClock& clock,
                     std::int64_t number);

}  // namespace pelagic
