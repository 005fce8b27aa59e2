// Inverse transforms in double, written plainly: F(x) = sum over p of f(p) e^{+2 pi i p x / N},
// without 1/N.
#pragma once

#include <complex>
#include <vector>

namespace pelagic::oracle {

using Complex = std::complex<double>;

/// An N x N field, element (i, j) at j N + i. Spectra are in FFT order: index p is wave number p,
/// or p - N from N/2 on.
using ComplexField = std::vector<Complex>;

/// Transforms by the definition, one line at a time: O(N^3).
ComplexField naive_inverse_dft(const ComplexField& spectrum, int n);

/// Transforms by the recursive radix-2 algorithm, for larger N. oracle_test.cpp compares it with
/// naive_inverse_dft().
ComplexField inverse_fft(const ComplexField& spectrum, int n);

/// Transforms forward by the conjugate algorithm, divided by N^2: the spectrum of a field.
ComplexField forward_fft(const ComplexField& field, int n);

}  // namespace pelagic::oracle
