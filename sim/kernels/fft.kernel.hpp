// Inverse transforms of W lines at once, a line a lane, in place: element p of the data is W real parts, then W
// imaginary ones. See fft_plan.hpp for the order of the steps.
#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/fft_tables.hpp"
#include "pelagic/simd/always_inline.hpp"

namespace pelagic::kernels {

template <class Arch>
struct Complex {
    using V = xsimd::batch<float, Arch>;
    V re, im;

    static Complex load(const float* from) { return {V::load_aligned(from), V::load_aligned(from + V::size)}; }
    void store(float* to) const {
        re.store_aligned(to);
        im.store_aligned(to + V::size);
    }
    Complex operator+(const Complex& o) const { return {re + o.re, im + o.im}; }
    Complex operator-(const Complex& o) const { return {re - o.re, im - o.im}; }
    Complex plus_i_times(const Complex& o) const { return {re - o.im, im + o.re}; }
    Complex minus_i_times(const Complex& o) const { return {re + o.im, im - o.re}; }
    /// Times the pair (re, im) at `root`, the same for every line.
    Complex times(const float* root) const {
        const V c(root[0]), s(root[1]);
        return {re * c - im * s, re * s + im * c};
    }
};

template <class Arch>
PELAGIC_INLINE void butterfly_4(Complex<Arch> (&x)[4]) {
    const Complex<Arch> even_sum = x[0] + x[2];
    const Complex<Arch> even_difference = x[0] - x[2];
    const Complex<Arch> odd_sum = x[1] + x[3];
    const Complex<Arch> odd_difference = x[1] - x[3];
    x[0] = even_sum + odd_sum;
    x[1] = even_difference.plus_i_times(odd_difference);
    x[2] = even_sum - odd_sum;
    x[3] = even_difference.minus_i_times(odd_difference);
}

// Two transforms of four, joined by the eighth roots of one: 1, r, i, i r with r = (1 + i)/sqrt(2).
template <class Arch>
PELAGIC_INLINE void butterfly_8(Complex<Arch> (&x)[8]) {
    Complex<Arch> even[4] = {x[0], x[2], x[4], x[6]};
    Complex<Arch> odd[4] = {x[1], x[3], x[5], x[7]};
    butterfly_4<Arch>(even);
    butterfly_4<Arch>(odd);
    const xsimd::batch<float, Arch> root_half(0.70710678f);
    odd[1] = {(odd[1].re - odd[1].im) * root_half, (odd[1].re + odd[1].im) * root_half};
    odd[3] = {(odd[3].re - odd[3].im) * root_half, (odd[3].re + odd[3].im) * root_half};
    for (int k = 0; k < 2; ++k) {
        x[k] = even[k] + odd[k];
        x[k + 2] = even[k + 2].plus_i_times(odd[k + 2]);
        x[k + 4] = even[k] - odd[k];
        x[k + 6] = even[k + 2].minus_i_times(odd[k + 2]);
    }
}

template <class Arch>
PELAGIC_INLINE void butterfly(Complex<Arch> (&x)[4]) {
    butterfly_4<Arch>(x);
}
template <class Arch>
PELAGIC_INLINE void butterfly(Complex<Arch> (&x)[8]) {
    butterfly_8<Arch>(x);
}

/// Elements j, j + span, ..., of one group, times their twiddle factors, through the butterfly.
template <class Arch, std::size_t Radix>
PELAGIC_INLINE void joined(Complex<Arch> (&x)[Radix], const float* at, std::size_t span, const float* roots) {
    constexpr std::size_t element = 2 * xsimd::batch<float, Arch>::size;
    x[0] = Complex<Arch>::load(at);
    for (std::size_t l = 1; l < Radix; ++l)
        x[l] = Complex<Arch>::load(at + l * span * element).times(roots + 2 * (l - 1));
    butterfly<Arch>(x);
}

/// The butterflies [j_begin, j_end) of one group of Radix spans, in place.
template <class Arch, std::size_t Radix>
inline void fft_group(float* data, std::size_t span, std::size_t j_begin, std::size_t j_end, const float* twiddles) {
    constexpr std::size_t element = 2 * xsimd::batch<float, Arch>::size;
    for (std::size_t j = j_begin; j < j_end; ++j) {
        float* at = data + j * element;
        Complex<Arch> x[Radix];
        joined<Arch, Radix>(x, at, span, twiddles + 2 * (Radix - 1) * j);
        for (std::size_t k = 0; k < Radix; ++k) x[k].store(at + k * span * element);
    }
}

template <class Arch, std::size_t Radix>
inline void fft_step(float* data, std::size_t size, const FftStep& step, const float* twiddles) {
    constexpr std::size_t element = 2 * xsimd::batch<float, Arch>::size;
    const std::size_t span = static_cast<std::size_t>(step.span);
    for (std::size_t first = 0; first < size; first += Radix * span)
        fft_group<Arch, Radix>(data + first * element, span, 0, span, twiddles + step.first_twiddle);
}

/// The steps between the first and the last on one part of the last one's input: fft.last_step().span elements.
template <class Arch>
inline void middle_steps(float* data, const FftTables& fft) {
    const std::size_t size = static_cast<std::size_t>(fft.last_step().span);
    for (std::size_t s = 1; s + 1 < fft.step_count; ++s) {
        if (fft.steps[s].radix == 8)
            fft_step<Arch, 8>(data, size, fft.steps[s], fft.twiddles);
        else
            fft_step<Arch, 4>(data, size, fft.steps[s], fft.twiddles);
    }
}

/// Floats of working memory for one transform.
template <class Arch>
constexpr std::size_t workspace_floats(const FftTables& fft) {
    return static_cast<std::size_t>(fft.size) * 2 * xsimd::batch<float, Arch>::size;
}

/// Working memory on the stack of the kernel that says this, as much as the transform's size needs and no more: a
/// host's threads may have small stacks. Aligned to 64 bytes.
#define PELAGIC_STACK_FLOATS(count) static_cast<float*>(__builtin_alloca_with_align((count) * sizeof(float), 512))

}  // namespace pelagic::kernels
