// How high and how long the waves are: what the model promises, and what this sea holds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

struct ExpectedWaves {
    double significant_wave_height_m;  ///< 4 sqrt(variance), mean over all seeds, of the waves that the grid holds
    double peak_period_s;              ///< where the model's frequency spectrum peaks
    double peak_wavelength_m;          ///< of the wave with that period in this depth
    /// 4 sqrt(integral of the spectrum over all waves); none for phillips-paper, which has no physical scale.
    std::optional<double> model_significant_wave_height_m;
};

/// Sums the spectrum over the grid: O(N^2).
ExpectedWaves expected_waves(const SeaState& sea);

/// 4 times the standard deviation of the frame's heights, summed in double, row by row.
double measured_significant_wave_height_m(const Frame& frame);

/// Peak period of the waves that this seed drew: T_p = (integral S^4 df) / (integral f S^4 df) over their energies in
/// bands of frequency (Young 1995). O(N^2).
double measured_peak_period_s(const SeaState& sea);

/// What a user should know before trusting this sea, a sentence each: a patch shorter than two peak wavelengths,
/// a grid too coarse for the peak, a loop so short that the peak's period is far off.
std::vector<std::string> warnings_about(const SeaState& sea);

}  // namespace pelagic
