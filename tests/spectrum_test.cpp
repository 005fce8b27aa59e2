// Wave spectra: attenuation by depth, the swell, and the cutoff of short waves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/spectrum/amplitudes.hpp"
#include "pelagic/sim/statistics.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;

constexpr double gravity = 9.80665;

/// Returns a cascade of the sea's waves, without surface tension.
CascadePlan cascade_of(const SeaState& sea) {
    return {.grid = {.side_m = sea.patch_size_m > 0 ? sea.patch_size_m : 250}, .resolution = resolution_of(sea)};
}
WaveSpectrum spectrum_of(const SeaState& sea) { return WaveSpectrum(sea, cascade_of(sea)); }

/// Integrates by Simpson's rule.
double integral(const std::function<double(double)>& f, double first, double last, int steps = 4000) {
    double sum = f(first) + f(last);
    for (int i = 1; i < steps; ++i) sum += (i % 2 ? 4 : 2) * f(first + (last - first) * i / steps);
    return sum * (last - first) / steps / 3;
}

/// Returns the integral of k^power S(k) over the wave numbers of a range.
double moment(const WaveSpectrum& spectrum, double power, double from = 1e-4, double to = 1e3) {
    return integral(
        [&](double log_k) {
            const double k = std::exp(log_k);
            return spectrum.radial_density(k) * std::pow(k, power + 1);
        },
        std::log(from), std::log(to));
}

constexpr SpectrumModel physical[] = {SpectrumModel::jonswap, SpectrumModel::pierson_moskowitz,
                                      SpectrumModel::phillips};

// Bouws et al. 1985: with w = omega sqrt(d/g), phi is w^2/2 up to 1 and 1 - (2 - w)^2/2 up to 2.
// These are the parabolas of Thompson and Vincent 1983, "within 4 %".
TEST(Depth, FactorIsThePublishedValue) {
    constexpr double depth = 7;
    for (double w = 0.05; w < 2; w += 0.05) {
        const double k = wave_number(w * std::sqrt(gravity / depth), depth);
        const double published = w <= 1 ? w * w / 2 : 1 - (2 - w) * (2 - w) / 2;
        EXPECT_NEAR(depth_factor(k, depth), published, 0.04) << w;
    }
    // Kitaigorodskii's limit in shallow water is w^2/2.
    const double k = wave_number(0.01 * std::sqrt(gravity / depth), depth);
    EXPECT_NEAR(depth_factor(k, depth) / (0.5e-4), 1, 1e-4);
}

TEST(Depth, FactorIsExactlyOneWhereItRoundsToOne) {
    for (const double k : {2 * pi / 1000, 0.01, 0.3, 40.0}) EXPECT_EQ(depth_factor(k, 4000), 1) << k;
    for (const SpectrumModel model : physical) {
        const SeaState sea{.spectrum = model};
        SeaState deeper = sea;
        deeper.depth_m = 11000;
        for (const double k : {2 * pi / 1000, 0.01, 0.3, 40.0})
            EXPECT_EQ(spectrum_of(sea).radial_density(k), spectrum_of(deeper).radial_density(k)) << k;
    }
}

// In the saturation range of the TMA spectrum the energy over wave numbers is alpha/2 k^-3 at any
// depth. This is the purpose of Kitaigorodskii's factor.
TEST(Depth, KeepsTheSaturationRangeOverWaveNumbers) {
    const SeaState sea{.spectrum = SpectrumModel::pierson_moskowitz, .wind_speed_mps = 30, .depth_m = 15};
    const WaveSpectrum spectrum = spectrum_of(sea);
    ASSERT_EQ(spectrum.kept_after_breaking(), 1);
    // exp(-0.74 (g/(V w))^4) is 0.99 at three times g/V.
    const double k = wave_number(3 * gravity / 30, 15);
    ASSERT_LT(std::tanh(k * 15), 0.95);
    EXPECT_NEAR(spectrum.radial_density(k) * k * k * k, 0.0081 / 2, 0.01 * 0.0081 / 2);
}

TEST(Depth, MakesEverySeaLower) {
    for (const SpectrumModel model : physical) {
        double before = 1e9;
        for (const double depth : {4000.0, 50.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.3}) {
            const double height =
                expected_waves({.spectrum = model, .depth_m = depth}).model_significant_wave_height_m.value();
            EXPECT_LE(height, before) << name_of(model) << " in " << depth;
            EXPECT_LE(height, highest_over_depth * depth * (1 + 1e-9)) << name_of(model) << " in " << depth;
            before = height;
        }
    }
}

