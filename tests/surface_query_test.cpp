// Queries compared with closed forms and with an oracle that tests every cell in double.
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/one_cascade_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "pelagic/sim/buffers/fold_map.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/oracle/sea_oracle.hpp"
#include "pelagic/tests/oracle/surface_oracle.hpp"
#include "pelagic/tests/query_points.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

/// Returns points in the squares of the world where the surface may be folded.
Points points_where_overturned(const Frame& frame, std::size_t count, unsigned seed) {
    const std::size_t n = static_cast<std::size_t>(frame.cascades[0].resolution());
    std::vector<std::size_t> squares;
    for (std::size_t square = 0; square < n * n; ++square)
        if (frame.cascades[0].folds[square / 8] >> square % 8 & 1) squares.push_back(square);
    Points points;
    if (squares.empty()) return points;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> within(0, 1);
    const double texel_m = frame.cascades[0].texel_m();
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t square = squares[random() % squares.size()];
        points.x.push_back((static_cast<double>(square % n) + within(random)) * texel_m);
        points.z.push_back((static_cast<double>(square / n) + within(random)) * texel_m);
    }
    return points;
}

std::unique_ptr<Ocean> ocean_with_queries(const SeaState& sea, Isa isa = choose_isa()) {
    return std::make_unique<Ocean>(
        sea, OceanOptions{.executor = make_serial_executor(), .isa = isa, .queries = true,
                          .velocities = Velocities::drawn});
}

struct Worst {
    double height_m = 0, normal = 0, jacobian = 0, error_m = 0;
    std::size_t folded = 0;  ///< points under more than one intersection
};

/// Heights within 1 mm + 1e-4 Hs: the tolerance in position, on faces not steeper than 1 : 1
/// outside of folds, and the float rounding of displacements. Normals and Jacobians within 1e-3 of
/// 1: the search stops 16 micrometres away, texels are decimetres wide and slopes change by less
/// than 1 from one to the next.
void expect_as_oracle(const Frame& frame, const oracle::Surface& surface, const Points& points, Worst& worst) {
    Samples samples(points.x.size(), false);
    SurfaceQuery(frame).sample(points.view(), samples.view());
    const double bound = 1e-3 + 1e-4 * measured_significant_wave_height_m(frame);
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        const std::vector<oracle::Intersection> intersections = surface.intersections_at(points.x[i], points.z[i]);
        ASSERT_FALSE(intersections.empty()) << "the oracle misses " << points.x[i] << ", " << points.z[i];
        worst.folded += intersections.size() > 1;
        const double off = std::fabs(samples.height[i] - intersections.front().height);
        ASSERT_LE(off, bound) << points.x[i] << ", " << points.z[i] << " of " << intersections.size()
                              << " intersections";
        ASSERT_TRUE(samples.converged[i]) << points.x[i] << ", " << points.z[i];
        const oracle::SurfaceFacts facts = surface.facts_at(intersections.front().rest);
        worst.height_m = std::max(worst.height_m, off);
        worst.error_m = std::max(worst.error_m, static_cast<double>(samples.error[i]));
        worst.jacobian = std::max(worst.jacobian, std::fabs(samples.jacobian[i] - facts.jacobian));
        worst.normal = std::max({worst.normal, std::fabs(samples.normal_x[i] - facts.normal_x),
                                 std::fabs(samples.normal_y[i] - facts.normal_y),
                                 std::fabs(samples.normal_z[i] - facts.normal_z)});
    }
}

// A million points in all.
TEST(SurfaceQuery, HeightsNormalsAndJacobiansMatchTheOracleFromCalmToStorm) {
    const std::size_t points_per_sea = is_sanitized ? 1000 : 65000;
    unsigned seed = 0;
    std::size_t all = 0;
    for (const std::string name : {"calm", "moderate", "rough", "storm"}) {
        for (const double choppiness : {0.0, 0.3, 0.7, 1.0}) {
            SCOPED_TRACE(name + ", choppiness " + std::to_string(choppiness));
            SeaState sea = sea_preset_named(name)->sea;
            sea.patch_size_m = 250;
            sea.choppiness = choppiness;
            sea.wind_direction_rad = 0.35 * ++seed;
            sea.seed = seed;
            const auto ocean = ocean_with_queries(sea);
            const Frame& frame = ocean->frame_at(3.7 * seed);
            Worst worst;
            expect_as_oracle(frame, oracle::Surface(frame, sea.patch_size_m),
                             random_points(points_per_sea, 2 * sea.patch_size_m, seed), worst);
            EXPECT_LE(worst.normal, 1e-3);
            EXPECT_LE(worst.jacobian, 1e-3);
            EXPECT_LE(worst.error_m, 1e-4) << "a 64th of the tolerance is the aim";
            RecordProperty(name + std::to_string(choppiness), std::to_string(worst.height_m));
            all += points_per_sea;
        }
    }
    EXPECT_GE(all, is_sanitized ? 0u : 1'000'000u);
}

