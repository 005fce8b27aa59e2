// Fourier transforms in double for what is measured, where nobody waits: any length, plain, the same bits everywhere.
#pragma once

#include <complex>
#include <span>

namespace pelagic::tools {

/// values[q] becomes the sum over p of values[p] e^{-2 pi i p q / n}, unscaled. O(n log n) for any n: radix 2 for powers of two,
/// else as a convolution with a chirp (Bluestein 1970).
void fourier(std::span<std::complex<double>> values);

/// The same along both axes of a square, element (i, j) at j n + i; `n` is its side, a power of two.
void fourier_of_square(std::span<std::complex<double>> values, std::size_t n);

}  // namespace pelagic::tools
