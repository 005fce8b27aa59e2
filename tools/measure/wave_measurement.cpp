#include "pelagic/tools/measure/wave_measurement.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/dispersion.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/tools/measure/fourier.hpp"

namespace pelagic::tools {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t max_points_per_side = 16;
constexpr std::size_t max_pairs = 8;
constexpr std::size_t min_frames = 16;  ///< minimum for a frequency spectrum
constexpr double band_ratio = 1.08;

/// Minimum |sin| of a wave's phase change between two frames. Near 0 or half a turn the frames
/// hardly determine the direction.
constexpr double min_sine = 0.2;

Water water_of(const HeightSeries& series) {
    return {series.depth_m, series.cascade.has_surface_tension ? sea_surface_tension_m3ps2 : 0};
}

/// Returns the signed index m of element p of a transform of length n.
double signed_number(std::size_t p, std::size_t n) {
    return static_cast<double>(p) - (p < n / 2 ? 0.0 : static_cast<double>(n));
}

double squared(double value) { return value * value; }

/// Peak after Young (1995): the mean of the frequency weighted by S^4. Bands are weighted by their
/// widths.
struct Peak {
    double weight = 0, weighted = 0;
    void add(double at, double density, double width) {
        const double fourth = squared(squared(density)) * width;
        weight += fourth;
        weighted += fourth * at;
    }
    std::optional<double> at() const { return weight > 0 ? std::optional(weighted / weight) : std::nullopt; }
};

/// Adds to `density` the one-sided variance density of a windowed series. Element q is the
/// frequency q / (n step).
void add_periodogram(std::vector<Complex>& values, double window_power, double step_s, std::vector<double>& density) {
    const auto n = static_cast<double>(values.size());
    fourier(values);
    for (std::size_t q = 1; q < density.size(); ++q) {
        const bool is_nyquist = 2 * q == values.size();  // the Nyquist frequency is its own mirror
        density[q] += (is_nyquist ? 1 : 2) * std::norm(values[q]) * step_s / (n * window_power);
    }
}

/// Merges neighbours from element 1 on until a band is band_ratio wide. Elements are `step` apart
/// and `step` wide.
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
      points_per_side_(std::min(max_points_per_side, static_cast<std::size_t>(series.cascade.resolution))),
      rings_(static_cast<std::size_t>(series.cascade.resolution)) {
    if (series.frames >= min_frames) {
        at_points_.resize(points_per_side_ * points_per_side_);
        for (auto& point : at_points_) point.reserve(series.frames);
    }
    if (series.frames == 1) {
        pairs_.push_back({0, 0, {}});
        return;
    }
    // Pairs are a quarter of the peak period apart, which best resolves the direction of the
    // highest waves. Other pairs are closer, for waves whose phase changes by half a turn in that
    // time.
    running_.resize(static_cast<std::size_t>(series.cascade.resolution) * series.cascade.resolution);
    pair_counts_.resize(running_.size());
    constexpr std::array fractions = {1.0, 0.7, 0.5};
    for (std::size_t i = 0; i < max_pairs; ++i) {
        const double apart =
            std::round(fractions[i % fractions.size()] * series.likely_peak_period_s / 4 / series.step_s);
        const auto gap = static_cast<std::size_t>(std::clamp(apart, 1.0, static_cast<double>(series.frames - 1)));
        const std::size_t first = i * (series.frames - gap) / max_pairs;
        pairs_.push_back({first, first + gap, {}});
    }
}

void WaveMeasurement::add_frame(std::span<const float> heights_m) {
    const auto n = static_cast<std::size_t>(series_.cascade.resolution);
    assert(added_ < series_.frames && heights_m.size() == n * n);
    double sum = 0, squares = 0;
    for (const double height : heights_m) {
        sum += height;
        squares += height * height;
    }
    const double mean = sum / static_cast<double>(heights_m.size());
    variances_ += std::max(0.0, squares / static_cast<double>(heights_m.size()) - mean * mean);

    for (std::size_t p = 0; p < at_points_.size(); ++p) {
        const std::size_t stride = n / points_per_side_;
        at_points_[p].push_back(heights_m[p / points_per_side_ * stride * n + p % points_per_side_ * stride]);
    }
    for (Pair& pair : pairs_) {
        if (added_ == pair.first) pair.heights_of_first.assign(heights_m.begin(), heights_m.end());
        if (added_ == pair.second) {
            add_pair(pair, heights_m);
            pair.heights_of_first = {};
        }
    }
    ++added_;
}

void WaveMeasurement::add_pair(const Pair& pair, std::span<const float> second) {
    const std::vector<float>& first = pair.heights_of_first;
    const double apart_s = series_.step_s * static_cast<double>(pair.second - pair.first);
    const auto n = static_cast<std::size_t>(series_.cascade.resolution);
    const double spacing = series_.cascade.spacing();
    // Transform two real planes at once:
    // h1 = (F(k) + conj F(-k)) / 2, h2 = (F(k) - conj F(-k)) / 2i.
    std::vector<Complex> both(n * n);
    for (std::size_t texel = 0; texel < both.size(); ++texel) both[texel] = {first[texel], second[texel]};
    fourier_of_square(both, n);
    const double scale = 1 / static_cast<double>(n * n);

    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = 0; i < n; ++i) {
            const double m = signed_number(i, n), l = signed_number(j, n);
            // mean and Nyquist: not part of the model
            if ((i == 0 && j == 0) || i == n / 2 || j == n / 2) continue;
            const Complex here = both[j * n + i] * scale;
            const Complex mirrored = std::conj(both[(n - j) % n * n + (n - i) % n]) * scale;
            const Complex h1 = 0.5 * (here + mirrored), h2 = Complex(0, -0.5) * (here - mirrored);
            const double number = std::sqrt(m * m + l * l), k = number * spacing;
            Ring& ring = rings_[std::min(rings_.size() - 1, static_cast<std::size_t>(number + 0.5))];
            const double variance = 0.5 * (std::norm(h1) + std::norm(h2));
            ring.variance += variance;
            ring.weighted_k += variance * k;
            if (pair.first == pair.second) continue;

            // h1 = a + b and h2 = a e^{-i phase} + b e^{+i phase}, with a along k. The frequency is
            // that of the loop.
            const double omega = two_pi / series_.loop_period_s *
                                 loop_harmonic(angular_frequency(k, water_of(series_)), series_.loop_period_s);
            const auto turn = det::sine_cosine_of_turns(omega * apart_s / two_pi);
            if (std::fabs(turn.sine) < min_sine) continue;
            running_[j * n + i] += std::norm(h2 - h1 * Complex(turn.cosine, turn.sine)) / squared(2 * turn.sine);
            ++pair_counts_[j * n + i];
        }
    }
    ++spectra_;
}

