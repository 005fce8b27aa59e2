// Inverse transforms of W lines at once, one line per lane, in place. Element p of the data is W
// real parts, then W imaginary parts, for each transformed field. See fft_plan.hpp for the order of
// the steps.
#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/fft_tables.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/times_lane.kernel.hpp"

namespace pelagic::kernels {

template <class Arch>
struct Complex {
    using V = xsimd::batch<float, Arch>;
    V re, im;

    // Copies the members one by one: g++ keeps an aggregate of two NEON registers in memory.
    Complex() = default;
    PELAGIC_INLINE Complex(V real, V imaginary) : re(real), im(imaginary) {}
    PELAGIC_INLINE Complex(const Complex& o) : Complex(o.re, o.im) {}
    Complex& operator=(const Complex& o) = default;

    PELAGIC_INLINE static Complex load(const float* from) {
        return {V::load_aligned(from), V::load_aligned(from + V::size)};
    }
    PELAGIC_INLINE void store(float* to) const {
        re.store_aligned(to);
        im.store_aligned(to + V::size);
    }
    PELAGIC_INLINE Complex operator+(const Complex& o) const { return {re + o.re, im + o.im}; }
    PELAGIC_INLINE Complex operator-(const Complex& o) const { return {re - o.re, im - o.im}; }
    PELAGIC_INLINE Complex plus_i_times(const Complex& o) const { return {re - o.im, im + o.re}; }
    PELAGIC_INLINE Complex minus_i_times(const Complex& o) const { return {re + o.im, im - o.re}; }
    /// Multiplies by pair l of the pairs (re, im) at `roots`, in every lane.
    PELAGIC_INLINE Complex times(const float* roots, std::size_t l) const {
        return l % 2 == 0 ? times_lanes<0, 1>(roots + 2 * l) : times_lanes<2, 3>(roots + 2 * (l - 1));
    }
    template <int c, int s>
    PELAGIC_INLINE Complex times_lanes(const float* four) const {
        return {times_lane<c>(re, four) - times_lane<s>(im, four), times_lane<s>(re, four) + times_lane<c>(im, four)};
    }
};

/// Transforms four points: input(first), input(first + step), ..., which are read in the order of
/// their use. Differences are computed before sums: SSE4.2 overwrites one of its operands, and this
/// order saves one copy.
template <class Arch, class Input>
PELAGIC_INLINE void butterfly_4(Complex<Arch> (&x)[4], Input input, std::size_t first, std::size_t step) {
    const Complex<Arch> a = input(first), c = input(first + 2 * step);
    const Complex<Arch> even_difference = a - c, even_sum = a + c;
    const Complex<Arch> b = input(first + step), d = input(first + 3 * step);
    const Complex<Arch> odd_difference = b - d, odd_sum = b + d;
    x[2] = even_sum - odd_sum;
    x[0] = even_sum + odd_sum;
    x[1] = even_difference.plus_i_times(odd_difference);
    x[3] = even_difference.minus_i_times(odd_difference);
}

/// Transforms Radix points: `input(l)` returns point l, `output(k, value)` receives result k. Eight
/// points fill the registers, so each point is read as late as possible and each result is written
/// as early as possible.
template <class Arch, std::size_t Radix, class Input, class Output>
PELAGIC_INLINE void butterfly(Input input, Output output) {
    using C = Complex<Arch>;
    if constexpr (Radix == 4) {
        C x[4];
        butterfly_4<Arch>(x, input, 0, 1);
        for (std::size_t k = 0; k < 4; ++k) output(k, x[k]);
    } else {
        // Two transforms of four points, combined with the eighth roots of unity: 1, r, i, i r, r =
        // (1 + i)/sqrt(2).
        static_assert(Radix == 8);
        C even[4], odd[4];
        butterfly_4<Arch>(even, input, 0, 2);
        butterfly_4<Arch>(odd, input, 1, 2);
        output(0, even[0] + odd[0]);
        output(4, even[0] - odd[0]);
        output(2, even[2].plus_i_times(odd[2]));
        output(6, even[2].minus_i_times(odd[2]));
        const xsimd::batch<float, Arch> root_half(0.70710678f);
        const C odd_1{(odd[1].re - odd[1].im) * root_half, (odd[1].re + odd[1].im) * root_half};
        output(1, even[1] + odd_1);
        output(5, even[1] - odd_1);
        const C odd_3{(odd[3].re - odd[3].im) * root_half, (odd[3].re + odd[3].im) * root_half};
        output(3, even[3].plus_i_times(odd_3));
        output(7, even[3].minus_i_times(odd_3));
    }
}

/// The inputs of a butterfly, `stride` floats apart. They are multiplied by their roots of unity,
/// unless all roots are 1.
template <class Arch, bool AllOnes = false>
struct InputsApart {
    const float* at;
    std::size_t stride;
    const float* roots = nullptr;
    PELAGIC_INLINE Complex<Arch> operator()(std::size_t l) const {
        const Complex<Arch> x = Complex<Arch>::load(at + l * stride);
        return l == 0 || AllOnes ? x : x.times(roots, l);
    }
};

template <class Arch>
struct OutputsApart {
    float* at;
    std::size_t stride;
    PELAGIC_INLINE void operator()(std::size_t k, const Complex<Arch>& x) const { x.store(at + k * stride); }
};

/// A butterfly in place.
template <class Arch, std::size_t Radix, bool AllOnes = false>
PELAGIC_INLINE void join(float* at, std::size_t stride, const float* roots) {
    butterfly<Arch, Radix>(InputsApart<Arch, AllOnes>{at, stride, roots}, OutputsApart<Arch>{at, stride});
}

/// Executes one step on `size` elements. Butterflies with equal roots (those of all groups and
/// fields) are consecutive.
template <class Arch, std::size_t Radix, std::size_t Fields>
PELAGIC_FLATTEN void fft_step(float* data, std::size_t size, const FftStep& step, const float* twiddles) {
    constexpr std::size_t point = 2 * xsimd::batch<float, Arch>::size, element = Fields * point;
    const std::size_t span = static_cast<std::size_t>(step.span) * element;
    const float* const end = data + size * element;
    const auto same_roots = [=](float* first, auto join_one) {
        for (float* group = first; group < end; group += Radix * span)
#pragma GCC unroll 1
            for (float* at = group; at < group + element; at += point) join_one(at);
    };
    same_roots(data, [=](float* at) { join<Arch, Radix, true>(at, span, nullptr); });
    const float* roots = twiddles + step.first_twiddle + 2 * Radix;
    for (float* first = data + element; first < data + span; first += element, roots += 2 * Radix)
        same_roots(first, [=](float* at) { join<Arch, Radix>(at, span, roots); });
}

/// Executes the steps between the first and the last on `size` elements: one or more input blocks
/// of the last step.
template <class Arch, std::size_t Fields>
inline void middle_steps(float* data, std::size_t size, const FftTables& fft) {
    for (std::size_t s = 1; s + 1 < fft.step_count; ++s) {
        if (fft.steps[s].radix == 8)
            fft_step<Arch, 8, Fields>(data, size, fft.steps[s], fft.twiddles);
        else
            fft_step<Arch, 4, Fields>(data, size, fft.steps[s], fft.twiddles);
    }
}

/// Returns the number of floats of working memory for one transform.
template <class Arch>
constexpr std::size_t workspace_floats(const FftTables& fft) {
    return static_cast<std::size_t>(fft.size) * 2 * xsimd::batch<float, Arch>::size;
}

/// Allocates working memory on the calling kernel's stack, aligned to 64 bytes. The size is exactly
/// that of the transform, because an application's threads may have small stacks.
#define PELAGIC_STACK_FLOATS(count) static_cast<float*>(__builtin_alloca_with_align((count) * sizeof(float), 512))

}  // namespace pelagic::kernels