TEST(Depth, LimitsHeightsToSixTenthsAndWarns) {
    SeaState sea{.wind_speed_mps = 25, .fetch_m = 500e3, .depth_m = 2, .swell_height_m = 2};
    EXPECT_NEAR(expected_waves(sea).model_significant_wave_height_m.value(), 1.2, 1e-9);
    const auto note = [](const SeaState& of) {
        for (const std::string& warning : warnings_about(of))
            if (warning.find("waves break") != std::string::npos) return warning;
        return std::string();
    };
    double depth = 0, before = 0, left = 0;
    ASSERT_EQ(std::sscanf(note(sea).c_str(),
                          "waves break in %lf m of water: Hs is limited to %lf m (0.6 of the depth) instead of %lf m",
                          &depth, &left, &before),
              3)
        << note(sea);
    EXPECT_EQ(depth, 2);
    EXPECT_EQ(left, 1.2);
    EXPECT_GT(before, 2);
    sea.depth_m = 50;
    EXPECT_EQ(note(sea), "");
    EXPECT_EQ(note({.spectrum = SpectrumModel::phillips_paper, .depth_m = 0.1}), "") << "it has no physical height";
}

/// Returns the mean over 16 seeds of the variance at the frames' points in frequency bands, by a
/// Fourier sum over a loop at every texel.
std::vector<double> measured_bands(SeaState sea, const std::vector<int>& harmonics, int frames) {
    std::vector<double> bands(harmonics.size() - 1);
    constexpr int seeds = 16;
    for (int seed = 1; seed <= seeds; ++seed) {
        sea.seed = static_cast<std::uint32_t>(seed);
        Ocean ocean(sea, {.executor = make_serial_executor()});
        const auto texels = static_cast<std::size_t>(sea.resolution * sea.resolution);
        const auto last = static_cast<std::size_t>(harmonics.back());
        std::vector<std::complex<double>> sums(last * texels);
        for (int frame = 0; frame < frames; ++frame) {
            const PlaneView height = ocean.frame_at(sea.loop_period_s * frame / frames).cascades[0].height;
            for (std::size_t q = static_cast<std::size_t>(harmonics.front()); q < last; ++q) {
                const auto turn = std::polar(1.0, -2 * pi * static_cast<double>(q) * frame / frames);
                for (std::size_t texel = 0; texel < texels; ++texel)
                    sums[q * texels + texel] +=
                        turn * static_cast<double>(height.at(static_cast<int>(texel) % sea.resolution,
                                                             static_cast<int>(texel) / sea.resolution));
            }
        }
        for (std::size_t band = 0; band < bands.size(); ++band)
            for (int q = harmonics[band]; q < harmonics[band + 1]; ++q)
                for (std::size_t texel = 0; texel < texels; ++texel)
                    bands[band] += 2 * std::norm(sums[static_cast<std::size_t>(q) * texels + texel]) /
                                   (static_cast<double>(texels) * frames * frames * seeds);
    }
    return bands;
}

// Compares a buoy's measurement, in the open sea and in 10 m of water, with the integral of
// S(omega) phi(omega). Bands of the loop's frequencies are q - 1/2 to q' - 1/2, because waves of a
// loop have a whole number of periods.
TEST(Depth, FrequenciesAtAPointMatchTheSpectrum) {
    for (const double depth : {4000.0, 10.0}) {
        const SeaState sea{.resolution = 64,
                           .patch_size_m = 800,
                           .wind_speed_mps = 15,
                           .fetch_m = 100e3,
                           .depth_m = depth,
                           .loop_period_s = 60};
        const WaveSpectrum spectrum = spectrum_of(sea);
        ASSERT_EQ(spectrum.kept_after_breaking(), 1);
        // From half the peak frequency up to the shortest wave that the grid resolves in all
        // directions, 26 m.
        const std::vector<int> harmonics = {5, 8, 10, 13};
        const std::vector<double> measured = measured_bands(sea, harmonics, 64);
        for (std::size_t band = 0; band + 1 < harmonics.size(); ++band) {
            const double from = wave_number(2 * pi * (harmonics[band] - 0.5) / 60, depth);
            const double to = wave_number(2 * pi * (harmonics[band + 1] - 0.5) / 60, depth);
            ASSERT_LT(to, 31 * 2 * pi / 800);
            const double expected = moment(spectrum, 0, from, to);
            // Each seed draws a variance for each wave of the grid. The sum varies like a sum of
            // exponential variates.
            double sum = 0, squares = 0;
            for (int n = -31; n <= 31; ++n)
                for (int m = -31; m <= 31; ++m) {
                    const double kx = m * 2 * pi / 800, kz = n * 2 * pi / 800, k = std::hypot(kx, kz);
                    if (k < from || k >= to) continue;
                    const double variance = 2 * spectrum.amplitude_variance(kx, kz);
                    sum += variance;
                    squares += variance * variance;
                }
            const double deviation = std::sqrt(squares / 16);
            // The bound is three deviations plus the difference between the grid's sum and the
            // integral.
            EXPECT_NEAR(measured[band], expected, 3 * deviation + std::fabs(sum - expected))
                << band << " in " << depth;
            EXPECT_NEAR(sum, expected, 0.08 * expected) << "a band is few rings of the grid wide";
            EXPECT_LT(deviation, 0.06 * expected);
        }
    }
}

