// The waves of a sea one by one, for sums that need their amplitudes, directions and phases.
#pragma once

#include <vector>

#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// A wave of elevation amplitude_m cos(kx x + kz z - omega t + phase_rad).
struct WaveComponent {
    double amplitude_m = 0;
    double kx_radpm = 0, kz_radpm = 0;
    double omega_radps = 0;
    double phase_rad = 0;
};

/// Returns the highest waves of a sea, in descending order, until they carry a share of the variance of all. They are
/// the waves of ExactWater, in the water's frame. Takes some 20 ms for four cascades of 128, and allocates.
/// Bit-identical on every machine. Thread-safe.
/// \param share  of the sum of the squares of all amplitudes; [0, 1]
/// \throws std::invalid_argument  check(sea), unless it is empty; for a pond, whose octaves are no linear waves; for a
///                                share out of range
std::vector<WaveComponent> highest_waves_of(const SeaState& sea, double share);

}  // namespace pelagic
