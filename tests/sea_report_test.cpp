// Directions, spreads and slopes of a sea, compared with closed forms and sums over the oracle's
// waves.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/spectrum/wave_noise.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/oracle/sea_oracle.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;

/// Returns the integral of cos^p over the half circle around 0.
double cosine_integral(double p) { return std::sqrt(pi) * std::tgamma((p + 1) / 2) / std::tgamma(p / 2 + 1); }

/// Returns the distance of a and b on the circle.
double apart(double a, double b) { return std::fabs(std::remainder(a - b, 2 * pi)); }

// |cos|^s, with a weight of sigma against the wind, has the first moment (1 - sigma) / (1 + sigma)
// times that of cos^s.
TEST(SeaReport, SpreadFollowsFromTheCosinePower) {
    for (const double alignment : {0.0, 0.3, 0.5, 1.0}) {
        const double s = 1 + 5 * alignment * alignment, sigma = 0.01 + 0.49 * (1 - alignment) * (1 - alignment);
        const double first = (1 - sigma) / (1 + sigma) * cosine_integral(s + 1) / cosine_integral(s);
        // The side has sixteen peak wavelengths, so the grid's few directions at the peak average
        // out to less than a degree.
        const SeaReport report = report_on({.spreading = SpreadingModel::paper,
                                             .resolution = 128,
                                             .patch_size_m = 1000,
                                             .wind_alignment = alignment});
        EXPECT_NEAR(report.expected_directions.spread_rad, std::sqrt(2 * (1 - first)), 0.01) << alignment;
    }
}

TEST(SeaReport, MeanDirectionIsTheWindDirection) {
    for (int twelfth = -12; twelfth <= 12; ++twelfth) {
        const double wind = twelfth * pi / 6 + 0.01;
        const SeaReport report = report_on({.resolution = 64, .patch_size_m = 500, .wind_direction_rad = wind});
        EXPECT_LT(apart(report.expected_directions.mean_rad, wind), 0.01) << wind;
        EXPECT_LE(std::fabs(report.expected_directions.mean_rad), pi);
    }
}

// The same waves from the oracle, over the full plane and with libm.
TEST(SeaReport, DrawnDirectionsMatchTheDrawnWaves) {
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const SeaState sea{.resolution = 32, .patch_size_m = 250, .wind_direction_rad = 2, .seed = seed};
        double all = 0, x = 0, z = 0;
        for (int n = -15; n <= 15; ++n) {
            for (int m = -15; m <= 15; ++m) {
                if (m == 0 && n == 0) continue;
                const double energy = std::norm(oracle::initial_amplitude(sea, m, n));
                all += energy;
                x += energy * m / std::hypot(m, n);
                z += energy * n / std::hypot(m, n);
            }
        }
        const WaveDirections realised = report_on(sea).realised_directions;
        EXPECT_LT(apart(realised.mean_rad, std::atan2(z, x)), 1e-9) << seed;
        EXPECT_NEAR(realised.spread_rad, std::sqrt(2 * (1 - std::hypot(x, z) / all)), 1e-9) << seed;
    }
}

TEST(SeaReport, SlopesAreTheSumOverTheWaves) {
    const SeaState sea{.resolution = 64, .patch_size_m = 120, .wind_speed_mps = 7, .wind_direction_rad = 0.8};
    const double spacing = 2 * pi / sea.patch_size_m;
    double along = 0, across = 0;
    for (int n = -31; n <= 31; ++n) {
        for (int m = -31; m <= 31; ++m) {
            if (m == 0 && n == 0) continue;
            const double kx = m * spacing, kz = n * spacing;
            const double energy = oracle::cell_density(sea, m, n) * spacing * spacing;
            along += energy * std::pow(kx * std::cos(0.8) + kz * std::sin(0.8), 2);
            across += energy * std::pow(kz * std::cos(0.8) - kx * std::sin(0.8), 2);
        }
    }
    const SeaReport report = report_on(sea);
    ASSERT_EQ(report.cascades.size(), 1u);
    EXPECT_EQ(report.cascades[0].side_m, 120);
    EXPECT_EQ(report.cascades[0].resolution, 64);
    EXPECT_NEAR(report.cascades[0].slopes.upwind / along, 1, 1e-6);
    EXPECT_NEAR(report.cascades[0].slopes.crosswind / across, 1, 1e-6);
}

