// How high, long, steep and spread the waves are: what the model promises, and what this sea holds.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/slope_variance.hpp"

namespace pelagic {

struct ExpectedWaves {
    double significant_wave_height_m;  ///< 4 sqrt(variance), mean over all seeds, of the waves that the grid holds
    double peak_period_s;              ///< where the model's frequency spectrum peaks; of few waves the highest one's
    double peak_wavelength_m;          ///< of the wave with that period in this depth
    /// 4 sqrt(integral of the spectrum over all waves), or of few waves asked for; none for phillips-paper, which has no physical scale.
    std::optional<double> model_significant_wave_height_m;
};

/// Side of the sea's coarsest cascade, which holds its longest waves, in metres: after this length, along either axis of that cascade,
/// those waves repeat. A sea of one cascade (a patch size given, phillips-paper, a pond) repeats exactly. Finer cascades repeat
/// after shorter sides along rotated axes, so the sum of several never repeats exactly. While one sea turns into another it is the
/// larger value of the two. \pre check(sea) is empty. Thread-safe.
double repeat_length_m(const SeaState& sea);

/// Sums the spectrum over the grid, without this seed's draws: O(N^2).
ExpectedWaves expected_waves(const SeaState& sea);

/// 4 times the standard deviation of the frame's heights, summed in double, row by row.
double measured_significant_wave_height_m(const Frame& frame);

/// Peak period of the waves that this seed drew: T_p = (integral S^4 df) / (integral f S^4 df) over their energies in
/// bands of frequency (Young 1995). Of a sea with a swell that of the part, wind sea or swell, which has the model's peak; a wave counts
/// for the parts by their shares of its energy over all seeds. O(N^2).
double measured_peak_period_s(const SeaState& sea);

/// How the waves that this seed drew share the frequencies of their loop. A loop knows only whole numbers of periods, so
/// its frequencies are 1/T, 2/T, ...; waves of one frequency rise and fall in step for ever.
struct LoopFrequencies {
    int for_90_percent;    ///< so many of them, the most energetic first, hold 90 % of the variance of the heights
    double largest_share;  ///< of that variance in the most energetic one; 0 for a sea without waves
};
/// O(N^2).
LoopFrequencies loop_frequencies(const SeaState& sea);

/// With fewer for 90 %, and less than ten peak periods in a loop, warnings_about() says that a loop is too short to look like a sea. The height at a point of n
/// equal waves of their own frequencies has the kurtosis 3 - 3/(2n): from 8 on it is within a sixteenth of the 3 of a
/// real sea's, which is Gaussian. With the wind's spectra that is a loop of about eight peak periods.
inline constexpr int fewest_loop_frequencies = 8;

/// Where waves run, over the whole spectrum with its energy as weight (Kuik, van Vledder and Holthuijsen 1988, J. Phys.
/// Oceanogr. 18, 1020-1034): with a = sum E cos(theta) / sum E and b the same of the sine, the mean is the angle of (a, b).
struct WaveDirections {
    double mean_rad = 0;  ///< towards which they run, from +x towards +z, in (-pi, pi]
    /// sqrt(2 (1 - sqrt(a^2 + b^2))): the standard deviation where it is small; 0 for one direction, sqrt(2) for all alike.
    double spread_rad = 0;
};

/// Of a moment (a, b).
WaveDirections directions_of_moment(double a, double b);

/// What a sea's options ask of its frequencies, m^2/Hz, and of its wave numbers, m^3, all directions together and whatever the
/// cascades hold: its integral over Hz or rad/m is the variance, but for phillips-paper, which has a shape and no scale. 0 of seas
/// of few waves, which are lines.
/// \pre every frequency, in Hz, or wave number, in rad/m, is above 0
std::vector<double> model_by_frequency(const SeaState& sea, std::span<const double> frequencies_hz);
std::vector<double> model_by_wave_number(const SeaState& sea, std::span<const double> wave_numbers);

/// Mean periods from the moments m_n = integral f^n S(f) df of the waves that the grid holds, seconds; 0 of a sea without waves.
struct MeanPeriods {
    double tm01_s = 0;  ///< m0 / m1
    /// sqrt(m0 / m2). In a Gaussian sea that is also the mean time between upward crossings of the rest level (Rice 1945).
    double tm02_s = 0;
};

/// The wind's waves or the swell of a sea that has both.
struct WavePart {
    double significant_wave_height_m = 0;  ///< mean over all seeds, of the waves that the grid holds
    double drawn_significant_wave_height_m = 0;
    double peak_period_s = 0;        ///< where the part's frequency spectrum peaks
    double drawn_peak_period_s = 0;  ///< of what this seed drew; 0 where the grid holds none of the part
};

/// The slope of the waves that a cascade holds, the mean over all seeds; shorter waves are below its texels.
struct CascadeSlopes {
    double side_m;
    int resolution;
    SlopeVariance slopes;
};

/// All that follows from a sea's options, in one pass over its waves: as long as one of the functions above and below.
struct SeaReport {
    ExpectedWaves expected;
    double drawn_significant_wave_height_m = 0;  ///< of the waves that this seed drew, the mean over time
    double drawn_peak_period_s = 0;              ///< measured_peak_period_s()
    MeanPeriods expected_periods;
    MeanPeriods drawn_periods;                ///< of the waves that this seed drew, at the loop's frequencies
    std::optional<WavePart> wind_sea, swell;  ///< of a spectrum with a swell alone
    /// Variance of Dx,x + Dz,z, how much the water converges: the waves' own, at the sea's choppiness. 0 of a pond.
    double expected_convergence_variance = 0, drawn_convergence_variance = 0;
    WaveDirections expected_directions;
    WaveDirections drawn_directions;  ///< of the waves that this seed drew
    /// Fetch that counts, metres, of `jonswap`; 0 of other models. Less than SeaState::fetch_m where the sea is fully developed.
    double effective_fetch_m = 0;
    std::vector<CascadeSlopes> cascades;
    LoopFrequencies loop_frequencies = {};
    std::vector<std::string> warnings;  ///< warnings_about()
};
SeaReport report_on(const SeaState& sea);

/// What a user should know before trusting this sea, a sentence each: a patch shorter than two peak wavelengths,
/// a grid too coarse for the peak, a loop so short that the peak's period is far off or that few
/// frequencies are left.
std::vector<std::string> warnings_about(const SeaState& sea);

}  // namespace pelagic