/// A frame with its horizontal displacement several times as large: folded everywhere, with many
/// intersections.
class Exaggerated {
   public:
    Exaggerated(const Frame& frame, float factor, const Kernels& kernels)
        : Exaggerated(frame, frame.cascades[0], factor, kernels) {}
    Exaggerated(const Frame& frame, const Cascade& cascade, float factor, const Kernels& kernels)
        : planes_(3 * static_cast<std::size_t>(cascade.resolution()) * cascade.resolution()),
          folds_(cascade.resolution()) {
        const int n = cascade.resolution();
        const PlaneView* const from[3] = {&cascade.dx, &cascade.height, &cascade.dz};
        PlaneView* const to[3] = {&water_.cascade.dx, &water_.cascade.height, &water_.cascade.dz};
        for (int p = 0; p < 3; ++p) {
            float* plane = planes_.data() + static_cast<std::size_t>(p) * n * n;
            for (int texel = 0; texel < n * n; ++texel)
                plane[texel] = from[p]->at(texel % n, texel / n) * (p == 1 ? 1 : factor);
            *to[p] = {plane, n, n, n, 0};
        }
        water_.frame.sea = frame.sea;
        water_.frame.isa = frame.isa;
        water_.cascade.grid = cascade.grid;
        FrameBounds bounds = cascade.bounds;
        bounds.horizontal_x_max_m *= factor;
        bounds.horizontal_z_max_m *= factor;
        water_.set_bounds(bounds);
        folds_.update(water_.cascade, kernels);
    }
    const Frame& frame() const { return water_.frame; }

   private:
    std::vector<float> planes_;
    FoldMap folds_;
    OneCascadeFrame water_;
};

// The kernel computes Jacobians only where a coarser bound does not exclude overturned cells.
TEST(FoldMap, MarksEveryOverturnedCellOnEachIsa) {
    Ocean ocean({.resolution = 64, .patch_size_m = 250, .choppiness = 1}, {.executor = make_serial_executor()});
    const Frame& frame = ocean.frame_at(3);
    for (const float factor : {1.f, 6.f, 30.f}) {
        std::vector<std::uint8_t> expected;
        std::size_t overturned = 0;
        for (const Isa isa : isas_here()) {
            const Exaggerated sea(frame, factor, kernels_for(isa));
            const Cascade& cascade = sea.frame().cascades[0];
            const int n = cascade.resolution();
            const auto place = [&](const PlaneView& plane, int i, int j) {
                return static_cast<double>(plane.at(i & (n - 1), j & (n - 1))) / cascade.texel_m();
            };
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i)
                    for (int corner = 0; corner < 4; ++corner) {
                        const int x = i + corner % 2, z = j + corner / 2;
                        const auto along_x = [&](const PlaneView& plane) {
                            return place(plane, i + 1, z) - place(plane, i, z);
                        };
                        const auto along_z = [&](const PlaneView& plane) {
                            return place(plane, x, j + 1) - place(plane, x, j);
                        };
                        const double jacobian = (1 + along_x(cascade.dx)) * (1 + along_z(cascade.dz)) -
                                                along_x(cascade.dz) * along_z(cascade.dx);
                        if (jacobian > FoldMap::max_jacobian - 1e-4) continue;
                        ++overturned;
                        const int square_x = static_cast<int>(std::floor(x + place(cascade.dx, x, z))) & (n - 1);
                        const int square_z = static_cast<int>(std::floor(z + place(cascade.dz, x, z))) & (n - 1);
                        const int square = square_z * n + square_x;
                        ASSERT_TRUE(cascade.folds[static_cast<std::size_t>(square) / 8] >> square % 8 & 1)
                            << i << ", " << j << " at " << factor;
                    }
            if (expected.empty()) expected.assign(cascade.folds.begin(), cascade.folds.end());
            EXPECT_TRUE(std::ranges::equal(expected, cascade.folds));
        }
        if (factor > 1) {
            EXPECT_GT(overturned, 0u);
        }
    }
}