// Cox and Munk's example of a clean sea: 10 m/s gives 0.003 + 0.0512.
TEST(SeaReport, SlopesOfCoxAndMunkAreThePublishedValues) {
    EXPECT_NEAR(measured_slopes(10).total(), 0.003 + 5.12e-3 * 10, 2e-4 * 10) << "their sum is rounded by itself";
    EXPECT_NEAR(measured_slopes(10).upwind, 0.0316, 1e-12);
    EXPECT_NEAR(measured_slopes(10).crosswind, 0.0222, 1e-12);
}

// The report of one pass equals the results of the single functions.
TEST(SeaReport, AgreesWithTheSingleStatistics) {
    const SeaState sea{.resolution = 64, .patch_size_m = 250, .loop_period_s = 12.8, .seed = 5};
    const SeaReport report = report_on(sea);
    EXPECT_EQ(report.expected.significant_wave_height_m, expected_waves(sea).significant_wave_height_m);
    EXPECT_EQ(report.realised_peak_period_s, measured_peak_period_s(sea));
    EXPECT_EQ(report.loop_frequencies.for_90_percent, loop_frequencies(sea).for_90_percent);
    EXPECT_EQ(report.warnings, warnings_about(sea));
    EXPECT_FALSE(report.warnings.empty());
}

TEST(SeaReport, OfExpectedWavesHasTheExpectedStatisticsAndWarnings) {
    for (const SeaState& sea : {SeaState{.resolution = 64}, SeaState{.resolution = 64, .swell_height_m = 2},
                                SeaState{.resolution = 64, .wind_speed_mps = 20, .loop_period_s = 20},
                                SeaState{.waves = WaveModel::analytic}, SeaState{.waves = WaveModel::pond},
                                SeaState{.waves = WaveModel::regular}}) {
        const SeaReport all = report_on(sea), expected = expected_report_on(sea);
        EXPECT_EQ(expected.expected.significant_wave_height_m, all.expected.significant_wave_height_m);
        EXPECT_EQ(expected.expected_periods.tm02_s, all.expected_periods.tm02_s);
        EXPECT_EQ(expected.expected_directions.spread_rad, all.expected_directions.spread_rad);
        EXPECT_EQ(expected.expected_convergence_variance, all.expected_convergence_variance);
        EXPECT_EQ(expected.warnings, all.warnings);
        ASSERT_EQ(expected.cascades.size(), all.cascades.size());
        EXPECT_EQ(expected.cascades.back().slopes.total(), all.cascades.back().slopes.total());
        ASSERT_EQ(expected.swell.has_value(), sea.swell_height_m > 0);
        if (!expected.swell) continue;
        EXPECT_EQ(expected.swell->significant_wave_height_m, all.swell->significant_wave_height_m);
        EXPECT_EQ(expected.wind_sea->significant_wave_height_m, all.wind_sea->significant_wave_height_m);
    }
}

TEST(SeaReport, OfASeaWithoutWavesIsCalm) {
    const SeaReport report = report_on({.resolution = 16, .patch_size_m = 250, .wind_speed_mps = 1e-3});
    EXPECT_EQ(report.expected_directions.spread_rad, 0);
    EXPECT_EQ(report.realised_directions.mean_rad, 0);
    EXPECT_EQ(report.loop_frequencies.for_90_percent, 0);
}

