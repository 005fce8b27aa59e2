// How far foam drifts: with the wind, and with the waves that carry what floats on them.
#pragma once

#include <cstdint>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic {

/// Whole texels along a cascade's axes, of any sign.
struct DriftTexels {
    int x, z;
};

/// In a whole loop: the nearest to what the drift comes to. A loop ends where it began, so foam does, too.
DriftTexels drift_a_loop(const SeaStatistics& statistics, const CascadeGrid& grid, int resolution,
                         const TickClock& clock);

/// From tick number - 1 to `number`: round(n r) - round((n - 1) r) with the loop's whole texels over its ticks as r, n counted
/// within the loop. It adds up to the loop's, and knows of no tick but this.
DriftTexels drift_of(const SeaStatistics& statistics, const CascadeGrid& grid, int resolution, const TickClock& clock,
                     std::int64_t number);

}  // namespace pelagic
