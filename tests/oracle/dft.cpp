#include "pelagic/tests/oracle/dft.hpp"

#include <cstddef>
#include <numbers>

namespace pelagic::oracle {
namespace {

using Line = std::vector<Complex>;

Line naive_line(const Line& in) {
    const std::size_t n = in.size();
    Line roots(n), out(n);
    for (std::size_t i = 0; i < n; ++i)
        roots[i] = std::polar(1.0, 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
    for (std::size_t x = 0; x < n; ++x)
        for (std::size_t p = 0; p < n; ++p) out[x] += in[p] * roots[p * x % n];
    return out;
}

Line fft_line(const Line& in) {
    const std::size_t n = in.size();
    if (n == 1) return in;
    Line even, odd;
    for (std::size_t i = 0; i < n; i += 2) {
        even.push_back(in[i]);
        odd.push_back(in[i + 1]);
    }
    even = fft_line(even);
    odd = fft_line(odd);
    Line out(n);
    for (std::size_t k = 0; k < n / 2; ++k) {
        const Complex turned =
            odd[k] * std::polar(1.0, 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
        out[k] = even[k] + turned;
        out[k + n / 2] = even[k] - turned;
    }
    return out;
}

template <class Transform>
ComplexField both_ways(ComplexField field, int size, Transform transform) {
    const std::size_t n = static_cast<std::size_t>(size);
    Line line(n);
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = 0; i < n; ++i) line[i] = field[j * n + i];
        const Line out = transform(line);
        for (std::size_t i = 0; i < n; ++i) field[j * n + i] = out[i];
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) line[j] = field[j * n + i];
        const Line out = transform(line);
        for (std::size_t j = 0; j < n; ++j) field[j * n + i] = out[j];
    }
    return field;
}

}  // namespace

ComplexField naive_inverse_dft(const ComplexField& spectrum, int n) { return both_ways(spectrum, n, naive_line); }

ComplexField inverse_fft(const ComplexField& spectrum, int n) { return both_ways(spectrum, n, fft_line); }

ComplexField forward_fft(const ComplexField& field, int n) {
    ComplexField conjugated = field;
    for (Complex& value : conjugated) value = std::conj(value);
    ComplexField spectrum = inverse_fft(conjugated, n);
    for (Complex& value : spectrum) value = std::conj(value) / (static_cast<double>(n) * n);
    return spectrum;
}

}  // namespace pelagic::oracle
