// Where a model's frequency spectrum is largest.
#pragma once

#include "pelagic/sim/spectrum/spectra.hpp"

namespace pelagic {

/// The model's energy over wave number, all directions together, whatever its scale, m^3.
double radial_energy(const WaveSpectrum& spectrum, const SeaState& sea, double k);

struct SpectralPeak {
    double k;      ///< rad/m
    double omega;  ///< rad/s
};

/// The largest S(omega) = S(k) / (d omega / d k).
SpectralPeak peak_of(const WaveSpectrum& spectrum, const SeaState& sea);

// Wave numbers to look at: from ten times the longest wave of the wind to a tenth of a millimetre, 2 % apart.
inline constexpr double shortest_k = 1e-5;
inline constexpr double longest_k = 6e4;
inline constexpr double k_ratio = 1.02;

}  // namespace pelagic