/// Returns the correlation of a sea's heights with those `lag_m` further along x, over 64 x 64
/// points of the coarsest cascade.
double correlation_of_heights(const SeaState& sea, double lag_m) {
    Ocean ocean(sea, {.queries = true});
    const SurfaceQuery water(ocean.frame_at(0));
    constexpr int side = 64;
    const double step_m = repeat_length_m(sea) / side;
    std::vector<double> x, further, z;
    for (int i = 0; i < side * side; ++i) {
        x.push_back(i % side * step_m);
        further.push_back(x.back() + lag_m);
        z.push_back(i / side * step_m);
    }
    std::vector<float> here(x.size()), there(x.size());
    water.sample({.x = x, .z = z}, {.height_m = here});
    water.sample({.x = further, .z = z}, {.height_m = there});
    double both = 0, squares = 0, other_squares = 0;
    for (std::size_t i = 0; i < here.size(); ++i) {
        both += here[i] * there[i];
        squares += here[i] * here[i];
        other_squares += there[i] * there[i];
    }
    return both / std::sqrt(squares * other_squares);
}

TEST(SeaReport, RepeatLengthIsTheCoarsestCascadesSide) {
    EXPECT_EQ(repeat_length_m({.patch_size_m = 321}), 321);
    EXPECT_EQ(repeat_length_m({.spectrum = SpectrumModel::phillips_paper}), 250);
    SeaState calm = sea_preset_named("calm")->sea;
    EXPECT_EQ(repeat_length_m(calm), 140)
        << "16 waves of the peak, 2 pi 3.2^2 / (0.8556^2 g) = 8.96 m, to two digits";

    calm.choppiness = 0;  // so that heights are at fixed points
    const double length_m = repeat_length_m(calm);
    EXPECT_GT(correlation_of_heights(calm, length_m), 0.8) << "the coarsest cascade's part of the variance";
    EXPECT_LT(std::fabs(correlation_of_heights(calm, 0.4 * length_m)), 0.5);

    SeaState one = calm;
    one.patch_size_m = 150;
    EXPECT_GT(correlation_of_heights(one, repeat_length_m(one)), 1 - 1e-6);
}

// Closed form for any depth: Ochi and Hubble's swell, S = 4 m0 u^3 e^-u / (2 omega), u = 13/4
// (omega_p / omega)^4, has the moments of omega^n m0 (13/4)^(n/4) Gamma(3 - n/4) / Gamma(3)
// omega_p^n.
TEST(SeaReport, MeanPeriodsOfASwellMatchTheClosedForm) {
    const SeaState sea{.resolution = 256,
                       .patch_size_m = 3000,
                       .wind_speed_mps = 0.1,
                       .swell_height_m = 2,
                       .swell_period_s = 11,
                       .loop_period_s = 2000};
    const auto moment = [](double n) {  // over m0 omega_p^n
        return std::pow(3.25, n / 4) * std::tgamma(3 - n / 4) / std::tgamma(3);
    };
    const SeaReport report = report_on(sea);
    // The grid's shortest wave, 23 m, omits 0.2 % of m2.
    EXPECT_NEAR(report.expected_periods.tm01_s, 11 / moment(1), 0.005 * 11);
    EXPECT_NEAR(report.expected_periods.tm02_s, 11 / std::sqrt(moment(2)), 0.005 * 11);
    EXPECT_NEAR(report.realised_periods.tm01_s / report.expected_periods.tm01_s, 1, 0.02);
    EXPECT_NEAR(report.realised_periods.tm02_s / report.expected_periods.tm02_s, 1, 0.02);
}

// Integrates the moments of JONSWAP's frequency spectrum up to the shortest wave of the cascades by
// Simpson's rule.
TEST(SeaReport, MeanPeriodsOfJonswapMatchItsIntegrals) {
    const SeaState sea{.wind_speed_mps = 10, .loop_period_s = 2000};
    const double last = std::sqrt(oracle::gravity * plan_cascades(sea).back().max_k), first = last / 100;
    double m0 = 0, m1 = 0, m2 = 0;
    constexpr int steps = 20000;
    for (int i = 0; i <= steps; ++i) {
        const double omega = first * std::pow(last / first, static_cast<double>(i) / steps);
        // d log omega
        const double weight = (i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2) * omega;
        const double density = weight * oracle::frequency_density(sea, omega);
        m0 += density, m1 += density * omega, m2 += density * omega * omega;
    }
    const SeaReport report = report_on(sea);
    EXPECT_NEAR(report.expected_periods.tm01_s / (2 * pi * m0 / m1), 1,
                0.005);  // The grid's cells are wide at the peak.
    EXPECT_NEAR(report.expected_periods.tm02_s / (2 * pi * std::sqrt(m0 / m2)), 1,
                0.01);  // Capillary waves are faster as well.
}

