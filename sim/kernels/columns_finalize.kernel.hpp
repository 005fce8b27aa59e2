#pragma once

#include <cstddef>
#include <type_traits>

#include "pelagic/sim/kernels/fft.kernel.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"

namespace pelagic::kernels {

/// Returns the minimum of a batch's lanes. The sign of a zero depends on the order of lanes; adding
/// 0 makes it positive.
template <class Arch>
inline float min_lane(xsimd::batch<float, Arch> v) {
    float lanes[xsimd::batch<float, Arch>::size];
    v.store_unaligned(lanes);
    float min = lanes[0];
    for (const float lane : lanes) min = lane < min ? lane : min;
    return min + 0.f;
}

template <class Arch>
inline float max_lane(xsimd::batch<float, Arch> v) {
    float lanes[xsimd::batch<float, Arch>::size];
    v.store_unaligned(lanes);
    float max = lanes[0];
    for (const float lane : lanes) max = lane > max ? lane : max;
    return max + 0.f;
}

/// Expands the half plane kz in [0, N/2) of W columns to the whole spectrum and executes the first
/// step. `half` returns the values at kz = 0, n and -n. The Nyquist wave is 0.
template <class Arch, std::size_t Radix, class HalfPlane>
PELAGIC_FLATTEN void load_columns(float* data, const FftTables& fft, HalfPlane half) {
    using C = Complex<Arch>;
    constexpr std::size_t element = 2 * xsimd::batch<float, Arch>::size;
    const std::size_t size = static_cast<std::size_t>(fft.size);
    const std::size_t groups = size / Radix;
    const auto load_group = [=, &fft](std::size_t a, auto is_first) {
        butterfly<Arch, Radix>(
            [=](std::size_t s) -> C {
                if (is_first && s == 0) return half.zero();
                if (is_first && s == Radix / 2) return C{0.f, 0.f};
                return s < Radix / 2 ? half.wave(a + s * groups) : half.mirror(size - a - s * groups);
            },
            OutputsApart<Arch>{data + fft.positions[a] * element, element});
    };
    load_group(0, std::true_type());
    for (std::size_t a = 1; a < groups; ++a) load_group(a, std::false_type());
}

/// Executes the last step and calls finish(z, result) for each result.
template <class Arch, std::size_t Radix, class Finish>
PELAGIC_FLATTEN Finish finish_columns(const float* data, const FftTables& fft, Finish finish) {
    constexpr std::size_t element = 2 * xsimd::batch<float, Arch>::size;
    const FftStep& step = fft.last_step();
    const std::size_t span = static_cast<std::size_t>(step.span);
    const float* roots = fft.twiddles + step.first_twiddle;
    for (std::size_t j = 0; j < span; ++j, roots += 2 * Radix)
        butterfly<Arch, Radix>(
            InputsApart<Arch>{data + j * element, span * element, roots},
            [&finish, j, span](std::size_t k, const Complex<Arch>& x) { finish(j + k * span, x); });
    return finish;
}

template <class Arch, class HalfPlane, class Finish>
inline Finish transform_columns(const FftTables& fft, float* data, HalfPlane half, Finish finish) {
    if (fft.first_step().radix == 8)
        load_columns<Arch, 8>(data, fft, half);
    else
        load_columns<Arch, 4>(data, fft, half);

    // Two middle steps process one block of the data after another, so that it stays in the
    // first-level cache. A single middle step processes all data at once.
    constexpr std::size_t element = 2 * xsimd::batch<float, Arch>::size;
    const std::size_t size = static_cast<std::size_t>(fft.size);
    const std::size_t block_size = fft.step_count > 3 ? static_cast<std::size_t>(fft.last_step().span) : size;
    for (std::size_t first = 0; first < size; first += block_size)
        middle_steps<Arch, 1>(data + first * element, block_size, fft);

    if (fft.last_step().radix == 8) return finish_columns<Arch, 8>(data, fft, finish);
    return finish_columns<Arch, 4>(data, fft, finish);
}

/// The horizontal pair: P for positive kz, R with real and imaginary part exchanged for negative
/// kz.
template <class Arch>
struct HorizontalHalfPlane {
    using V = xsimd::batch<float, Arch>;
    PELAGIC_INLINE Complex<Arch> zero() const { return wave(0); }
    PELAGIC_INLINE Complex<Arch> wave(std::size_t n) const { return {line(n, p_re), line(n, p_im)}; }
    PELAGIC_INLINE Complex<Arch> mirror(std::size_t n) const { return {line(n, r_im), line(n, r_re)}; }
    PELAGIC_INLINE V line(std::size_t n, std::size_t component) const {
        return V::load_aligned(block + (n * line_components + component) * V::size);
    }
    const float* block;
};

/// Converts a transformed horizontal pair to the displacement along the world's axes, times lambda.
/// The pair is minus the displacement along the cascade's axes.
template <class Arch, bool Turned>
struct FinishHorizontal {
    using V = xsimd::batch<float, Arch>;
    FinishHorizontal(const ColumnsFinalizeJob& job, float* to, V x_so_far, V z_so_far)
        : straight(0.f - (Turned ? job.choppiness * job.cosine : job.choppiness)),
          crossed(0.f - job.choppiness * job.sine),
          block(to),
          max_x(x_so_far),
          max_z(z_so_far) {}
    PELAGIC_INLINE void operator()(std::size_t row, const Complex<Arch>& p) {
        float* to = block + row * surface_components * V::size;
        const V dx = Turned ? p.re * straight - p.im * crossed : p.re * straight;
        const V dz = Turned ? p.re * crossed + p.im * straight : p.im * straight;
        dx.store_aligned(to + surface_dx * V::size);
        dz.store_aligned(to + surface_dz * V::size);
        max_x = xsimd::max(max_x, xsimd::abs(dx));
        max_z = xsimd::max(max_z, xsimd::abs(dz));
    }
    V straight, crossed;
    float* block;
    V max_x, max_z;
};

template <class Arch, bool Turned>
inline void horizontal_columns(const ColumnsFinalizeJob& job, float* workspace) {
    using V = xsimd::batch<float, Arch>;
    V max_x(0.f), max_z(0.f);
    for (float* block : job.blocks) {
        if (!block) continue;
        const auto finished = transform_columns<Arch>(*job.fft, workspace, HorizontalHalfPlane<Arch>{block},
                                                      FinishHorizontal<Arch, Turned>(job, block, max_x, max_z));
        max_x = finished.max_x;
        max_z = finished.max_z;
    }
    job.bounds->horizontal_x_max_m = max_lane<Arch>(max_x);
    job.bounds->horizontal_z_max_m = max_lane<Arch>(max_z);
}

/// The heights of two column blocks as a + i b. Both are real, so the value at -kz is conj(a) + i
/// conj(b). At kz = 0 the imaginary parts are rounding errors and are discarded, and the level adds to
/// the mean of each column.
template <class Arch, bool HasSecond>
struct HeightHalfPlane {
    using V = xsimd::batch<float, Arch>;
    PELAGIC_INLINE Complex<Arch> zero() const {
        return {a(0, height_re) + level, HasSecond ? b(0, height_re) + level : V(0.f)};
    }
    PELAGIC_INLINE Complex<Arch> wave(std::size_t n) const {
        return {a(n, height_re) - b(n, height_im), a(n, height_im) + b(n, height_re)};
    }
    PELAGIC_INLINE Complex<Arch> mirror(std::size_t n) const {
        return {a(n, height_re) + b(n, height_im), b(n, height_re) - a(n, height_im)};
    }
    PELAGIC_INLINE V a(std::size_t n, std::size_t component) const {
        return V::load_aligned(first + (n * line_components + component) * V::size);
    }
    PELAGIC_INLINE V b(std::size_t n, std::size_t component) const {
        return HasSecond ? V::load_aligned(second + (n * line_components + component) * V::size) : V(0.f);
    }
    const float *first, *second;
    V level;
};

template <class Arch, bool HasSecond>
struct FinishHeights {
    using V = xsimd::batch<float, Arch>;
    PELAGIC_INLINE void operator()(std::size_t row, const Complex<Arch>& ab) {
        const std::size_t at = (row * surface_components + surface_height) * V::size;
        take(ab.re, first + at);
        if constexpr (HasSecond) take(ab.im, second + at);
    }
    PELAGIC_INLINE void take(V height, float* to) {
        height.store_aligned(to);
        min = xsimd::min(min, height);
        max = xsimd::max(max, height);
    }
    float *first, *second;
    V min = V(3.4e38f), max = V(-3.4e38f);
};

template <class Arch, bool HasSecond>
inline void height_columns(const ColumnsFinalizeJob& job, float* workspace) {
    float *const first = job.blocks[0], *const second = job.blocks[1];
    const auto finished =
        transform_columns<Arch>(*job.fft, workspace, HeightHalfPlane<Arch, HasSecond>{first, second, job.level_m},
                                FinishHeights<Arch, HasSecond>{first, second});
    job.bounds->height_min_m = min_lane<Arch>(finished.min);
    job.bounds->height_max_m = max_lane<Arch>(finished.max);
}

template <class Arch>
void columns_finalize(const ColumnsFinalizeJob& job) {
    float* const workspace = PELAGIC_STACK_FLOATS(workspace_floats<Arch>(*job.fft));
    // Transform the heights first: they overwrite only heights, so the horizontal fields of the
    // lines stay intact.
    if (job.blocks[1])
        height_columns<Arch, true>(job, workspace);
    else
        height_columns<Arch, false>(job, workspace);

    if (job.sine == 0)
        horizontal_columns<Arch, false>(job, workspace);
    else
        horizontal_columns<Arch, true>(job, workspace);
}

}  // namespace pelagic::kernels