// Linear seas with physical heights do not fold even at choppiness 1. Seas of the paper's scale do.
TEST(SurfaceQuery, ReturnsTheHighestOfSeveralIntersections) {
    std::size_t folded = 0;
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const SeaState sea{.spectrum = SpectrumModel::phillips_paper,
                           .resolution = seed % 2 ? 128 : 256,
                           .patch_size_m = 250,
                           .wind_speed_mps = 20,
                           .choppiness = 1,
                           .seed = seed};
        const auto ocean = ocean_with_queries(sea);
        const Frame& frame = ocean->frame_at(seed);
        const oracle::Surface surface(frame, sea.patch_size_m);
        Worst worst;
        expect_as_oracle(frame, surface, points_where_overturned(frame, is_sanitized ? 500 : 20000, seed), worst);
        expect_as_oracle(frame, surface, random_points(is_sanitized ? 500 : 20000, 1000, seed), worst);
        folded += worst.folded;
    }
    EXPECT_GE(folded, is_sanitized ? 20u : 1000u) << "the seas should fold";
}

TEST(SurfaceQuery, ReturnsTheHighestOfManyIntersections) {
    const auto ocean = ocean_with_queries({.resolution = 128, .patch_size_m = 250, .choppiness = 1});
    for (const float factor : {8.f, 12.f, 20.f}) {
        const Exaggerated sea(ocean->frame_at(factor), factor, kernels_for(ocean->isa()));
        const oracle::Surface surface(sea.frame(), sea.frame().sea.patch_size_m);
        Worst worst;
        const std::size_t count = is_sanitized ? 500 : 30000;
        expect_as_oracle(sea.frame(), surface, random_points(count, 500, 7), worst);
        EXPECT_GE(worst.folded, count / 100) << factor;
    }
}

TEST(SurfaceQuery, TheFoldMapCoversEveryPointWithSeveralIntersections) {
    const SeaState sea{.spectrum = SpectrumModel::phillips_paper,
                       .resolution = 64,
                       .patch_size_m = 250,
                       .wind_speed_mps = 20,
                       .choppiness = 1};
    const auto ocean = ocean_with_queries(sea);
    const Frame& frame = ocean->frame_at(5);
    const oracle::Surface surface(frame, sea.patch_size_m);
    const Points points = random_points(is_sanitized ? 2000 : 100000, sea.patch_size_m, 6);
    const double texel_m = sea.patch_size_m / sea.resolution;
    std::size_t folded = 0;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        if (surface.intersections_at(points.x[i], points.z[i]).size() < 2) continue;
        ++folded;
        const auto square_of = [&](double along) {
            return static_cast<std::size_t>(static_cast<int>(std::floor(along / texel_m)) & (sea.resolution - 1));
        };
        const std::size_t square = square_of(points.z[i]) * 64 + square_of(points.x[i]);
        ASSERT_TRUE(frame.cascades[0].folds[square / 8] >> square % 8 & 1) << points.x[i] << ", " << points.z[i];
    }
    EXPECT_GT(folded, 0u);
}

// x = q - a sin(k q), height A cos(k q): for a k > 1 a prolate trochoid, whose crests are loops.
class Trochoid {
   public:
    static constexpr int n = 256;
    static constexpr double patch_m = 64, a = 12, amplitude = 3;
    static constexpr double k = 2 * std::numbers::pi / patch_m;

    explicit Trochoid(const Kernels& kernels) : folds_(n) {
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                const double q = i * patch_m / n;
                dx_.push_back(static_cast<float>(-a * std::sin(k * q)));
                height_.push_back(static_cast<float>(amplitude * std::cos(k * q)));
            }
        }
        zero_.assign(dx_.size(), 0.f);
        const auto view = [](const std::vector<float>& plane) { return PlaneView{plane.data(), n, n, n, 0}; };
        water_.frame.isa = choose_isa();
        water_.cascade.grid.side_m = patch_m;
        water_.cascade.dx = view(dx_), water_.cascade.height = view(height_), water_.cascade.dz = view(zero_);
        water_.set_bounds({-amplitude, amplitude, a, 0});
        folds_.update(water_.cascade, kernels);
    }
    const Frame& frame() const { return water_.frame; }

    /// Displaced position, and the highest of the heights there, by bisection between the turning
    /// points.
    static double x_of(double q) { return q - a * std::sin(k * q); }
    static double turning_point() { return std::acos(1 / (a * k)) / k; }
    static double height_at(double x) {
        const double turn = turning_point();
        double highest = -1e300;
        for (int crest = -1; crest <= 1; ++crest) {
            const double ends[3] = {crest * patch_m - turn, crest * patch_m + turn, (crest + 1) * patch_m - turn};
            for (int piece = 0; piece < 2; ++piece) {
                double low = ends[piece], high = ends[piece + 1];
                if ((x_of(low) < x) == (x_of(high) < x)) continue;
                for (int step = 0; step < 60; ++step) {
                    const double middle = (low + high) / 2;
                    ((x_of(middle) < x) == (x_of(low) < x) ? low : high) = middle;
                }
                highest = std::max(highest, amplitude * std::cos(k * low));
            }
        }
        return highest;
    }

   private:
    std::vector<float> dx_, height_, zero_;
    FoldMap folds_;
    OneCascadeFrame water_;
};

