// Sums of Gerstner waves, and the search for the reference point of a displaced position.
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

/// W points, and the vectors from their reference points to them.
template <class Arch>
struct GerstnerPoints {
    using V = xsimd::batch<float, Arch>;

    /// Returns the rotation of a wave's phase at the reference point, which is the point minus
    /// `back`.
    PELAGIC_INLINE Rotation<Arch> rotation(const GerstnerTerms& wave, int i) const {
        const V turns = back_x * V(wave.turns_per_m_x) + back_z * V(wave.turns_per_m_z);
        return rotation_of_turns<Arch>(phases.of(i) - phase_of_turns<Arch>(turns));
    }

    PointPhases<Arch> phases;
    V back_x = V(0.f), back_z = V(0.f);
};

/// Horizontal displacement and its derivatives along x and z.
template <class Arch>
struct HorizontalSum {
    using V = xsimd::batch<float, Arch>;
    V x = V(0.f), z = V(0.f), xx = V(0.f), xz = V(0.f), zz = V(0.f);

    PELAGIC_INLINE void add(const GerstnerTerms& wave, const Rotation<Arch>& at) {
        x = x + V(wave.horizontal_x) * at.sine;
        z = z + V(wave.horizontal_z) * at.sine;
        xx = xx + V(wave.contraction_xx) * at.cosine;
        xz = xz + V(wave.contraction_xz) * at.cosine;
        zz = zz + V(wave.contraction_zz) * at.cosine;
    }
};

/// Finds the reference points of W displaced positions. Lanes that have converged do not change, so
/// a point's result does not depend on the other lanes.
template <class Arch>
PELAGIC_INLINE void search_reference(const GerstnerJob& job, GerstnerPoints<Arch>& at) {
    using V = xsimd::batch<float, Arch>;
    V error_bound(1e30f);
    for (int step = 0; step < job.max_steps; ++step) {
        const auto open = error_bound > V(job.target_m);
        if (!xsimd::any(open)) return;
        HorizontalSum<Arch> d;
        for (int i = 0; i < job.wave_count; ++i) d.add(job.waves[i], at.rotation(job.waves[i], i));

        // Displaced position of the reference point minus the given point.
        const V off_x = d.x - at.back_x, off_z = d.z - at.back_z;
        const V error = square_root<Arch>(off_x * off_x + off_z * off_z);
        const V j_xx = V(1.f) + d.xx, j_zz = V(1.f) + d.zz;
        const V inverse = divided<Arch>(V(1.f), j_xx * j_zz - d.xz * d.xz);
        const V after_newton = V(job.curvature) * error;
        const auto newton = after_newton <= V(job.contraction);
        const V step_x = xsimd::select(newton, (j_zz * off_x - d.xz * off_z) * inverse, off_x);
        const V step_z = xsimd::select(newton, (j_xx * off_z - d.xz * off_x) * inverse, off_z);
        at.back_x = xsimd::select(open, at.back_x + step_x, at.back_x);
        at.back_z = xsimd::select(open, at.back_z + step_z, at.back_z);
        error_bound = xsimd::select(open, error * xsimd::min(after_newton, V(job.contraction)), error_bound);
    }
}

/// Computes the outputs for W points.
template <class Arch, bool InWorld, bool Normals, bool Velocities>
PELAGIC_INLINE void gerstner_points(const GerstnerJob& job, std::size_t at) {
    using V = xsimd::batch<float, Arch>;
    GerstnerPoints<Arch> points{{job.waves, job.starts, job.wave_count, job.x + at, job.z + at}};
    if constexpr (InWorld) search_reference<Arch>(job, points);

    HorizontalSum<Arch> d;
    V height(0.f), slope_x(0.f), slope_z(0.f), vertical_velocity(0.f), drift_x(0.f), drift_z(0.f);
    for (int i = 0; i < job.wave_count; ++i) {
        const GerstnerTerms& wave = job.waves[i];
        const Rotation<Arch> r = InWorld ? points.rotation(wave, i) : rotation_of_turns<Arch>(points.phases.of(i));
        height = height + V(wave.height) * r.cosine;
        d.add(wave, r);  // the compiler removes unused sums
        if constexpr (Normals) {
            slope_x = slope_x + V(wave.slope_x) * r.sine;
            slope_z = slope_z + V(wave.slope_z) * r.sine;
        }
        if constexpr (Velocities) {
            vertical_velocity = vertical_velocity + V(wave.vertical_velocity) * r.sine;
            drift_x = drift_x + V(wave.drift_x) * r.cosine;
            drift_z = drift_z + V(wave.drift_z) * r.cosine;
        }
    }

    const WaveOutputs& out = job.out;
    height.store_unaligned(out.height + at);
    d.x.store_unaligned(out.horizontal_x + at);
    d.z.store_unaligned(out.horizontal_z + at);
    if constexpr (Normals) {
        const V j_xx = V(1.f) + d.xx, j_zz = V(1.f) + d.zz;
        const V n_x = slope_z * d.xz - slope_x * j_zz;
        const V n_y = j_xx * j_zz - d.xz * d.xz;
        const V n_z = slope_x * d.xz - slope_z * j_xx;
        const V inverse = divided<Arch>(V(1.f), square_root<Arch>(n_x * n_x + n_y * n_y + n_z * n_z));
        (n_x * inverse).store_unaligned(out.normal_x + at);
        (n_y * inverse).store_unaligned(out.normal_y + at);
        (n_z * inverse).store_unaligned(out.normal_z + at);
        n_y.store_unaligned(out.jacobian + at);
    }
    if constexpr (Velocities) {
        drift_x.store_unaligned(out.velocity_x + at);
        vertical_velocity.store_unaligned(out.velocity_y + at);
        drift_z.store_unaligned(out.velocity_z + at);
    }
}

template <class Arch, bool InWorld, bool Normals, bool Velocities>
PELAGIC_FLATTEN void all_gerstner_points(const GerstnerJob& job) {
    for (std::size_t at = 0; at < job.count; at += xsimd::batch<float, Arch>::size)
        gerstner_points<Arch, InWorld, Normals, Velocities>(job, at);
}

template <class Arch, bool InWorld>
PELAGIC_INLINE void gerstner(const GerstnerJob& job) {
    if (job.out.normal_x && job.out.velocity_x) return all_gerstner_points<Arch, InWorld, true, true>(job);
    if (job.out.normal_x) return all_gerstner_points<Arch, InWorld, true, false>(job);
    if (job.out.velocity_x) return all_gerstner_points<Arch, InWorld, false, true>(job);
    all_gerstner_points<Arch, InWorld, false, false>(job);
}

template <class Arch>
void gerstner_undisplaced(const GerstnerJob& job) {
    gerstner<Arch, false>(job);
}

template <class Arch>
void gerstner_in_world(const GerstnerJob& job) {
    gerstner<Arch, true>(job);
}

}  // namespace pelagic::kernels
