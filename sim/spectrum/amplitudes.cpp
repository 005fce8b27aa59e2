#include "pelagic/sim/spectrum/amplitudes.hpp"

#include <cmath>

#include "pelagic/sim/spectrum/wave_noise.hpp"

namespace pelagic {
namespace {

// Waves below this many metres are none: nobody can see an atom's width, but denormal floats slow every transform.
constexpr double least_amplitude_m = 1e-20;

}  // namespace

TileWaves::TileWaves(const SeaState& sea, const TilePlan& tile)
    : seed_(sea.seed), tile_(tile), spectrum_(sea, tile) {}

TileWaves::MirroredVariances TileWaves::variances(int m, int n) const {
    const double spacing = tile_.spacing();
    const double kx = m * spacing, kz = n * spacing;
    const WaveSpectrum::Shell shell = spectrum_.shell(std::sqrt(kx * kx + kz * kz));
    return {spectrum_.amplitude_variances(shell, kx, kz), spectrum_.amplitude_variances(shell, -kx, kz)};
}

TileWaves::MirroredPair TileWaves::pair(int m, int n) const {
    const auto [plus, minus] = variances(m, n);
    return {{drawn(plus.along, m, n), drawn(plus.against, -m, -n)},
            {drawn(minus.along, -m, n), drawn(minus.against, m, -n)}};
}

std::complex<double> TileWaves::amplitude(int m, int n) const {
    return holds(m, n) ? drawn(variances(m, n).plus.along, m, n).amplitude : std::complex<double>{};
}

double TileWaves::drawn_square(double variance, int m, int n) const {
    return 0.5 * variance * gaussian_pair_square(seed_, tile_.number, m, n);
}

Wave TileWaves::drawn(double variance, int m, int n) const {
    // Both parts of the draw have variance 1, so half of E|h0|^2 belongs to each.
    const double scale = std::sqrt(0.5 * variance);
    if (scale < least_amplitude_m) return {};
    const GaussianPair draw = gaussian_pair(seed_, tile_.number, m, n);
    return {{draw.re * scale, draw.im * scale}, variance};
}

}  // namespace pelagic
