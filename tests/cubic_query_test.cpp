// Cubic interpolation, compared with its transfer function, an oracle in double, and the statistics
// of the sea.
#include "pelagic/sim/surface_query.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

#include "pelagic/sim/buffers/fold_map.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"
#include "pelagic/sim/surface_ray.hpp"
#include "pelagic/tests/cascade_stack.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/one_cascade_frame.hpp"
#include "pelagic/tests/oracle/stack_oracle.hpp"
#include "pelagic/tests/query_points.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;

/// A cascade with a plane wave of `m` and `n` periods along its axes, without horizontal
/// displacement.
class PlaneWaveFrame {
   public:
    static constexpr int side = 32;
    static constexpr double amplitude_m = 0.5, texel_m = 2;

    PlaneWaveFrame(int m, int n) : zero_(side * side), folds_(side) {
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i)
                height_.push_back(static_cast<float>(amplitude_m * std::cos(2 * pi * (m * i + n * j) / side)));
        const auto view = [](const std::vector<float>& plane) {
            return PlaneView{plane.data(), side, side, side, 0};
        };
        water_.frame.isa = choose_isa();
        water_.cascade.grid.side_m = side * texel_m;
        water_.cascade.dx = view(zero_), water_.cascade.height = view(height_), water_.cascade.dz = view(zero_);
        water_.set_bounds({-amplitude_m, amplitude_m, 0, 0});
        folds_.update(water_.cascade, kernels_for(choose_isa()));
    }
    const Frame& frame() const { return water_.frame; }

   private:
    std::vector<float> height_, zero_;
    FoldMap folds_;
    OneCascadeFrame water_;
};

/// The fraction of the variance of a wave that interpolation along one axis preserves, for its
/// values and its slopes. `k` is in radians per texel. It is the mean over a cell of the squared
/// sum of weights times the texels' phases.
struct Kept {
    double value, slope;
};
Kept kept_by_cubic(double k) {
    Kept kept{0, 0};
    constexpr int places = 1000;
    for (int place = 0; place < places; ++place) {
        const double t = (place + 0.5) / places;
        // Keys' kernel with a = -1/2, and its derivative, at the distances of the four texels.
        const auto kernel = [](double s) {
            return s < 1 ? 1.5 * s * s * s - 2.5 * s * s + 1 : -0.5 * s * s * s + 2.5 * s * s - 4 * s + 2;
        };
        const auto derivative = [](double s) { return s < 1 ? 4.5 * s * s - 5 * s : -1.5 * s * s + 5 * s - 4; };
        std::complex<double> value = 0, slope = 0;
        for (int texel = -1; texel <= 2; ++texel) {
            const double from = t - texel;
            value += kernel(std::fabs(from)) * std::polar(1.0, k * texel);
            slope += (from < 0 ? -1 : 1) * derivative(std::fabs(from)) * std::polar(1.0, k * texel);
        }
        kept.value += std::norm(value) / places;
        kept.slope += std::norm(slope) / places / (k * k);
    }
    return kept;
}

