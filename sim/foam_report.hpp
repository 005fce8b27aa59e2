// What an application should know of a sea's foam before it asks for it: when it is remembered, how it drifts, how much of it there is.
#pragma once

#include <vector>

#include "pelagic/sim/frame.hpp"

namespace pelagic {

struct CascadeFoam {
    bool makes_whitecaps;
    /// How far foam drifts in a whole loop, along the cascade's columns and rows: the nearest whole texels to what the drift comes to, so
    /// that a loop ends where it began.
    int columns_a_loop, rows_a_loop;
    double drift_mps;  ///< how fast that is
};

struct FoamReport {
    double tick_s;      ///< foam is remembered at ticks, as many as fit the loop
    int ticks_a_loop;   ///< about 10 a second
    int warm_up_ticks;  ///< what a jump in time costs; after so many all foam has faded
    /// How fast it drifts but for whole texels, and where to, from +x towards +z.
    double drift_mps, drift_direction_rad;
    double whitecap_cover;  ///< part of the sea that is to be white, by the wind (Monahan and O'Muircheartaigh 1980)
    std::vector<CascadeFoam> cascades;
};

/// Of the sea that a frame shows, whether or not it has foam.
FoamReport report_on_foam(const Frame& frame);

}  // namespace pelagic
