// Statistics of a record of one point, as a buoy at anchor measures it: height and slopes.
#pragma once

#include <optional>
#include <vector>

#include "pelagic/sim/statistics.hpp"

namespace pelagic::tools {

/// Samples at constant steps. All series are equally long.
struct BuoyRecord {
    double rate_hz = 4;
    double depth_m = 4000;  ///< of the water, for the wave number of a frequency
    std::vector<double> height_m = {};
    std::vector<double> slope_x = {}, slope_z = {};  ///< derivatives of the height along +x and +z
};

/// Statistics that the record does not determine are empty: the zero-crossing period without two
/// crossings, and all but the height of still water.
struct RecordStatistics {
    double significant_wave_height_m = 0;  ///< Hm0, 4 standard deviations of the height
    /// Tp, (integral S^4 df) / (integral f S^4 df) (Young 1995).
    std::optional<double> peak_period_s = {};
    /// Tz, mean time between upward crossings of the mean level.
    std::optional<double> zero_crossing_period_s = {};
    /// Mean direction and spread, from the quadrature of height and slopes (Longuet-Higgins,
    /// Cartwright and Smith 1963) over the frequencies with a hundredth of the peak's density.
    std::optional<WaveDirections> directions = {};
    double skewness = 0;  ///< third moment of the height over the cube of its deviation
    /// Largest difference of crest and trough between two upward crossings; 0 without waves.
    double highest_wave_m = 0;
};

/// Computes the statistics; identical on every machine. The spectrum is a mean over Hann windows of
/// a quarter of the record, half overlapping (Welch 1967).
/// \pre at least 16 samples, and all are finite
RecordStatistics statistics_of(const BuoyRecord& record);

}  // namespace pelagic::tools
