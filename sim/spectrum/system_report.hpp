// Statistics of one wave system by its model, and the note about what a grid holds of it.
#pragma once

#include <string>

#include "pelagic/sim/spectrum/spectra.hpp"
#include "pelagic/sim/statistics.hpp"

namespace pelagic {

/// A system as the model gives it, without the limits of the cascades.
struct ModelOfSystem {
    double peak_radps;   ///< of the maximum of S(omega)
    double variance;     ///< m^2, after breaking
    double tm02_s;       ///< sqrt(m0 / m2)
    double spread_rad;   ///< as WaveDirections::spread_rad
    double towards_rad;  ///< mean direction
    bool is_given;       ///< whether its height or peak is given; otherwise it follows from the wind
};

/// Integrates a system over all wave numbers. \param system  number in spectrum.systems()
ModelOfSystem model_of_system(const WaveSpectrum& spectrum, std::size_t system);

/// Returns in which values the waves of the grid differ from those given: "Hs 1.8 m instead of 2 m,
/// spread 7 degrees instead of 5". Empty within 0.5 % of height and Tm02, 0.5 degrees of direction and
/// 1 % of spread, and if the system is not given.
/// \param tm02_s  of the grid
std::string deviation_of(const SystemReport& held, double tm02_s, const ModelOfSystem& given);

}  // namespace pelagic
