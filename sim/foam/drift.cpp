#include "pelagic/sim/foam/drift.hpp"

#include <cmath>

namespace pelagic {
namespace {

/// Returns round(n whole / ticks) - round((n - 1) whole / ticks); halves are rounded up.
int texels_of_tick(std::int64_t n, std::int64_t whole, std::int64_t ticks) {
    const auto rounded = [&](std::int64_t of) {
        const std::int64_t twice = 2 * of * whole + ticks, unit = 2 * ticks;
        return twice >= 0 ? twice / unit : -((unit - 1 - twice) / unit);
    };
    return static_cast<int>(rounded(n) - rounded(n - 1));
}

}  // namespace

DriftTexels drift_a_loop(const SeaStatistics& statistics, const CascadeGrid& grid, int resolution,
                         const TickClock& clock) {
    const CascadeGrid::Place drift = grid.in_cascade(statistics.foam_drift_x_mps, statistics.foam_drift_z_mps);
    const double texels_a_mps = clock.ticks_a_loop() * clock.tick_s() * resolution / grid.side_m;
    const auto whole = [&](double mps) { return static_cast<int>(std::floor(mps * texels_a_mps + 0.5)); };
    return {whole(drift.along), whole(drift.across)};
}

DriftTexels drift_of(const SeaStatistics& statistics, const CascadeGrid& grid, int resolution, const TickClock& clock,
                     std::int64_t number) {
    const DriftTexels loop = drift_a_loop(statistics, grid, resolution, clock);
    const int n = clock.in_loop(number), ticks = clock.ticks_a_loop();
    return {texels_of_tick(n, loop.x, ticks), texels_of_tick(n, loop.z, ticks)};
}

}  // namespace pelagic
