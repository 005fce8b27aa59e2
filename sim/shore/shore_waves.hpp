// The waves of a sea that a shore takes from the cascades: the long ones, few enough to follow each over the floor; and what a depth
// leaves of those that stay.
#pragma once

#include <cstdint>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

inline constexpr std::size_t max_shore_waves = 32;

/// One wave in the open sea: h = amplitude cos(k (dir . x) - omega t + 2 pi phase_turns).
struct ShoreWave {
    double amplitude_m;
    std::uint32_t harmonic;   ///< periods in a loop
    double omega;             ///< rad/s, of that harmonic
    double along_x, along_z;  ///< where it runs to, a unit vector
    double phase_turns;

    double variance() const { return 0.5 * amplitude_m * amplitude_m; }
};

/// Of the coarsest cascade of a sea, longest first, with its whole energy. Of a spectrum 32 waves of equal energy, which share the
/// frequencies among them; at each the direction is a quantile of the energy's, and the phase is drawn by the seed. Of an analytic
/// sea the cascade's own waves, the 32 strongest. None where the cascade holds no energy.
/// \pre check(sea) is empty; the waves are a physical spectrum's or an analytic sea's
std::vector<ShoreWave> shore_waves(const SeaState& sea, const CascadePlan& coarsest);

/// How much of the height of a cascade's waves a depth leaves: no more energy than the TMA spectrum bears there (Bouws et al. 1985), wave
/// number by wave number, and no higher than water breaks (highest_over_depth). 0 on land, at most 1.
class DepthPart {
   public:
    /// \pre as above
    DepthPart(const SeaState& sea, const CascadePlan& cascade);
    double at(double depth_m) const;
    double variance() const { return variance_; }  ///< m^2, of the cascade's heights in the open sea

   private:
    struct Band {
        double omega, variance, factor;  ///< rad/s, m^2; what the sea's own depth leaves already
    };
    std::vector<Band> bands_;
    double variance_ = 0;
};

}  // namespace pelagic
