// Fourier transforms in double precision for measurements: any length, bit-identical on every
// machine, not optimised for speed.
#pragma once

#include <complex>
#include <span>

namespace pelagic::tools {

/// Replaces values[q] by the sum over p of values[p] e^{-2 pi i p q / n}, unscaled. Takes O(n log
/// n) for any n: radix 2 for powers of two, else a convolution with a chirp (Bluestein 1970).
void fourier(std::span<std::complex<double>> values);

/// Transforms a square along both axes; element (i, j) is at j n + i.
/// \param n  side of the square, a power of two
void fourier_of_square(std::span<std::complex<double>> values, std::size_t n);

}  // namespace pelagic::tools
