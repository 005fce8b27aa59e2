#include "pelagic/analytic/analytic_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "pelagic/analytic/kernels/analytic_kernels.hpp"
#include "pelagic/analytic/point_groups.hpp"
#include "pelagic/analytic/wave_phase.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

// The other half of the tolerance covers float rounding of a displacement of 64 m, the largest.
constexpr double search_target_m = AnalyticSurface::tolerance_m / 2;

GerstnerTerms terms_of(const PlaneWave& wave, double choppiness) {
    const double per_m = wave.turns_per_m(), x = wave.turns_per_m_x / per_m, z = wave.turns_per_m_z / per_m;
    const double k = two_pi * per_m, a = wave.amplitude_m, moved = choppiness * a;
    const double speed = two_pi * wave.frequency_hz;
    const auto rounded = [](double value) { return static_cast<float>(value); };
    return {.phase = {wave.turns_per_m_x, wave.turns_per_m_z},
            .turns_per_m_x = rounded(wave.turns_per_m_x),
            .turns_per_m_z = rounded(wave.turns_per_m_z),
            .height = rounded(a),
            .horizontal_x = rounded(-moved * x),
            .horizontal_z = rounded(-moved * z),
            .slope_x = rounded(-a * k * x),
            .slope_z = rounded(-a * k * z),
            .contraction_xx = rounded(-moved * k * x * x),
            .contraction_xz = rounded(-moved * k * x * z),
            .contraction_zz = rounded(-moved * k * z * z),
            .vertical_velocity = rounded(a * speed),
            .drift_x = rounded(moved * speed * x),
            .drift_z = rounded(moved * speed * z)};
}

// The search for q with q + D(q) = p. Let s = choppiness sum k A, at most 0.4, and M = choppiness
// sum k^2 A. Then |D'| <= s and |D''| <= M everywhere. From q with the residual off = q + D(q) - p
// of length r, a step is
//
// * a fixed-point step to q - off: off' = D(q - off) - D(q), so r' <= s r;
// * a Newton step to q - (1 + D')^-1 off, of length at most r / (1 - s): r' <= M/2 (r / (1 - s))^2
// by Taylor's theorem.
//
// Each step uses the method with the lower bound, so r' <= r min(s, c r), c = M / (2 (1 - s)^2).
// The search starts at p, where r is at most choppiness sum A, and ends when the bound is within
// the target.
struct Convergence {
    double s = 0, c = 0, first_m = 0;

    explicit Convergence(const PlaneWaves& sea) {
        double bend = 0;
        for (const PlaneWave& wave : sea.waves) {
            const double k = two_pi * wave.turns_per_m(), moved = sea.choppiness * wave.amplitude_m;
            s += k * moved;
            bend += k * k * moved;
            first_m += moved;
        }
        c = bend / (2 * (1 - s) * (1 - s));
    }

    /// Returns the upper bound of the steps, plus one for float rounding.
    int max_steps() const {
        int steps = 1;
        for (double r = first_m; r > search_target_m; r *= std::min(s, c * r)) ++steps;
        return steps;
    }
};

}  // namespace

AnalyticSurface::AnalyticSurface(const AnalyticSea& sea, std::optional<Isa> isa)
    : AnalyticSurface(plane_waves_of(checked(sea)), isa) {}

AnalyticSurface::AnalyticSurface(PlaneWaves waves, std::optional<Isa> isa) : waves_(std::move(waves)) {
    checked(waves_);
    const DefaultFloatEnvironment environment;
    kernels_ = &analytic_kernels_for(choose_isa(isa));
    for (const PlaneWave& wave : waves_.waves) terms_.push_back(terms_of(wave, waves_.choppiness));
    const Convergence search(waves_);
    contraction_ = static_cast<float>(search.s);
    curvature_ = static_cast<float>(search.c);
    max_steps_ = search.max_steps();
}

AnalyticSurface::~AnalyticSurface() = default;
AnalyticSurface::AnalyticSurface(AnalyticSurface&&) noexcept = default;
AnalyticSurface& AnalyticSurface::operator=(AnalyticSurface&&) noexcept = default;

void AnalyticSurface::sample_undisplaced(double time_s, const AnalyticPoints& rest,
                                         const AnalyticSamples& samples) const {
    sample_points(false, time_s, rest, samples);
}

void AnalyticSurface::sample(double time_s, const AnalyticPoints& world, const AnalyticSamples& samples) const {
    sample_points(true, time_s, world, samples);
}

void AnalyticSurface::sample_points(bool in_world, double time_s, const AnalyticPoints& points,
                                    const AnalyticSamples& samples) const {
    need_finite_time(time_s);
    const DefaultFloatEnvironment environment(time_s);
    std::array<double, max_analytic_waves> starts;
    for (std::size_t i = 0; i < terms_.size(); ++i)
        starts[i] = turns_at_origin(waves_.waves[i].phase_turns, waves_.waves[i].frequency_hz, time_s);

    const OutputArrays<10> arrays{samples.height_m,      samples.horizontal_x_m, samples.horizontal_z_m,
                                  samples.normal_x,      samples.normal_y,       samples.normal_z,
                                  samples.jacobian,      samples.velocity_x_mps, samples.velocity_y_mps,
                                  samples.velocity_z_mps};
    const auto level = static_cast<float>(waves_.level_m);
    const bool normals = arrays.has_any(3, 7), velocities = arrays.has_any(7, 10);
    for_each_group(points.x, points.z, arrays, kernels_->lanes, [&](const PointGroup<10>& group) {
        float* const* out = group.outputs.data();
        GerstnerJob job{.waves = terms_.data(),
                        .starts = starts.data(),
                        .wave_count = static_cast<int>(terms_.size()),
                        .count = group.count,
                        .x = group.x,
                        .z = group.z,
                        .out = {.height = out[0], .horizontal_x = out[1], .horizontal_z = out[2]},
                        .contraction = contraction_,
                        .curvature = curvature_,
                        .target_m = static_cast<float>(search_target_m),
                        .max_steps = max_steps_};
        if (normals)
            job.out.normal_x = out[3], job.out.normal_y = out[4], job.out.normal_z = out[5],
            job.out.jacobian = out[6];
        if (velocities) job.out.velocity_x = out[7], job.out.velocity_y = out[8], job.out.velocity_z = out[9];
        (in_world ? kernels_->gerstner_in_world : kernels_->gerstner_undisplaced)(job);
        for (std::size_t i = 0; i < group.count; ++i) out[0][i] += level;
    });
}

}  // namespace pelagic
