// Queries of stacks of cascades, compared with an exhaustive search in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <thread>
#include <vector>

#include "pelagic/sim/buffers/surface_texels.hpp"
#include "pelagic/sim/query/height_change.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/sim/surface_ray.hpp"
#include "pelagic/tests/cascade_stack.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/oracle/stack_oracle.hpp"
#include "pelagic/tests/query_points.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

/// Checks that heights are within 1 mm + 1e-4 Hs, and normals, Jacobians and velocities within 2e-3
/// where the surface is not folded. The search stops within 16 micrometres; the finest texels are
/// 26 mm wide, and slopes change by less than 1 over them. Near a fold's edge the reference
/// position changes much faster than the displaced position.
std::size_t expect_as_stack_oracle(const Frame& frame, const Points& points, bool is_overturned) {
    const oracle::Stack stack(frame);
    Samples samples(points.x.size());
    SurfaceQuery(frame).sample(points.view(), samples.view());
    const double bound = 1e-3 + 1e-4 * measured_significant_wave_height_m(frame);
    std::size_t folded = 0;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        const std::vector<oracle::StackIntersection> intersections = stack.intersections_at(points.x[i], points.z[i]);
        EXPECT_FALSE(intersections.empty()) << "the oracle misses " << points.x[i] << ", " << points.z[i];
        if (intersections.empty()) continue;
        folded += intersections.size() > 1;
        // Each point has an odd number of intersections: a continuous map with bounded displacement
        // has degree 1. If the number is even, the oracle's Newton iteration missed one near a
        // fold's edge. A queried height above all that it found belongs to the missed intersection,
        // whose error estimate must be within the tolerance.
        if (intersections.size() % 2 == 0 &&
            static_cast<double>(samples.height[i]) > intersections.front().height_m + bound) {
            EXPECT_LE(samples.error[i], SurfaceQuery::default_tolerance_m);
            continue;
        }
        EXPECT_LE(std::fabs(static_cast<double>(samples.height[i]) - intersections.front().height_m), bound)
            << points.x[i] << ", " << points.z[i] << " of " << intersections.size() << " intersections";
        EXPECT_TRUE(samples.converged[i]) << points.x[i] << ", " << points.z[i] << ": " << samples.error[i];
        if (is_overturned) continue;
        EXPECT_LE(samples.error[i], 2e-5f) << "a 64th of the tolerance is the aim";
        const oracle::SurfaceFacts facts = stack.facts_at(intersections.front().x_m, intersections.front().z_m);
        EXPECT_NEAR(samples.normal_x[i], facts.normal_x, 2e-3);
        EXPECT_NEAR(samples.normal_y[i], facts.normal_y, 2e-3);
        EXPECT_NEAR(samples.normal_z[i], facts.normal_z, 2e-3);
        EXPECT_NEAR(samples.jacobian[i], facts.jacobian, 2e-3);
        const oracle::Stack::Vector velocity =
            stack.velocity_at(intersections.front().x_m, intersections.front().z_m);
        EXPECT_NEAR(samples.velocity_x[i], velocity.x, 1e-3);
        EXPECT_NEAR(samples.velocity_y[i], velocity.y, 1e-3);
        EXPECT_NEAR(samples.velocity_z[i], velocity.z, 1e-3);
    }
    return folded;
}

TEST(CascadeStackQuery, MatchesTheOracleForTwoToFourRotatedCascades) {
    for (const std::size_t cascades : {2, 3, 4}) {
        for (const double wind_mps : {5.0, 12.0, 25.0}) {
            for (const double choppiness : {0.0, 0.8, 1.0}) {
                SCOPED_TRACE(std::to_string(cascades) + " cascades, " + std::to_string(wind_mps) +
                             " m/s, choppiness " + std::to_string(choppiness));
                const CascadeStack stack(CascadeStack::of_scales(cascades, wind_mps, choppiness, 5, 64), 3.7);
                expect_as_stack_oracle(stack.frame(), random_points(is_sanitized ? 10 : 600, 3000, 4), false);
            }
        }
    }
}

/// The cascades without lean and with displacements multiplied by `factor`, so that the surface folds.
std::vector<CascadeStack::Part> exaggerated(std::vector<CascadeStack::Part> parts, double factor) {
    for (CascadeStack::Part& part : parts) {
        part.sea.lean = 0;
        part.factor *= factor;
    }
    return parts;
}

