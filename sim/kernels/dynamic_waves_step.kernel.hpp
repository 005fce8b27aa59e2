#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/dynamic_wave_jobs.hpp"
#include "pelagic/sim/kernels/fft.kernel.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/transpose.kernel.hpp"

namespace pelagic::kernels {

/// Transforms N elements into `data`, in order. `input(i)` returns element i.
template <class Arch, std::size_t FirstRadix, class Input>
inline void transform_from(Input input, const FftTables& fft, float* data) {
    constexpr std::size_t element = 2 * xsimd::batch<float, Arch>::size;
    const std::size_t size = static_cast<std::size_t>(fft.size), groups = size / FirstRadix;
    for (std::size_t first = 0; first < groups; ++first)
        butterfly<Arch, FirstRadix>([&](std::size_t l) { return input(first + l * groups); },
                                    OutputsApart<Arch>{data + fft.positions[first] * element, element});
    middle_steps<Arch, 1>(data, size, fft);
    if (fft.last_step().radix == 8)
        fft_step<Arch, 8, 1>(data, size, fft.last_step(), fft.twiddles);
    else
        fft_step<Arch, 4, 1>(data, size, fft.last_step(), fft.twiddles);
}

template <class Arch, class Input>
inline void transform_from(Input input, const FftTables& fft, float* data) {
    if (fft.first_step().radix == 8)
        transform_from<Arch, 8>(input, fft, data);
    else
        transform_from<Arch, 4>(input, fft, data);
}

/// BorderDamping of W columns, in registers.
template <class Arch>
struct BorderColumns {
    using V = xsimd::batch<float, Arch>;
    V damping_x;
    const float* damping_z;

    PELAGIC_INLINE BorderColumns(const BorderDamping& border, std::size_t first_column)
        : damping_x(V::load_aligned(border.damping_x + first_column)), damping_z(border.damping_z) {}

