// Statistics of a sea: heights, periods, slopes and directions that the model gives, and those of
// the waves that the grid holds.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pelagic/sim/forecast.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/slope_variance.hpp"

namespace pelagic {

struct ExpectedWaves {
    /// 4 sqrt(variance) of the waves that the grid holds, mean over all seeds.
    double significant_wave_height_m;
    /// Period of the maximum of the model's frequency spectrum; of analytic waves, that of the
    /// highest.
    double peak_period_s;
    double peak_wavelength_m;  ///< of the wave with that period in this depth
    /// 4 sqrt(integral of the spectrum over all waves), or of the analytic waves of the options.
    /// None for phillips-paper, which has no physical scale.
    std::optional<double> model_significant_wave_height_m;
};

/// Returns the side of the sea's coarsest cascade, in metres: the period of its longest waves along
/// either axis of that cascade.
///
/// A sea of one cascade (a patch size given, phillips-paper, a pond) repeats exactly. Finer
/// cascades repeat after shorter sides along rotated axes, so the sum of several never repeats
/// exactly. During a transition the period is the larger value of the two seas. \pre check(sea) is
/// empty. Thread-safe.
double repeat_length_m(const SeaState& sea);

/// Sums the spectrum over the grid, as the mean over all seeds: O(N^2).
ExpectedWaves expected_waves(const SeaState& sea);

/// Returns 4 times the standard deviation of the frame's heights, summed in double, row by row.
/// \throws std::invalid_argument  without planes (OceanOptions::planes)
double measured_significant_wave_height_m(const Frame& frame);

/// Returns the peak period of the waves that this seed drew:
/// T_p = (integral S^4 df) / (integral f S^4 df) over their energies in bands of frequency (Young
/// 1995). O(N^2).
///
/// For a sea of several systems it is the period of the system that has the model's peak. A wave
/// counts for each system, by its fraction of the energy over all seeds.
double measured_peak_period_s(const SeaState& sea);

/// Distribution of the realised waves' energy over the frequencies of their loop. A loop contains
/// whole numbers of periods, so its frequencies are 1/T, 2/T, ... Waves of one frequency rise and
/// fall in phase permanently.
struct LoopFrequencies {
    /// Number of frequencies, the most energetic first, that hold 90 % of the variance of the
    /// heights.
    int for_90_percent;
    /// Fraction of that variance in the most energetic frequency; 0 for a sea without waves.
    double largest_share;
};
/// Computes the distribution for the seed's waves: O(N^2).
LoopFrequencies loop_frequencies(const SeaState& sea);

/// If fewer frequencies hold 90 %, and a loop has less than ten peak periods, warnings_about()
/// warns that the loop is too short to resemble a sea.
///
/// The height at a point of n equal waves of distinct frequencies has the kurtosis 3 - 3/(2n). From
/// 8 on it is within a sixteenth of the 3 of a real sea's, which is Gaussian. For the wind's
/// spectra that is a loop of about eight peak periods.
inline constexpr int fewest_loop_frequencies = 8;

/// Mean direction and spread of the whole spectrum with its energy as weight (Kuik, van Vledder and
/// Holthuijsen 1988, J. Phys. Oceanogr. 18, 1020-1034). With a = sum E cos(theta) / sum E and b the
/// corresponding sum of sines, the mean is the angle of (a, b).
struct WaveDirections {
    double mean_rad = 0;  ///< direction waves run towards, from +x towards +z, in (-pi, pi]
    /// sqrt(2 (1 - sqrt(a^2 + b^2))): the standard deviation where it is small; 0 for one
    /// direction, sqrt(2) for equal energy in all directions.
    double spread_rad = 0;
};

/// Computes mean and spread of a moment (a, b).
WaveDirections directions_of_moment(double a, double b);

/// Returns the model's spectrum by frequency, in m^2/Hz, and by wave number, in m^3. It is
/// integrated over all directions and independent of the cascades. Its integral over Hz or rad/m is
/// the variance, except for phillips-paper, which has a shape and no scale. 0 for the other wave
/// models, whose spectra are lines.
/// \pre every frequency, in Hz, or wave number, in rad/m, is above 0
std::vector<double> model_by_frequency(const SeaState& sea, std::span<const double> frequencies_hz);
/// As above, by wave number, m^3.
std::vector<double> model_by_wave_number(const SeaState& sea, std::span<const double> wave_numbers);

/// Mean periods from the moments m_n = integral f^n S(f) df of the waves that the grid holds,
/// seconds; 0 for a sea without waves.
struct MeanPeriods {
    double tm01_s = 0;  ///< m0 / m1
    /// sqrt(m0 / m2). In a Gaussian sea this is also the mean time between upward crossings of the
    /// rest level (Rice 1945).
    double tm02_s = 0;
};

/// One wave system of a sea: the wind sea, the swell, or one of SeaState::systems. Expected values are
/// those of the waves that the grid holds, mean over all seeds; realised ones are those of this seed.
struct SystemReport {
    double significant_wave_height_m = 0;
    double realised_significant_wave_height_m = 0;
    double peak_period_s = 0;        ///< of the maximum of this system's frequency spectrum
    /// None if the grid holds no waves of the system.
    std::optional<double> realised_peak_period_s = {};
    WaveDirections expected_directions, realised_directions;
};

/// Slope variance of the waves that a cascade holds, mean over all seeds. Its texels do not resolve
/// shorter waves.
struct CascadeSlopes {
    double side_m;
    int resolution;
    SlopeVariance slopes;
};

/// All statistics of a sea, computed in one pass over its waves. It takes as long as one of the
/// functions above and below.
struct SeaReport {
    ExpectedWaves expected;
    double realised_significant_wave_height_m = 0;  ///< of this seed's waves, mean over time
    double realised_peak_period_s = 0;              ///< measured_peak_period_s()
    MeanPeriods expected_periods;
    MeanPeriods realised_periods;               ///< of this seed's waves, at the loop's frequencies
    std::optional<SystemReport> wind_sea;       ///< of a spectrum with other systems
    std::optional<SystemReport> swell;          ///< of a spectrum with a swell
    std::vector<SystemReport> systems;          ///< of SeaState::systems
    /// Variance of the horizontal convergence Dx,x + Dz,z, at the sea's choppiness. 0 for a pond.
    double expected_convergence_variance = 0, realised_convergence_variance = 0;
    /// Sum of Cascade::level_m, by which heights are raised so that the mean level is 0, in metres.
    double expected_level_m = 0, realised_level_m = 0;
    /// Fraction of the expected variance of the heights in waves that Velocities::water has: those of
    /// WaterLevels::shortest_velocity_texels texels and longer. 0 without waves, and for a pond, whose water rests.
    double velocity_share = 0;
    WaveDirections expected_directions;
    WaveDirections realised_directions;  ///< of this seed's waves
    /// Fetch that has an effect (jonswap), metres; none for other models. Less than
    /// SeaState::fetch_m if the sea is fully developed.
    std::optional<double> effective_fetch_m = {};
    std::vector<CascadeSlopes> cascades;
    LoopFrequencies loop_frequencies = {};
    std::vector<std::string> warnings;  ///< warnings_about()
};
/// Returns expected and realised statistics, and warnings. \pre check(sea) is empty
SeaReport report_on(const SeaState& sea);

/// As report_on(), in half the time, without realised waves. Their statistics are valid only if a
/// warning depends on them: in a loop shorter than ten peak periods. \pre check(sea) is empty
SeaReport expected_report_on(const SeaState& sea);

/// Returns the period of a wave in a loop, which holds a whole number of periods, at least one.
/// \pre both are above 0
double period_in_loop_s(double period_s, double loop_period_s);

/// Returns a warning if the cascades of a forecast, which fit its longest peak or largest_peak_m, have
/// twice the shortest wave that its first sea alone would have, else an empty string.
/// \pre check(forecast) is empty
std::string warning_about(const Forecast& forecast);

/// Returns warnings about a sea, a sentence each: a patch shorter than two peak wavelengths, a grid
/// too coarse for the peak, or a loop so short that the peak period is far off or few frequencies
/// remain. One more describes how the waves of
/// the grid differ from the heights, periods, directions and spreads that are given.
std::vector<std::string> warnings_about(const SeaState& sea);

}  // namespace pelagic
