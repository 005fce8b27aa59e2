#include "sim/initial_spectrum.hpp"

#include <cmath>

#include "sim/dispersion.hpp"
#include "sim/wave_noise.hpp"

namespace pelagic {
namespace {

constexpr double two_pi = 6.28318530717958647693;

// Waves below this many metres are none: nobody can see an atom's width, but denormal floats slow every transform.
constexpr double least_amplitude_m = 1e-20;

}  // namespace

std::complex<double> initial_amplitude(const SeaState& sea, const WaveSpectrum& spectrum, int m, int n) {
    const int nyquist = sea.resolution / 2;
    if ((m == 0 && n == 0) || m == -nyquist || n == -nyquist) return 0;

    const double spacing = two_pi / sea.patch_size_m;
    // Both parts of the draw have variance 1, so half of E|h0|^2 belongs to each.
    const double scale = std::sqrt(0.5 * spectrum.amplitude_variance(m * spacing, n * spacing));
    if (scale < least_amplitude_m) return 0;
    const GaussianPair draw = gaussian_pair(sea.seed, m, n);
    return {draw.re * scale, draw.im * scale};
}

void bake_spectrum_line(const SeaState& sea, const WaveSpectrum& spectrum, std::size_t line, PackedSpectrum& out) {
    const int resolution = sea.resolution;
    const int n = static_cast<int>(line);
    const double spacing = two_pi / sea.patch_size_m;
    const std::size_t lane = line % lane_block;
    ModeRow* rows = out.modes.data() + line / lane_block * static_cast<std::size_t>(resolution);

    for (int p = 0; p < resolution; ++p) {
        const int m = p < resolution / 2 ? p : p - resolution;
        const std::complex<double> along = initial_amplitude(sea, spectrum, m, n);
        const std::complex<double> against =
            m == -resolution / 2 ? 0 : std::conj(initial_amplitude(sea, spectrum, -m, -n));
        const double length = std::sqrt(static_cast<double>(m) * m + static_cast<double>(n) * n);
        const bool is_dc = length == 0;

        ModeRow& row = rows[p];
        row.cos_re[lane] = static_cast<float>(along.real() + against.real());
        row.cos_im[lane] = static_cast<float>(along.imag() + against.imag());
        row.sin_re[lane] = static_cast<float>(along.imag() - against.imag());
        row.sin_im[lane] = static_cast<float>(against.real() - along.real());
        row.dir_x[lane] = is_dc ? 0.f : static_cast<float>(m / length);
        row.dir_z[lane] = is_dc ? 0.f : static_cast<float>(n / length);
        row.harmonic[lane] =
            is_dc ? 0 : loop_harmonic(angular_frequency(length * spacing, sea.depth_m), sea.loop_period_s);
    }
}

}  // namespace pelagic
