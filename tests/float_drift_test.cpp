// The drift of small floats in a wind sea, against Stokes' (1847).
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/spectrum/amplitudes.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/tests/hull_meshes.hpp"

namespace pelagic {
namespace {

/// Returns the mean of 2 omega k E e^(-2 k z) along the wind, +x, over the depths to a draught: of this seed's waves
/// on the grid, in deep water.
double stokes_mps(const SeaState& sea, double draught_m) {
    double sum_mps = 0;
    for (const CascadePlan& cascade : plan_cascades(sea)) {
        const CascadeWaves waves(sea, cascade);
        const int half = cascade.resolution / 2;
        for (int n = 0; n < half; ++n)
            for (int m = n == 0 ? 1 : 0; m < half; ++m) {
                const double k = cascade.spacing() * std::hypot(m, n);
                const double over_draught = (1 - std::exp(-2 * k * draught_m)) / (2 * k * draught_m);
                const auto add = [&](const OppositeDensities& variances, int signed_m) {
                    const double kx = cascade.grid.in_world(signed_m * cascade.spacing(), n * cascade.spacing()).along;
                    const double along = 2 * waves.realised_square(variances.along, signed_m, n),
                                 against = 2 * waves.realised_square(variances.against, -signed_m, -n);
                    sum_mps += 2 * waves.frequency(k) * kx * (along - against) * over_draught;
                };
                const CascadeWaves::MirroredVariances variances = waves.variances(m, n);
                add(variances.plus, m);
                if (m > 0 && n > 0) add(variances.minus, -m);
            }
    }
    return sum_mps;
}

class FloatDrift : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Night, FloatDrift, testing::Values(64, 128, 512));

// Water that follows velocities has Stokes' drift (water_query_test.cpp). A float drifts up to 30 % faster, and with ten
// times the drag 20 % slower; the bounds hold what is measured, and the cause is not known. The mean of ten floats over
// 40 s is known within 4 %.
TEST_P(FloatDrift, IsNearStokesAtAnyResolution) {
    SeaState sea{.wind_speed_mps = 12};
    sea.resolution = GetParam();
    constexpr double side_m = 0.2, tick_s = 1.0 / 30, warm_up_s = 10, measured_s = 40;
    constexpr int floats = 10;
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .depth = true});
    FloatingBodies bodies(make_serial_executor());
    const Hull hull(box_mesh({side_m, side_m, side_m}, 2),
                    {.mass_kg = 1025 * side_m * side_m * side_m / 2,
                     .centre_of_mass_m = glm::dvec3(0, -side_m / 4, 0)});
    std::vector<std::uint32_t> numbers;
    const Frame& first = ocean.frame_at(0);
    for (int i = 0; i < floats; ++i)
        numbers.push_back(bodies.add(hull, hull.at_rest(WaterQuery(first), i % 4 * 61.3, i / 4 * 57.7)));
    const auto sum_x = [&] {
        double sum = 0;
        for (const std::uint32_t number : numbers) sum += bodies.state(number).position_m.x;
        return sum;
    };
    double begin_m = 0;
    for (int tick = 0; tick * tick_s < warm_up_s + measured_s; ++tick) {
        if (tick == std::lround(warm_up_s / tick_s)) begin_m = sum_x();
        bodies.step(ocean.frame_at(tick * tick_s), tick_s);
    }
    const double drift_mps = (sum_x() - begin_m) / floats / measured_s, expected_mps = stokes_mps(sea, side_m / 2);
    EXPECT_GT(drift_mps / expected_mps, 0.85) << drift_mps << " " << expected_mps;
    EXPECT_LT(drift_mps / expected_mps, 1.35) << drift_mps << " " << expected_mps;
}

}  // namespace
}  // namespace pelagic
