// How fast waves run, and how time is quantised so that the sea loops exactly.
//
//   omega^2 = g k tanh(k depth)                     VR Ocean, equation 15 is its deep-water limit
//   q(k)    = max(1, round(omega T / 2 pi))         equation 16, with round instead of floor (errata)
//   phase   = q f turns, f = t / T as a 32-bit fraction of the loop
#pragma once

#include <cstdint>

namespace pelagic {

/// Standard gravity, m/s^2 (ISO 80000-3).
inline constexpr double gravity_mps2 = 9.80665;

/// omega in rad/s of the wave number `k` in rad/m.
double angular_frequency(double k, double depth_m);

/// d omega / d k in m/s. \pre k > 0
double group_velocity(double k, double depth_m);

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
