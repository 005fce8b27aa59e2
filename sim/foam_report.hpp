// Properties of a sea's foam: its ticks, drift and cover.
#pragma once

#include <vector>

#include "pelagic/sim/frame.hpp"

namespace pelagic {

struct CascadeFoam {
    bool makes_whitecaps;
    /// Drift of foam in a loop, along the cascade's columns and rows, rounded to whole texels so
    /// that the loop repeats.
    int columns_per_loop, rows_per_loop;
    double drift_mps;  ///< speed of that drift
};

struct FoamReport {
    double tick_s;      ///< interval of foam ticks, a whole number of them in a loop
    int ticks_per_loop;  ///< about 5 a second
    int warm_up_ticks;  ///< ticks after which all foam has faded, computed after a jump in time
    /// Time in which foam of 1 fades to 0.
    double fade_s;
    /// SeaStatistics::foam_level
    double level;
    /// Speed and direction of the drift before rounding, from +x towards +z.
    double drift_mps, drift_direction_rad;
    /// Fraction covered by whitecaps in this wind (Monahan and O'Muircheartaigh 1980).
    double whitecap_cover;
    std::vector<CascadeFoam> cascades;
};

/// Returns the foam properties of a frame's sea, whether or not the frame has foam.
FoamReport report_on_foam(const Frame& frame);

}  // namespace pelagic
