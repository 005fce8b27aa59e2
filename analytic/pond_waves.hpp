// A pond or a puddle in closed form: octaves of exp(sin - 1), which has sharp crests and broad troughs. Each octave
// moves those after it along its own way by its slope, so that small waves gather on the crests of large ones.
//
//   h = sum a_i (E_i - mean),  E_i = exp(sin p_i - 1),  p_i = k_i . x_i - w_i t + phase_i
//   x_(i+1) = x_i - d_i drag_i E_i cos p_i,  d_i = k_i / |k_i|
//
// The mean of exp(sin - 1) is I0(1) / e: still water is at 0, and h is within [lowest_m(), highest_m()]. Normal and rise
// are the derivatives of h as it is summed, what the moved places add included. Waves keep their own speed,
// w^2 = g k + 7.4e-5 k^3 (gravity and surface tension).
// Bits are as AnalyticSurface has them.
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

/// Ranges are checked by check().
struct PondSea {
    int octaves = 24;           ///< [1, 64]
    double height_m = 0.05;     ///< sum of the octaves' a; a sum of crests is 0.53 of it high. (0, 10]
    double wavelength_m = 1.2;  ///< of the first octave; [0.01, 1000]
    double direction_rad = 0;   ///< where it runs towards, the others a golden angle apart; [-2 pi, 2 pi]
    double growth = 1.18;       ///< of k from octave to octave; [1, 4]
    double decay = 0.8;         ///< of a from octave to octave; (0, 1]
    double drag = 0.38;         ///< how far the first octave moves the others, in parts of its 1/k; [0, 1]
};

/// Empty if usable, else the first bad field: "octaves is 65, needs 1 to 64". The last octave may be no shorter than
/// 1 mm.
std::string check(const PondSea& sea);

/// One of its octaves.
struct PondOctave {
    double turns_per_m_x, turns_per_m_z;  ///< k / 2 pi, 1/m
    double frequency_hz;
    double phase_turns;
    double height_m;  ///< a
    double drag_m;    ///< how far it moves the octaves after it

    double turns_per_m() const;
};

/// The octaves in their order, the longest first. \pre check(sea) is empty
std::vector<PondOctave> octaves_of(const PondSea& sea);

/// Frequency of waves of gravity and surface tension, sqrt(g k + 7.4e-5 k^3) / 2 pi.
double ripple_frequency_hz(double turns_per_m);

/// How much of an octave samples so far apart can show, 1 to 0: 1 - smoothstep(0.4, 1, footprint over half a wavelength).
double shown_part(double wavelength_m, double footprint_m);

/// Means over all phases of (exp(sin p - 1) - I0(1)/e)^2, I0(2)/e^2 - (I0(1)/e)^2, and of the square of its derivative,
/// I1(2) / (2 e^2).
inline constexpr double pond_variance = 0.09157631048788914, pond_slope_variance = 0.10763464462446883;

struct PondSamples {
    std::span<float> height_m = {};
    std::span<float> normal_x = {}, normal_y = {}, normal_z = {};
    std::span<float> vertical_velocity_mps = {};  ///< dh/dt at the point
    /// Mean square slope of what the footprint hides: roughness, alpha^2 of GGX. The octaves' own, without what
    /// dragging adds.
    std::span<float> slope_variance = {};
};

struct PondHit {
    double distance_m;  ///< from the origin
    std::array<double, 3> position_m;
};

/// Const methods may be called from any number of threads at once. They allocate nothing and wait for nothing.
class PondWaves {
   public:
    /// Throws std::invalid_argument with check(sea)'s line, or for an instruction set that this CPU lacks.
    explicit PondWaves(const PondSea& sea, std::optional<Isa> isa = {});
    /// Of octaves that were moved onto a grid, for instance. \pre 1 to 64 finite ones (asserted)
    static PondWaves of(std::vector<PondOctave> octaves, std::optional<Isa> isa = {});
    ~PondWaves();
    PondWaves(PondWaves&&) noexcept;
    PondWaves& operator=(PondWaves&&) noexcept;

    /// \param footprint_m  how far apart samples lie at each point, a pixel's size on the water, or empty: everything is
    ///                     told. An octave fades from where that is 0.4 of half its wavelength to where it is the whole
    ///                     half: height and normal are of what is left, slope_variance is of the rest.
    /// \pre time_s is finite; spans are as long as the points or empty (asserted)
    void sample(double time_s, const AnalyticPoints& points, const PondSamples& samples,
                std::span<const float> footprint_m = {}) const;

    /// The first place where a ray from above meets the water, none within its reach. It is looked at only between
    /// the highest and the lowest water, every eighth of the last octave's wavelength along the ray; a crest through
    /// which it passes for less may be missed.
    /// The place is within 1e-6 m along the ray, or 1e-12 of the distance where that is more.
    /// \param direction  of any length but 0 \pre finite numbers (asserted)
    std::optional<PondHit> first_hit(double time_s, std::array<double, 3> origin_m, std::array<double, 3> direction,
                                     double reach_m) const;

    double lowest_m() const;
    double highest_m() const;
    const std::vector<PondOctave>& octaves() const { return octaves_; }

   private:
    PondWaves(std::optional<Isa> isa, std::vector<PondOctave> octaves);

    std::vector<PondOctave> octaves_;
    const AnalyticKernels* kernels_;
    std::vector<PondTerms> terms_;
    double height_m_, shortest_m_;
};

}  // namespace pelagic
