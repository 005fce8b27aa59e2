// Mean square slopes of the sea, compared with measurements.
#include "pelagic/sim/spectrum/mean_square_slope.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/slope_sum.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;

// Cox and Munk 1954 fitted the sum separately, 0.003 + 0.00512 U, so the coefficients of the
// components add up except for rounding.
TEST(MeanSquareSlope, MatchesCoxAndMunk) {
    for (const double wind : {1.0, 5.0, 10.0, 14.0}) {
        EXPECT_NEAR(measured_slopes(wind).total(), 0.003 + 0.00512 * wind, 0.041e-3 * wind) << wind;
        EXPECT_NEAR(measured_slopes(wind).upwind, 0.00316 * wind, 1e-15);
        EXPECT_NEAR(measured_slopes(wind).crosswind, 0.003 + 0.00192 * wind, 1e-15);
    }
}

// For one wave a cos(k.x) the mean square slope is (a k)^2 / 2, all of it along k.
TEST(MeanSquareSlope, OfOneWaveLiesAlongIt) {
    const double k = 0.7, mean_square = 0.08, direction = 1.1;
    SlopeMoments moments;
    moments.add_wave(mean_square, k * std::cos(direction), k * std::sin(direction));
    EXPECT_NEAR(moments.around(direction).upwind, mean_square * k * k, 1e-15);
    EXPECT_NEAR(moments.around(direction).crosswind, 0, 1e-15);
    EXPECT_NEAR(moments.around(direction + pi / 2).crosswind, mean_square * k * k, 1e-15);
    EXPECT_NEAR(moments.around(direction + pi / 4).upwind, mean_square * k * k / 2, 1e-15);
}

// The sums in the wind's axes, wave by wave.
TEST(MeanSquareSlope, OfManyWavesRotatesWithTheWind) {
    std::mt19937 random(3);
    const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    for (const double wind : {0.0, 0.4, -2.0, 6.2}) {
        SlopeMoments first, second;
        double up = 0, cross = 0;
        for (int i = 0; i < 50; ++i) {
            const double square = number() + 0.5, x = number(), z = number();
            (i < 20 ? first : second).add_wave(square, x, z);
            up += square * std::pow(x * std::cos(wind) + z * std::sin(wind), 2);
            cross += square * std::pow(z * std::cos(wind) - x * std::sin(wind), 2);
        }
        first += second;
        EXPECT_NEAR(first.around(wind).upwind, up, 1e-12);
        EXPECT_NEAR(first.around(wind).crosswind, cross, 1e-12);
    }
}

TEST(MeanSquareSlope, RemainderIsNeverNegative) {
    const SlopeVariance all = measured_slopes(10);
    EXPECT_EQ(unresolved_slopes({}, 10).total(), all.total());
    EXPECT_NEAR(unresolved_slopes({0.01, 0.02}, 10).upwind, all.upwind - 0.01, 1e-15);
    EXPECT_NEAR(unresolved_slopes({0.01, 0.02}, 10).crosswind, all.crosswind - 0.02, 1e-15);
    // An excess in one direction is subtracted from the other; a total excess leaves zero.
    EXPECT_EQ(unresolved_slopes({all.upwind + 0.002, 0.01}, 10).upwind, 0);
    EXPECT_NEAR(unresolved_slopes({all.upwind + 0.002, 0.01}, 10).crosswind, all.crosswind - 0.012, 1e-15);
    EXPECT_EQ(unresolved_slopes({0.01, 0.5}, 10).total(), 0);
}

// The same waves in the world's axes, wave by wave.
TEST(MeanSquareSlope, OfARotatedCascadeIsThatOfItsWavesInTheWorld) {
    std::mt19937 random(4);
    const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
    const CascadeGrid grid{.side_m = 1, .cosine = std::cos(0.9), .sine = std::sin(0.9)};
    SlopeMoments in_cascade, in_world;
    for (int i = 0; i < 30; ++i) {
        const double square = number() + 0.5, along = number(), across = number();
        in_cascade.add_wave(square, along, across);
        const CascadeGrid::Vector wave = grid.in_world(along, across);
        in_world.add_wave(square, wave.along, wave.across);
    }
    const SlopeMoments turned = in_cascade.in_world(grid);
    EXPECT_NEAR(turned.xx, in_world.xx, 1e-12);
    EXPECT_NEAR(turned.zz, in_world.zz, 1e-12);
    EXPECT_NEAR(turned.xz, in_world.xz, 1e-12);
}

/// Mean square slopes between neighbouring texels, upwind and crosswind, summed over the cascades
/// of a frame: waves of different cascades are independent.
SlopeVariance shown_slopes(const Frame& frame) {
    const double c = std::cos(frame.sea.wind_direction_rad), s = std::sin(frame.sea.wind_direction_rad);
    SlopeVariance all;
    for (const Cascade& cascade : frame.cascades) {
        const int n = cascade.resolution();
        double up = 0, cross = 0;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const auto h = [&](int x, int z) {
                    return static_cast<double>(cascade.height.at((x + n) % n, (z + n) % n));
                };
                const double along = (h(i + 1, j) - h(i - 1, j)) / (2 * cascade.texel_m());
                const double across = (h(i, j + 1) - h(i, j - 1)) / (2 * cascade.texel_m());
                const auto [x, z] = cascade.grid.in_world(along, across);
                up += std::pow(c * x + s * z, 2);
                cross += std::pow(c * z - s * x, 2);
            }
        all.upwind += up / n / n;
        all.crosswind += cross / n / n;
    }
    return all;
}

