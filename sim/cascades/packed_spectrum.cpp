#include "pelagic/sim/cascades/packed_spectrum.hpp"

#include <array>
#include <cmath>
#include <complex>

#include "pelagic/sim/kernels/harmonic_bands.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/foam_front.hpp"
#include "pelagic/sim/spectrum/wind_drift.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

/// S' of equation 22.
using PackedWave = std::array<float, 4>;

PackedWave packed(const OppositeWaves& waves) {
    const std::complex<double> along = waves.along.amplitude, against = std::conj(waves.against.amplitude);
    return {static_cast<float>(along.real() + against.real()), static_cast<float>(along.imag() + against.imag()),
            static_cast<float>(along.imag() - against.imag()), static_cast<float>(against.real() - along.real())};
}

/// Returns the response of the paper's central differences (equation 45) to a wave number, 1/m.
/// \param periods  of the wave along a side of the cascade
double central_difference(const CascadePlan& cascade, int periods) {
    const double texel_m = cascade.grid.side_m / cascade.resolution;
    return det::sine_cosine_of_turns(static_cast<double>(periods) / cascade.resolution).sine / texel_m;
}

/// Derivative of a wave along an axis of the cascade, as a texture of the cascade represents it.
struct ShownSlope {
    double derivative;  ///< 1/m, at texels
    double filter;      ///< factor on the mean square from bilinear filtering between texels
};

/// Returns the derivative in the textures of slopes and of compression.
/// \param periods  of the wave along a side of the cascade
ShownSlope filtered_slope(const CascadePlan& cascade, int periods) {
    const double texel_m = cascade.grid.side_m / cascade.resolution;
    const auto [sine, cosine] = det::sine_cosine_of_turns(static_cast<double>(periods) / cascade.resolution);
    // Differences of stage `slopes`; the mean of ((1 - u) a + u b)^2 over u is (a^2 + a b + b^2)/3.
    const double near = SlopesJob::near_weight * sine, far = SlopesJob::far_weight * (2 * sine * cosine);
    return {2 * (near + far) / texel_m, (2 + cosine) / 3};
}

/// Returns the derivative of which the sea's resolved slopes are made.
ShownSlope resolved_slope(const CascadePlan& cascade, int periods) {
    return cascade.is_banded() ? filtered_slope(cascade, periods)
                               : ShownSlope{central_difference(cascade, periods), 1};
}

}  // namespace

PackedSpectrum::PackedSpectrum(const FftPlan& plan, std::size_t lane_count, const Allocator& memory)
    : lanes(lane_count),
      pairs(plan.pairs().size() * static_cast<std::size_t>(plan.tables().first_step().radix)),
      waves(line_blocks(plan.tables().size, lanes) * pairs * wave_quantities * lanes, memory),
      harmonics(line_blocks(plan.tables().size, lanes) * pairs * lanes, memory) {}

LineStatistics& LineStatistics::operator+=(const LineStatistics& other) {
    height_variance += other.height_variance;
    mean_square_slope += other.mean_square_slope;
    mean_square_convergence += other.mean_square_convergence;
    slopes += other.slopes;
    compression_square += other.compression_square;
    compression_rate_square += other.compression_rate_square;
    contraction += other.contraction;
    contraction_before += other.contraction_before;
    compression_drop_x += other.compression_drop_x;
    compression_drop_z += other.compression_drop_z;
    level_m += other.level_m;
    stokes_x += other.stokes_x;
    stokes_z += other.stokes_z;
    lacking_x += other.lacking_x;
    lacking_z += other.lacking_z;
    lacking_size += other.lacking_size;
    lacking_k += other.lacking_k;
    return *this;
}

LineStatistics& StatisticsByBand::operator[](std::size_t band) {
    if (statistics_.empty()) first_ = band;
    if (band < first_) {
        statistics_.insert(statistics_.begin(), first_ - band, LineStatistics());
        first_ = band;
    }
    if (band >= end()) statistics_.resize(band - first_ + 1);
    return statistics_[band - first_];
}

StatisticsByBand& StatisticsByBand::operator+=(const StatisticsByBand& other) {
    for (std::size_t band = other.first(); band < other.end(); ++band) (*this)[band] += other.at(band);
    return *this;
}