TEST(CascadeStackQuery, ReturnsTheHighestOfSeveralSheets) {
    std::size_t folded = 0;
    for (const std::size_t cascades : {2, 3, 4}) {
        for (const double factor : {6.0, 12.0, 20.0}) {
            SCOPED_TRACE(std::to_string(cascades) + " cascades, " + std::to_string(factor) + " times as steep");
            const CascadeStack stack(exaggerated(CascadeStack::of_scales(cascades, 12, 1, 9, 32), factor), 2);
            folded += expect_as_stack_oracle(stack.frame(), random_points(is_sanitized ? 15 : 300, 300, 6), true);
        }
    }
    EXPECT_GT(folded, is_sanitized ? 0u : 60u);
}

/// Compares samples of a batch with those of each of its points alone, in reverse order.
void expect_bits_of_lone_points(const SurfaceQuery& query, const Points& points, const Samples& together) {
    for (std::size_t i = points.x.size(); i-- > 0;) {
        Samples one(1);
        query.sample({{&points.x[i], 1}, {&points.z[i], 1}}, one.view());
        ASSERT_EQ(one.height[0], together.height[i]);
        ASSERT_EQ(one.normal_x[0], together.normal_x[i]);
        ASSERT_EQ(one.velocity_y[0], together.velocity_y[i]);
        ASSERT_EQ(one.error[0], together.error[i]);
    }
}

/// Results are bit-identical for each batch size, order, thread and instruction set.
TEST(CascadeStackQuery, ResultsAreBitIdenticalForEachBatchThreadAndInstructionSet) {
    const std::size_t count = 1000;
    const Points points = random_points(count, 2000, 8);
    for (const double factor : {1.0, 4.0}) {
        std::vector<Samples> of_isas;
        for (const Isa isa : isas_here()) {
            const CascadeStack stack(exaggerated(CascadeStack::of_scales(4, 12, 1, 2, 32), factor), 5, isa);
            const SurfaceQuery query(stack.frame());
            Samples together(count);
            query.sample(points.view(), together.view());
            of_isas.push_back(together);

            expect_bits_of_lone_points(query, points, together);

            Samples of_threads[2] = {Samples(count), Samples(count)};
            std::thread other([&] { query.sample(points.view(), of_threads[1].view()); });
            query.sample(points.view(), of_threads[0].view());
            other.join();
            EXPECT_TRUE(of_threads[0] == together && of_threads[1] == together);
        }
        for (const Samples& samples : of_isas) EXPECT_TRUE(samples == of_isas.front());
    }
}

/// A lone point shares its registers with the origin, in another cell. Lanes of dense points are in
/// one cell of the coarse cascades, or of all.
TEST(CascadeStackQuery, DensePointsHaveTheBitsOfLonePoints) {
    constexpr std::size_t count = 128;
    for (const Isa isa : isas_here()) {
        const CascadeStack stack(CascadeStack::of_scales(4, 12, 1, 2, 32), 5, isa);
        for (const Interpolation interpolation : {Interpolation::linear, Interpolation::cubic})
            for (const double reach_m : {2.0, 0.002}) {
                const SurfaceQuery query(stack.frame(), {.interpolation = interpolation});
                Points points = random_points(count, reach_m, 9);
                for (double& x : points.x) x += 777;
                Samples together(count);
                query.sample(points.view(), together.view());
                expect_bits_of_lone_points(query, points, together);
            }
    }
}

TEST(CascadeStackQuery, InvalidPositionsHaveNoSample) {
    const CascadeStack stack(CascadeStack::of_scales(3, 12, 1, 2, 32), 5);
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    const Points points{{infinity, -infinity, nan, 0, 1e300, 3, 1e9}, {0, 0, 0, nan, 0, 4, -1e9}};
    Samples samples(7);
    SurfaceQuery(stack.frame()).sample(points.view(), samples.view());
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(samples.error[i], infinity);
        EXPECT_FALSE(samples.converged[i]);
        for (const auto* values : {&samples.height, &samples.normal_x, &samples.normal_y, &samples.normal_z})
            EXPECT_EQ(std::bit_cast<std::uint32_t>((*values)[i]), 0x7fc00000u);
    }
    EXPECT_TRUE(samples.converged[5]);
    EXPECT_TRUE(samples.converged[6]) << "a million kilometres away";
}

TEST(CascadeStackQuery, ErrorIsReportedIfTheToleranceIsBelowFloatPrecision) {
    const CascadeStack stack(CascadeStack::of_scales(3, 12, 1, 2, 32), 5);
    const Points points = random_points(500, 1000, 5);
    Samples samples(500);
    SurfaceQuery(stack.frame(), 1e-12).sample(points.view(), samples.view());
    for (std::size_t i = 0; i < 500; ++i) {
        EXPECT_EQ(samples.converged[i] != 0, samples.error[i] <= 1e-12f);
        EXPECT_LE(samples.error[i], 2e-5);
    }
}

