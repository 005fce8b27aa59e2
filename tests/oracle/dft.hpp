// Inverse transforms in double, plain enough to be believed: F(x) = sum over p of f(p) e^{+2 pi i p x / N}, no 1/N.
#pragma once

#include <complex>
#include <vector>

namespace pelagic::oracle {

using Complex = std::complex<double>;

/// An N x N field, element (i, j) at j N + i. Spectra are in FFT order: index p is wave number p, or p - N from N/2 on.
using ComplexField = std::vector<Complex>;

/// By the definition, a line at a time: O(N^3).
ComplexField naive_inverse_dft(const ComplexField& spectrum, int n);

/// The recursive radix-2 transform of textbooks, for larger N. oracle_test holds it against the naive one.
ComplexField inverse_fft(const ComplexField& spectrum, int n);

/// Forward by the same means (conjugated), divided by N^2: the spectrum of a field.
ComplexField forward_fft(const ComplexField& field, int n);

}  // namespace pelagic::oracle
