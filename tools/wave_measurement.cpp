#include "pelagic/tools/wave_measurement.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <complex>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/tools/fourier.hpp"

namespace pelagic::tools {
namespace {

using Complex = std::complex<double>;

constexpr double two_pi = 6.28318530717958647693;

constexpr std::size_t most_points_a_side = 16;
constexpr std::size_t most_pairs = 8;
constexpr std::size_t fewest_frames = 16;  ///< for a frequency spectrum
constexpr double band_ratio = 1.08;

/// Where a wave has turned by less than this, or by as little from half a turn, two frames hardly tell its direction.
constexpr double least_sine = 0.2;

double squared(double value) { return value * value; }

/// Young's peak: where S^4 has its mean. Widths weigh what has them.
struct Peak {
    double weight = 0, weighted = 0;
    void add(double at, double density, double width) {
        const double fourth = squared(squared(density)) * width;
        weight += fourth;
        weighted += fourth * at;
    }
    std::optional<double> at() const { return weight > 0 ? std::optional(weighted / weight) : std::nullopt; }
};

/// The one-sided variance density over frequency of a series times a window, added to `density`: element q is q / (n step).
void add_periodogram(std::vector<Complex>& values, double window_power, double step_s, std::vector<double>& density) {
    const auto n = static_cast<double>(values.size());
    fourier(values);
    for (std::size_t q = 1; q < density.size(); ++q) {
        const bool is_nyquist = 2 * q == values.size();  // it is its own mirror
        density[q] += (is_nyquist ? 1 : 2) * std::norm(values[q]) * step_s / (n * window_power);
    }
}

/// Neighbours joined until a band is band_ratio wide, from element 1 on; elements are `step` apart and as wide.
std::vector<SpectrumPoint> in_bands(const std::vector<double>& density, double step) {
    std::vector<SpectrumPoint> bands;
    for (std::size_t first = 1; first < density.size();) {
        double sum = density[first];
        std::size_t last = first;
        while (last + 1 < density.size() &&
               (static_cast<double>(last) + 1.5) < band_ratio * (static_cast<double>(first) - 0.5))
            sum += density[++last];
        bands.push_back(
            {step * 0.5 * static_cast<double>(first + last), sum / static_cast<double>(last - first + 1)});
        first = last + 1;
    }
    return bands;
}

}  // namespace

WaveMeasurement::WaveMeasurement(const HeightSeries& series)
    : series_(series),
      points_a_side_(std::min(most_points_a_side, static_cast<std::size_t>(series.resolution))),
      rings_(static_cast<std::size_t>(series.resolution)) {
    if (series.frames >= fewest_frames) {
        at_points_.resize(points_a_side_ * points_a_side_);
        for (auto& point : at_points_) point.reserve(series.frames);
    }
    if (series.frames == 1) {
        pairs_.push_back({0, 0, {}});
        return;
    }
    // A quarter of the peak's period apart, so that the highest waves are told best.
    const double quarter = std::max(1.0, std::round(series.likely_peak_period_s / 4 / series.step_s));
    gap_ = static_cast<std::size_t>(std::min(quarter, static_cast<double>(series.frames - 1)));
    const std::size_t starts = series.frames - gap_, count = std::min(most_pairs, starts);
    for (std::size_t i = 0; i < count; ++i) pairs_.push_back({i * starts / count, i * starts / count + gap_, {}});
}

void WaveMeasurement::add_frame(std::span<const float> heights_m) {
    assert(added_ < series_.frames && heights_m.size() == squared(series_.resolution));
    const auto n = static_cast<std::size_t>(series_.resolution);
    double sum = 0, squares = 0;
    for (const double height : heights_m) {
        sum += height;
        squares += height * height;
    }
    const double mean = sum / static_cast<double>(heights_m.size());
    variances_ += std::max(0.0, squares / static_cast<double>(heights_m.size()) - mean * mean);

    for (std::size_t p = 0; p < at_points_.size(); ++p) {
        const std::size_t stride = n / points_a_side_;
        at_points_[p].push_back(heights_m[p / points_a_side_ * stride * n + p % points_a_side_ * stride]);
    }
    for (Pair& pair : pairs_) {
        if (added_ == pair.first) pair.heights_of_first.assign(heights_m.begin(), heights_m.end());
        if (added_ == pair.second) {
            add_pair(pair.heights_of_first, heights_m);
            pair.heights_of_first = {};
        }
    }
    ++added_;
}

void WaveMeasurement::add_pair(std::span<const float> first, std::span<const float> second) {
    const auto n = static_cast<std::size_t>(series_.resolution);
    const double spacing = two_pi / series_.lattice.side_m;
    // Two real planes in one transform: h1 = (F(k) + conj F(-k)) / 2, h2 = (F(k) - conj F(-k)) / 2i.
    std::vector<Complex> both(n * n);
    for (std::size_t texel = 0; texel < both.size(); ++texel) both[texel] = {first[texel], second[texel]};
    fourier_of_square(both, n);
    const double scale = 1 / static_cast<double>(n * n);

    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = 0; i < n; ++i) {
            const auto signed_number = [&](std::size_t p) {
                return static_cast<double>(p) - (p < n / 2 ? 0.0 : static_cast<double>(n));
            };
            const double m = signed_number(i), l = signed_number(j);
            if ((i == 0 && j == 0) || i == n / 2 || j == n / 2) continue;  // mean and Nyquist: no waves of ours
            const Complex here = both[j * n + i] * scale;
            const Complex mirrored = std::conj(both[(n - j) % n * n + (n - i) % n]) * scale;
            const Complex h1 = 0.5 * (here + mirrored), h2 = Complex(0, -0.5) * (here - mirrored);
            const double number = std::sqrt(m * m + l * l), k = number * spacing;
            Ring& ring = rings_[std::min(rings_.size() - 1, static_cast<std::size_t>(number + 0.5))];
            const double variance = 0.5 * (std::norm(h1) + std::norm(h2));
            ring.variance += variance;
            ring.weighted_k += variance * k;
            if (gap_ == 0) continue;

            // h1 = a + b and h2 = a e^{-i phase} + b e^{+i phase}, a running along k: the frequency is the loop's own.
            const double omega = two_pi / series_.loop_period_s *
                                 loop_harmonic(angular_frequency(k, series_.depth_m), series_.loop_period_s);
            const auto turn = det::sine_cosine_of_turns(omega * series_.step_s * static_cast<double>(gap_) / two_pi);
            if (std::fabs(turn.sine) < least_sine) continue;
            const double energy = std::norm(h2 - h1 * Complex(turn.cosine, turn.sine)) / squared(2 * turn.sine);
            running_ += energy;
            running_x_ += energy * m / number;
            running_z_ += energy * l / number;
        }
    }
    ++spectra_;
}

