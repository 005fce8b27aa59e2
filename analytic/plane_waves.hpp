// Plane waves with explicit wave vectors and frequencies. They represent an AnalyticSea, also one
// whose waves were moved to the grids of cascades (sim/analytic_cascades.hpp).
#pragma once

#include <string>
#include <vector>

#include "pelagic/analytic/analytic_sea.hpp"

namespace pelagic {

/// A plane wave:
/// height = amplitude cos(2 pi (x turns_per_m_x + z turns_per_m_z - t frequency_hz + phase_turns))
struct PlaneWave {
    double amplitude_m = 0;                       ///< [0, 100]
    double turns_per_m_x = 0, turns_per_m_z = 0;  ///< k / 2 pi, 1/m; length in [0.0001, 200]
    double frequency_hz = 0;                      ///< [0, 1e4]
    double phase_turns = 0;                       ///< [-1, 1]

    /// Returns the wave number in cycles per metre, 1 / wavelength.
    double turns_per_m() const;
};

struct PlaneWaves {
    std::vector<PlaneWave> waves;  ///< 1 to 64
    double choppiness = 1;         ///< as AnalyticSea::choppiness
    double level_m = 0;            ///< added to all heights; [-100, 100]
};

/// Converts each wave without change, in deep water. \pre check(sea) is empty
PlaneWaves plane_waves_of(const AnalyticSea& sea);

/// Overloads of the functions for AnalyticSea.
double steepness_of(const PlaneWaves& sea);
/// Returns Hs in metres.
double significant_height_m(const PlaneWaves& sea);
/// Returns a message about the first invalid value, or an empty text.
std::string check(const PlaneWaves& sea);

/// Returns sqrt(g k) / 2 pi.
double deep_water_frequency_hz(double turns_per_m);

}  // namespace pelagic