// Linear interpolation preserves (2 + cos k) / 3 of the heights' variance along each axis,
// and (sin k / k)^2 of the slopes'. Rounding to float and the finite grid of points (27 x 27 per
// cell, all cells) add an error of 1e-3.
TEST(CubicQuery, PreservedVarianceMatchesTheTransferFunction) {
    for (const auto& [m, n] : {std::pair{1, 0}, {3, 0}, {5, 0}, {4, 3}, {8, 2}, {10, 0}, {2, 9}}) {
        const PlaneWaveFrame wave(m, n);
        Points points;
        constexpr int a_texel = 27, all = a_texel * PlaneWaveFrame::side;
        for (int j = 0; j < all; ++j)
            for (int i = 0; i < all; ++i) {
                points.x.push_back((i + 0.5) / a_texel * PlaneWaveFrame::texel_m);
                points.z.push_back((j + 0.5) / a_texel * PlaneWaveFrame::texel_m);
            }
        const double k_x = 2 * pi * m / PlaneWaveFrame::side, k_z = 2 * pi * n / PlaneWaveFrame::side;
        const double variance = PlaneWaveFrame::amplitude_m * PlaneWaveFrame::amplitude_m / 2;
        for (const Interpolation interpolation : {Interpolation::linear, Interpolation::cubic}) {
            Samples samples(points.x.size());
            SurfaceQuery(wave.frame(), {.interpolation = interpolation})
                .sample(points.view(), {.height_m = samples.height,
                                        .normal_x = samples.normal_x,
                                        .normal_y = samples.normal_y,
                                        .normal_z = samples.normal_z});
            double heights = 0, slopes = 0;
            for (std::size_t i = 0; i < points.x.size(); ++i) {
                const auto square = [](double a) { return a * a; };
                const double y = static_cast<double>(samples.normal_y[i]);
                heights += square(static_cast<double>(samples.height[i]));
                slopes += square(static_cast<double>(samples.normal_x[i]) / y) +
                          square(static_cast<double>(samples.normal_z[i]) / y);
            }
            const auto count = static_cast<double>(points.x.size());
            const auto kept_by_linear = [](double k) {
                const double value = (2 + std::cos(k)) / 3;
                return Kept{value, k == 0 ? 1 : value * std::sin(k) * std::sin(k) / (k * k)};
            };
            const bool is_cubic = interpolation == Interpolation::cubic;
            const Kept x = is_cubic && k_x > 0 ? kept_by_cubic(k_x) : kept_by_linear(k_x);
            const Kept z = is_cubic && k_z > 0 ? kept_by_cubic(k_z) : kept_by_linear(k_z);
            EXPECT_NEAR(heights / count / variance, x.value * z.value, 1e-3)
                << m << ", " << n << " cubic " << is_cubic;
            const double steepness = (k_x * k_x + k_z * k_z),
                         texels = PlaneWaveFrame::texel_m * PlaneWaveFrame::texel_m;
            EXPECT_NEAR(slopes / count * texels / (variance * steepness),
                        (k_x * k_x * x.slope * z.value + k_z * k_z * x.value * z.slope) / steepness, 1e-3)
                << m << ", " << n << " cubic " << is_cubic;
        }
    }
}

/// Hm0 and slope variance at points of the world, relative to the frame's values.
struct Ratios {
    double hm0, slopes;
};
Ratios ratios_of(const SeaState& sea, Interpolation interpolation, std::size_t count) {
    Ocean ocean(sea, {.executor = make_default_executor(), .queries = true, .slopes = true});
    const Frame& frame = ocean.frame_at(10);
    const Points points = random_points(count, 1e5, 1);
    Samples samples(count);
    SurfaceQueryJobs(make_default_executor())
        .sample(SurfaceQuery(frame, {.interpolation = interpolation}), points.view(),
                {.height_m = samples.height,
                 .normal_x = samples.normal_x,
                 .normal_y = samples.normal_y,
                 .normal_z = samples.normal_z});
    double mean = 0, squares = 0, slopes = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double height = static_cast<double>(samples.height[i]), y = static_cast<double>(samples.normal_y[i]),
                     x = static_cast<double>(samples.normal_x[i]), z = static_cast<double>(samples.normal_z[i]);
        mean += height / static_cast<double>(count);
        squares += height * height / static_cast<double>(count);
        slopes += (x * x + z * z) / (y * y) / static_cast<double>(count);
    }
    double resolved = 0;
    for (const CascadeSlopes& cascade : report_on(sea).cascades) resolved += cascade.slopes.total();
    return {4 * std::sqrt(squares - mean * mean) / measured_significant_wave_height_m(frame), slopes / resolved};
}

TEST(CubicQuery, DefaultSeaKeepsItsHeightAndSlopes) {
    const std::size_t count = is_sanitized ? 40000 : 400000;
    // Hm0 of that many random points has a standard deviation of 0.3 % or 0.1 %; the bound is two
    // to three deviations.
    const double scatter = is_sanitized ? 0.008 : 0.002;
    for (const double choppiness : {0.0, 0.8}) {
        SCOPED_TRACE(choppiness);
        const SeaState sea{.resolution = 128, .choppiness = choppiness};
        const Ratios cubic = ratios_of(sea, Interpolation::cubic, count);
        EXPECT_NEAR(cubic.hm0, 1, 0.015 + scatter);
        EXPECT_NEAR(cubic.slopes, 1, 0.05);
        // the documented loss of linear interpolation
        const Ratios linear = ratios_of(sea, Interpolation::linear, count);
        EXPECT_NEAR(linear.hm0, 0.93, 0.01);
        EXPECT_NEAR(linear.slopes, 0.67, 0.02);
    }
}