TEST(CascadeStackQuery, RejectsFramesWithoutQueryData) {
    Ocean plain({.cascades = 3, .resolution = 32}, {.executor = make_serial_executor()});
    EXPECT_THROW(SurfaceQuery(plain.frame_at(0)), std::invalid_argument);
    Ocean asked({.cascades = 3, .resolution = 32}, {.executor = make_serial_executor(), .queries = true});
    const SurfaceQuery query(asked.frame_at(0));
    EXPECT_EQ(query.texel_m(), asked.frame_at(0).cascades[2].texel_m());
}

/// Queries of the default cascades, for every preset, from calm to storm.
TEST(CascadeStackQuery, MatchesTheOracleOnEveryPreset) {
    unsigned seed = 0;
    for (const SeaPreset& preset : sea_presets()) {
        SCOPED_TRACE(preset.name);
        SeaState sea = preset.sea;
        sea.choppiness = 1;
        sea.seed = ++seed;
        if (cascades_of(sea) == 1) continue;
        Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .velocities = Velocities::drawn});
        expect_as_stack_oracle(ocean.frame_at(3.7 * seed), random_points(is_sanitized ? 3 : 100, 2e4, seed), false);
    }
    EXPECT_GT(seed, 5u);
}

/// Slopes of a cascade at one corner of a cell, along the cascade's axes, in double.
struct CornerSlopes {
    double xx, xz, zx, zz;  ///< the change of the displacement's first axis along the second
    double steepness;       ///< of the heights

    CornerSlopes(const Cascade& cascade, int i, int j, int right, int below) {
        const auto change = [&](const PlaneView& plane, int from_i, int from_j, int to_i, int to_j) {
            const int n = cascade.resolution();
            const auto at = [&](int x, int z) { return static_cast<double>(plane.at(x & (n - 1), z & (n - 1))); };
            return (at(to_i, to_j) - at(from_i, from_j)) / cascade.texel_m();
        };
        const auto along_x = [&](const PlaneView& plane) { return change(plane, i, j + below, i + 1, j + below); };
        const auto along_z = [&](const PlaneView& plane) { return change(plane, i + right, j, i + right, j + 1); };
        const auto x = cascade.grid.in_cascade(along_x(cascade.dx), along_x(cascade.dz));
        const auto z = cascade.grid.in_cascade(along_z(cascade.dx), along_z(cascade.dz));
        xx = x.along, zx = x.across, xz = z.along, zz = z.across;
        steepness = std::hypot(along_x(cascade.height), along_z(cascade.height));
    }
    /// Minus the smallest eigenvalue of the symmetric part.
    double contraction() const { return (std::hypot(xx - zz, xz + zx) - (xx + zz)) / 2; }
    double norm() const { return (std::hypot(xx + zz, zx - xz) + std::hypot(xx - zz, xz + zx)) / 2; }
};

TEST(CascadeStackQuery, TheContractionMapBoundsTheSlopesOfEveryCell) {
    for (const Isa isa : isas_here()) {
        for (const double factor : {1.0, 3.0, 20.0}) {
            std::vector<CascadeStack::Part> parts = CascadeStack::of_scales(3, 12, 1, 4, is_sanitized ? 16 : 64);
            for (CascadeStack::Part& part : parts) part.factor *= factor;
            const CascadeStack stack(parts, 5, isa);
            for (const Cascade& cascade : stack.frame().cascades) {
                const int n = cascade.resolution();
                const ContractionBound& bound = cascade.contraction;
                const float steepness = kernels_for(isa).steepness(
                    {.surface = texels_of(cascade), .texels_per_m = static_cast<float>(1 / cascade.texel_m())});
                double excess = 0;
                for (int cell = 0; cell < n * n; ++cell) {
                    const int i = cell % n, j = cell / n;
                    const std::uint8_t byte = bound.blocks[static_cast<std::size_t>(j / 4 * n + i)];
                    double largest = 0;
                    for (int corner = 0; corner < 4; ++corner) {
                        const CornerSlopes slopes(cascade, i, j, corner % 2, corner / 2);
                        largest = std::max(largest, slopes.contraction());
                        ASSERT_LE(slopes.norm(), static_cast<double>(bound.stretch)) << i << ", " << j;
                        ASSERT_LE(slopes.steepness, static_cast<double>(steepness) * (1 + 1e-6));
                    }
                    ASSERT_TRUE(byte == 255 || largest * ContractionBound::one <= byte) << i << ", " << j;
                    ASSERT_GE(bound.around[static_cast<std::size_t>(j / 4 * n + i)], byte);
                    ASSERT_LE(std::hypot(cascade.dx.at(i, j), cascade.dz.at(i, j)), bound.largest_m);
                    // Each level bounds the cells of its blocks.
                    std::size_t first = 0;
                    for (int shift_x = 0, shift_z = 2; n >> shift_x > 0;) {
                        const int columns = n >> shift_x, rows = n >> shift_z;
                        ASSERT_GE(bound.blocks[first + static_cast<std::size_t>((j >> shift_z) * columns +
                                                                                (i >> shift_x))],
                                  byte);
                        first += static_cast<std::size_t>(columns * rows);
                        if (++shift_x > shift_z) ++shift_z;
                    }
                    ASSERT_EQ(first, bound.blocks.size());
                    excess += byte - largest * ContractionBound::one;
                }
                // The map would be useless if it were far above the slopes.
                if (factor == 1) {
                    EXPECT_LT(excess / (n * n), 0.1 * ContractionBound::one);
                }
            }
        }
    }
}

