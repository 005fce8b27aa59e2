#include "pelagic/tools/measure/fourier.hpp"

#include <bit>
#include <utility>
#include <vector>

#include "pelagic/simd/det_math.hpp"

namespace pelagic::tools {
namespace {

using Complex = std::complex<double>;

/// Returns e^{-2 pi i turns}.
Complex rotated_back(double turns) {
    const auto at = det::sine_cosine_of_turns(turns);
    return {at.cosine, -at.sine};
}

/// Returns a b. The product of std::complex would check for infinities first.
Complex product(Complex a, Complex b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

/// Returns e^{-2 pi i p / n} for p < n / 2.
std::vector<Complex> half_a_turn(std::size_t n) {
    std::vector<Complex> factors(n / 2);
    for (std::size_t p = 0; p < factors.size(); ++p)
        factors[p] = rotated_back(static_cast<double>(p) / static_cast<double>(n));
    return factors;
}

/// Transforms in place by decimation in time.
/// \pre values.size() is a power of two; `factors` belong to this length
void radix_2(std::span<Complex> values, std::span<const Complex> factors) {
    const std::size_t n = values.size();
    for (std::size_t i = 1, reversed = 0; i < n; ++i) {
        std::size_t bit = n >> 1;
        for (; reversed & bit; bit >>= 1) reversed ^= bit;
        reversed ^= bit;
        if (i < reversed) std::swap(values[i], values[reversed]);
    }
    for (std::size_t half = 1; half < n; half *= 2) {
        const std::size_t stride = n / (2 * half);
        for (std::size_t block = 0; block < n; block += 2 * half) {
            for (std::size_t p = 0; p < half; ++p) {
                const Complex even = values[block + p];
                const Complex odd = product(values[block + p + half], factors[p * stride]);
                values[block + p] = even + odd;
                values[block + p + half] = even - odd;
            }
        }
    }
}

/// Transforms values of any length. With pq = (p^2 + q^2 - (q - p)^2) / 2 the sum is a convolution,
/// computed with transforms whose length is a power of two.
void by_chirp(std::span<Complex> values) {
    const std::size_t n = values.size(), padded = std::bit_ceil(2 * n - 1);
    std::vector<Complex> chirp(n);  // e^{-pi i p^2 / n}; p^2 is reduced modulo 2 n
    for (std::size_t p = 0; p < n; ++p)
        chirp[p] = rotated_back(static_cast<double>(p * p % (2 * n)) / static_cast<double>(2 * n));
    std::vector<Complex> input(padded), response(padded);
    for (std::size_t p = 0; p < n; ++p) {
        input[p] = product(values[p], chirp[p]);
        response[p] = response[(padded - p) % padded] = std::conj(chirp[p]);
    }
    const std::vector<Complex> factors = half_a_turn(padded);
    radix_2(input, factors);
    radix_2(response, factors);
    // The inverse transform is the transform of the conjugate, conjugated and scaled.
    for (std::size_t q = 0; q < padded; ++q) input[q] = std::conj(product(input[q], response[q]));
    radix_2(input, factors);
    for (std::size_t q = 0; q < n; ++q)
        values[q] = product(std::conj(input[q]) / static_cast<double>(padded), chirp[q]);
}

}  // namespace

void fourier(std::span<Complex> values) {
    if (values.size() < 2) return;
    if (std::has_single_bit(values.size()))
        radix_2(values, half_a_turn(values.size()));
    else
        by_chirp(values);
}

void fourier_of_square(std::span<Complex> values, std::size_t n) {
    const std::vector<Complex> factors = half_a_turn(n);
    for (std::size_t j = 0; j < n; ++j) radix_2(values.subspan(j * n, n), factors);
    std::vector<Complex> column(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) column[j] = values[j * n + i];
        radix_2(column, factors);
        for (std::size_t j = 0; j < n; ++j) values[j * n + i] = column[j];
    }
}

}  // namespace pelagic::tools
