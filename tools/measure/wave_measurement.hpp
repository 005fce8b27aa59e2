// What waves a series of planes of heights holds, found out from the heights alone, but for directions: two frames tell a wave that
// runs along k from one against it once its frequency is known, and that comes from the dispersion relation.
//
// Heights are those of reference points, which move horizontally with the sea (Lagrangian). There a sea is a plain sum of its waves, so
// spectra are those of the model; a gauge at a fixed place of the world would see crests sharpened, as harmonics of the peak.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/statistics.hpp"

namespace pelagic::tools {

/// Where and when the heights of one cascade are.
struct HeightSeries {
    CascadePlan cascade;
    double depth_m = 0;
    double loop_period_s = 0;
    double likely_peak_period_s = 0;  ///< how far apart in time two frames tell directions best
    std::size_t frames = 1;
    double step_s = 0;         ///< between frames, the same for all; unless there is one frame only
    bool is_one_loop = false;  ///< the frames are exactly one period of the loop
};

struct SpectrumPoint {
    double at;       ///< Hz, or rad/m
    double density;  ///< m^2/Hz, or m^3; the integral over `at` is the variance
};

struct MeasuredWaves {
    double significant_wave_height_m = 0;  ///< 4 sqrt(variance) over all texels of all frames
    /// (integral S^4 df) / (integral f S^4 df) of by_frequency, before its bands are joined (Young 1995); none without it.
    std::optional<double> peak_period_s;
    /// m0 / m1 and sqrt(m0 / m2) of by_frequency, m_n = integral f^n S df; none without it.
    std::optional<double> tm01_s, tm02_s;
    /// Mean time between upward crossings of the mean level at the points, cascades together; none without by_frequency, or crossings.
    std::optional<double> zero_crossing_period_s;
    /// The same of by_wave_number carried to frequencies, as a wavelength; none for a flat sea.
    std::optional<double> peak_wavelength_m;
    std::optional<WaveDirections> directions;  ///< needs two frames that tell half of the energy and more
    std::vector<SpectrumPoint>
        by_frequency;  ///< mean over the points, in bands of 8 %; empty for fewer than 16 frames
    std::vector<SpectrumPoint> by_harmonic;  ///< by_frequency before its bands are joined
    /// Mean over some frames, in rings as wide as a cascade's grid is fine. Rings that the end of a cascade's band cuts are left out.
    std::vector<SpectrumPoint> by_wave_number;
    std::string frequency_method;  ///< how by_frequency was estimated, for people
};

class WaveMeasurement {
   public:
    explicit WaveMeasurement(const HeightSeries& series);

    /// The frames in their order, N x N heights each, row by row. \pre no more than were announced
    void add_frame(std::span<const float> heights_m);

    /// Of all cascades together, whose waves are independent. \pre all frames of each were added; the series differ in the cascade only
    friend MeasuredWaves measured_waves(std::span<const WaveMeasurement> cascades);

   private:
    struct Pair {
        std::size_t first, second;
        std::vector<float> heights_of_first;
    };
    void add_pair(const Pair& pair, std::span<const float> second);
    struct Running {
        double variance = 0, x = 0,
               z = 0;  ///< of waves whose direction is known; times its unit vector along the cascade's axes
    };
    Running running() const;
    bool holds_whole_ring(std::size_t number) const;
    std::size_t segment_length() const;
    std::vector<double> frequency_density() const;
    static std::optional<double> zero_crossing_period(std::span<const WaveMeasurement> cascades);

    HeightSeries series_;
    std::size_t added_ = 0;
    double variances_ = 0;
    std::size_t points_a_side_;
    std::vector<std::vector<float>> at_points_;  ///< [point][frame]
    std::vector<Pair> pairs_;
    std::size_t spectra_ = 0;  ///< planes in the two sums below
    struct Ring {
        double variance = 0, weighted_k = 0;
    };
    std::vector<Ring> rings_;
    std::vector<double>
        running_;  ///< [wave] m^2 of the wave that runs along it, summed over the pairs that could tell
    std::vector<std::uint8_t> told_;  ///< [wave] how many could
};

MeasuredWaves measured_waves(std::span<const WaveMeasurement> cascades);

}  // namespace pelagic::tools
