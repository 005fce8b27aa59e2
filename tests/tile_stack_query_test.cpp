// Queries of several tiles held against an oracle that looks everywhere, in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/oracle/stack_oracle.hpp"
#include "pelagic/tests/sanitized.hpp"
#include "pelagic/tests/tile_stack.hpp"

namespace pelagic {
namespace {

struct Points {
    std::vector<double> x, z;
    SurfacePoints view() const { return {x, z}; }
};

struct Samples {
    explicit Samples(std::size_t count)
        : height(count),
          normal_x(count),
          normal_y(count),
          normal_z(count),
          jacobian(count),
          velocity_x(count),
          velocity_y(count),
          velocity_z(count),
          error(count),
          converged(count) {}
    SurfaceSamples view() {
        return {height, normal_x, normal_y, normal_z, jacobian, velocity_x, velocity_y, velocity_z, error, converged};
    }
    bool operator==(const Samples&) const = default;
    std::vector<float> height, normal_x, normal_y, normal_z, jacobian, velocity_x, velocity_y, velocity_z, error;
    std::vector<std::uint8_t> converged;
};

Points random_points(std::size_t count, double reach_m, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> anywhere(-reach_m, reach_m);
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        points.x.push_back(anywhere(random));
        points.z.push_back(anywhere(random));
    }
    return points;
}

double significant_wave_height_m(const Frame& frame) {
    double variance = 0;
    for (const Tile& tile : frame.tiles) {
        double sum = 0;
        for (int texel = 0; texel < tile.resolution() * tile.resolution(); ++texel) {
            const double height =
                static_cast<double>(tile.height.at(texel % tile.resolution(), texel / tile.resolution()));
            sum += height * height;
        }
        variance += sum / (tile.resolution() * tile.resolution());
    }
    return 4 * std::sqrt(variance);
}

/// Height within 1 mm + 1e-4 Hs; normals, Jacobians and velocities within 2e-3 where the surface isn't folded: the search
/// stops 16 micrometres away, of the finest texels' 26 mm, over which slopes change by less than 1. Near a fold's edge
/// the rest point moves much faster than what is drawn.
std::size_t expect_as_oracle(const Frame& frame, const Points& points, bool is_folded) {
    const oracle::Stack stack(frame);
    Samples samples(points.x.size());
    SurfaceQuery(frame).sample(points.view(), samples.view());
    const double bound = 1e-3 + 1e-4 * significant_wave_height_m(frame);
    std::size_t folded = 0;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        const std::vector<oracle::StackSheet> sheets = stack.sheets_at(points.x[i], points.z[i]);
        EXPECT_FALSE(sheets.empty()) << "the oracle misses " << points.x[i] << ", " << points.z[i];
        if (sheets.empty()) continue;
        folded += sheets.size() > 1;
        EXPECT_LE(std::fabs(static_cast<double>(samples.height[i]) - sheets.front().height_m), bound)
            << points.x[i] << ", " << points.z[i] << " of " << sheets.size() << " sheets";
        EXPECT_TRUE(samples.converged[i]) << points.x[i] << ", " << points.z[i] << ": " << samples.error[i];
        if (is_folded) continue;
        EXPECT_LE(samples.error[i], 2e-5f) << "a 64th of the tolerance is the aim";
        const oracle::SurfaceFacts facts = stack.facts_at(sheets.front().x_m, sheets.front().z_m);
        EXPECT_NEAR(samples.normal_x[i], facts.normal_x, 2e-3);
        EXPECT_NEAR(samples.normal_y[i], facts.normal_y, 2e-3);
        EXPECT_NEAR(samples.normal_z[i], facts.normal_z, 2e-3);
        EXPECT_NEAR(samples.jacobian[i], facts.jacobian, 2e-3);
        const oracle::Stack::Vector velocity = stack.velocity_at(sheets.front().x_m, sheets.front().z_m);
        EXPECT_NEAR(samples.velocity_x[i], velocity.x, 1e-3);
        EXPECT_NEAR(samples.velocity_y[i], velocity.y, 1e-3);
        EXPECT_NEAR(samples.velocity_z[i], velocity.z, 1e-3);
    }
    return folded;
}

TEST(TileStackQuery, AnswersAsTheOracleForTwoToFourTurnedTiles) {
    for (const std::size_t tiles : {2, 3, 4}) {
        for (const double wind_mps : {5.0, 12.0, 25.0}) {
            for (const double choppiness : {0.0, 0.8, 1.0}) {
                SCOPED_TRACE(std::to_string(tiles) + " tiles, " + std::to_string(wind_mps) + " m/s, choppiness " +
                             std::to_string(choppiness));
                const TileStack stack(TileStack::of_scales(tiles, wind_mps, choppiness, 5, 64), 3.7);
                expect_as_oracle(stack.frame(), random_points(is_sanitized ? 10 : 600, 3000, 4), false);
            }
        }
    }
}

/// The same with its displacements several times as large: it folds.
std::vector<TileStack::Part> exaggerated(std::vector<TileStack::Part> parts, double factor) {
    for (TileStack::Part& part : parts) part.factor *= factor;
    return parts;
}

TEST(TileStackQuery, OfSheetsOverOneAnotherTheHighestCounts) {
    std::size_t folded = 0;
    for (const std::size_t tiles : {2, 3, 4}) {
        for (const double factor : {6.0, 12.0, 20.0}) {
            SCOPED_TRACE(std::to_string(tiles) + " tiles, " + std::to_string(factor) + " times as steep");
            const TileStack stack(exaggerated(TileStack::of_scales(tiles, 12, 1, 9, 32), factor), 2);
            folded += expect_as_oracle(stack.frame(), random_points(is_sanitized ? 5 : 300, 300, 6), true);
        }
    }
    EXPECT_GT(folded, is_sanitized ? 0u : 60u);
}

}  // namespace
}  // namespace pelagic
