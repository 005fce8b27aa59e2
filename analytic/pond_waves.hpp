// Procedural pond waves: octaves of exp(sin - 1), which has sharp crests and broad troughs. Each
// octave displaces the octaves after it along its direction by its slope, so that short waves
// gather on the crests of long ones.
//
//   h = sum a_i (E_i - mean),  E_i = exp(sin p_i - 1),  p_i = k_i . x_i - w_i t + phase_i
//   x_(i+1) = x_i - d_i drag_i E_i cos p_i,  d_i = k_i / |k_i|
//
// The mean of exp(sin - 1) is I0(1) / e, so still water is at 0, and h is within [lowest_m(),
// highest_m()]. Normal and vertical velocity are the derivatives of h, including those of the
// displaced positions. Each octave has the dispersion w^2 = g k + 7.4e-5 k^3 (gravity and surface
// tension). Results are bit-identical for equal octaves, time, point and footprint, as those of
// AnalyticSurface.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pelagic/analytic/analytic_surface.hpp"

namespace pelagic {

struct PondJob;
struct PondTerms;

/// Parameters of a pond; check() checks their ranges.
struct PondSea {
    int octaves = 24;  ///< [1, 64]
    /// Sum of the octaves' a; the highest possible crest is 0.53 of it; (0, 10].
    double height_m = 0.05;
    double wavelength_m = 1.2;  ///< of the first octave; [0.01, 1000]
    double direction_rad = 0;   ///< of the first octave, the others at golden angles; [-2 pi, 2 pi]
    double growth = 1.18;       ///< factor of k from octave to octave; [1, 4]
    double decay = 0.8;         ///< factor of a from octave to octave; (0, 1]
    /// Displacement of other octaves by the first, in units of its 1/k; [0, 1].
    double drag = 0.38;
};

/// Returns an empty string if the sea is valid, otherwise the first invalid field: "octaves is 65,
/// expected 1 to 64". The last octave is at least 1 mm long.
std::string check(const PondSea& sea);

/// An octave of a pond.
struct PondOctave {
    double turns_per_m_x, turns_per_m_z;  ///< k / 2 pi, 1/m
    double frequency_hz;
    double phase_turns;
    double height_m;  ///< a
    double drag_m;    ///< displacement of the octaves after it, m

    /// Returns the wave number in cycles per metre, 1 / wavelength.
    double turns_per_m() const;
};

/// Returns the octaves, longest first. \pre check(sea) is empty
std::vector<PondOctave> octaves_of(const PondSea& sea);

/// Returns the frequency of gravity-capillary waves, sqrt(g k + 7.4e-5 k^3) / 2 pi.
double ripple_frequency_hz(double turns_per_m);

/// Returns the weight of an octave, from 1 to 0, for samples that are footprint_m apart:
/// 1 - smoothstep(0.4, 1, footprint_m / (wavelength_m / 2)).
double footprint_weight(double wavelength_m, double footprint_m);

/// Means over all phases of (exp(sin p - 1) - I0(1)/e)^2, which is I0(2)/e^2 - (I0(1)/e)^2, and of
/// the squared derivative, which is I1(2) / (2 e^2).
inline constexpr double pond_variance = 0.09157631048788914, pond_slope_variance = 0.10763464462446883;

/// Outputs, under the conditions of AnalyticSamples.
struct PondSamples {
    std::span<float> height_m = {};
    std::span<float> normal_x = {}, normal_y = {}, normal_z = {};
    std::span<float> vertical_velocity_mps = {};  ///< dh/dt at the point
    /// Mean square slope that the footprint filters out, alpha^2 of GGX roughness. It excludes the
    /// slopes that the displacement of octaves adds.
    std::span<float> slope_variance = {};
};

struct PondHit {
    double distance_m;  ///< from the origin
    std::array<double, 3> position_m;
};

/// Evaluator of a pond. Const methods are thread-safe, do not allocate and do not block.
class PondWaves {
   public:
    /// \throws std::invalid_argument if check(sea) is not empty, or the CPU lacks the instruction
    /// set
    explicit PondWaves(const PondSea& sea, std::optional<Isa> isa = {});
    /// Returns an evaluator of given octaves, for example octaves on a cascade's grid.
    /// \pre finite numbers
    /// \throws std::invalid_argument  unless there are 1 to 64 octaves
    static PondWaves of(std::vector<PondOctave> octaves, std::optional<Isa> isa = {});
    ~PondWaves();
    PondWaves(PondWaves&&) noexcept;
    PondWaves& operator=(PondWaves&&) noexcept;

    /// Samples the water at the points.
    /// \param footprint_m  distance between samples at each point (a pixel's size on the water),
    ///                     metres; empty: 0. An octave fades out from 0.4 of half its wavelength to
    ///                     half its wavelength. Height and normal are of the weighted octaves,
    ///                     slope_variance of the filtered slopes.
    /// \throws std::invalid_argument  what AnalyticSurface::sample() throws, and if footprint_m differs
    ///                                in length from the points and is not empty
    void sample(double time_s, const AnalyticPoints& points, const PondSamples& samples,
                std::span<const float> footprint_m = {}) const;

    /// Returns the first position where a ray from above meets the water; empty if there is none
    /// within its reach. The ray is sampled between lowest_m() and highest_m(), at every eighth of
    /// the shortest wavelength. The search may miss a crest through which the ray passes for less
    /// than that. The error along the ray is at most 1e-6 m, or 1e-12 of the distance if that is
    /// larger.
    /// \param direction  any length except 0
    /// \throws std::invalid_argument  for a number that is not finite, and a direction of 0
    std::optional<PondHit> first_hit(double time_s, std::array<double, 3> origin_m, std::array<double, 3> direction,
                                     double reach_m) const;

    /// Returns a lower bound of the height, metres.
    double lowest_m() const;
    /// Returns an upper bound of the height, metres.
    double highest_m() const;
    /// Returns the octaves, the longest first.
    const std::vector<PondOctave>& octaves() const { return octaves_; }

   private:
    PondWaves(std::optional<Isa> isa, std::vector<PondOctave> octaves);

    std::vector<PondOctave> octaves_;
    const AnalyticKernels* kernels_;
    std::vector<PondTerms> terms_;
    double height_m_, shortest_m_;
};

}  // namespace pelagic
