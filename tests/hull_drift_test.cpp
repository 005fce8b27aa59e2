// Hulls with wakes in flat water for ten minutes, at several rates of ticks.
#include "pelagic/tests/hull_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

namespace pelagic {
namespace {

using HullAtRate = std::tuple<DriftingHull, int>;
class HullDrift : public testing::TestWithParam<HullAtRate> {};

TEST_P(HullDrift, AHullAtRestStaysWhereItIs) {
    const auto [kind, ticks_per_s] = GetParam();
    FlatWater water(kind, ticks_per_s);
    while (water.time_s() < 300) water.advance();
    const double before_mps = water.speed_mps();
    while (water.time_s() < 600) water.advance();
    EXPECT_LT(before_mps, 0.002);
    // heights are floats
    EXPECT_LT(water.speed_mps(), before_mps + 1e-4);
    EXPECT_LT(std::fabs(water.heading_degrees()), 1);
}

TEST_P(HullDrift, AWakeHoldsATowedHullBack) {
    const auto [kind, ticks_per_s] = GetParam();
    for (const double speed_mps : {0.01, 0.1, 0.2}) EXPECT_LT(towed_force_n(kind, speed_mps, ticks_per_s), 0);
}

INSTANTIATE_TEST_SUITE_P(Night, HullDrift,
                         testing::Combine(testing::Values(DriftingHull::boat, DriftingHull::spar, DriftingHull::barge),
                                          testing::Values(30, 60, 90, 144)));

}  // namespace
}  // namespace pelagic
