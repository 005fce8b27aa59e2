#include "pelagic/sim/spectrum/amplitudes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pelagic/sim/spectrum/wave_noise.hpp"

namespace pelagic {
namespace {

// Smaller amplitudes, in metres, become 0. They are invisible, but denormal floats slow every
// transform.
constexpr double min_amplitude_m = 1e-20;

// Half the diagonal of a cell, in grid steps.
constexpr double half_diagonal = 0.7071067811865476;

// A spectrum falls as k^-4. At the centre of a cell m steps from k = 0, it is within 0.7 / m^2 of
// the cell's mean.
constexpr double steps_of_wide_cells = 16;
constexpr int points_of_wide_cell = 4;

// Points per axis that give the covered fraction of a cut cell within 0.01. A band edge cuts dozens
// of cells, whose errors cancel.
constexpr int points_of_cut_cell = 8;

// The model has no energy and no direction at k = 0. In grid steps.
constexpr double min_steps = 1e-3;

bool stands_before(const GridWave& a, const GridWave& b) {
    return std::pair(a.at.n, a.at.m) < std::pair(b.at.n, b.at.m);
}

}  // namespace

CascadeWaves::CascadeWaves(const SeaState& sea, const CascadePlan& cascade) : seed_(sea.seed), cascade_(cascade) {
    if (sea.waves == WaveModel::spectrum) {
        spectrum_.emplace(sea, cascade);
    } else {
        list_ = grid_waves(sea, cascade);
        std::stable_sort(list_.begin(), list_.end(), stands_before);
        if (sea.waves != WaveModel::regular) return;
        listed_water_ = Water(sea.depth_m);
        regular_ = stokes_wave_of(sea);
    }
}

CascadeWaves::MirroredVariances CascadeWaves::variances(int m, int n) const {
    if (!spectrum_)
        return {{listed(m, n).variance, listed(-m, -n).variance}, {listed(-m, n).variance, listed(m, -n).variance}};
    return cascade_.is_banded() ? cell_variances(m, n) : point_variances(m, n);
}

/// Returns the variances of the cells if the spectrum were constant in each cell.
CascadeWaves::MirroredVariances CascadeWaves::point_variances(double m, double n) const {
    const double spacing = cascade_.spacing();
    const double along = m * spacing, across = n * spacing;
    const auto [c, s] = std::pair(cascade_.grid.cosine, cascade_.grid.sine);
    const WaveSpectrum::Shell shell = spectrum_->shell(std::sqrt(along * along + across * across));
    return {spectrum_->amplitude_variances(shell, c * along - s * across, s * along + c * across),
            spectrum_->amplitude_variances(shell, -c * along - s * across, c * across - s * along)};
}

/// Returns the variances of the cells within the band, from the mean over sample points. Several
/// points are used if a band edge cuts the cell, or if the spectrum varies strongly within it.
CascadeWaves::MirroredVariances CascadeWaves::cell_variances(int m, int n) const {
    const double steps = std::sqrt(static_cast<double>(m) * m + static_cast<double>(n) * n);
    const double min = cascade_.min_k / cascade_.spacing(), max = cascade_.max_k / cascade_.spacing();
    if (steps + half_diagonal < min || steps - half_diagonal >= max) return {};
    const bool is_cut = steps - half_diagonal < min || steps + half_diagonal >= max;
    const int points = is_cut ? points_of_cut_cell : steps < steps_of_wide_cells ? points_of_wide_cell : 1;

    MirroredVariances sum{};
    const auto add = [](OppositeDensities& to, const OppositeDensities& from) {
        to.along += from.along;
        to.against += from.against;
    };
    for (int row = 0; row < points; ++row) {
        for (int column = 0; column < points; ++column) {
            const double at_m = m + (column + 0.5) / points - 0.5, at_n = n + (row + 0.5) / points - 0.5;
            const double at = std::sqrt(at_m * at_m + at_n * at_n);
            if (at < min || at >= max || at < min_steps) continue;
            const MirroredVariances here = point_variances(at_m, at_n);
            add(sum.plus, here.plus);
            add(sum.minus, here.minus);
        }
    }
    const double share = 1.0 / (points * points);
    return {{sum.plus.along * share, sum.plus.against * share}, {sum.minus.along * share, sum.minus.against * share}};
}

CascadeWaves::MirroredPair CascadeWaves::pair(int m, int n) const {
    if (!spectrum_) return {{listed(m, n), listed(-m, -n)}, {listed(-m, n), listed(m, -n)}};
    const auto [plus, minus] = variances(m, n);
    return {{realised(plus.along, m, n), realised(plus.against, -m, -n)},
            {realised(minus.along, -m, n), realised(minus.against, m, -n)}};
}

std::complex<double> CascadeWaves::amplitude(int m, int n) const {
    if (!spectrum_) return listed(m, n).amplitude;
    return holds(m, n) ? realised(variances(m, n).plus.along, m, n).amplitude : std::complex<double>{};
}

double CascadeWaves::realised_square(double variance, int m, int n) const {
    if (!spectrum_) return variance;
    return 0.5 * variance * gaussian_pair_square(seed_, cascade_.number, m, n);
}

/// Returns the sum of the listed waves at a grid index.
Wave CascadeWaves::listed(int m, int n) const {
    const GridWave wanted{.at = {m, n}, .amplitude_m = 0, .phase_turns = 0};
    Wave wave;
    for (auto at = std::lower_bound(list_.begin(), list_.end(), wanted, stands_before);
         at != list_.end() && at->at == wanted.at; ++at)
        wave.amplitude += at->half_amplitude();
    wave.variance = std::norm(wave.amplitude);
    return wave;
}

Wave CascadeWaves::realised(double variance, int m, int n) const {
    // Real and imaginary part of the draw have variance 1, so each gets half of E|h0|^2.
    const double scale = std::sqrt(0.5 * variance);
    if (scale < min_amplitude_m) return {};
    const GaussianPair draw = gaussian_pair(seed_, cascade_.number, m, n);
    return {{draw.re * scale, draw.im * scale}, variance};
}

}  // namespace pelagic
