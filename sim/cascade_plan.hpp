// Layout of cascades: the grid and the wavelength band of each cascade of a sea.
#pragma once

#include <limits>
#include <numbers>
#include <vector>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// Minimum number of grid steps between k = 0 and an analytic wave, so that its surface is smooth.
/// Each wave is in the finest cascade of a stack in which it has that many, unless it has less than
/// three texels of the next coarser cascade.
inline constexpr double steps_of_few_waves = 8;

/// The layout of a cascade. Its wave vectors are (2 pi / side)(m, n) along the cascade's own
/// axes, m and n from -N/2 to N/2 - 1.
struct CascadePlan {
    CascadeGrid grid;
    int resolution = 0;  ///< N
    /// Position in the stack, 0 is the coarsest; each number has independent random waves.
    int number = 0;
    /// Band of wave numbers min_k <= |k| < max_k, rad/m. A cell of wave vectors on a limit holds
    /// the energy of its area inside the band.
    double min_k = 0, max_k = std::numeric_limits<double>::infinity();
    /// Whether the dispersion relation includes surface tension. A cascade whose side is given
    /// follows the paper, without it.
    bool has_surface_tension = false;

    /// Cascades of a stack that may have foam, the coarsest ones.
    static constexpr int max_foam_cascades = 3;
    /// Returns the weight of the cascade's compression in the sum that decides where a stack of
    /// cascades breaks. With l the geometric mean of its longest and shortest wave, it is
    /// min(1, sqrt(l / 5.7 m)). It is 0 for the fourth cascade, and if all waves are shorter than a
    /// metre. Fronts of small waves are ripples on the crests of larger ones and seldom break
    /// on their own. The shortest wave is taken as three texels, so that all seas of a forecast
    /// have one weight.
    double foam_weight() const;

    double spacing() const { return 2 * std::numbers::pi / grid.side_m; }  ///< dk in rad/m
    /// Returns whether the cascade holds a band of wave numbers only.
    bool is_banded() const { return min_k > 0 || max_k < std::numeric_limits<double>::infinity(); }
};

/// The range of waves that a stack of cascades holds. All seas of a forecast share one range.
struct WaveReach {
    double peak_m = 0;  ///< longest peak wavelength
    double end_k = 0;   ///< rad/m; larger wave numbers are unresolved roughness
    /// End of the waves that the mean period of given systems depends on, rad/m; 0 without such.
    /// Where a stack does not reach it, its coarsest side is smaller, at least four peak_m.
    double tail_k = 0;

    /// Returns the range of one sea; zeros if patch_size_m is set, whose grid determines the range.
    static WaveReach of(const SeaState& sea);
    /// Extends the range to contain another one.
    WaveReach& extend_to(const WaveReach& other);
};

/// Returns the cascades of a sea, the coarsest first. \pre check(sea) is empty
std::vector<CascadePlan> plan_cascades(const SeaState& sea);

/// Returns the cascades of a sea for a larger range of waves. Grids and bands are those of `reach`
/// and of the sea's options for cascades, and the last band ends where this sea's own range does.
/// \pre check(sea) is empty
std::vector<CascadePlan> plan_cascades(const SeaState& sea, const WaveReach& reach);

/// Returns these cascades for a known WaveReach::of(sea), which takes most of the time of a plan.
/// \pre check(sea) is empty
std::vector<CascadePlan> plan_cascades(const SeaState& sea, const WaveReach& reach, const WaveReach& own);

}  // namespace pelagic