// The sea of issue 29: the old peak of 9.56 s was between the two, at no peak of the spectrum.
TEST(SeaReport, PeaksOfWindSeaAndSwellAreSeparate) {
    const SeaState sea{.spreading = SpreadingModel::hasselmann,
                       .wind_speed_mps = 14,
                       .wind_direction_rad = -130 * pi / 180,
                       .swell_height_m = 2,
                       .swell_period_s = 14,
                       .swell_direction_rad = -60 * pi / 180,
                       .seed = 62};
    const SeaReport report = report_on(sea);
    ASSERT_TRUE(report.wind_sea && report.swell);
    EXPECT_EQ(report.swell->peak_period_s, 14);
    SeaState wind = sea;
    wind.swell_height_m = 0;
    const SeaReport of_wind = report_on(wind);
    EXPECT_EQ(report.wind_sea->peak_period_s, of_wind.expected.peak_period_s);
    // Few waves of the grid form the swell's peak. So one seed's peak is within an eighth of the
    // model's, and the mean of eight seeds is closer.
    double swell_s = 0, wind_s = 0;
    for (std::uint32_t seed = 60; seed < 68; ++seed) {
        SeaState seeded = sea;
        seeded.seed = seed;
        const SeaReport one = report_on(seeded);
        const double of_swell_s = one.swell->realised_peak_period_s.value();
        const double of_wind_s = one.wind_sea->realised_peak_period_s.value();
        EXPECT_NEAR(of_swell_s, 14, 14.0 / 8) << seed;
        EXPECT_NEAR(of_wind_s, one.wind_sea->peak_period_s, one.wind_sea->peak_period_s / 8);
        swell_s += of_swell_s / 8;
        wind_s += of_wind_s / 8;
    }
    EXPECT_NEAR(swell_s, 14, 0.06 * 14);
    EXPECT_NEAR(wind_s, of_wind.expected.peak_period_s, 0.06 * of_wind.expected.peak_period_s);
    EXPECT_NEAR(report.swell->significant_wave_height_m, 2, 0.02);
    EXPECT_NEAR(report.wind_sea->significant_wave_height_m, of_wind.expected.significant_wave_height_m, 0.02);
    EXPECT_NEAR(std::hypot(report.swell->realised_significant_wave_height_m,
                           report.wind_sea->realised_significant_wave_height_m),
                report.realised_significant_wave_height_m, 1e-9);
    const double peak_s = report.realised_peak_period_s;
    EXPECT_TRUE(peak_s == report.swell->realised_peak_period_s || peak_s == report.wind_sea->realised_peak_period_s);
    EXPECT_FALSE(of_wind.wind_sea || of_wind.swell) << "one part alone is the sea";
}

TEST(SeaReport, EffectiveFetchEndsAtAFullyDevelopedSea) {
    EXPECT_EQ(report_on({.resolution = 16, .patch_size_m = 250}).effective_fetch_m, 100e3);
    EXPECT_NEAR(report_on({.resolution = 16, .patch_size_m = 250, .wind_speed_mps = 3}).effective_fetch_m.value(),
                17000 * 9 / oracle::gravity, 1e-6);
    EXPECT_FALSE(
        report_on({.spectrum = SpectrumModel::phillips, .resolution = 16, .patch_size_m = 250}).effective_fetch_m);
}

// The function that returns only the square agrees with the square of the full draw.
TEST(WaveNoise, SquareMatchesTheFullDraw) {
    for (int m = -20; m < 20; ++m) {
        const GaussianPair draw = gaussian_pair(7, 2, m, 3 - m);
        const double square = draw.re * draw.re + draw.im * draw.im;
        // rounding of sine and cosine
        EXPECT_NEAR(gaussian_pair_square(7, 2, m, 3 - m) / square, 1, 1e-14);
    }
}

}  // namespace
}  // namespace pelagic
