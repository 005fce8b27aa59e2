// The oracle's fast transform compared with its naive one, so that results at N = 256 are as
// trustworthy as at N = 64.
#include <gtest/gtest.h>

#include <random>

#include "pelagic/tests/oracle/dft.hpp"

namespace pelagic::oracle {
namespace {

TEST(Oracle, FftEqualsTheNaiveDft) {
    constexpr int n = 32;
    std::mt19937 random(3);
    std::normal_distribution<double> part;
    ComplexField spectrum(n * n);
    for (Complex& value : spectrum) value = {part(random), part(random)};
    const ComplexField naive = naive_inverse_dft(spectrum, n), fast = inverse_fft(spectrum, n);
    const ComplexField back = forward_fft(naive, n);
    for (std::size_t i = 0; i < spectrum.size(); ++i) {
        EXPECT_LT(std::abs(naive[i] - fast[i]), 1e-11);
        EXPECT_LT(std::abs(back[i] - spectrum[i]), 1e-13);
    }
}

TEST(Oracle, OneWaveIsACosineAlongItsOwnDirection) {
    constexpr int n = 16;
    ComplexField spectrum(n * n);
    spectrum[2 * n + 3] = 0.5;              // k = (3, 2)
    spectrum[(n - 2) * n + (n - 3)] = 0.5;  // k = (-3, -2)
    const ComplexField field = naive_inverse_dft(spectrum, n);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            EXPECT_NEAR(field[static_cast<std::size_t>(j * n + i)].real(),
                        std::cos(2 * 3.14159265358979323846 * (3 * i + 2 * j) / n), 1e-13);
}

}  // namespace
}  // namespace pelagic::oracle