/// Returns the alpha^2 that the smoothness channel encodes.
double rough_slopes(const Frame& frame) {
    const double smoothness = (frame.cascades[0].gradient_level(0)[0] >> 24) / 255.0;
    return std::pow(1 - smoothness, 4);
}

// For any wind, wind direction and grid, resolved waves and encoded roughness together have the
// measured slopes.
TEST(MeanSquareSlope, OfWavesAndRoughnessIsTheSeas) {
    for (const double wind : {3.0, 5.0, 8.0, 12.0, 18.0, 25.0})
        for (const int resolution : {64, 256})
            for (const SpreadingModel spreading : {SpreadingModel::paper, SpreadingModel::donelan_banner}) {
                SlopeVariance shown;
                double rough = 0, resolved = 0;
                constexpr int seeds = 4;
                for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
                    Ocean ocean({.spreading = spreading,
                                 .resolution = resolution,
                                 // so that 64 texels resolve waves of 8 m
                                 .patch_size_m = wind < 5 ? 60.0 : 250.0,
                                 .wind_speed_mps = wind,
                                 .wind_direction_rad = 0.6,
                                 .seed = seed},
                                {.executor = make_serial_executor()});
                    const Frame& frame = ocean.frame_at(3);
                    const SlopeVariance here = shown_slopes(frame);
                    shown.upwind += here.upwind / seeds;
                    shown.crosswind += here.crosswind / seeds;
                    rough = rough_slopes(frame);
                    resolved = frame.statistics.resolved_slopes.total();
                    // A frame of 250 m at 25 m/s holds few of the relevant waves; four seeds have
                    // an accuracy of about 5 %.
                    EXPECT_NEAR(frame.statistics.unresolved_slopes.total() + frame.statistics.resolved_slopes.total(),
                                measured_slopes(wind).total(), 1e-12);
                }
                const std::string which = std::to_string(static_cast<int>(wind)) + "_" + std::to_string(resolution) +
                                          "_" + std::string(name_of(spreading));
                RecordProperty(which, std::to_string((shown.total() + rough) / measured_slopes(wind).total()));
                EXPECT_NEAR((shown.total() + rough) / (0.003 + 0.00512 * wind), 1, 0.05) << which;
                EXPECT_NEAR(shown.total() / resolved, 1, 0.08) << which;
                EXPECT_GT(resolved, 0.05 * measured_slopes(wind).total()) << which;
            }
}

/// Returns the slopes of a stack as a GPU interpolates them, bilinearly between the texels of the
/// slope maps. A square between texels is a polynomial of second degree along each axis, so Gauss's
/// two points are exact.
SlopeVariance filtered_slopes(const Frame& frame) {
    const double c = std::cos(frame.sea.wind_direction_rad), s = std::sin(frame.sea.wind_direction_rad);
    const double gauss[] = {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};
    SlopeVariance all;
    for (const Cascade& cascade : frame.cascades) {
        const int n = cascade.resolution();
        const auto slopes = cascade.level_of(cascade.slopes_rgba8, 0),
                   moments = cascade.level_of(cascade.moments_rgba8, 0);
        const auto at = [&](int i, int j) {
            const auto texel = static_cast<std::size_t>(j % n * n + i % n);
            return slopes_of_texel(slopes[texel], moments[texel], cascade.slope_ranges);
        };
        double up = 0, cross = 0;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const SurfaceSlopes corners[] = {at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)};
                for (const double u : gauss)
                    for (const double v : gauss) {
                        const double weights[] = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
                        double x = 0, z = 0;
                        for (std::size_t corner = 0; corner < 4; ++corner) {
                            x += weights[corner] * corners[corner].h_x;
                            z += weights[corner] * corners[corner].h_z;
                        }
                        up += std::pow(c * x + s * z, 2) / 4;
                        cross += std::pow(c * z - s * x, 2) / 4;
                    }
            }
        all.upwind += up / n / n;
        all.crosswind += cross / n / n;
    }
    return all;
}

TEST(MeanSquareSlope, OfAStackOfCascadesAndRoughnessIsTheSeas) {
    for (const double wind : {3.0, 5.0, 8.0, 12.0, 18.0, 25.0})
        for (const int cascades : {2, 4}) {
            Ocean ocean({.cascades = cascades, .resolution = 128, .wind_speed_mps = wind, .wind_direction_rad = 0.6},
                        {.executor = make_serial_executor()});
            const Frame& frame = ocean.frame_at(3);
            ASSERT_EQ(frame.cascades.size(), static_cast<std::size_t>(cascades));
            const SlopeVariance shown = filtered_slopes(frame);
            const double alpha = frame.statistics.roughness;
            const std::string which =
                std::to_string(static_cast<int>(wind)) + "_" + std::to_string(cascades) + "_cascades";
            RecordProperty(which, std::to_string((shown.total() + alpha * alpha) / measured_slopes(wind).total()));
            RecordProperty(which + "_resolved", std::to_string(shown.total() / measured_slopes(wind).total()));
            EXPECT_NEAR((shown.total() + alpha * alpha) / (0.003 + 0.00512 * wind), 1, 0.05) << which;
        }
}

}  // namespace
}  // namespace pelagic