TEST(SurfaceQuery, FindsTheTopOfALoopKnownInClosedForm) {
    ASSERT_GT(Trochoid::a * Trochoid::k, 1.1) << "it should fold";
    const Trochoid trochoid(kernels_for(choose_isa()));
    const double width = Trochoid::x_of(-Trochoid::turning_point());  // width of half a loop
    Points points = random_points(20000, 1, 3);
    for (double& x : points.x) x *= Trochoid::patch_m / 2;
    Samples samples(points.x.size(), false);
    SurfaceQuery(trochoid.frame()).sample(points.view(), samples.view());
    // Between texels the curve is linear. Its error is at most the second derivative times an
    // eighth of a texel squared: horizontally (a k^2) and vertically (A k^2). A horizontal error is
    // multiplied by the slope, which is below 10 here away from the edges.
    const double texel_m = Trochoid::patch_m / Trochoid::n;
    const double off = texel_m * texel_m / 8 * Trochoid::k * Trochoid::k;
    std::size_t inside = 0, turned = 0;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        // The edge itself has an error, too.
        if (std::fabs(std::fabs(points.x[i]) - width) < 0.05) continue;
        inside += std::fabs(points.x[i]) < width;
        turned += samples.jacobian[i] < 0;
        EXPECT_TRUE(samples.converged[i]);
        ASSERT_NEAR(samples.height[i], Trochoid::height_at(points.x[i]),
                    1e-3 + off * (Trochoid::amplitude + 10 * Trochoid::a))
            << points.x[i];
    }
    EXPECT_GT(inside, 100u);
    EXPECT_GT(turned, 100u) << "the top of a loop is a intersection that is overturned";
}

// The library's phase is a fraction of the loop in steps of 2^-32. Differences over 1 ms have an
// error of w^3 dt^2 / 6 < 1e-5 of a wave's amplitude up to w = 4 rad/s, which is the limit of this
// grid.
TEST(SurfaceQuery, VelocityMatchesTheOraclesDifferenceInTime) {
    for (const auto& [choppiness, lean] : {std::pair(0.0, 0.0), {1.0, 0.0}, {1.0, 0.6}}) {
        const SeaState sea{.resolution = 64,
                           .patch_size_m = 200,
                           .wind_speed_mps = 14,
                           .choppiness = choppiness,
                           .lean = lean,
                           .loop_period_s = 60};
        const double time_s = 11.5, dt = 1e-3;
        const auto ocean = ocean_with_queries(sea);
        const Frame& frame = ocean->frame_at(time_s);
        const oracle::Surface surface(frame, sea.patch_size_m);
        const oracle::Fields before = oracle::fields_at(sea, time_s - dt),
                             after = oracle::fields_at(sea, time_s + dt);
        const auto derivative = [&](const oracle::ComplexField oracle::Fields::*field) {
            oracle::Plane plane;
            for (std::size_t i = 0; i < (before.*field).size(); ++i)
                plane.push_back(((after.*field)[i].real() - (before.*field)[i].real()) / (2 * dt));
            return plane;
        };
        const oracle::Plane x = derivative(&oracle::Fields::dx), y = derivative(&oracle::Fields::height),
                            z = derivative(&oracle::Fields::dz);

        const Points points = random_points(3000, 300, 8);
        Samples samples(points.x.size());
        SurfaceQuery(frame).sample(points.view(), samples.view());
        for (std::size_t i = 0; i < points.x.size(); ++i) {
            const oracle::ReferencePoint rest = surface.intersections_at(points.x[i], points.z[i]).front().rest;
            // Velocities are some metres a second and change by less than 3 per second over a
            // metre.
            ASSERT_NEAR(samples.velocity_x[i], surface.value_at(x, rest), 2e-4);
            ASSERT_NEAR(samples.velocity_y[i], surface.value_at(y, rest), 2e-4);
            ASSERT_NEAR(samples.velocity_z[i], surface.value_at(z, rest), 2e-4);
        }
        EXPECT_GT(*std::max_element(samples.velocity_y.begin(), samples.velocity_y.end()), 0.5);
    }
}

