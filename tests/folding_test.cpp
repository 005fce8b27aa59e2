// The distribution of a surface's Jacobians, and their rate of change.
#include "pelagic/sim/spectrum/folding.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/spectrum/wind_drift.hpp"

namespace pelagic {
namespace {

/// Many waves in six directions around +x, each direction with the given mean square slope.
FoldMoments spread_sea(double mean_square_slope) {
    FoldMoments moments;
    for (const double direction : {-1.2, -0.5, -0.1, 0.2, 0.6, 0.9}) {
        const double x = 0.4 * std::cos(direction), z = 0.4 * std::sin(direction);
        for (int wave = 0; wave < 100; ++wave)
            moments.add_wave(mean_square_slope / 16, 4 * mean_square_slope / 16, x, z, x, z, 1);
    }
    return moments;
}

// Random triples of Gaussian u, v, w with the given moments, by a Cholesky factorisation of their
// covariances.
TEST(FoldDistribution, QuantilesMatchGaussianTriples) {
    for (const double choppiness : {0.5, 1.0}) {
        const FoldMoments m = spread_sea(0.004);
        const FoldDistribution jacobians(m, choppiness);
        const double uu = std::sqrt(m.uu), uv = m.uv / uu, uw = m.uw / uu;
        const double vv = std::sqrt(m.vv - uv * uv), vw = (m.vw - uv * uw) / vv;
        const double ww = std::sqrt(m.ww - uw * uw - vw * vw);
        std::mt19937 random(1);
        std::normal_distribution<double> normal;
        constexpr int triples = 400'000;
        int below_two = 0, below_three = 0;
        for (int i = 0; i < triples; ++i) {
            const double a = normal(random), b = normal(random), c = normal(random);
            const double u = 1 + choppiness * uu * a, v = choppiness * (uv * a + vv * b),
                         w = choppiness * (uw * a + vw * b + ww * c);
            const double jacobian = u * u - v * v - w * w;
            below_two += jacobian < jacobians.below_mean(2);
            below_three += jacobian < jacobians.below_mean(3);
        }
        // About 9100 and 540 samples: their relative errors are 1 % and 4 %.
        EXPECT_NEAR(below_two / (triples * 0.022750), 1, 0.04) << choppiness;
        EXPECT_NEAR(below_three / (triples * 0.0013499), 1, 0.15) << choppiness;
    }
}

// Cosines in one direction sum to J = 1 + 2u, and eight of them are not Gaussian.
TEST(FoldDistribution, QuantilesOfFewWavesAreSmaller) {
    constexpr int waves = 8, draws = 200'000;
    constexpr double amplitude = 0.02, wave_number = 1;
    FoldMoments m;
    for (int wave = 0; wave < waves; ++wave) m.add_wave(amplitude * amplitude / 2, 1, wave_number, 0, wave_number, 0, 1);
    const FoldDistribution jacobians(m, 1);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> phase(0, 6.283185307179586);
    int below_two = 0, below_three = 0;
    for (int i = 0; i < draws; ++i) {
        double jacobian = 1;
        for (int wave = 0; wave < waves; ++wave) jacobian += amplitude * std::cos(phase(random));
        below_two += jacobian < jacobians.below_mean(2);
        below_three += jacobian < jacobians.below_mean(3);
    }
    EXPECT_NEAR(below_two / (draws * 0.022750), 1, 0.05);
    EXPECT_NEAR(below_three / (draws * 0.0013499), 1, 0.25);
}

TEST(FoldMoments, FrequencyOfEqualWavesIsTheirFrequency) {
    EXPECT_NEAR(spread_sea(0.004).frequency_radps(), 2, 1e-12);
    EXPECT_NEAR((spread_sea(0.004) * 3).frequency_radps(), 2, 1e-12);
    EXPECT_DOUBLE_EQ((spread_sea(0.004) * 3).uu, 3 * spread_sea(0.004).uu);
}

// Whitecap thresholds are computed before the sum of the waves' own drift is available.
TEST(FoamDrift, EstimateIsWithinASixthForWindSeas) {
    for (const char* name : {"calm", "lake", "rough", "storm", "beaufort-1", "beaufort-12"}) {
        const SeaState& sea = sea_preset_named(name)->sea;
        Ocean ocean(sea, {.executor = make_serial_executor()});
        const SeaStatistics statistics = ocean.frame_at(0).statistics;
        const WindDrift estimate = usual_foam_drift(sea);
        const double speed = std::hypot(estimate.x_mps, estimate.z_mps);
        EXPECT_NEAR(statistics.foam_drift_x_mps, estimate.x_mps, speed / 6) << name;
        EXPECT_NEAR(statistics.foam_drift_z_mps, estimate.z_mps, speed / 6) << name;
    }
}

}  // namespace
}  // namespace pelagic
