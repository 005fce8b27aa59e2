#pragma once

#include <cstddef>

#include "pelagic/sim/kernels/fft.kernel.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"

namespace pelagic::kernels {

/// Extremes of a batch's lanes. A zero may come with either sign, by the order of lanes; + 0 makes it positive.
template <class Arch>
inline float least_lane(xsimd::batch<float, Arch> v) {
    float lanes[xsimd::batch<float, Arch>::size];
    v.store_unaligned(lanes);
    float least = lanes[0];
    for (const float lane : lanes) least = lane < least ? lane : least;
    return least + 0.f;
}

template <class Arch>
inline float most_lane(xsimd::batch<float, Arch> v) {
    float lanes[xsimd::batch<float, Arch>::size];
    v.store_unaligned(lanes);
    float most = lanes[0];
    for (const float lane : lanes) most = lane > most ? lane : most;
    return most + 0.f;
}

/// Spreads the half plane kz in [0, N/2) of W columns over the whole spectrum, through the first step: `wave(n)` and
/// `mirror(n)` give the values at kz = n and -n; the Nyquist wave is none.
template <class Arch, std::size_t Radix, class Wave, class Mirror>
inline void load_columns(float* data, const FftTables& fft, Wave wave, Mirror mirror) {
    using V = xsimd::batch<float, Arch>;
    constexpr std::size_t element = 2 * V::size;
    const std::size_t size = static_cast<std::size_t>(fft.size);
    const std::size_t groups = size / Radix;
    for (std::size_t a = 0; a < groups; ++a) {
        Complex<Arch> x[Radix];
        for (std::size_t s = 0; s < Radix / 2; ++s) x[s] = wave(a + s * groups);
        if (a == 0)
            x[Radix / 2] = {V(0.f), V(0.f)};
        else
            x[Radix / 2] = mirror(size / 2 - a);
        for (std::size_t s = Radix / 2 + 1; s < Radix; ++s) x[s] = mirror(size - a - s * groups);
        butterfly<Arch>(x);
        float* to = data + fft.positions[a] * element;
        for (std::size_t s = 0; s < Radix; ++s) x[s].store(to + s * element);
    }
}

/// The last step; `finish(z, span, results)` takes the results of each butterfly, which stand at z, z + span, ...
template <class Arch, std::size_t Radix, class Finish>
inline void finish_columns(const float* data, const FftTables& fft, Finish finish) {
    constexpr std::size_t element = 2 * xsimd::batch<float, Arch>::size;
    const FftStep& step = fft.last_step();
    const std::size_t span = static_cast<std::size_t>(step.span);
    const float* roots = fft.twiddles + step.first_twiddle;
    for (std::size_t j = 0; j < span; ++j, roots += 2 * (Radix - 1)) {
        Complex<Arch> x[Radix];
        joined<Arch, Radix>(x, data + j * element, span, roots);
        finish(j, span, x);
    }
}

template <class Arch, class Wave, class Mirror, class Finish>
inline void transform_columns(const FftTables& fft, float* data, Wave wave, Mirror mirror, Finish finish) {
    if (fft.first_step().radix == 8)
        load_columns<Arch, 8>(data, fft, wave, mirror);
    else
        load_columns<Arch, 4>(data, fft, wave, mirror);

    const std::size_t parts = static_cast<std::size_t>(fft.last_step().radix);
    const std::size_t part_floats =
        static_cast<std::size_t>(fft.last_step().span) * 2 * xsimd::batch<float, Arch>::size;
    for (std::size_t part = 0; part < parts; ++part) middle_steps<Arch>(data + part * part_floats, fft);

    if (fft.last_step().radix == 8)
        finish_columns<Arch, 8>(data, fft, finish);
    else
        finish_columns<Arch, 4>(data, fft, finish);
}

/// From a transformed sideways pair, which is minus the displacement along the tile's axes, to the displacement along the
/// world's, times lambda.
template <class Arch, bool Turned>
struct SidewaysFactors {
    using V = xsimd::batch<float, Arch>;
    explicit SidewaysFactors(const ColumnsFinalizeJob& job)
        : straight(0.f - (Turned ? job.choppiness * job.cosine : job.choppiness)),
          crossed(0.f - job.choppiness * job.sine) {}
    PELAGIC_INLINE V x(const Complex<Arch>& p) const {
        return Turned ? p.re * straight - p.im * crossed : p.re * straight;
    }
    PELAGIC_INLINE V z(const Complex<Arch>& p) const {
        return Turned ? p.re * crossed + p.im * straight : p.im * straight;
    }
    V straight, crossed;
};

/// The sideways pair of one column block: P above, R with its parts exchanged below.
template <class Arch, bool Turned>
inline void sideways_columns(const ColumnsFinalizeJob& job, float* block, float* workspace,
                             xsimd::batch<float, Arch> (&most)[2]) {
    using V = xsimd::batch<float, Arch>;
    const auto line = [block](std::size_t n, std::size_t component) {
        return V::load_aligned(block + (n * line_components + component) * V::size);
    };
    const SidewaysFactors<Arch, Turned> factors(job);
    V most_x = most[0], most_z = most[1];
    transform_columns<Arch>(
        *job.fft, workspace,
        [line](std::size_t n) {
            return Complex<Arch>{line(n, p_re), line(n, p_im)};
        },
        [line](std::size_t n) {
            return Complex<Arch>{line(n, r_im), line(n, r_re)};
        },
        [&most_x, &most_z, factors, block](std::size_t row, std::size_t span, const auto& results) {
            float* to = block + row * surface_components * V::size;
            V here_x(0.f), here_z(0.f);
            for (const Complex<Arch>& result : results) {
                const V dx = factors.x(result), dz = factors.z(result);
                dx.store_aligned(to + surface_dx * V::size);
                dz.store_aligned(to + surface_dz * V::size);
                here_x = xsimd::max(here_x, xsimd::abs(dx));
                here_z = xsimd::max(here_z, xsimd::abs(dz));
                to += span * surface_components * V::size;
            }
            most_x = xsimd::max(most_x, here_x);
            most_z = xsimd::max(most_z, here_z);
        });
    most[0] = most_x;
    most[1] = most_z;
}

/// The heights of two column blocks as a + i b. Both are real, so conj(a) + i conj(b) is the mirror; at kz = 0 their
/// imaginary parts are rounding errors and are dropped.
template <class Arch, bool HasSecond>
inline void height_columns(float* first, float* second, const FftTables& fft, float* workspace, PartBounds& bounds) {
    using V = xsimd::batch<float, Arch>;
    const auto a = [first](std::size_t n, std::size_t component) {
        return V::load_aligned(first + (n * line_components + component) * V::size);
    };
    const auto b = [second](std::size_t n, std::size_t component) {
        return HasSecond ? V::load_aligned(second + (n * line_components + component) * V::size) : V(0.f);
    };
    V least(3.4e38f), most(-3.4e38f);
    transform_columns<Arch>(
        fft, workspace,
        [a, b](std::size_t n) {
            const V a_re = a(n, height_re), b_re = b(n, height_re);
            if (n == 0) return Complex<Arch>{a_re, b_re};
            return Complex<Arch>{a_re - b(n, height_im), a(n, height_im) + b_re};
        },
        [a, b](std::size_t n) {
            return Complex<Arch>{a(n, height_re) + b(n, height_im), b(n, height_re) - a(n, height_im)};
        },
        [&](std::size_t row, std::size_t span, const auto& results) {
            std::size_t at = (row * surface_components + surface_height) * V::size;
            V here_least = results[0].re, here_most = results[0].re;
            for (const Complex<Arch>& result : results) {
                result.re.store_aligned(first + at);
                here_least = xsimd::min(here_least, result.re);
                here_most = xsimd::max(here_most, result.re);
                if constexpr (HasSecond) {
                    result.im.store_aligned(second + at);
                    here_least = xsimd::min(here_least, result.im);
                    here_most = xsimd::max(here_most, result.im);
                }
                at += span * surface_components * V::size;
            }
            least = xsimd::min(least, here_least);
            most = xsimd::max(most, here_most);
        });
    bounds.height_min = least_lane<Arch>(least);
    bounds.height_max = most_lane<Arch>(most);
}

template <class Arch>
void columns_finalize(const ColumnsFinalizeJob& job) {
    using V = xsimd::batch<float, Arch>;
    const FftTables& fft = *job.fft;
    float* const workspace = PELAGIC_STACK_FLOATS(workspace_floats<Arch>(fft));
    // Heights first: they land where only heights were, so the sideways fields of the lines are still whole.
    if (job.blocks[1])
        height_columns<Arch, true>(job.blocks[0], job.blocks[1], fft, workspace, *job.bounds);
    else
        height_columns<Arch, false>(job.blocks[0], nullptr, fft, workspace, *job.bounds);

    V most[2] = {V(0.f), V(0.f)};
    for (float* block : job.blocks) {
        if (!block) continue;
        if (job.sine == 0)
            sideways_columns<Arch, false>(job, block, workspace, most);
        else
            sideways_columns<Arch, true>(job, block, workspace, most);
    }
    job.bounds->sideways_x_max = most_lane<Arch>(most[0]);
    job.bounds->sideways_z_max = most_lane<Arch>(most[1]);
}

}  // namespace pelagic::kernels
