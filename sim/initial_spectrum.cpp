#include "pelagic/sim/initial_spectrum.hpp"

#include <array>
#include <cmath>

#include "pelagic/sim/dispersion.hpp"
#include "pelagic/sim/wave_noise.hpp"

namespace pelagic {
namespace {

constexpr double two_pi = 6.28318530717958647693;

// Waves below this many metres are none: nobody can see an atom's width, but denormal floats slow every transform.
constexpr double least_amplitude_m = 1e-20;

using PackedWave = std::array<float, 4>;

/// S' of equation 22.
PackedWave packed_wave(const SeaState& sea, const WaveSpectrum& spectrum, int m, int n) {
    const std::complex<double> along = initial_amplitude(sea, spectrum, m, n);
    const std::complex<double> against = std::conj(initial_amplitude(sea, spectrum, -m, -n));
    return {static_cast<float>(along.real() + against.real()), static_cast<float>(along.imag() + against.imag()),
            static_cast<float>(along.imag() - against.imag()), static_cast<float>(against.real() - along.real())};
}

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

PackedSpectrum::PackedSpectrum(const FftPlan& plan, std::size_t lane_count, const HostMemory& memory)
    : lanes(lane_count),
      pairs(plan.pairs().size() * static_cast<std::size_t>(plan.tables().first_step().radix)),
      waves(line_blocks(plan.tables().size, lanes) * pairs * wave_quantities * lanes, memory),
      harmonics(line_blocks(plan.tables().size, lanes) * pairs * lanes, memory) {}

void bake_spectrum_line(const SeaState& sea, const WaveSpectrum& spectrum, const FftPlan& plan, std::size_t line,
                        PackedSpectrum& out) {
    const int resolution = sea.resolution;
    const int radix = plan.tables().first_step().radix;
    const int n = static_cast<int>(line);
    const double spacing = two_pi / sea.patch_size_m;
    float* wave = out.block(line / out.lanes) + line % out.lanes;
    std::uint32_t* harmonic = out.block_harmonics(line / out.lanes) + line % out.lanes;

    for (const GroupPair& pair : plan.pairs()) {
        for (int s = 0; s < radix; ++s, wave += wave_quantities * out.lanes, harmonic += out.lanes) {
            const int position = pair.plus + s * (resolution / radix);
            const int m = position < resolution / 2 ? position : position - resolution;
            const auto put = [&](WaveQuantity quantity, double value) {
                wave[quantity * out.lanes] = static_cast<float>(value);
            };
            const auto put_wave = [&](WaveQuantity first, int signed_m) {
                const PackedWave packed = packed_wave(sea, spectrum, signed_m, n);
                for (std::size_t i = 0; i < packed.size(); ++i) wave[(first + i) * out.lanes] = packed[i];
            };
            if (m == -resolution / 2 || (m == 0 && n == 0)) continue;  // no wave: all zeros
            put_wave(plus_cos_re, m);
            if (!pair.is_own_negative()) put_wave(minus_cos_re, -m);
            const double length = std::sqrt(static_cast<double>(m) * m + static_cast<double>(n) * n);
            put(direction_x, m / length);
            put(direction_z, n / length);
            *harmonic = loop_harmonic(angular_frequency(length * spacing, sea.depth_m), sea.loop_period_s);
        }
    }
}

}  // namespace pelagic