    PELAGIC_INLINE V operator()(V value, std::size_t z) const {
        const V damped = value * (damping_x * V(damping_z[z]));
        return xsimd::select(xsimd::abs(damped) < V(BorderDamping::smallest), V(0.f), damped);
    }
};

template <class Arch>
void damp_rows(const DampJob& job) {
    using V = xsimd::batch<float, Arch>;
    for (std::size_t z = job.first_row; z < job.first_row + job.rows; ++z) {
        const std::size_t row = z * dynamic_row_stride(job.resolution);
        for (std::size_t x = 0; x < job.resolution; x += V::size) {
            const BorderColumns<Arch> border(job.border, x);
            for (float* const plane : job.planes)
                border(V::load_aligned(plane + row + x), z).store_aligned(plane + row + x);
        }
    }
}

template <class Arch>
void dynamic_columns(const DynamicColumnsJob& job) {
    using V = xsimd::batch<float, Arch>;
    constexpr std::size_t lanes = V::size, element = 2 * lanes;
    const std::size_t size = static_cast<std::size_t>(job.fft->size), stride = dynamic_row_stride(size);
    float* const data = PELAGIC_STACK_FLOATS(workspace_floats<Arch>(*job.fft));
    const float* const h = job.h + job.first_column;
    const float* const w = job.w + job.first_column;
    const BorderColumns<Arch> border(job.border, job.first_column);
    // Exchange real and imaginary parts of the input: the transform becomes a forward transform.
    transform_from<Arch>(
        [=](std::size_t z) {
            return Complex<Arch>{border(V::load_aligned(w + z * stride), z),
                                 border(V::load_aligned(h + z * stride), z)};
        },
        *job.fft, data);
    for (std::size_t line = 0; line < size; line += lanes) {
        for (std::size_t component = 0; component < 2; ++component) {
            V transposed[lanes];
            load_transposed<Arch>(data + line * element + component * lanes, element, transposed);
            float* const to = (component == 0 ? job.h : job.w) + line * stride + job.first_column;
            for (std::size_t x = 0; x < lanes; ++x) transposed[x].store_aligned(to + x * stride);
        }
    }
}

template <class Arch>
void dynamic_lines(const DynamicLinesJob& job) {
    using V = xsimd::batch<float, Arch>;
    using C = Complex<Arch>;
    constexpr std::size_t lanes = V::size, element = 2 * lanes;
    const std::size_t size = static_cast<std::size_t>(job.fft->size), stride = dynamic_row_stride(size);
    float* const waves = PELAGIC_STACK_FLOATS(2 * workspace_floats<Arch>(*job.fft));
    float *const h = job.h, *const w = job.w;
    const auto place_of = [stride](std::size_t x) { return x % lanes * stride + (x - x % lanes); };
    transform_from<Arch>(
        [=](std::size_t x) {
            const std::size_t place = place_of(x);
            return C{V::load_aligned(h + place), V::load_aligned(w + place)};
        },
        *job.fft, waves);
    // Multiplying the exchanged number by e^(i omega t) multiplies the number by e^(-i omega t).
    // The result is exchanged back for the opposite direction.
    const auto moved_on = [&](std::size_t kx) -> C {
        const C wave = C::load(waves + kx * element);
        const C phase = C::load(job.phases + (kx <= size / 2 ? kx : size - kx) * element);
        return {wave.re * phase.im + wave.im * phase.re, wave.re * phase.re - wave.im * phase.im};
    };
    float* const moved = waves + size * element;
    transform_from<Arch>(moved_on, *job.fft, moved);
    for (std::size_t row = 0; row < lanes; ++row)
        for (std::size_t x = row; x < size; x += lanes) {
            const C texels = C::load(moved + x * element);
            texels.re.store_aligned(h + place_of(x));
            texels.im.store_aligned(w + place_of(x));
        }
}

template <class Arch>
void dynamic_columns_back(const DynamicColumnsJob& job) {
    using V = xsimd::batch<float, Arch>;
    constexpr std::size_t lanes = V::size, element = 2 * lanes;
    const FftTables& fft = *job.fft;
    const std::size_t size = static_cast<std::size_t>(fft.size), stride = dynamic_row_stride(size);
    float* const data = PELAGIC_STACK_FLOATS(2 * workspace_floats<Arch>(fft));
    float* const columns = data + size * element;
    for (std::size_t line = 0; line < size; line += lanes) {
        for (std::size_t component = 0; component < 2; ++component) {
            const float* const from = (component == 0 ? job.h : job.w) + line * stride + job.first_column;
            V transposed[lanes];
            load_transposed<Arch>(from, stride, transposed);
            for (std::size_t k = 0; k < lanes; ++k)
                transposed[k].store_aligned(columns + (line + k) * element + component * lanes);
        }
    }
    transform_from<Arch>([=](std::size_t kz) { return Complex<Arch>::load(columns + kz * element); }, fft, data);
    float* const h = job.h + job.first_column;
    float* const w = job.w + job.first_column;
    for (std::size_t z = 0; z < size; ++z) {
        const Complex<Arch> texel = Complex<Arch>::load(data + z * element);
        texel.re.store_aligned(h + z * stride);
        texel.im.store_aligned(w + z * stride);
    }
}

template <class Arch>
void verlet_rows(const VerletRowsJob& job) {
    using V = xsimd::batch<float, Arch>;
    const std::size_t n = job.resolution, stride = dynamic_row_stride(n);
    const V coupling(job.coupling), damping(job.damping), four(4.f);
    for (std::size_t z = job.first_row; z < job.first_row + job.rows; ++z) {
        const float* const row = job.now + z * stride;
        const float* const above = job.now + (z + n - 1) % n * stride;
        const float* const below = job.now + (z + 1) % n * stride;
        float* const to = job.before + z * stride;
        for (std::size_t x = 0; x < n; x += V::size) {
            const V sides = V::load_unaligned(row + x - 1) + V::load_unaligned(row + x + 1);
            const V ends = V::load_aligned(above + x) + V::load_aligned(below + x);
            const V here = V::load_aligned(row + x);
            const V moved = damping * (here - V::load_aligned(to + x));
            const V pulled = coupling * ((sides + ends) - four * here);
            (here + (moved + pulled)).store_aligned(to + x);
        }
    }
}

template <class Arch>
void dynamic_foam(const DynamicFoamJob& job) {
    using V = xsimd::batch<float, Arch>;
    const V threshold(job.threshold), scale(job.scale), none(0.f), max(255.f);
    alignas(64) std::int32_t fresh[DynamicFoamJob::max_resolution];
    for (std::size_t z = job.first_row; z < job.first_row + job.rows; ++z) {
        const float* const row = job.heights + z * dynamic_row_stride(job.resolution);
        V highest(row[0]);
        for (std::size_t x = 0; x < job.resolution; x += V::size)
            highest = xsimd::max(highest, V::load_aligned(row + x));
        if (!job.has_foam[z] && !xsimd::any(highest > threshold)) continue;

        for (std::size_t x = 0; x < job.resolution; x += V::size) {
            const V above = (V::load_aligned(row + x) - threshold) * scale;
            xsimd::to_int(xsimd::min(xsimd::max(above, none), max)).store_aligned(fresh + x);
        }
        std::uint8_t* const foam = job.foam + z * job.resolution;
        std::uint8_t all = 0;
        for (std::size_t x = 0; x < job.resolution; ++x) {
            const int remaining = foam[x] - job.fade, more = fresh[x] > remaining ? fresh[x] : remaining;
            foam[x] = static_cast<std::uint8_t>(more);
            all = static_cast<std::uint8_t>(all | foam[x]);
        }
        job.has_foam[z] = all;
    }
}

template <class Arch>
void interpolate_ticks(const TickInterpolationJob& job) {
    using V = xsimd::batch<float, Arch>;
    const std::size_t n = job.resolution;
    const V fraction(job.fraction), from_middle(job.fraction - 0.5f), ticks_per_s(job.ticks_per_s);
    for (std::size_t z = job.first_row; z < job.first_row + job.rows; ++z) {
        const float* const before = job.before + z * dynamic_row_stride(n);
        const float* const now = job.now + z * dynamic_row_stride(n);
        const float* const difference_before = job.difference_before + z * dynamic_row_stride(n);
        const V shown_z(job.shown_z[z]);
        V low(0.f), high(0.f);
        for (std::size_t x = 0; x < n; x += V::size) {
            const V from = V::load_aligned(before + x), difference = V::load_aligned(now + x) - from;
            const V shown = V::load_aligned(job.shown_x + x) * shown_z;
            const V height = (from + fraction * difference) * shown;
            height.store_aligned(job.height + z * n + x);
            const V vertical_velocity =
                difference + from_middle * (difference - V::load_aligned(difference_before + x));
            ((vertical_velocity * ticks_per_s) * shown).store_aligned(job.vertical_velocity + z * n + x);
            low = xsimd::min(low, height);
            high = xsimd::max(high, height);
        }
        alignas(64) float lows[V::size], highs[V::size];
        low.store_aligned(lows);
        high.store_aligned(highs);
        for (std::size_t lane = 1; lane < V::size; ++lane) {
            if (lows[lane] < lows[0]) lows[0] = lows[lane];
            if (highs[lane] > highs[0]) highs[0] = highs[lane];
        }
        job.lowest[z] = lows[0];
        job.highest[z] = highs[0];
    }
}

}  // namespace pelagic::kernels
