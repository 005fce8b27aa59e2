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

}  // namespace pelagic
