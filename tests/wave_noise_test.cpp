// The Gaussian draws: distribution, independence and keys.
#include "pelagic/sim/spectrum/wave_noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pelagic {
namespace {

std::vector<double> draws(std::uint32_t seed, int half_side) {
    std::vector<double> values;
    for (int n = -half_side; n < half_side; ++n) {
        for (int m = -half_side; m < half_side; ++m) {
            const GaussianPair pair = gaussian_pair(seed, 0, m, n);
            values.push_back(pair.re);
            values.push_back(pair.im);
        }
    }
    return values;
}

// 2 * 10^6 draws: the mean of a standard normal has a deviation of 7e-4, the variance of 1e-3,
// skewness of 1.7e-3 and kurtosis of 3.5e-3. The bounds are five deviations.
TEST(WaveNoise, HasTheMomentsOfAStandardNormal) {
    for (const std::uint32_t seed : {0u, 1u, 2u, 4294967295u}) {
        const std::vector<double> values = draws(seed, 512);
        double moments[5] = {};
        for (const double value : values)
            for (int power = 1; power <= 4; ++power) moments[power] += std::pow(value, power);
        for (double& moment : moments) moment /= static_cast<double>(values.size());
        EXPECT_NEAR(moments[1], 0, 3.5e-3) << seed;
        EXPECT_NEAR(moments[2], 1, 5e-3) << seed;
        EXPECT_NEAR(moments[3], 0, 1.4e-2) << seed;
        EXPECT_NEAR(moments[4], 3, 3.5e-2) << seed;
    }
}

// Kolmogorov and Smirnov: sqrt(n) D exceeds 1.95 for one of a thousand samples of a normal
// distribution.
TEST(WaveNoise, FollowsTheNormalDistribution) {
    std::vector<double> values = draws(7, 512);
    std::sort(values.begin(), values.end());
    const double count = static_cast<double>(values.size());
    double distance = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double truth = 0.5 * std::erfc(-values[i] / std::sqrt(2.0));
        distance = std::max({distance, std::fabs(truth - static_cast<double>(i) / count),
                             std::fabs(truth - static_cast<double>(i + 1) / count)});
    }
    EXPECT_LT(distance * std::sqrt(count), 1.95);
}

// A correlation of 10^6 independent pairs has a deviation of 1e-3. The bound is five deviations.
TEST(WaveNoise, NeighboursPartsAndSeedsAreIndependent) {
    constexpr int half_side = 500;
    double parts = 0, across = 0, along = 0, opposite = 0, next_seed = 0;
    for (int n = -half_side; n < half_side; ++n) {
        for (int m = -half_side; m < half_side; ++m) {
            const GaussianPair here = gaussian_pair(1, 0, m, n);
            parts += here.re * here.im;
            across += here.re * gaussian_pair(1, 0, m + 1, n).re;
            along += here.re * gaussian_pair(1, 0, m, n + 1).re;
            opposite += here.re * gaussian_pair(1, 0, -m - 1, -n).re;
            next_seed += here.re * gaussian_pair(2, 0, m, n).re;
        }
    }
    for (const double sum : {parts, across, along, opposite, next_seed})
        EXPECT_LT(std::fabs(sum) / (4.0 * half_side * half_side), 5e-3);
}

// Seeds that are shifted copies would give the same sea, displaced.
TEST(WaveNoise, SeedsAreNotShiftedCopies) {
    for (int shift = -64; shift <= 64; ++shift)
        EXPECT_NE(gaussian_pair(1, 0, 3, 4).re, gaussian_pair(2, 0, 3 + shift, 4).re);
}

// Fixed values: the sea of a seed must not change between versions.
TEST(WaveNoise, DrawsNeverChange) {
    EXPECT_EQ(gaussian_pair(1, 0, 5, -3).re, -0x1.2aeec46e615d6p-6);
    EXPECT_EQ(gaussian_pair(1, 0, 5, -3).im, 0x1.6a678d253094cp-1);
}

}  // namespace
}  // namespace pelagic
