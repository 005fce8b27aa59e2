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

// Points per axis and width of the narrowest lobe: a sum over points half a width apart is exact
// within 1e-5.
constexpr double points_per_width = 0.8, most_points = 64;

// The model has no energy and no direction at k = 0. In grid steps.
constexpr double min_steps = 1e-3;

OppositeDensities& operator+=(OppositeDensities& to, const OppositeDensities& more) {
    to.along += more.along;
    to.against += more.against;
    return to;
}

OppositeDensities operator*(const OppositeDensities& of, double factor) {
    return {of.along * factor, of.against * factor};
}

bool stands_before(const GridWave& a, const GridWave& b) {
    return std::pair(a.at.n, a.at.m) < std::pair(b.at.n, b.at.m);
}

}  // namespace

CascadeWaves::CascadeWaves(const SeaState& sea, const CascadePlan& cascade) : seed_(sea.seed), cascade_(cascade) {
    if (sea.waves == WaveModel::spectrum) {
        spectrum_.emplace(sea, cascade);
        narrowest_rad_ = spectrum_->narrowest_lobe_rad();
    } else {
        list_ = grid_waves(sea, cascade);
        std::stable_sort(list_.begin(), list_.end(), stands_before);
        if (sea.waves != WaveModel::regular) return;
        listed_water_ = Water(sea.depth_m);
        regular_ = stokes_wave_of(sea);
    }
}

/// The wave vectors of (m, n) and (-m, n) in the world's axes, and their wave number.
struct CascadeWaves::ShellOfPoint {
    CascadeGrid::Vector plus, minus;
    WaveSpectrum::Shell shell;

    ShellOfPoint(const CascadeWaves& waves, double m, double n, double widening) {
        const double spacing = waves.cascade_.spacing();
        const double along = m * spacing, across = n * spacing;
        const auto [c, s] = std::pair(waves.cascade_.grid.cosine, waves.cascade_.grid.sine);
        plus = {c * along - s * across, s * along + c * across};
        minus = {-c * along - s * across, c * across - s * along};
        shell = waves.spectrum_->shell(std::sqrt(along * along + across * across), widening);
    }
};

/// Calls add(m, n, widening) for each sample point of a cell that lies in the band. Several points
/// are used if a band edge cuts the cell, or if the spectrum varies strongly within it. The energy of
/// a cell runs in the direction of its centre, so that its points widen the directions by the
/// variance of their offsets, in steps^2. Returns the factor that turns sums into means.
template <class Add>
double CascadeWaves::for_points_of_cell(int m, int n, const Add& add) const {
    const double steps = std::sqrt(static_cast<double>(m) * m + static_cast<double>(n) * n);
    const double min = cascade_.min_k / cascade_.spacing(), max = cascade_.max_k / cascade_.spacing();
    if (steps + half_diagonal < min || steps - half_diagonal >= max) return 0;
    const bool is_cut = steps - half_diagonal < min || steps + half_diagonal >= max;
    const int points = points_across(steps, is_cut);
    const double widening = (1 - 1.0 / (points * points)) / 12;
    for (int row = 0; row < points; ++row) {
        for (int column = 0; column < points; ++column) {
            const double at_m = m + (column + 0.5) / points - 0.5, at_n = n + (row + 0.5) / points - 0.5;
            const double at = std::sqrt(at_m * at_m + at_n * at_n);
            if (at < min || at >= max || at < min_steps) continue;
            add(at_m, at_n, widening);
        }
    }
    return 1.0 / (points * points);
}

CascadeWaves::MirroredVariances CascadeWaves::variances(int m, int n) const {
    if (!spectrum_)
        return {{listed(m, n).variance, listed(-m, -n).variance}, {listed(-m, n).variance, listed(m, -n).variance}};
    if (!spectrum_->is_physical()) return point_variances(m, n, 0);
    MirroredVariances sum{};
    const double share = for_points_of_cell(m, n, [&](double at_m, double at_n, double widening) {
        const MirroredVariances here = point_variances(at_m, at_n, widening);
        sum.plus += here.plus;
        sum.minus += here.minus;
    });
    return {sum.plus * share, sum.minus * share};
}

CascadeWaves::VariancesBySystem CascadeWaves::variances_by_system(int m, int n) const {
    const std::size_t count = spectrum_->systems().size();
    VariancesBySystem sums{};
    const double share = for_points_of_cell(m, n, [&](double at_m, double at_n, double widening) {
        const ShellOfPoint at(*this, at_m, at_n, widening);
        for (std::size_t system = 0; system < count; ++system) {
            sums[system].plus += spectrum_->amplitude_variances(at.shell, system, at.plus.along, at.plus.across);
            sums[system].minus += spectrum_->amplitude_variances(at.shell, system, at.minus.along, at.minus.across);
        }
    });
    for (std::size_t system = 0; system < count; ++system)
        sums[system] = {sums[system].plus * share, sums[system].minus * share};
    return sums;
}

/// Returns the variances of the cells if the spectrum were constant in each cell.
CascadeWaves::MirroredVariances CascadeWaves::point_variances(double m, double n, double widening) const {
    const ShellOfPoint at(*this, m, n, widening);
    return {spectrum_->amplitude_variances(at.shell, at.plus.along, at.plus.across),
            spectrum_->amplitude_variances(at.shell, at.minus.along, at.minus.across)};
}

int CascadeWaves::points_across(double steps, bool is_cut) const {
    const int points = is_cut ? points_of_cut_cell : steps < steps_of_wide_cells ? points_of_wide_cell : 1;
    const double of_lobe = std::min(points_per_width / (steps * narrowest_rad_), most_points);
    return std::max(points, static_cast<int>(std::ceil(of_lobe)));
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
