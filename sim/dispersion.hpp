// The dispersion relation, and the quantisation of frequencies that makes the sea loop exactly.
// Gravity is standard gravity, ISO 80000-3. Thread-safe.
//
//   omega^2 = (g k + (T/rho) k^3) tanh(k depth)
//             Lamb 1932, article 267; VR Ocean, equation 15, is the case of deep water and T = 0
//   q(k)    = max(1, round(omega T / 2 pi))
//             equation 16, with round instead of floor (errata)
#pragma once

#include <cstdint>

namespace pelagic {

/// Surface tension over density, T/rho, m^3/s^2: 0.074 N/m (Lamb 1932, article 267) over 1025
/// kg/m^3 for sea water. Waves of 1.7 cm have the lowest phase speed. Waves longer than 7 cm become
/// less than 3 % faster.
inline constexpr double sea_surface_tension_m3ps2 = 0.074 / 1025;

/// Depth and surface tension of the water. Converts from a depth alone.
struct Water {
    /// \param depth  depth_m
    /// \param tension  tension_m3ps2
    constexpr Water(double depth, double tension = 0) : depth_m(depth), tension_m3ps2(tension) {}

    double depth_m;  ///< above 0
    /// T/rho; 0 disables surface tension, bit-identical to omitting the term.
    double tension_m3ps2;
};

/// Returns omega in rad/s. \param k  wave number in rad/m, at least 0
double angular_frequency(double k, const Water& water);

/// Returns k in rad/m, with gravity only: the inverse of angular_frequency(k, depth_m) within
/// 1e-12.
/// \param omega  rad/s \pre omega > 0
double wave_number(double omega, double depth_m);

/// Returns the wave's number of periods in one loop, at least 1, so that no wave is static.
/// \param omega  rad/s, above 0 \param loop_period_s  seconds, above 0
std::uint32_t loop_harmonic(double omega, double loop_period_s);

}  // namespace pelagic