class SurfaceQueryOnEachIsa : public OnEachIsa {};

TEST_P(SurfaceQueryOnEachIsa, MatchesTheOracleForEveryResolution) {
    for (const int n : {16, 32, 64, 512}) {
        const SeaState sea{.resolution = n, .patch_size_m = 100, .choppiness = 1};
        const auto ocean = ocean_with_queries(sea, GetParam());
        const Frame& frame = ocean->frame_at(1);
        const oracle::Surface surface(frame, sea.patch_size_m);
        const Points points = random_points(500, 300, 4);
        Samples samples(points.x.size(), false);
        SurfaceQuery(frame).sample(points.view(), samples.view());
        for (std::size_t i = 0; i < points.x.size(); ++i)
            ASSERT_NEAR(samples.height[i], surface.intersections_at(points.x[i], points.z[i]).front().height, 1e-3)
                << n;
    }
}

INSTANTIATE_TEST_SUITE_P(Isa, SurfaceQueryOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

TEST(SurfaceQuery, RepetitionsFarFromTheOriginAreBitIdentical) {
    const SeaState sea{.resolution = 64, .patch_size_m = 128};
    const auto ocean = ocean_with_queries(sea);
    const SurfaceQuery query(ocean->frame_at(2));
    // Sixteenths of a metre, so that moving them by whole patches is exact.
    Points near, far;
    for (int i = 0; i < 400; ++i) {
        near.x.push_back(i * 0.3125 - 40);
        near.z.push_back(i * 0.6875 - 100);
        far.x.push_back(near.x.back() + 128 * 1e9);
        far.z.push_back(near.z.back() - 128 * 3e8);
    }
    Samples here(400, false), there(400, false);
    query.sample(near.view(), here.view());
    query.sample(far.view(), there.view());
    EXPECT_EQ(here.height, there.height);
    EXPECT_EQ(here.normal_x, there.normal_x);
    EXPECT_EQ(here.error, there.error);
}

TEST(SurfaceQuery, InvalidPositionsHaveNoSample) {
    const auto ocean = ocean_with_queries({.resolution = 32, .patch_size_m = 250});
    const SurfaceQuery query(ocean->frame_at(0));
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    const Points points{{infinity, -infinity, nan, 0, 1e300, 3}, {0, 0, 0, nan, 0, 4}};
    Samples samples(6, false);
    query.sample(points.view(), samples.view());
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(samples.error[i], infinity);
        EXPECT_FALSE(samples.converged[i]);
        for (const auto* values : {&samples.height, &samples.normal_x, &samples.normal_y, &samples.normal_z})
            EXPECT_EQ(std::bit_cast<std::uint32_t>((*values)[i]), 0x7fc00000u);
    }
    EXPECT_TRUE(samples.converged[5]);
}

TEST(SurfaceQuery, ReportsTheErrorIfTheToleranceIsBelowFloatPrecision) {
    const SeaState sea{.resolution = 64, .patch_size_m = 100};
    const auto ocean = ocean_with_queries(sea);
    const SurfaceQuery query(ocean->frame_at(0), 1e-12);
    const Points points = random_points(1000, 100, 5);
    Samples samples(1000, false);
    query.sample(points.view(), samples.view());
    for (std::size_t i = 0; i < 1000; ++i) {
        EXPECT_EQ(samples.converged[i] != 0, samples.error[i] <= 1e-12f);
        EXPECT_LE(samples.error[i], 1e-5);  // about a 250000th of a texel
    }
}

TEST(SurfaceQuery, NamesTheDataThatTheFrameLacks) {
    Ocean plain({.resolution = 32, .patch_size_m = 250}, {.executor = make_serial_executor()});
    EXPECT_THROW(SurfaceQuery(plain.frame_at(0)), std::invalid_argument);

    Ocean still({.resolution = 32, .patch_size_m = 250}, {.executor = make_serial_executor(), .queries = true});
    const SurfaceQuery query(still.frame_at(0));
    const Points points{{1}, {2}};
    std::vector<float> height = {-1}, velocity(1);
    EXPECT_THROW(query.sample(points.view(), {.height_m = height, .velocity_y_mps = velocity}),
                 std::invalid_argument);
    EXPECT_EQ(height[0], -1) << "it wrote before it looked";
    query.sample(points.view(), {.height_m = height});
    EXPECT_NE(height[0], -1);
    query.sample({}, {});
}

}  // namespace
}  // namespace pelagic
