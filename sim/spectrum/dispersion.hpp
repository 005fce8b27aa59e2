// The dispersion relation, and the quantisation of frequencies that makes the sea loop exactly.
//
//   omega^2 = (g k + (T/rho) k^3) tanh(k depth)
//             Lamb 1932, article 267; VR Ocean, equation 15, is the case of deep water and T = 0
//   q(k)    = max(1, round(omega T / 2 pi))
//             equation 16, with round instead of floor (errata)
//   phase   = q f turns, f = t / T as a 32-bit fraction of the loop
#pragma once

#include <cstdint>

#include "pelagic/simd/constants.hpp"

namespace pelagic {

/// Standard gravity, m/s^2 (ISO 80000-3).

/// Surface tension over density, T/rho, m^3/s^2: 0.074 N/m (Lamb 1932, article 267) over 1025
/// kg/m^3 for sea water. Waves of 1.7 cm have the lowest phase speed. Waves longer than 7 cm become
/// less than 3 % faster.
inline constexpr double sea_surface_tension_m3ps2 = 0.074 / 1025;

/// Depth and surface tension of the water. Converts from a depth alone.
struct Water {
    constexpr Water(double depth, double tension = 0) : depth_m(depth), tension_m3ps2(tension) {}

    double depth_m;
    /// T/rho; 0 disables surface tension, bit-identical to omitting the term.
    double tension_m3ps2;
};

/// Returns omega in rad/s. \param k  wave number in rad/m
double angular_frequency(double k, const Water& water);

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

/// Returns k in rad/m, with gravity only: the inverse of angular_frequency(k, depth_m) within
/// 1e-12.
/// \param omega  rad/s \pre omega > 0
double wave_number(double omega, double depth_m);

/// Returns the wave's number of periods in one loop, at least 1, so that no wave is static.
std::uint32_t loop_harmonic(double omega, double loop_period_s);

/// A moment of the loop in units of 2^-32 of its period. The phase of a wave is harmonic * turns
/// mod 2^32. Integer arithmetic keeps it exact for any run time.
struct LoopFraction {
    std::uint32_t turns = 0;
};

/// Returns the fraction nearest to t / T, modulo 1, for positive and negative times. \pre time_s is
/// finite
LoopFraction loop_fraction(double time_s, double loop_period_s);

}  // namespace pelagic
