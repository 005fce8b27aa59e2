// Measurement of waves in a series of planes of heights. Only directions need more than the
// heights. Two frames distinguish a wave along k from one against k if the frequency is known; it
// follows from the dispersion relation.
//
// Heights are those of reference points, which move horizontally with the sea (Lagrangian). At
// reference points a sea is the linear sum of its waves, so the spectra are those of the model. A
// gauge at a fixed position would measure sharpened crests, as harmonics of the peak.
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

/// Positions and times of the heights of a cascade.
struct HeightSeries {
    CascadePlan cascade;
    double depth_m = 0;
    double loop_period_s = 0;
    /// time scale for choosing pairs of frames that resolve directions
    double likely_peak_period_s = 0;
    std::size_t frames = 1;
    double step_s = 0;         ///< between frames, constant; unused if there is only one
    bool is_one_loop = false;  ///< the frames span exactly one loop period
};

struct SpectrumPoint {
    double at;       ///< Hz or rad/m
    double density;  ///< m^2/Hz or m^3; the integral over `at` is the variance
};

struct MeasuredWaves {
    double significant_wave_height_m = 0;  ///< 4 sqrt(variance) over all texels of all frames
    /// (integral S^4 df) / (integral f S^4 df) of by_harmonic (Young 1995); none without it.
    std::optional<double> peak_period_s;
    /// m0 / m1 and sqrt(m0 / m2) of by_harmonic, m_n = integral f^n S df; none without it.
    std::optional<double> tm01_s, tm02_s;
    /// Mean time between upward crossings of the mean level, over the points of the sum of all
    /// cascades. None without by_frequency, or without crossings.
    std::optional<double> zero_crossing_period_s;
    /// Peak of by_wave_number (Young 1995), computed over frequencies and converted to a
    /// wavelength; none for a flat sea.
    std::optional<double> peak_wavelength_m;
    /// Needs two frames, and at least half of the energy in waves whose direction is resolved.
    std::optional<WaveDirections> directions;
    /// Mean over the points, in bands of 8 %; empty for fewer than 16 frames.
    std::vector<SpectrumPoint> by_frequency;
    std::vector<SpectrumPoint> by_harmonic;  ///< by_frequency before its bands are merged
    /// Mean over some frames, in rings as wide as the grid spacing of a cascade in wave number.
    /// Rings that the limit of a cascade's band cuts are omitted.
    std::vector<SpectrumPoint> by_wave_number;
    std::string frequency_method;  ///< description of the estimation of by_frequency
};

class WaveMeasurement {
   public:
    explicit WaveMeasurement(const HeightSeries& series);

    /// Adds the next frame: N x N heights in metres, row by row.
    /// \pre at most series.frames calls
    void add_frame(std::span<const float> heights_m);

    /// Returns the waves of all cascades, which are independent.
    /// \pre all frames of each cascade were added; the series differ in the cascade only
    friend MeasuredWaves measured_waves(std::span<const WaveMeasurement> cascades);

   private:
    struct Pair {
        std::size_t first, second;
        std::vector<float> heights_of_first;
    };
    void add_pair(const Pair& pair, std::span<const float> second);
    /// Sums over waves whose direction is resolved.
    struct Running {
        double variance = 0;
        double x = 0, z = 0;  ///< variance times the unit vector along the cascade's axes
    };
    Running running() const;
    bool holds_whole_ring(std::size_t number) const;
    std::size_t segment_length() const;
    std::vector<double> frequency_density() const;
    static std::optional<double> zero_crossing_period(std::span<const WaveMeasurement> cascades);

    HeightSeries series_;
    std::size_t added_ = 0;
    double variances_ = 0;
    std::size_t points_per_side_;
    std::vector<std::vector<float>> at_points_;  ///< [point][frame]
    std::vector<Pair> pairs_;
    std::size_t spectra_ = 0;  ///< number of pairs summed in rings_
    struct Ring {
        double variance = 0, weighted_k = 0;
    };
    std::vector<Ring> rings_;
    /// [wave] variance in m^2 of the wave along k, summed over the pairs that resolve its direction
    std::vector<double> running_;
    std::vector<std::uint8_t> pair_counts_;  ///< [wave] number of pairs in running_
};

MeasuredWaves measured_waves(std::span<const WaveMeasurement> cascades);

}  // namespace pelagic::tools
