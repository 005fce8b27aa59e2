#include "pelagic/tools/measure/buoy_record.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <span>

#include "pelagic/sim/dispersion.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"
#include "pelagic/tools/measure/fourier.hpp"

namespace pelagic::tools {
namespace {

using Waves = std::vector<std::complex<double>>;

/// Smallest density of the frequencies whose directions count, as a fraction of the peak's. Windows
/// leak less than that from the peak.
constexpr double min_density = 0.01;

/// Deviation of still water, which is that of rounding errors.
constexpr double still_m = 1e-9;

double mean_of(std::span<const double> values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

/// Returns the transform of a segment without its mean, in a Hann window.
Waves windowed(std::span<const double> segment) {
    const double mean = mean_of(segment);
    Waves waves;
    for (std::size_t i = 0; i < segment.size(); ++i) {
        const double turns = static_cast<double>(i) / static_cast<double>(segment.size());
        waves.emplace_back((0.5 - 0.5 * det::sine_cosine_of_turns(turns).cosine) * (segment[i] - mean));
    }
    fourier(waves);
    return waves;
}

/// Sums over segments by frequency, element q being q / (segment's duration), in units of one scale.
struct RecordSpectrum {
    std::vector<double> heights;             ///< |H|^2
    std::vector<double> slopes_x, slopes_z;  ///< k |H|^2 times cosine and sine of the direction
};

RecordSpectrum spectrum_of(const BuoyRecord& record, std::size_t length) {
    RecordSpectrum sums{std::vector<double>(length / 2), std::vector<double>(length / 2),
                        std::vector<double>(length / 2)};
    const auto segment = [&](const std::vector<double>& of, std::size_t begin) {
        return windowed(std::span(of).subspan(begin, length));
    };
    for (std::size_t begin = 0; begin + length <= record.height_m.size(); begin += length / 2) {
        const Waves h = segment(record.height_m, begin), x = segment(record.slope_x, begin),
                    z = segment(record.slope_z, begin);
        // h = a cos(k.x - w t) has the slopes -k a sin(k.x - w t): a quarter of a period behind.
        for (std::size_t q = 1; q < sums.heights.size(); ++q) {
            sums.heights[q] += std::norm(h[q]);
            sums.slopes_x[q] += h[q].imag() * x[q].real() - h[q].real() * x[q].imag();
            sums.slopes_z[q] += h[q].imag() * z[q].real() - h[q].real() * z[q].imag();
        }
    }
    return sums;
}

void add_spectrum(const BuoyRecord& record, RecordStatistics& found) {
    const std::size_t frames = record.height_m.size();
    const std::size_t length = std::bit_floor(std::max(frames / 4, std::min<std::size_t>(frames, 16)));
    const RecordSpectrum sums = spectrum_of(record, length);
    const double highest = *std::max_element(sums.heights.begin(), sums.heights.end());
    const double step_hz = record.rate_hz / static_cast<double>(length);
    double weight = 0, weighted_hz = 0, variance = 0, along_x = 0, along_z = 0;
    for (std::size_t q = 1; q < sums.heights.size(); ++q) {
        const double hertz = static_cast<double>(q) * step_hz, density = sums.heights[q] / highest;
        const double fourth = density * density * density * density;
        weight += fourth;
        weighted_hz += fourth * hertz;
        if (density < min_density) continue;
        const double k = wave_number(two_pi * hertz, record.depth_m);
        variance += sums.heights[q];
        along_x += sums.slopes_x[q] / k;
        along_z += sums.slopes_z[q] / k;
    }
    found.peak_period_s = weight / weighted_hz;
    found.directions = directions_of_moment(along_x / variance, along_z / variance);
}

void add_waves(const BuoyRecord& record, double mean_m, RecordStatistics& found) {
    double first = 0, last = 0, low = 0, high = 0;
    int crossings = 0;
    for (std::size_t i = 1; i < record.height_m.size(); ++i) {
        const double before = record.height_m[i - 1] - mean_m, here = record.height_m[i] - mean_m;
        if (before < 0 && here >= 0) {
            last = static_cast<double>(i - 1) + before / (before - here);
            if (crossings++ == 0)
                first = last;
            else
                found.highest_wave_m = std::max(found.highest_wave_m, high - low);
            low = high = 0;
        }
        low = std::min(low, here);
        high = std::max(high, here);
    }
    if (crossings > 1) found.zero_crossing_period_s = (last - first) / (crossings - 1) / record.rate_hz;
}

}  // namespace

RecordStatistics statistics_of(const BuoyRecord& record) {
    const DefaultFloatEnvironment environment;
    RecordStatistics found;
    const double mean_m = mean_of(record.height_m);
    double squares = 0, cubes = 0;
    for (const double height : record.height_m) {
        const double above = height - mean_m;
        squares += above * above;
        cubes += above * above * above;
    }
    const auto count = static_cast<double>(record.height_m.size());
    const double deviation = std::sqrt(squares / count);
    if (deviation < still_m) return found;
    found.significant_wave_height_m = 4 * deviation;
    found.skewness = cubes / count / (deviation * deviation * deviation);
    add_waves(record, mean_m, found);
    add_spectrum(record, found);
    return found;
}

}  // namespace pelagic::tools