MeasuredWaves WaveMeasurement::result() const {
    assert(added_ == series_.frames);
    MeasuredWaves found;
    found.significant_wave_height_m = 4 * std::sqrt(variances_ / static_cast<double>(added_));
    measure_frequencies(found);
    measure_wave_numbers(found);
    if (running_ > 0) {
        const auto world = series_.lattice.in_world(running_x_ / running_, running_z_ / running_);
        found.directions = directions_of_moment(world.along, world.across);
    }
    return found;
}

void WaveMeasurement::measure_frequencies(MeasuredWaves& found) const {
    if (at_points_.empty()) {
        found.frequency_method = "none: fewer than " + number_text(fewest_frames) + " frames";
        return;
    }
    const std::size_t frames = series_.frames;
    // A loop holds its own frequencies exactly: no window, one segment. Else Welch (1967): Hann windows that overlap by half, at
    // least seven of them where there are enough frames.
    const std::size_t length =
        series_.is_one_loop ? frames : std::bit_floor(std::max(frames / 4, std::min(frames, fewest_frames)));
    const std::size_t hop = series_.is_one_loop ? length : length / 2;
    std::vector<double> window(length, 1.0);
    if (!series_.is_one_loop)
        for (std::size_t i = 0; i < length; ++i)
            window[i] =
                0.5 - 0.5 * det::sine_cosine_of_turns(static_cast<double>(i) / static_cast<double>(length)).cosine;
    double window_power = 0;
    for (const double weight : window) window_power += weight * weight / static_cast<double>(length);

    std::vector<double> density(length / 2 + 1);
    std::vector<Complex> segment(length);
    std::size_t segments = 0;
    for (const std::vector<float>& point : at_points_) {
        for (std::size_t begin = 0; begin + length <= frames; begin += hop) {
            double mean = 0;
            for (std::size_t i = 0; i < length; ++i)
                mean += static_cast<double>(point[begin + i]) / static_cast<double>(length);
            for (std::size_t i = 0; i < length; ++i) segment[i] = window[i] * (point[begin + i] - mean);
            add_periodogram(segment, window_power, series_.step_s, density);
            ++segments;
        }
    }
    for (double& value : density) value /= static_cast<double>(segments);
    const double step_hz = 1 / (static_cast<double>(length) * series_.step_s);
    Peak peak;
    for (std::size_t q = 1; q < density.size(); ++q) peak.add(static_cast<double>(q) * step_hz, density[q], step_hz);
    if (const auto at = peak.at()) found.peak_period_s = 1 / *at;
    found.by_frequency = in_bands(density, step_hz);
    found.frequency_method =
        (series_.is_one_loop ? "the loop's own harmonics"
                             : "Welch, Hann windows of " + number_text(length) + " frames, half overlapping") +
        " at " + number_text(at_points_.size()) + " points";
}

void WaveMeasurement::measure_wave_numbers(MeasuredWaves& found) const {
    const double spacing = two_pi / series_.lattice.side_m;
    Peak peak;
    // Rings beyond N/2 are cut by the square's edges.
    for (std::size_t r = 1; r < rings_.size() / 2; ++r) {
        const double variance = rings_[r].variance / static_cast<double>(spectra_);
        found.by_wave_number.push_back({static_cast<double>(r) * spacing, variance / spacing});
        if (!(variance > 0)) continue;
        const auto hertz = [&](double number) {
            return angular_frequency(number * spacing, series_.depth_m) / two_pi;
        };
        const double width = hertz(static_cast<double>(r) + 0.5) - hertz(static_cast<double>(r) - 0.5);
        const double mean_k = rings_[r].weighted_k / rings_[r].variance;
        peak.add(angular_frequency(mean_k, series_.depth_m), variance / width, width);
    }
    if (const auto omega = peak.at()) found.peak_wavelength_m = two_pi / wave_number(*omega, series_.depth_m);
}

}  // namespace pelagic::tools
