// Octaves of exp(sin - 1), each moved by the slopes of those before it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/analytic/kernels/analytic_kernels.hpp"
#include "pelagic/analytic/kernels/phases.kernel.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/exact.kernel.hpp"
#include "pelagic/simd/turns.kernel.hpp"

namespace pelagic::kernels {

/// exp(s - 1) of s in [-1, 1], within 2^-23: a polynomial fitted at Chebyshev nodes.
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> exp_of_sine(xsimd::batch<float, Arch> s) {
    using V = xsimd::batch<float, Arch>;
    V sum(9.354704e-06f);
    sum = V(7.53043059e-05f) + s * sum;
    sum = V(0.000510770013f) + s * sum;
    sum = V(0.00306392042f) + s * sum;
    sum = V(0.0153283579f) + s * sum;
    sum = V(0.061313726f) + s * sum;
    sum = V(0.18393971f) + s * sum;
    sum = V(0.367879391f) + s * sum;
    return V(0.36787945f) + s * sum;
}

/// 1 - smoothstep(0.4, 1, footprint over half a wave): how much of an octave points so far apart can show.
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> shown_part(xsimd::batch<float, Arch> half_waves) {
    using V = xsimd::batch<float, Arch>;
    const V t = xsimd::min(xsimd::max((half_waves - V(0.4f)) * V(1.f / 0.6f), V(0.f)), V(1.f));
    return V(1.f) - t * t * (V(3.f) - (t + t));
}

template <class Arch>
PELAGIC_INLINE void exp_sine_points(const ExpSineJob& job, std::size_t at) {
    using V = xsimd::batch<float, Arch>;
    const PointPhases<Arch> phases(job.octaves, job.starts, job.octave_count, job.x + at, job.z + at);
    const V footprint = job.footprint ? V::load_unaligned(job.footprint + at) : V(0.f);
    V height(0.f), slope_x(0.f), slope_z(0.f), rise(0.f), left(0.f);
    // Where the point has been moved to, less where it is; its derivatives along x, along z and in time.
    V off_x(0.f), off_z(0.f), x_x(1.f), x_z(0.f), z_x(0.f), z_z(1.f), x_t(0.f), z_t(0.f);
    for (int i = 0; i < job.octave_count; ++i) {
        const ExpSineTerms& octave = job.octaves[i];
        const V way_x(octave.way_x), way_z(octave.way_z), k(octave.k);
        const V moved_turns = (way_x * off_x + way_z * off_z) * V(octave.turns_per_m);
        const auto [s, c] = rotation_of_turns<Arch>(phases.of(i) + phase_of_turns<Arch>(moved_turns));
        const V wave = exp_of_sine<Arch>(s);
        const V shown = shown_part<Arch>(footprint * V(octave.half_waves_per_m));

        const V amplitude = V(octave.height) * shown;
        height = height + amplitude * (wave - V(0.465759608f));  // E exp(sin p - 1) = I0(1) / e
        const V gain = amplitude * wave * c;
        const V phase_x = k * (way_x * x_x + way_z * z_x), phase_z = k * (way_x * x_z + way_z * z_z);
        const V phase_t = k * (way_x * x_t + way_z * z_t) - V(octave.frequency);
        slope_x = slope_x + gain * phase_x;
        slope_z = slope_z + gain * phase_z;
        rise = rise + gain * phase_t;
        // E (exp(sin p - 1) cos p)^2 = I1(2) / (2 e^2)
        const V steepness = V(octave.height) * k;
        left = left + (V(1.f) - shown * shown) * (steepness * steepness * V(0.107634645f));

        const V drag = V(octave.drag) * shown * wave;
        const V by = drag * c, by_phase = drag * (c * c - s);
        off_x = off_x - way_x * by;
        off_z = off_z - way_z * by;
        x_x = x_x - way_x * (by_phase * phase_x);
        x_z = x_z - way_x * (by_phase * phase_z);
        x_t = x_t - way_x * (by_phase * phase_t);
        z_x = z_x - way_z * (by_phase * phase_x);
        z_z = z_z - way_z * (by_phase * phase_z);
        z_t = z_t - way_z * (by_phase * phase_t);
    }

    const ExpSineAnswers& out = job.out;
    height.store_unaligned(out.height + at);
    if (!out.normal_x) return;
    const V inverse = divided<Arch>(V(1.f), square_root<Arch>(slope_x * slope_x + V(1.f) + slope_z * slope_z));
    (-slope_x * inverse).store_unaligned(out.normal_x + at);
    inverse.store_unaligned(out.normal_y + at);
    (-slope_z * inverse).store_unaligned(out.normal_z + at);
    rise.store_unaligned(out.rise + at);
    left.store_unaligned(out.slope_variance + at);
}

template <class Arch>
PELAGIC_FLATTEN void exp_sine(const ExpSineJob& job) {
    for (std::size_t at = 0; at < job.count; at += xsimd::batch<float, Arch>::size) exp_sine_points<Arch>(job, at);
}

}  // namespace pelagic::kernels
