// Which cascades a sea is made of, and which waves each of them holds.
#pragma once

#include <limits>
#include <vector>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// Few waves want many texels, or what lies between them is a facet: each wave of an analytic sea is in the finest cascade of a stack
/// that has so many steps of its grid between it and k = 0, unless it has less than three texels of the one above.
inline constexpr double steps_of_few_waves = 8;

/// One cascade. Its wave vectors are (2 pi / side)(m, n) along the cascade's own axes, m and n from -N/2 to N/2 - 1.
struct CascadePlan {
    CascadeGrid grid;
    int resolution = 0;  ///< N
    int number = 0;      ///< in the stack, 0 is the coarsest; cascades draw their waves independently of one another
    /// Its waves have min_k <= |k| < max_k, rad/m. A cell of wave vectors that an end cuts holds the share inside.
    double min_k = 0, max_k = std::numeric_limits<double>::infinity();
    bool has_surface_tension =
        false;  ///< short waves feel it; a cascade whose side is given keeps to the paper, without

    /// Waves shorter than a metre break without white water.
    bool makes_whitecaps() const { return min_k < 6.28318530717958647693; }

    double spacing() const { return 6.28318530717958647693 / grid.side_m; }  ///< dk in rad/m
    bool is_banded() const { return min_k > 0 || max_k < std::numeric_limits<double>::infinity(); }
};

/// From which waves to which a stack of cascades reaches. Seas that turn into one another share one.
struct WaveReach {
    double peak_m = 0;  ///< the longest peak's wavelength
    double end_k = 0;   ///< rad/m: shorter waves have slopes that cascades leave to the light

    /// Of one sea; zeros where its side is given, which reaches as far as it does.
    static WaveReach of(const SeaState& sea);
    WaveReach& extend_to(const WaveReach& other);
};

/// The cascades of a sea, the coarsest first. \pre check(sea) is empty
std::vector<CascadePlan> plan_cascades(const SeaState& sea);

/// The same on cascades that reach farther: grids and bands are those of `reach` and of whatever else the sea says about cascades,
/// and the last band ends where this sea's own does.
std::vector<CascadePlan> plan_cascades(const SeaState& sea, const WaveReach& reach);

/// The same where it is known how far the sea itself reaches: WaveReach::of(sea), most of the time that a plan takes.
std::vector<CascadePlan> plan_cascades(const SeaState& sea, const WaveReach& reach, const WaveReach& own);

}  // namespace pelagic
