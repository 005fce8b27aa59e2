// Quantities that follow from the dispersion relation (sim/dispersion.hpp): group velocity, drift,
// the effects of a finite depth, and the phase of a wave in the loop.
//
//   phase   = q f turns, f = t / T as a 32-bit fraction of the loop
#pragma once

#include <cstdint>

#include "pelagic/sim/dispersion.hpp"
#include "pelagic/simd/constants.hpp"

namespace pelagic {

/// Returns d omega / d k in m/s. \pre k > 0
double group_velocity(double k, const Water& water);

/// Returns the Stokes drift at the surface of waves with a mean square height of 1 m^2, in m/s
/// along their direction: omega k cosh 2kd / sinh^2 kd, which is 2 omega k in deep water (Stokes
/// 1847). The drift is proportional to the mean square height. \pre k > 0
double stokes_drift(double k, const Water& water);

/// Returns the ratio of horizontal to vertical displacement at the surface for a wave of small
/// amplitude: coth(k d), at most 20 (Airy 1845; Lamb 1932, article 229). Exactly 1 for k depth over
/// 20, where a double cannot distinguish the depth from infinity. \pre k > 0
double orbit_ratio(double k, double depth_m);

/// Returns Kitaigorodskii's factor phi (Kitaigorodskii et al. 1975; Bouws et al. 1985): the
/// attenuation of a deep-water frequency spectrum at a depth. It is the ratio of k^-3 dk/domega at
/// the depth to the value in deep water. Range [0, 1]; exactly 1 for k depth over 20, where a
/// double cannot distinguish the depth from infinity. Includes gravity only, because the depth does
/// not affect capillary waves. \pre k > 0
double depth_factor(double k, double depth_m);

/// A moment of the loop in units of 2^-32 of its period. The phase of a wave is harmonic * turns
/// mod 2^32. Integer arithmetic keeps it exact for any run time.
struct LoopFraction {
    std::uint32_t turns = 0;
};

/// Returns the fraction nearest to t / T, modulo 1, for positive and negative times. \pre time_s is
/// finite
LoopFraction loop_fraction(double time_s, double loop_period_s);

}  // namespace pelagic
