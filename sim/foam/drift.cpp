#include "pelagic/sim/foam/drift.hpp"

#include <cmath>

namespace pelagic {

DriftTexels drift_per_loop(const SeaStatistics& statistics, const CascadeGrid& grid, int resolution,
                           const TickClock& clock) {
    const CascadeGrid::Vector drift = grid.in_cascade(statistics.foam_drift_x_mps, statistics.foam_drift_z_mps);
    const double texels_per_mps = clock.ticks_per_loop() * clock.tick_s() * resolution / grid.side_m;
    const auto whole = [&](double mps) { return static_cast<int>(std::floor(mps * texels_per_mps + 0.5)); };
    return {whole(drift.along), whole(drift.across)};
}

}  // namespace pelagic