TEST(CascadeStackQuery, MapsAreTheSameOnEachIsa) {
    for (const double factor : {1.0, 20.0}) {
        std::vector<CascadeStack::Part> parts = CascadeStack::of_scales(3, 12, 1, 4, 32);
        for (CascadeStack::Part& part : parts) part.factor *= factor;
        const CascadeStack expected(parts, 5, Isa(isas_here().front()));
        for (const Isa isa : isas_here()) {
            const CascadeStack stack(parts, 5, isa);
            for (std::size_t i = 0; i < parts.size(); ++i) {
                const ContractionBound &a = expected.frame().cascades[i].contraction,
                                       &b = stack.frame().cascades[i].contraction;
                EXPECT_TRUE(std::ranges::equal(a.blocks, b.blocks));
                EXPECT_TRUE(std::ranges::equal(a.around, b.around));
                EXPECT_EQ(a.max_sum, b.max_sum);
                EXPECT_EQ(a.largest_m, b.largest_m);
                EXPECT_EQ(a.stretch, b.stretch);
            }
        }
    }
}

TEST(CascadeStackQuery, ThereIsOneSheetWhereTheContractionMapProvesIt) {
    std::size_t proven = 0, folded = 0;
    for (const double factor : {8.0, 24.0, 40.0}) {
        std::vector<CascadeStack::Part> parts = CascadeStack::of_scales(2, 12, 1, 4, 32);
        parts[0].factor = factor;
        const CascadeStack stack(parts, 5);
        const oracle::Stack oracle(stack.frame());
        const Points points = random_points(is_sanitized ? 200 : 1500, 1000, 2);
        for (std::size_t i = 0; i < points.x.size(); ++i) {
            const std::vector<oracle::StackIntersection> intersections =
                oracle.intersections_at(points.x[i], points.z[i]);
            folded += intersections.size() > 1;
            for (const oracle::StackIntersection& intersection : intersections) {
                int sum = 0;
                bool is_within = true;
                for (const Cascade& cascade : stack.frame().cascades) {
                    const auto [along, across] = cascade.grid.in_cascade(intersection.x_m, intersection.z_m);
                    const int n = cascade.resolution();
                    const auto cell = [&](double place_m) {
                        return static_cast<int>(std::floor(place_m / cascade.texel_m())) & (n - 1);
                    };
                    sum += cascade.contraction.around[static_cast<std::size_t>(cell(across) / 4 * n + cell(along))];
                    is_within &= sum <= cascade.contraction.max_sum;
                }
                proven += is_within;
                ASSERT_TRUE(!is_within || intersections.size() == 1) << points.x[i] << ", " << points.z[i];
            }
        }
    }
    EXPECT_GT(proven, is_sanitized ? 1u : 50u);
    EXPECT_GT(folded, is_sanitized ? 0u : 50u);
}

/// The distance at which a ray first crosses the surface, searched in steps of a tenth of the
/// finest texel. `is_certain` is true if the ray stays on the other side for six steps or more,
/// which first_hit() is specified to detect.
struct BruteForceHit {
    double distance_m;
    bool is_certain;
};

