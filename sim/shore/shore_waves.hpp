// Waves of a sea at a shore. Long waves move from the coarsest cascade to the shore, which refracts
// each of them over the floor. The waves of the other cascades are attenuated by depth.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

inline constexpr std::size_t max_shore_waves = 32;

/// One wave in the open sea: h = amplitude cos(k (dir . x) - omega t + 2 pi phase_turns).
struct ShoreWave {
    double amplitude_m;
    std::uint32_t harmonic;   ///< periods in a loop
    double omega;             ///< rad/s, of the harmonic
    double along_x, along_z;  ///< unit vector of the direction in which it travels
    double phase_turns;

    double variance() const { return 0.5 * amplitude_m * amplitude_m; }
};

/// Returns the waves of the coarsest cascade of a sea, longest first. Empty if the cascade has no
/// energy. For a spectrum, they are 32 waves of equal energy with the cascade's total energy. Each
/// has a band of frequencies, a direction from a quantile of the energy over direction, and a
/// random phase from the seed. For an analytic sea, they are the up to 32 waves of the cascade with
/// the largest amplitudes.
/// \pre check(sea) is empty; the waves are a physical spectrum's or an analytic sea's
std::vector<ShoreWave> shore_waves(const SeaState& sea, const CascadePlan& coarsest);

/// Attenuation of a cascade's wave heights by depth. At each wave number the energy is at most that
/// of the TMA spectrum (Bouws et al. 1985). The significant height is at most highest_over_depth
/// times the depth, because of breaking.
class DepthAttenuation {
   public:
    /// \pre check(sea) is empty; the waves are a physical spectrum's or an analytic sea's
    DepthAttenuation(const SeaState& sea, const CascadePlan& cascade);
    /// Returns the factor on the heights at each depth, in [0, 1]; 0 on land.
    std::vector<double> at(std::span<const double> depths_m) const;
    double variance() const { return variance_; }  ///< of heights in the open sea, m^2

   private:
    struct Band {
        double omega, variance, factor;  ///< rad/s; m^2; TMA factor at the depth of the open sea
    };
    std::vector<Band> bands_;
    double variance_ = 0;
};

}  // namespace pelagic
