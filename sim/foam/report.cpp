#include "pelagic/sim/foam_report.hpp"

#include <cmath>

#include "pelagic/sim/foam/accumulation.hpp"
#include "pelagic/sim/foam/drift.hpp"
#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

double length(double x, double z) { return std::sqrt(x * x + z * z); }

}  // namespace

FoamReport report_on_foam(const Frame& frame) {
    const DefaultFloatEnvironment environment;
    const TickClock clock(frame.sea.loop_period_s);
    const SeaStatistics& statistics = frame.statistics;
    FoamReport report{.tick_s = clock.tick_s(),
                      .ticks_per_loop = clock.ticks_per_loop(),
                      .warm_up_ticks = TickClock::kept_ticks,
                      .fade_s = (TickClock::kept_ticks - 1) * clock.tick_s(),
                      .level = statistics.foam_level,
                      .drift_mps = length(statistics.foam_drift_x_mps, statistics.foam_drift_z_mps),
                      .drift_direction_rad = std::atan2(statistics.foam_drift_z_mps, statistics.foam_drift_x_mps),
                      .whitecap_cover = whitecap_cover(frame.sea),
                      .cascades = {}};
    for (const Cascade& cascade : frame.cascades) {
        const DriftTexels loop = drift_per_loop(statistics, cascade.grid, cascade.resolution(), clock);
        report.cascades.push_back(
            {.makes_whitecaps = cascade.makes_whitecaps(),
             .columns_per_loop = loop.x,
             .rows_per_loop = loop.z,
             .drift_mps = length(loop.x, loop.z) * cascade.texel_m() / frame.sea.loop_period_s});
    }
    return report;
}

}  // namespace pelagic
