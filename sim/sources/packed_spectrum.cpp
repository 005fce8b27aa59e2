#include "pelagic/sim/sources/packed_spectrum.hpp"

#include <array>
#include <cmath>

#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/wave_noise.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

constexpr double two_pi = 6.28318530717958647693;

// Waves below this many metres are none: nobody can see an atom's width, but denormal floats slow every transform.
constexpr double least_amplitude_m = 1e-20;

struct Wave {
    std::complex<double> amplitude;  ///< h0
    double variance = 0;             ///< E|h0|^2
};

/// \param variance  E|h0|^2 of the wave
Wave drawn_wave(const SeaState& sea, double variance, int m, int n) {
    // Both parts of the draw have variance 1, so half of E|h0|^2 belongs to each.
    const double scale = std::sqrt(0.5 * variance);
    if (scale < least_amplitude_m) return {};
    const GaussianPair draw = gaussian_pair(sea.seed, m, n);
    return {{draw.re * scale, draw.im * scale}, variance};
}

/// Of k and of -k.
struct OppositeWaves {
    Wave along, against;
};

/// S' of equation 22, and the mean squares over time of the wave that it is.
struct PackedWave {
    std::array<float, 4> values;
    double expected_square, drawn_square;
};

/// \pre the wave is neither DC nor in the Nyquist row or column
OppositeWaves opposite_waves(const SeaState& sea, const WaveSpectrum& spectrum, const WaveSpectrum::Shell& shell,
                             int m, int n) {
    const double spacing = two_pi / sea.patch_size_m;
    const auto variances = spectrum.amplitude_variances(shell, m * spacing, n * spacing);
    return {drawn_wave(sea, variances.along, m, n), drawn_wave(sea, variances.against, -m, -n)};
}

PackedWave packed_wave(const OppositeWaves& waves) {
    const auto& [wave, opposite] = waves;
    const std::complex<double> along = wave.amplitude, against = std::conj(opposite.amplitude);
    return {{static_cast<float>(along.real() + against.real()), static_cast<float>(along.imag() + against.imag()),
             static_cast<float>(along.imag() - against.imag()), static_cast<float>(against.real() - along.real())},
            wave.variance + opposite.variance,
            std::norm(along) + std::norm(against)};
}

}  // namespace

std::complex<double> initial_amplitude(const SeaState& sea, const WaveSpectrum& spectrum, int m, int n) {
    const int nyquist = sea.resolution / 2;
    if ((m == 0 && n == 0) || m == -nyquist || n == -nyquist) return {};
    const double spacing = two_pi / sea.patch_size_m;
    return drawn_wave(sea, spectrum.amplitude_variance(m * spacing, n * spacing), m, n).amplitude;
}

double drawn_variance(const SeaState& sea, const WaveSpectrum& spectrum, const WaveSpectrum::Shell& shell, int m,
                      int n) {
    const OppositeWaves waves = opposite_waves(sea, spectrum, shell, m, n);
    return std::norm(waves.along.amplitude) + std::norm(waves.against.amplitude);
}

PackedSpectrum::PackedSpectrum(const FftPlan& plan, std::size_t lane_count, const HostMemory& memory)
    : lanes(lane_count),
      pairs(plan.pairs().size() * static_cast<std::size_t>(plan.tables().first_step().radix)),
      waves(line_blocks(plan.tables().size, lanes) * pairs * wave_quantities * lanes, memory),
      harmonics(line_blocks(plan.tables().size, lanes) * pairs * lanes, memory) {}

LineFigures bake_spectrum_line(const SeaState& sea, const WaveSpectrum& spectrum, const FftPlan& plan,
                               std::size_t line, PackedSpectrum& out) {
    const int resolution = sea.resolution;
    const int radix = plan.tables().first_step().radix;
    const int n = static_cast<int>(line);
    const double spacing = two_pi / sea.patch_size_m;
    const double texel_m = sea.patch_size_m / resolution;
    const auto difference = [&](int of) {
        return det::sine_cosine_of_turns(static_cast<double>(of) / resolution).sine / texel_m;
    };
    const double difference_z = difference(n);
    const double mirrors = n == 0 ? 1 : 2;  // line 0 holds its own
    LineFigures figures;
    float* wave = out.block(line / out.lanes) + line % out.lanes;
    std::uint32_t* harmonic = out.block_harmonics(line / out.lanes) + line % out.lanes;

    for (const GroupPair& pair : plan.pairs()) {
        for (int s = 0; s < radix; ++s, wave += wave_quantities * out.lanes, harmonic += out.lanes) {
            const int position = pair.plus + s * (resolution / radix);
            const int m = position < resolution / 2 ? position : position - resolution;
            if (m == -resolution / 2 || (m == 0 && n == 0)) continue;  // no wave: all zeros
            const auto put = [&](WaveQuantity quantity, double value) {
                wave[quantity * out.lanes] = static_cast<float>(value);
            };
            const double kx = m * spacing, kz = n * spacing;
            const WaveSpectrum::Shell shell = spectrum.shell(std::sqrt(kx * kx + kz * kz));
            const auto put_wave = [&](WaveQuantity first, int signed_m) {
                const PackedWave packed = packed_wave(opposite_waves(sea, spectrum, shell, signed_m, n));
                for (std::size_t i = 0; i < packed.values.size(); ++i)
                    wave[(first + i) * out.lanes] = packed.values[i];
                figures.height_variance += mirrors * packed.expected_square;
                figures.folding.add_wave(mirrors * packed.drawn_square, signed_m * spacing, n * spacing,
                                         difference(signed_m), difference_z);
            };
            put_wave(plus_cos_re, m);
            if (!pair.is_own_negative()) put_wave(minus_cos_re, -m);
            const double length = std::sqrt(static_cast<double>(m) * m + static_cast<double>(n) * n);
            put(direction_x, m / length);
            put(direction_z, n / length);
            *harmonic = loop_harmonic(angular_frequency(length * spacing, sea.depth_m), sea.loop_period_s);
        }
    }
    return figures;
}

}  // namespace pelagic
