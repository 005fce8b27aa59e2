// Peak of a model's frequency spectrum.
#pragma once

#include <functional>

#include "pelagic/sim/spectrum/spectra.hpp"

namespace pelagic {

/// Returns the model's energy density over wave number, integrated over all directions, m^3. For
/// phillips-paper the scale is arbitrary.
double radial_energy(const WaveSpectrum& spectrum, const SeaState& sea, double k);

struct SpectralPeak {
    double k;      ///< rad/m
    double omega;  ///< rad/s
};

/// Returns the maximum of S(omega) = S(k) / (d omega / d k).
/// \param density  S(k), of wave numbers in rad/m
SpectralPeak peak_of(double depth_m, const std::function<double(double)>& density);
/// Returns the maximum of the whole sea.
SpectralPeak peak_of(const WaveSpectrum& spectrum, const SeaState& sea);

}  // namespace pelagic
