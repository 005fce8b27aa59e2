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

/// How the waves that this seed drew share the frequencies of their loop. A loop knows only whole numbers of periods, so
/// its frequencies are 1/T, 2/T, ...; waves of one frequency rise and fall in step for ever.
struct LoopFrequencies {
    int for_90_percent;    ///< so many of them, the most energetic first, hold 90 % of the variance of the heights
    double largest_share;  ///< of that variance in the most energetic one; 0 for a sea without waves
};
/// O(N^2).
LoopFrequencies loop_frequencies(const SeaState& sea);

/// With fewer for 90 %, warnings_about() says that a loop is too short to look like a sea. The height at a point of n
/// equal waves of their own frequencies has the kurtosis 3 - 3/(2n): from 8 on it is within a sixteenth of the 3 of a
/// real sea's, which is Gaussian. With the wind's spectra that is a loop of about eight peak periods.
inline constexpr int fewest_loop_frequencies = 8;

/// What a user should know before trusting this sea, a sentence each: a patch shorter than two peak wavelengths,
/// a grid too coarse for the peak, a loop so short that the peak's period is far off or that few
/// frequencies are left.
std::vector<std::string> warnings_about(const SeaState& sea);

}  // namespace pelagic