const SeaState only_swell{.resolution = 64,
                              .patch_size_m = 4000,
                              .wind_speed_mps = 0.05,
                              .fetch_m = 1e3,
                              .swell_height_m = 2.5,
                              .swell_period_s = 12,
                              .swell_direction_rad = 2.3};

TEST(Swell, HasTheRequestedHeightAndPeriod) {
    for (const double depth : {4000.0, 30.0}) {
        SeaState sea = only_swell;
        sea.depth_m = depth;
        const ExpectedWaves waves = expected_waves(sea);
        // The wind sea is less than a centimetre high.
        EXPECT_NEAR(waves.model_significant_wave_height_m.value(), 2.5, 1e-4) << depth;
        EXPECT_NEAR(waves.peak_period_s, 12, 1e-3) << depth;
        EXPECT_NEAR(waves.peak_wavelength_m, 2 * pi / wave_number(2 * pi / 12, depth), 0.1) << depth;
    }
}

// Goda's peakedness is Qp = 2/m0^2 integral of f S^2 df. For this shape it is 8 Gamma(2 lambda) /
// (4^lambda Gamma(lambda)^2) = 3.75 in closed form. A jonswap sea has 3, a fully developed sea 2.
TEST(Swell, IsNarrowerThanAWindSea) {
    const auto peakedness = [](const SeaState& sea) {
        const WaveSpectrum spectrum = spectrum_of(sea);
        const double m0 = moment(spectrum, 0);
        return 2 / (m0 * m0) *
               integral(
                   [&](double log_omega) {
                       const double omega = std::exp(log_omega), k = wave_number(omega, sea.depth_m);
                       const double density = spectrum.radial_density(k) / group_velocity(k, sea.depth_m);
                       return omega * density * omega * density;
                   },
                   std::log(0.1), std::log(30.0));
    };
    EXPECT_NEAR(peakedness(only_swell), 3.75, 0.01);
    EXPECT_NEAR(peakedness({.spectrum = SpectrumModel::pierson_moskowitz}), 2, 0.01);
}

TEST(Swell, AddsItsEnergyToThatOfTheWind) {
    SeaState sea{.wind_speed_mps = 9};
    const double wind = spectrum_of(sea).variance();
    sea.swell_height_m = 2.5;
    EXPECT_NEAR(spectrum_of(sea).variance(), wind + 2.5 * 2.5 / 16, 1e-6);
    // The same for each wave, in all directions.
    sea.swell_height_m = 0;
    const WaveSpectrum without = spectrum_of(sea);
    sea.swell_height_m = 2.5;
    const WaveSpectrum with = spectrum_of(sea);
    const DirectionalLobe lobe = DirectionalLobe::cosine_2s(cosine_2s_exponent(15 * pi / 180));
    for (const double angle : {0.0, 0.2, 1.0, 3.0, 5.0}) {
        const double kx = 0.03 * std::cos(angle), kz = 0.03 * std::sin(angle);
        const double swell = with.amplitude_variance(kx, kz) - without.amplitude_variance(kx, kz);
        const double dk = 2 * pi / 250;
        EXPECT_NEAR(swell,
                    0.5 * dk * dk * (with.radial_density(0.03) - without.radial_density(0.03)) / 0.03 *
                        lobe.densities(std::cos(angle)).along,
                    1e-12)
            << angle;
    }
}