std::optional<BruteForceHit> brute_force_hit(const SurfaceQuery& query, const SurfaceRay& ray) {
    const auto& d = ray.direction;
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double step = query.texel_m() / 10;
    const auto steps = static_cast<std::size_t>(ray.reach_m / step);
    std::vector<double> x(steps), z(steps), y(steps);
    for (std::size_t i = 0; i < steps; ++i) {
        const double t = static_cast<double>(i) * step / length;
        x[i] = ray.origin_m[0] + t * d[0];
        y[i] = ray.origin_m[1] + t * d[1];
        z[i] = ray.origin_m[2] + t * d[2];
    }
    std::vector<float> height(steps);
    query.sample({x, z}, {.height_m = height});
    const auto is_below = [&](std::size_t i) { return y[i] < static_cast<double>(height[i]); };
    for (std::size_t i = 1; i < steps; ++i) {
        if (is_below(i) == is_below(0)) continue;
        std::size_t out = i;
        while (out < steps && is_below(out) != is_below(0)) ++out;
        return BruteForceHit{static_cast<double>(i - 1) * step, out - i >= 6};
    }
    return {};
}

TEST(CascadeStackRay, FirstHitMatchesASearchInSmallSteps) {
    int hits = 0, misses = 0, from_below = 0;
    for (const std::size_t cascades : {2, 3, 4}) {
        for (const double choppiness : {0.8, 1.0}) {
            const CascadeStack stack(CascadeStack::of_scales(cascades, 12, choppiness, 3, 32), 6);
            const SurfaceQuery query(stack.frame());
            const double top_m = static_cast<double>(stack.frame().bounds.height_max_m);
            std::mt19937 random(static_cast<unsigned>(cascades));
            std::uniform_real_distribution<double> horizontal(-1, 1);
            for (int i = 0; i < (is_sanitized ? 5 : 60); ++i) {
                const double angle = 3.14159 * horizontal(random), down = i % 5 == 0 ? 0 : 0.2 * horizontal(random);
                const SurfaceRay ray{
                    {500 * horizontal(random), 1.2 * top_m * horizontal(random), 500 * horizontal(random)},
                    {2 * std::cos(angle), 2 * down, 2 * std::sin(angle)},
                    300};
                const std::optional<BruteForceHit> expected = brute_force_hit(query, ray);
                const std::optional<SurfaceHit> hit = first_hit(query, ray);
                if (expected && !expected->is_certain) continue;
                ASSERT_EQ(hit.has_value(), expected.has_value()) << i;
                hits += hit.has_value();
                misses += !hit;
                if (!hit) continue;
                from_below += hit->from_below;
                EXPECT_GE(hit->distance_m, expected->distance_m - 2e-3) << i;
                EXPECT_LE(hit->distance_m, expected->distance_m + query.texel_m() / 10 + 2e-3) << i;
            }
        }
    }
    EXPECT_GT(hits, is_sanitized ? 5 : 100);
    EXPECT_GT(misses, is_sanitized ? 0 : 20);
    EXPECT_GT(from_below, is_sanitized ? 0 : 30);
}

// Rays skip distances by this bound on height differences. The test also checks that the bound is
// not much too large.
TEST(CascadeStackRay, HeightDifferencesAreWithinTheBound) {
    for (const double factor : {1.0, 6.0}) {
        const CascadeStack stack(exaggerated(CascadeStack::of_scales(3, 12, 1, 3, 32), factor), 6);
        const SurfaceQuery query(stack.frame());
        const HeightChange change(stack.frame().cascades, kernels_for(stack.frame().isa));
        std::mt19937 random(5);
        std::uniform_real_distribution<double> horizontal(-1, 1);
        double closest = 0;
        for (int i = 0; i < (is_sanitized ? 500 : 5000); ++i) {
            const double distance_m = std::exp(-7 * std::fabs(horizontal(random))) * 50,
                         angle = 3.14159 * horizontal(random);
            const double x = 1000 * horizontal(random), z = 1000 * horizontal(random);
            const double xs[] = {x, x + distance_m * std::cos(angle)}, zs[] = {z, z + distance_m * std::sin(angle)};
            float height[2];
            query.sample({xs, zs}, {.height_m = height});
            const double differs = static_cast<double>(std::fabs(height[0] - height[1]));
            ASSERT_LE(differs, change.within(distance_m) + 1e-3) << distance_m;
            closest = std::max(closest, differs / change.within(distance_m));
        }
        EXPECT_GT(closest, factor > 1 ? 0.1 : 0.2);
    }
}

}  // namespace
}  // namespace pelagic
