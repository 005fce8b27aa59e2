// Evaluates an AnalyticSea, or any PlaneWaves, in closed form at any points and times, without a
// frame or grid.
//
//   const AnalyticSurface water(analytic_preset_named("analytic-moderate")->sea);
//   water.sample(time_s, {.x = xs, .z = zs}, {.height_m = heights});
//
//   phase = k.q - w t + phase,  h = level + sum A cos(phase),  D = -choppiness sum A k/|k| sin(phase)
//
// The water with the undisplaced position q is at q + D, with the height h. With choppiness 1 each
// particle moves in a circle (Gerstner 1802). Slopes, Jacobian and velocity are the derivatives of
// these sums.
//
// Results are bit-identical for equal sea, time and point. They do not depend on other points,
// their order, the thread or the instruction set. Accuracy is constant for any finite time, because
// the turns of a wave are an exact product of two doubles (wave_phase.hpp). Heights of reference
// points are within 1e-6 of the sum of the amplitudes, up to 1e6 times the shortest wavelength from
// the origin.
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

/// Positions in metres, finite, at most 1e9 from the origin.
struct AnalyticPoints {
    std::span<const double> x, z;  ///< equally long
};

/// Outputs. Each span is as long as the points, or empty: then the field is not computed. No span
/// aliases another or the points.
struct AnalyticSamples {
    std::span<float> height_m = {};
    /// Horizontal displacement D from the undisplaced position.
    std::span<float> horizontal_x_m = {}, horizontal_z_m = {};
    /// Unit normal of the displaced surface, (hz Dz,x - hx (1 + Dz,z), J, hx Dx,z - hz (1 + Dx,x))
    /// over its length.
    std::span<float> normal_x = {}, normal_y = {}, normal_z = {};
    /// J = (1 + Dx,x)(1 + Dz,z) - Dx,z Dz,x: 1 on flat water, less at crests, at least 0.6.
    std::span<float> jacobian = {};
    /// Velocity of the water particle.
    std::span<float> velocity_x_mps = {}, velocity_y_mps = {}, velocity_z_mps = {};
};

/// Evaluator of an analytic sea. Const methods are thread-safe, do not allocate and do not block.
class AnalyticSurface {
   public:
    /// Largest horizontal distance of the water that sample() finds from the given point, metres.
    static constexpr double tolerance_m = 1e-4;

    /// \throws std::invalid_argument if check(sea) is not empty, or the CPU lacks the instruction
    /// set
    explicit AnalyticSurface(const AnalyticSea& sea, std::optional<Isa> isa = {});
    /// As above, for plane waves.
    /// \throws std::invalid_argument if the CPU lacks the instruction set
    explicit AnalyticSurface(PlaneWaves waves, std::optional<Isa> isa = {});
    ~AnalyticSurface();
    AnalyticSurface(AnalyticSurface&&) noexcept;
    AnalyticSurface& operator=(AnalyticSurface&&) noexcept;

    /// Samples the water whose undisplaced positions are `rest`.
    /// \throws std::invalid_argument  before it writes, if the time or a point is out of range, or a
    ///                                span differs in length from the points and is not empty
    void sample_undisplaced(double time_s, const AnalyticPoints& rest, const AnalyticSamples& samples) const;

    /// Samples the water that is at the points `world`. Its reference point is the point minus
    /// `horizontal`.
    /// \throws std::invalid_argument  what sample_undisplaced() throws
    void sample(double time_s, const AnalyticPoints& world, const AnalyticSamples& samples) const;

    /// Returns the waves of the sea.
    const PlaneWaves& waves() const { return waves_; }
    /// Returns the upper bound of the search's steps for any point (proof in analytic_surface.cpp).
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