WaveMeasurement::Running WaveMeasurement::running() const {
    Running sum;
    const auto n = static_cast<std::size_t>(series_.cascade.resolution);
    for (std::size_t wave = 0; wave < running_.size(); ++wave) {
        if (pair_counts_[wave] == 0) continue;
        // The wave along k and the wave against k, which is the one along -k, both contribute to
        // h~(k) and h~(-k).
        const double variance = 2 * running_[wave] / pair_counts_[wave];
        const double m = signed_number(wave % n, n), l = signed_number(wave / n, n),
                     number = std::sqrt(m * m + l * l);
        sum.variance += variance;
        sum.x += variance * m / number;
        sum.z += variance * l / number;
    }
    return sum;
}

/// A loop contains its frequencies exactly and needs one segment. Otherwise use Welch's method
/// (1967): segments that overlap by half, at least seven if there are enough frames.
std::size_t WaveMeasurement::segment_length() const {
    if (series_.is_one_loop) return series_.frames;
    return std::bit_floor(std::max(series_.frames / 4, std::min(series_.frames, min_frames)));
}

/// Returns the density at q / (segment_length() step_s) in element q, averaged over the points;
/// empty for too few frames.
std::vector<double> WaveMeasurement::frequency_density() const {
    if (at_points_.empty()) return {};
    const std::size_t length = segment_length(), hop = series_.is_one_loop ? length : length / 2;
    std::vector<double> window(length, 1.0);  // Hann window; rectangular for a loop
    double window_power = 0;
    for (std::size_t i = 0; i < length; ++i) {
        const double turns = static_cast<double>(i) / static_cast<double>(length);
        if (!series_.is_one_loop) window[i] = 0.5 - 0.5 * det::sine_cosine_of_turns(turns).cosine;
        window_power += window[i] * window[i] / static_cast<double>(length);
    }
    std::vector<double> density(length / 2 + 1);
    std::vector<Complex> segment(length);
    std::size_t segments = 0;
    for (const std::vector<float>& point : at_points_) {
        for (std::size_t begin = 0; begin + length <= series_.frames; begin += hop) {
            double mean = 0;
            for (std::size_t i = 0; i < length; ++i)
                mean += static_cast<double>(point[begin + i]) / static_cast<double>(length);
            for (std::size_t i = 0; i < length; ++i) segment[i] = window[i] * (point[begin + i] - mean);
            add_periodogram(segment, window_power, series_.step_s, density);
            ++segments;
        }
    }
    for (double& value : density) value /= static_cast<double>(segments);
    return density;
}

