// Octaves of exp(sin - 1), each displaced by the slopes of the octaves before it.
#pragma once

#include <cstddef>
#include <utility>
#include <xsimd/xsimd.hpp>

#include "pelagic/analytic/kernels/analytic_kernels.hpp"
#include "pelagic/analytic/kernels/phases.kernel.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/exact.kernel.hpp"
#include "pelagic/simd/turns.kernel.hpp"

namespace pelagic::kernels {

/// Returns exp(s - 1) for s in [-1, 1], within 2^-23, by a polynomial fitted at Chebyshev nodes.
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

/// Returns the weight of an octave: 1 - smoothstep(0.4, 1, half_waves).
/// \param half_waves  footprint divided by half a wavelength
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> footprint_weight(xsimd::batch<float, Arch> half_waves) {
    using V = xsimd::batch<float, Arch>;
    const V t = xsimd::min(xsimd::max((half_waves - V(0.4f)) * V(1.f / 0.6f), V(0.f)), V(1.f));
    return V(1.f) - t * t * (V(3.f) - (t + t));
}

/// Sums of the octaves at W points. Without `Slopes`, only heights are computed.
template <class Arch, bool Slopes>
class PondPoints {
    using V = xsimd::batch<float, Arch>;

   public:
    PELAGIC_INLINE PondPoints(const PondJob& job, std::size_t at)
        : phases_(job.octaves, job.starts, job.octave_count, job.x + at, job.z + at),
          footprint_(job.footprint ? V::load_unaligned(job.footprint + at) : V(0.f)) {}

    PELAGIC_INLINE void add(const PondTerms& octave, int i) {
        const V direction_x(octave.direction_x), direction_z(octave.direction_z), k(octave.k);
        const V moved_turns = (direction_x * off_x_ + direction_z * off_z_) * V(octave.turns_per_m);
        const auto [s, c] = rotation_of_turns<Arch>(phases_.of(i) + phase_of_turns<Arch>(moved_turns));
        const V wave = exp_of_sine<Arch>(s), shown = footprint_weight<Arch>(footprint_ * V(octave.half_waves_per_m));
        const V amplitude = V(octave.height) * shown, drag = V(octave.drag) * shown * wave, by = drag * c;
        height_ = height_ + amplitude * (wave - V(0.465759608f));  // E exp(sin p - 1) = I0(1) / e
        off_x_ = off_x_ - direction_x * by;
        off_z_ = off_z_ - direction_z * by;
        if constexpr (!Slopes) return;

        const V phase_x = k * (direction_x * x_x_ + direction_z * z_x_),
                phase_z = k * (direction_x * x_z_ + direction_z * z_z_);
        const V phase_t = k * (direction_x * x_t_ + direction_z * z_t_) - V(octave.frequency);
        const V gain = amplitude * wave * c, by_phase = drag * (c * c - s);
        slope_x_ = slope_x_ + gain * phase_x;
        slope_z_ = slope_z_ + gain * phase_z;
        vertical_velocity_ = vertical_velocity_ + gain * phase_t;
        x_x_ = x_x_ - direction_x * (by_phase * phase_x);
        x_z_ = x_z_ - direction_x * (by_phase * phase_z);
        x_t_ = x_t_ - direction_x * (by_phase * phase_t);
        z_x_ = z_x_ - direction_z * (by_phase * phase_x);
        z_z_ = z_z_ - direction_z * (by_phase * phase_z);
        z_t_ = z_t_ - direction_z * (by_phase * phase_t);
        // E (exp(sin p - 1) cos p)^2 = I1(2) / (2 e^2)
        const V steepness = V(octave.height) * k;
        hidden_ = hidden_ + (V(1.f) - shown * shown) * (steepness * steepness * V(0.107634645f));
    }

    PELAGIC_INLINE void store(const PondOutputs& out, std::size_t at) const {
        height_.store_unaligned(out.height + at);
        if constexpr (!Slopes) return;
        const V length = square_root<Arch>(slope_x_ * slope_x_ + V(1.f) + slope_z_ * slope_z_);
        const V up = divided<Arch>(V(1.f), length), down = V(-1.f) * up;
        (slope_x_ * down).store_unaligned(out.normal_x + at);
        up.store_unaligned(out.normal_y + at);
        (slope_z_ * down).store_unaligned(out.normal_z + at);
        vertical_velocity_.store_unaligned(out.vertical_velocity + at);
        hidden_.store_unaligned(out.slope_variance + at);
    }

   private:
    PointPhases<Arch> phases_;
    V footprint_;
    V height_ = V(0.f), slope_x_ = V(0.f), slope_z_ = V(0.f), vertical_velocity_ = V(0.f), hidden_ = V(0.f);
    /// Displacement of the points, and derivatives of the displaced position along x, along z and
    /// in time.
    V off_x_ = V(0.f), off_z_ = V(0.f);
    V x_x_ = V(1.f), x_z_ = V(0.f), z_x_ = V(0.f), z_z_ = V(1.f), x_t_ = V(0.f), z_t_ = V(0.f);
};

/// Processes a group of registers together. An octave depends on the octaves before it, and the
/// other registers hide that latency.
template <class Arch, bool Slopes, std::size_t... Registers>
PELAGIC_FLATTEN void pond_groups(const PondJob& job, std::index_sequence<Registers...>) {
    constexpr std::size_t lanes = xsimd::batch<float, Arch>::size;
    for (std::size_t at = 0; at < job.count; at += analytic_group) {
        PondPoints<Arch, Slopes> points[] = {{job, at + Registers * lanes}...};
        for (int i = 0; i < job.octave_count; ++i) (points[Registers].add(job.octaves[i], i), ...);
        (points[Registers].store(job.out, at + Registers * lanes), ...);
    }
}

template <class Arch>
void pond(const PondJob& job) {
    const std::make_index_sequence<analytic_group / xsimd::batch<float, Arch>::size> registers;
    if (job.out.normal_x) return pond_groups<Arch, true>(job, registers);
    pond_groups<Arch, false>(job, registers);
}

}  // namespace pelagic::kernels