TEST(Swell, DoesNotChangeTheShortWaves) {
    SeaState sea{.wind_speed_mps = 9, .swell_height_m = 4};
    const WaveSpectrum with = spectrum_of(sea);
    sea.swell_height_m = 0;
    const WaveSpectrum without = spectrum_of(sea);
    for (const double k : {1.0, 10.0, 100.0})
        EXPECT_NEAR(with.radial_density(k) / without.radial_density(k), 1, 1e-5) << k;
}

struct Directions {
    double towards_rad, r1;
    double deviation;  ///< of r1, by the random draws
};

/// Returns the first circular moment of the waves that 16 seeds drew; with `realised` false, that of
/// the variances.
Directions directions(SeaState sea, bool realised) {
    const WaveSpectrum spectrum = spectrum_of(sea);
    std::vector<CascadeWaves> seeds;
    for (sea.seed = 1; realised && sea.seed <= 16; ++sea.seed) seeds.emplace_back(sea, cascade_of(sea));
    double x = 0, z = 0, all = 0, squares = 0;
    const int half = sea.resolution / 2;
    for (int n = -half + 1; n < half; ++n)
        for (int m = -half + 1; m < half; ++m) {
            if (m == 0 && n == 0) continue;
            double energy = 0;
            const double dk = 2 * pi / sea.patch_size_m, length = std::hypot(m, n);
            const double variance = spectrum.amplitude_variance(m * dk, n * dk);
            if (realised) {
                for (const CascadeWaves& waves : seeds) energy += std::norm(waves.amplitude(m, n)) / 16;
            } else {
                energy = variance;
            }
            x += energy * m / length;
            z += energy * n / length;
            all += energy;
            squares += variance * variance;
        }
    return {std::atan2(z, x), std::hypot(x, z) / all, std::sqrt(squares / 16) / all};
}

TEST(Swell, HasTheRequestedDirectionAndSpread) {
    for (const double degrees : {10.0, 25.0, 50.0}) {
        SeaState sea = only_swell;
        sea.swell_spread_rad = degrees * pi / 180;
        const Directions found = directions(sea, true);
        // The mean direction varies by the spread over the root of the number of waves. r1 varies
        // as its energies do.
        EXPECT_NEAR(found.towards_rad, 2.3, 4 * found.deviation * sea.swell_spread_rad + 1e-3) << degrees;
        EXPECT_NEAR(std::sqrt(2 * (1 - found.r1)), sea.swell_spread_rad, 0.05 * sea.swell_spread_rad) << degrees;
    }
}

// r1 = s/(s + 1) for each frequency, weighted with the spectrum: the closed form for cosine-2s and
// hasselmann.
TEST(Directions, OfDrawnWavesMatchTheSpreading) {
    for (const SpreadingModel model : {SpreadingModel::cosine_2s, SpreadingModel::hasselmann}) {
        SeaState sea{.spreading = model,
                     .resolution = 128,
                     .patch_size_m = 1200,
                     .wind_speed_mps = 12,
                     .wind_direction_rad = -1.1};
        const WaveSpectrum spectrum = spectrum_of(sea);
        const double peak = 22 * std::cbrt(gravity * gravity / (12 * 100e3)), age = 12 * peak / gravity;
        const auto s_at = [&](double over_peak) {
            if (model == SpreadingModel::cosine_2s)
                return 11.5 * std::pow(age, -2.5) * std::pow(over_peak, over_peak < 1 ? 5 : -2.5);
            return over_peak < 1.05 ? 6.97 * std::pow(over_peak, 4.06)
                                    : 9.77 * std::pow(over_peak, -2.33 - 1.45 * (age - 1.17));
        };
        // Waves that the grid resolves in all directions.
        const double to = 63 * 2 * pi / 1200;
        const double along = integral(
                         [&](double k) {
                             const double s = s_at(std::sqrt(gravity * k) / peak);
                             return spectrum.radial_density(k) * s / (s + 1);
                         },
                         0.005, to),
                     all = integral([&](double k) { return spectrum.radial_density(k); }, 0.005, to);
        const Directions found = directions(sea, true);
        EXPECT_NEAR(found.towards_rad, -1.1, 4 * found.deviation) << name_of(model);
        // The square's corners have waves that the disc does not: 2 % more energy, with a wider
        // spread.
        EXPECT_NEAR(found.r1, along / all, 4 * found.deviation + 0.02) << name_of(model);
        EXPECT_LT(found.deviation, 0.02);
    }
}