/// As in cascade_stack_query_test.cpp: heights are within the tolerance on slopes of 1 : 1, plus
/// the float rounding of several metres. The other values are compared where the surface is not
/// folded.
void expect_as_cubic_oracle(const Frame& frame, const Points& points, bool is_overturned, std::size_t& folded) {
    const oracle::Stack stack(frame, Interpolation::cubic);
    Samples samples(points.x.size());
    SurfaceQuery(frame, {.interpolation = Interpolation::cubic}).sample(points.view(), samples.view());
    const double coarsest_m =
        // a search in texels ends at 4e-6 texels
        frame.cascades.size() == 1 ? frame.cascades.front().texel_m() : 0;
    for (std::size_t i = 0; i < points.x.size(); ++i) {
        const std::vector<oracle::StackIntersection> intersections = stack.intersections_at(points.x[i], points.z[i]);
        ASSERT_FALSE(intersections.empty()) << "the oracle misses " << points.x[i] << ", " << points.z[i];
        folded += intersections.size() > 1;
        EXPECT_TRUE(samples.converged[i]) << points.x[i] << ", " << points.z[i] << ": " << samples.error[i];
        const double off = std::fabs(static_cast<double>(samples.height[i]) - intersections.front().height_m);
        EXPECT_LE(off, 2e-3) << points.x[i] << ", " << points.z[i] << " of " << intersections.size()
                             << " intersections";
        if (is_overturned) continue;
        EXPECT_LE(static_cast<double>(samples.error[i]), 2e-5 + 5e-6 * coarsest_m)
            << "a 64th of the tolerance is the aim";
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
}

TEST(CubicQuery, MatchesTheOracle) {
    std::size_t folded = 0;
    for (const std::size_t cascades : {2, 3, 4})
        for (const double choppiness : {0.0, 0.8, 1.0}) {
            SCOPED_TRACE(std::to_string(cascades) + " cascades, choppiness " + std::to_string(choppiness));
            const CascadeStack stack(CascadeStack::of_scales(cascades, 12, choppiness, 5, 64), 3.7);
            expect_as_cubic_oracle(stack.frame(), random_points(is_sanitized ? 5 : 200, 3000, 4), false, folded);
        }
    for (const Isa isa : isas_here())
        for (const int n : {16, 64}) {
            SCOPED_TRACE(std::to_string(n) + "^2 texels");
            Ocean ocean({.resolution = n, .patch_size_m = 250, .choppiness = 1},
                        {.executor = make_serial_executor(), .isa = isa, .queries = true,
                         .velocities = Velocities::drawn});
            expect_as_cubic_oracle(ocean.frame_at(3), random_points(is_sanitized ? 20 : 300, 1000, 4), false, folded);
        }
}

TEST(CubicQuery, ReturnsTheHighestOfSeveralSheets) {
    std::size_t folded = 0;
    for (const std::size_t cascades : {2, 3})
        for (const double factor : {6.0, 12.0}) {
            SCOPED_TRACE(std::to_string(cascades) + " cascades, " + std::to_string(factor) + " times as steep");
            std::vector<CascadeStack::Part> parts = CascadeStack::of_scales(cascades, 12, 1, 9, 32);
            for (CascadeStack::Part& part : parts) part.factor *= factor;
            const CascadeStack stack(parts, 2);
            expect_as_cubic_oracle(stack.frame(), random_points(is_sanitized ? 5 : 200, 300, 6), true, folded);
        }
    for (unsigned seed = 1; seed <= 2; ++seed) {
        Ocean ocean({.spectrum = SpectrumModel::phillips_paper,
                     .resolution = 128,
                     .patch_size_m = 250,
                     .wind_speed_mps = 20,
                     .choppiness = 1,
                     .seed = seed},
                    {.executor = make_serial_executor(), .queries = true, .velocities = Velocities::drawn});
        expect_as_cubic_oracle(ocean.frame_at(seed), random_points(is_sanitized ? 20 : 2000, 1000, seed), true,
                               folded);
    }
}

// Rays are intersected with the drawn surface, independently of the query's interpolation.
TEST(CubicQuery, RaysHitTheLinearSurface) {
    Ocean ocean({.resolution = 64}, {.executor = make_serial_executor(), .queries = true});
    const Frame& frame = ocean.frame_at(3);
    for (int i = 0; i < 20; ++i) {
        const SurfaceRay ray{{i * 31.0, 10, i * -17.0}, {1, -0.2, 0.3}, 500};
        const auto linear = first_hit(SurfaceQuery(frame), ray);
        const auto cubic = first_hit(SurfaceQuery(frame, {.interpolation = Interpolation::cubic}), ray);
        ASSERT_TRUE(linear && cubic);
        EXPECT_EQ(linear->position_m, cubic->position_m);
    }
}

}  // namespace
}  // namespace pelagic