LineStatistics between(const LineStatistics& before, const LineStatistics& after, double weight) {
    if (weight == 0) return before;
    if (weight == 1) return after;
    LineStatistics sum;
    const auto add = [&](const LineStatistics& of, double factor) {
        sum += {.height_variance = of.height_variance * factor,
                .mean_square_slope = of.mean_square_slope * factor,
                .mean_square_convergence = of.mean_square_convergence * factor,
                .slopes = of.slopes * factor,
                .compression_square = of.compression_square * factor,
                .compression_rate_square = of.compression_rate_square * factor,
                .contraction = of.contraction * factor,
                .contraction_before = of.contraction_before * factor,
                .compression_drop_x = of.compression_drop_x * factor,
                .compression_drop_z = of.compression_drop_z * factor,
                .level_m = of.level_m * factor,
                .stokes_x = of.stokes_x * factor,
                .stokes_z = of.stokes_z * factor,
                .lacking_x = of.lacking_x * factor,
                .lacking_z = of.lacking_z * factor,
                .lacking_size = of.lacking_size * factor,
                .lacking_k = of.lacking_k * factor};
    };
    add(before, 1 - weight);
    add(after, weight);
    return sum;
}

LineStatistics bake_spectrum_line(const SeaState& sea, const CascadeWaves& waves, const FftPlan& plan,
                                  std::size_t line, PackedSpectrum& out, StatisticsByBand* by_band) {
    const CascadePlan& cascade = waves.cascade();
    const int resolution = cascade.resolution;
    const int radix = plan.tables().first_step().radix;
    const int n = static_cast<int>(line);
    const double spacing = cascade.spacing();
    const ShownSlope resolved_z = resolved_slope(cascade, n), filtered_z = filtered_slope(cascade, n);
    const WindDrift usual = usual_foam_drift(sea);
    const CascadeGrid::Vector foam_drift = cascade.grid.in_cascade(usual.x_mps, usual.z_mps);
    const FoamFront fronts = foam_front(sea);
    const CascadeGrid::Vector front = cascade.grid.in_cascade(fronts.x, fronts.z);
    const double mirrors = n == 0 ? 1 : 2;  // line 0 is its own mirror
    const double largest_moving_k =
        two_pi / (WaterLevels::shortest_velocity_texels * cascade.grid.side_m / cascade.resolution);
    LineStatistics all;
    float* wave = out.block(line / out.lanes) + line % out.lanes;
    std::uint32_t* harmonic = out.block_harmonics(line / out.lanes) + line % out.lanes;

    for (const GroupPair& pair : plan.pairs()) {
        for (int s = 0; s < radix; ++s, wave += wave_quantities * out.lanes, harmonic += out.lanes) {
            const int position = pair.plus + s * (resolution / radix);
            const int m = position < resolution / 2 ? position : position - resolution;
            if (!waves.holds(m, n)) continue;  // amplitude 0
            const double length = std::sqrt(static_cast<double>(m) * m + static_cast<double>(n) * n);
            const double k = length * spacing;
            const double frequency = waves.frequency(k);
            const std::uint32_t periods = loop_harmonic(frequency, sea.loop_period_s);
            const auto put = [&](WaveQuantity quantity, double value) {
                wave[quantity * out.lanes] = static_cast<float>(value);
            };
            const ShownSlope resolved_x = resolved_slope(cascade, m), filtered_x = filtered_slope(cascade, m);
            const double drift = stokes_drift(k, waves.water()) / k;
            const double orbit = orbit_ratio(k, waves.water().depth_m), orbit_square = orbit * orbit;
            const CascadeWaves::MirroredPair mirrored = waves.pair(m, n);
            const bool has_waves = mirrored.plus.expected_square() + mirrored.minus.expected_square() > 0;
            const double lean = has_waves ? waves.lean(k) : 0;  // most cells are beyond the band
            const double sharpening = orbit / std::sqrt(1 + lean * lean);
            const auto put_wave = [&](WaveQuantity first, const OppositeWaves& opposites, int signed_m) {
                const PackedWave values = packed(opposites);
                for (std::size_t i = 0; i < values.size(); ++i) wave[(first + i) * out.lanes] = values[i];
                LineStatistics statistics;
                statistics.height_variance = mirrors * opposites.expected_square();
                statistics.mean_square_slope = mirrors * opposites.expected_square() * k * k;
                statistics.mean_square_convergence = statistics.mean_square_slope * orbit_square;
                statistics.level_m = mirrors * opposites.realised_square() * k * sharpening;
                const double sign = signed_m == m ? 1 : -1;
                // Frequency in the frame of drifting foam: foam that moves with a wave meets it
                // less often.
                const double drifted = signed_m * spacing * foam_drift.along + n * spacing * foam_drift.across;
                const auto square_rate = [](const Wave& of, double met_frequency) {
                    return std::norm(of.amplitude) * met_frequency * met_frequency;
                };
                // Trace of the gradient of a displacement of 1 m along the wave, times k.
                const double k_x = signed_m * spacing, k_z = n * spacing, of_square = 1 / (k_x * k_x + k_z * k_z);
                const double trace = k_x * (sign * filtered_x.derivative) + k_z * filtered_z.derivative;
                const double filter = filtered_x.filter * filtered_z.filter;
                // A wave cos(phase) of 1 m along k has the compression
                // crest cos(phase - b) + face sin(phase), where b is the lean. Against k, face is
                // negative.
                const double crest = orbit * trace / k;
                const double face = front.along * (sign * filtered_x.derivative) + front.across * filtered_z.derivative;
                const double sine = lean / std::sqrt(1 + lean * lean), cosine = 1 / std::sqrt(1 + lean * lean);
                const double both = mirrors * opposites.realised_square();
                const double forward =
                    mirrors * (std::norm(opposites.along.amplitude) - std::norm(opposites.against.amplitude));
                const double contraction =
                    both * orbit_square * of_square * trace * trace + forward * crest * face * sine;
                const double at_texels = contraction + (both * face + forward * crest * sine) * face;
                statistics.contraction = filter * contraction;
                statistics.contraction_before = filter * forward * crest * face * cosine;
                statistics.compression_square = filter * at_texels;
                // The mean square at u between two texels is 1 - 2 u (1 - u) (1 - cos), with the mean
                // 1 - (1 - cos) / 3.
                statistics.compression_drop_x = 1.5 * (1 - filtered_x.filter) * filtered_z.filter * at_texels;
                statistics.compression_drop_z = 1.5 * (1 - filtered_z.filter) * filtered_x.filter * at_texels;
                const double along_rate = square_rate(opposites.along, frequency - drifted);
                const double against_rate = square_rate(opposites.against, frequency + drifted);
                const double both_rates = along_rate + against_rate;
                statistics.compression_rate_square =
                    filter * (mirrors * both_rates * orbit_square) * of_square * trace * trace +
                    filter * mirrors * (both_rates * face + 2 * (along_rate - against_rate) * crest * sine) * face;
                statistics.slopes.add_wave(
                    mirrors * opposites.expected_square() * resolved_x.filter * resolved_z.filter,
                    sign * resolved_x.derivative, resolved_z.derivative);
                const double running = mirrors * (opposites.along.variance - opposites.against.variance) * drift;
                statistics.stokes_x = running * (signed_m * spacing);
                statistics.stokes_z = running * (n * spacing);
                const double lacking = k > largest_moving_k ? 0 : 0.5 * (1 + sea.choppiness);
                statistics.lacking_x = lacking * statistics.stokes_x;
                statistics.lacking_z = lacking * statistics.stokes_z;
                statistics.lacking_size = lacking * std::fabs(running) * k;
                statistics.lacking_k = statistics.lacking_size * k;
                all += statistics;
                if (by_band && opposites.expected_square() > 0) (*by_band)[harmonic_band(periods)] += statistics;
            };
            put_wave(plus_cos_re, mirrored.plus, m);
            if (!pair.is_own_negative()) put_wave(minus_cos_re, mirrored.minus, -m);
            put(direction_x, m / length * sharpening);
            put(direction_z, n / length * sharpening);
            put(lean_tangent, lean);
            *harmonic = periods;
        }
    }
    return all;
}

}  // namespace pelagic