TEST(SmallWaves, EndBelowAQuarterOfThePeakInEveryCascade) {
    for (const SpectrumModel model : physical) {
        const SeaState all{.spectrum = model};
        SeaState few = all;
        few.short_wave_cutoff = 1;
        const double peak = 2 * pi / expected_waves(all).peak_wavelength_m;
        const auto kept = [&](double k) {
            return spectrum_of(few).radial_density(k) / spectrum_of(all).radial_density(k);
        };
        EXPECT_NEAR(kept(4 * peak), std::exp(-4), 0.02 * std::exp(-4)) << name_of(model);
        EXPECT_NEAR(kept(peak), std::exp(-0.25), 0.01) << name_of(model);
        const double height = expected_waves(few).model_significant_wave_height_m.value() /
                              expected_waves(all).model_significant_wave_height_m.value();
        EXPECT_GT(height, 0.6) << name_of(model) << ": most of the sea is still there";
        SeaState other = few;
        other.patch_size_m = 33;
        other.resolution = 16;
        EXPECT_EQ(spectrum_of(few).radial_density(1), spectrum_of(other).radial_density(1));
    }
}

// One call returns both densities, and the result does not depend on which of the two comes first.
TEST(Directions, OfOppositeWavesAreComputedTogether) {
    for (const SpreadingModel model : values_of<SpreadingModel>()) {
        const SeaState sea{
            .spreading = model, .wind_direction_rad = 0.7, .swell_height_m = 1, .swell_direction_rad = 4};
        const WaveSpectrum spectrum = spectrum_of(sea);
        for (int i = 1; i < 40; ++i) {
            const double kx = 0.03 * i, kz = 0.017 * (20 - i);
            const auto both = spectrum.amplitude_variances(spectrum.shell(std::sqrt(kx * kx + kz * kz)), kx, kz);
            EXPECT_EQ(both.along, spectrum.amplitude_variance(kx, kz)) << name_of(model);
            EXPECT_EQ(both.against, spectrum.amplitude_variance(-kx, -kz)) << name_of(model);
        }
    }
}

TEST(Swell, OfNoHeightChangesNoBit) {
    SeaState sea;
    const WaveSpectrum before = spectrum_of(sea);
    sea.swell_period_s = 20;
    sea.swell_direction_rad = 1;
    sea.swell_spread_rad = 0.1;
    const WaveSpectrum after = spectrum_of(sea);
    for (const double k : {0.03, 0.3, 3.0})
        EXPECT_EQ(before.amplitude_variance(k, k / 2), after.amplitude_variance(k, k / 2));
}

// With gamma = 1 the variance is alpha g^2 / (5 omega_p^4) in closed form. A larger gamma raises it by
// 1 / (1 - 0.287 ln(gamma)), the fit of DNV-RP-C205, section 3.5.5.5, which is within 0.3 % of the
// integral up to gamma = 5 and within 2 % at 7.
TEST(Jonswap, VarianceGrowsWithThePeakEnhancementAsPublished) {
    SeaState sea{.wind_speed_mps = 14, .fetch_m = 200e3};
    const double wind_fetch = 14 * 200e3, peak = 22 * std::cbrt(gravity * gravity / wind_fetch),
                 alpha = 0.076 * std::pow(14.0 * 14 / (200e3 * gravity), 0.22),
                 flat = alpha * gravity * gravity / (5 * std::pow(peak, 4));
    for (const auto& [gamma, bound] : {std::pair{1.0, 0.001}, {2.0, 0.004}, {3.3, 0.004}, {5.0, 0.004}, {7.0, 0.02}}) {
        sea.peak_enhancement = gamma;
        EXPECT_NEAR(spectrum_of(sea).variance() / flat * (1 - 0.287 * std::log(gamma)), 1, bound) << gamma;
        EXPECT_NEAR(report_on(sea).expected.peak_period_s, 2 * pi / peak, 0.01) << gamma;
    }
}

TEST(Phillips, PaperAllowsNeitherSwellNorMeasuredSpreading) {
    EXPECT_EQ(check({.spectrum = SpectrumModel::phillips_paper, .spreading = SpreadingModel::cosine_2s}),
              "spreading is cosine-2s, expected paper where the spectrum is phillips-paper");
    EXPECT_EQ(check({.spectrum = SpectrumModel::phillips_paper, .swell_height_m = 2}),
              "swell_height_m is 2, expected 0 where the spectrum is phillips-paper");
    EXPECT_EQ(
        check({.spectrum = SpectrumModel::phillips, .spreading = SpreadingModel::cosine_2s, .swell_height_m = 2}),
        "");
}

}  // namespace
}  // namespace pelagic
