// The water of an AnalyticSea, or of any PlaneWaves, at any points and times, in closed form: no frame, no grid, no state.
//
//   const AnalyticSurface water(analytic_preset_named("analytic-moderate")->sea);
//   water.sample(time_s, {.x = xs, .z = zs}, {.height_m = heights});
//
//   phase = k.q - w t + phase,  h = sum A cos(phase),  D = -choppiness sum A k/|k| sin(phase)
//
// and the water that rests at q is drawn at q + D, h high: with choppiness 1 each particle goes round in a circle
// (Gerstner 1802). Slopes, Jacobian and velocity are the derivatives of these sums.
//
// Bits depend on the sea, the time and the point alone: not on other points, nor their order, nor the thread, nor the
// instruction set. The same time gives the same bits however it was reached, and any finite time keeps its accuracy: the
// turns of a wave are an exact product of two doubles (wave_phase.hpp). Heights of reference points are within 1e-6 of the
// sum of the amplitudes up to 1e6 of the shortest wavelength from the origin.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "pelagic/analytic/analytic_sea.hpp"
#include "pelagic/analytic/plane_waves.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic {

struct AnalyticKernels;
struct GerstnerJob;
struct GerstnerTerms;

/// Metres, finite, at most 1e9 from the origin (asserted).
struct AnalyticPoints {
    std::span<const double> x, z;  ///< equally long
};

/// What to tell. Each span is as long as the points, or empty if nobody wants it. None aliases another or the points.
struct AnalyticSamples {
    std::span<float> height_m = {};
    /// D: the water is drawn so far from where it rests.
    std::span<float> horizontal_x_m = {}, horizontal_z_m = {};
    /// Unit normal of the displaced surface, (hz Dz,x - hx (1 + Dz,z), J, hx Dx,z - hz (1 + Dx,x)) over its length.
    std::span<float> normal_x = {}, normal_y = {}, normal_z = {};
    /// J = (1 + Dx,x)(1 + Dz,z) - Dx,z Dz,x: 1 at rest, less at crests, never below 0.6.
    std::span<float> jacobian = {};
    std::span<float> velocity_x_mps = {}, velocity_y_mps = {}, velocity_z_mps = {};  ///< of the water
};

/// Const methods may be called from any number of threads at once. They allocate nothing and wait for nothing.
class AnalyticSurface {
   public:
    /// The sampled water of a world point is drawn at most this far from it.
    static constexpr double tolerance_m = 1e-4;

    /// Throws std::invalid_argument with check(sea)'s line, or for an instruction set that this CPU lacks.
    explicit AnalyticSurface(const AnalyticSea& sea, std::optional<Isa> isa = {});
    explicit AnalyticSurface(PlaneWaves waves, std::optional<Isa> isa = {});
    ~AnalyticSurface();
    AnalyticSurface(AnalyticSurface&&) noexcept;
    AnalyticSurface& operator=(AnalyticSurface&&) noexcept;

    /// The water that rests at the points. \pre time_s is finite; spans are as long as the points or empty (asserted)
    void sample_undisplaced(double time_s, const AnalyticPoints& rest, const AnalyticSamples& samples) const;

    /// The water that is drawn at the points: its reference point is the point less `horizontal`.
    void sample(double time_s, const AnalyticPoints& world, const AnalyticSamples& samples) const;

    const PlaneWaves& waves() const { return waves_; }
    /// Steps after which a search has ended, wherever the point lies; analytic_surface.cpp says why.
    int max_search_steps() const { return max_steps_; }

   private:
    void sample_points(bool in_world, double time_s, const AnalyticPoints& points,
                       const AnalyticSamples& samples) const;

    PlaneWaves waves_;
    const AnalyticKernels* kernels_;
    std::vector<GerstnerTerms> terms_;
    float contraction_, curvature_;
    int max_steps_;
};

}  // namespace pelagic