/// Returns the mean time between upward zero crossings in seconds; none without crossings. Adds the
/// heights of one point of each cascade: cascades are independent, so any choice of points will do.
std::optional<double> WaveMeasurement::zero_crossing_period(std::span<const WaveMeasurement> cascades) {
    const HeightSeries& series = cascades.front().series_;
    std::size_t points = cascades.front().at_points_.size(), crossings = 0;
    for (const WaveMeasurement& cascade : cascades) points = std::min(points, cascade.at_points_.size());
    std::vector<double> heights(series.frames);
    for (std::size_t point = 0; point < points; ++point) {
        double mean = 0;
        for (std::size_t frame = 0; frame < series.frames; ++frame) {
            heights[frame] = 0;
            for (const WaveMeasurement& cascade : cascades)
                heights[frame] += static_cast<double>(cascade.at_points_[point][frame]);
            mean += heights[frame] / static_cast<double>(series.frames);
        }
        for (std::size_t frame = 1; frame < series.frames; ++frame)
            crossings += heights[frame - 1] < mean && heights[frame] >= mean;
        if (series.is_one_loop) crossings += heights.back() < mean && heights.front() >= mean;
    }
    if (crossings == 0) return {};
    const std::size_t steps = series.is_one_loop ? series.frames : series.frames - 1;
    return static_cast<double>(points * steps) * series.step_s / static_cast<double>(crossings);
}

bool WaveMeasurement::holds_whole_ring(std::size_t number) const {
    const CascadePlan& cascade = series_.cascade;
    const auto r = static_cast<double>(number);
    // Rings beyond N/2 are cut by the edges of the square. Below 1 there are no waves, so the first
    // ring of the first cascade is complete.
    return number >= 1 && 2 * number < rings_.size() &&
           (cascade.min_k == 0 || (r - 0.5) * cascade.spacing() >= cascade.min_k) &&
           (r + 0.5) * cascade.spacing() <= cascade.max_k;
}

MeasuredWaves measured_waves(std::span<const WaveMeasurement> cascades) {
    MeasuredWaves found;
    const HeightSeries& series = cascades.front().series_;
    double variance = 0, running = 0, running_x = 0, running_z = 0;
    std::vector<double> density;
    Peak longest;
    for (const WaveMeasurement& cascade : cascades) {
        assert(cascade.added_ == series.frames);
        variance += cascade.variances_ / static_cast<double>(cascade.added_);
        const WaveMeasurement::Running its_running = cascade.running();
        const auto world = cascade.series_.cascade.grid.in_world(its_running.x, its_running.z);
        running += its_running.variance;
        running_x += world.along;
        running_z += world.across;
        const std::vector<double> its_own = cascade.frequency_density();
        density.resize(its_own.size());
        for (std::size_t q = 0; q < density.size(); ++q) density[q] += its_own[q];

        const double spacing = cascade.series_.cascade.spacing();
        const Water water = water_of(cascade.series_);
        for (std::size_t r = 1; r < cascade.rings_.size(); ++r) {
            if (!cascade.holds_whole_ring(r)) continue;
            const double in_ring = cascade.rings_[r].variance / static_cast<double>(cascade.spectra_);
            const auto number = static_cast<double>(r);
            found.by_wave_number.push_back({number * spacing, in_ring / spacing});
            if (!(in_ring > 0)) continue;
            const double width = (angular_frequency((number + 0.5) * spacing, water) -
                                  angular_frequency((number - 0.5) * spacing, water));
            const double mean_k = cascade.rings_[r].weighted_k / cascade.rings_[r].variance;
            longest.add(angular_frequency(mean_k, water), in_ring / width, width);
        }
    }
    found.significant_wave_height_m = 4 * std::sqrt(variance);
    if (const auto omega = longest.at()) found.peak_wavelength_m = two_pi / wave_number(*omega, series.depth_m);
    if (running > 0.5 * variance) found.directions = directions_of_moment(running_x / running, running_z / running);
    if (density.empty()) {
        found.frequency_method = "none: fewer than " + number_text(min_frames) + " frames";
        return found;
    }
    const std::size_t length = cascades.front().segment_length();
    const double step_hz = 1 / (static_cast<double>(length) * series.step_s);
    Peak peak;
    double m0 = 0, m1 = 0, m2 = 0;
    for (std::size_t q = 1; q < density.size(); ++q) {
        const double hertz = static_cast<double>(q) * step_hz;
        peak.add(hertz, density[q], step_hz);
        found.by_harmonic.push_back({hertz, density[q]});
        m0 += density[q];
        m1 += density[q] * hertz;
        m2 += density[q] * (hertz * hertz);
    }
    if (const auto hertz = peak.at()) found.peak_period_s = 1 / *hertz;
    if (m0 > 0) found.tm01_s = m0 / m1, found.tm02_s = std::sqrt(m0 / m2);
    found.zero_crossing_period_s = WaveMeasurement::zero_crossing_period(cascades);
    found.by_frequency = in_bands(density, step_hz);
    found.frequency_method = series.is_one_loop
                                 ? std::string("the loop's own harmonics")
                                 : "Welch, Hann windows of " + number_text(length) + " frames, half overlapping";
    found.frequency_method += " at " + number_text(cascades.front().at_points_.size()) + " points of a cascade";
    return found;
}

}  // namespace pelagic::tools
