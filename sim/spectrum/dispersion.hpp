// How fast waves run, and how time is quantised so that the sea loops exactly.
//
//   omega^2 = (g k + (T/rho) k^3) tanh(k depth)     Lamb 1932, article 267; VR Ocean, equation 15: deep and without T
//   q(k)    = max(1, round(omega T / 2 pi))         equation 16, with round instead of floor (errata)
//   phase   = q f turns, f = t / T as a 32-bit fraction of the loop
#pragma once

#include <cstdint>

namespace pelagic {

/// Standard gravity, m/s^2 (ISO 80000-3).
inline constexpr double gravity_mps2 = 9.80665;

/// Surface tension over density, T/rho, m^3/s^2: 0.074 N/m (Lamb 1932, article 267) and sea water's 1025 kg/m^3. Waves of
/// 1.7 cm run slowest; those over 7 cm it makes less than 3 % faster.
inline constexpr double sea_surface_tension_m3ps2 = 0.074 / 1025;

/// What waves run in; a depth alone will do.
struct Water {
    constexpr Water(double depth, double tension = 0) : depth_m(depth), tension_m3ps2(tension) {}

    double depth_m;
    double tension_m3ps2;  ///< T/rho; 0 leaves surface tension out, and every bit is as without the term
};

/// omega in rad/s of the wave number `k` in rad/m.
double angular_frequency(double k, const Water& water);

/// d omega / d k in m/s. \pre k > 0
double group_velocity(double k, const Water& water);

/// How fast waves of a mean square height of 1 m^2 carry what floats on them the way they run, m/s: omega k cosh 2kd / sinh^2 kd,
/// 2 omega k in deep water (Stokes 1847). It grows as the mean square. \pre k > 0
double stokes_drift(double k, const Water& water);

/// How many times farther horizontally than up a wave of small amplitude moves the water at the surface, coth(k d), at most 20 (Airy 1845; Lamb
/// 1932, article 229). Exactly 1 where no double tells the depth from infinity, k depth over 20. \pre k > 0
double orbit_ratio(double k, double depth_m);

/// Kitaigorodskii's factor phi (Kitaigorodskii et al. 1975; Bouws et al. 1985): what depth leaves of a deep sea's
/// frequency spectrum, the ratio of k^-3 dk/domega at the depth and in deep water. Between 0 and 1, and exactly 1 where no
/// double tells the depth from infinity, k depth over 20. Gravity alone: ripples don't feel the ground. \pre k > 0
double depth_factor(double k, double depth_m);

/// k in rad/m of `omega` in rad/s, gravity alone: the inverse of angular_frequency(k, depth_m) within 1e-12.
/// \pre omega > 0
double wave_number(double omega, double depth_m);

/// The wave's whole number of periods in one loop, at least 1, so that no wave stands frozen.
std::uint32_t loop_harmonic(double omega, double loop_period_s);

/// A moment of the loop in units of 2^-32 of its period. The phase of a wave is harmonic * turns mod 2^32: integer
/// arithmetic, exact at any age of the program.
struct LoopFraction {
    std::uint32_t turns = 0;
};

/// The nearest fraction to t / T; whole periods, before and after 0, drop out. \pre time_s is finite
LoopFraction loop_fraction(double time_s, double loop_period_s);

}  // namespace pelagic
