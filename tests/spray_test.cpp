// Spray: droplets fly as differential equations and measured terminal velocities require, leave
// breaking water only, and depend on the sea, the time and the centre alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/spray.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/each_executor.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/message_of.hpp"

namespace pelagic {
namespace {

SeaState preset_sea(std::string_view preset) {
    SeaState sea = sea_preset_named(preset)->sea;
    sea.resolution = 128;
    return sea;
}

/// Adds the ticks that a time needs.
void follow(Spray& spray, Ocean& ocean, double time_s, double x_m = 0, double z_m = 0) {
    while (const std::optional<double> tick_s = spray.missing_tick_s(time_s))
        spray.add_tick(ocean.frame_at(*tick_s), x_m, z_m);
}

using Droplets = std::vector<SprayDroplet>;

Droplets droplets_of(Spray& spray, Ocean& ocean, double time_s, double x_m = 0, double z_m = 0) {
    follow(spray, ocean, time_s, x_m, z_m);
    const auto droplets = spray.droplets_at(time_s);
    return {droplets.begin(), droplets.end()};
}

/// Returns whether two lists are bit-identical. A droplet has no padding.
bool same_droplets(const Droplets& a, const Droplets& b) {
    static_assert(sizeof(SprayDroplet) == 3 * sizeof(double) + 6 * sizeof(float));
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(SprayDroplet)) == 0;
}

/// One droplet that leaves the point (1, 2, 3) at time 10, in still air.
SprayDroplet single(const SprayEmitter& emitter, double age_s) {
    Spray spray;
    spray.emit({&emitter, 1});
    const auto droplets = spray.droplets_at(10 + age_s);
    return droplets.size() == 1 ? droplets.front() : SprayDroplet{.y_m = std::numeric_limits<double>::quiet_NaN()};
}

// dv/dt = -g - v / T, with T = 4.03 m/s / g for drops of 1 mm (Gunn and Kinzer 1949, table 3), by
// Runge and Kutta's method with steps of 1 ms. Its error is below 1e-9 m. Velocities are floats,
// which resolve 5e-7 m/s at 6 m/s.
TEST(Spray, FliesAsSmallStepsDo) {
    const SprayEmitter emitter{.time_s = 10, .x_m = 1, .y_m = 2, .z_m = 3, .velocity_x_mps = 5, .velocity_y_mps = 6};
    constexpr double g = 9.80665, relaxation_s = 4.03 / g;
    std::array<double, 4> state = {1, 2, 5, 6};  // x, y and their velocities
    const auto change = [&](const std::array<double, 4>& at) {
        return std::array{at[2], at[3], -at[2] / relaxation_s, -g - at[3] / relaxation_s};
    };
    const auto moved = [](std::array<double, 4> at, const std::array<double, 4>& by, double step) {
        for (std::size_t i = 0; i < 4; ++i) at[i] += step * by[i];
        return at;
    };
    constexpr double h = 1e-3;
    for (int step = 0; step <= 600; ++step) {
        if (step % 100 == 0) {
            const SprayDroplet droplet = single(emitter, step * h);
            EXPECT_NEAR(droplet.x_m, state[0], 1e-8) << step;
            EXPECT_NEAR(droplet.y_m, state[1], 1e-8) << step;
            EXPECT_EQ(droplet.z_m, 3) << step;
            EXPECT_NEAR(static_cast<double>(droplet.velocity_x_mps), state[2], 1e-6) << step;
            EXPECT_NEAR(static_cast<double>(droplet.velocity_y_mps), state[3], 1e-6) << step;
        }
        const auto a = change(state), b = change(moved(state, a, h / 2)), c = change(moved(state, b, h / 2)),
                   d = change(moved(state, c, h));
        for (std::size_t i = 0; i < 4; ++i) state[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    }
}

// Drops of 0.2 mm fall with 0.72 m/s (Gunn and Kinzer 1949). After 0.65 s, 8.85 relaxation times, a
// share of 1.4e-4 of the initial difference remains.
TEST(Spray, FallsAtTheMeasuredVelocity) {
    const SprayDroplet droplet = single({.time_s = 10, .drop_mm = 0.2}, 0.65);
    EXPECT_NEAR(static_cast<double>(droplet.velocity_y_mps), -0.72, 1.5e-4 * 0.72);
}

TEST(Spray, GrowsWiderAndThinnerUntilItEnds) {
    const SprayEmitter emitter{.time_s = 10};
    const SprayDroplet young = single(emitter, 0), old = single(emitter, 0.5);
    EXPECT_GT(old.radius_m, young.radius_m);
    EXPECT_LT(old.opacity, young.opacity);
    EXPECT_TRUE(std::isnan(single(emitter, -0.001).y_m));
    EXPECT_TRUE(std::isnan(single(emitter, Spray::max_lifetime_s).y_m));
}

TEST(Spray, IsAbsentFromACalmSeaAndDenseInAStorm) {
    const auto count = [](std::string_view preset) {
        Ocean ocean(preset_sea(preset), {.velocities = true});
        Spray spray;
        return droplets_of(spray, ocean, 20).size();
    };
    EXPECT_EQ(count("beaufort-2"), 0u);
    EXPECT_EQ(count("swell"), 0u);
    const std::size_t gale = count("beaufort-8"), storm = count("beaufort-10");
    EXPECT_GT(gale, 200u);
    EXPECT_GT(storm, gale);
    EXPECT_LE(storm, Spray::max_droplets);
}

// Droplets that left within 2 ms of a tick have moved at most 2 ms * 15 m/s = 3 cm. Where the
// surface intersects itself, a query returns the highest point, and a droplet may have left a lower
// one.
TEST(Spray, LeavesTheSurfaceWhereItBreaks) {
    Ocean ocean(preset_sea("storm"), {.queries = true, .velocities = true, .foam = true});
    Spray spray({.amount = 10});
    int all = 0, on_surface = 0, breaking = 0;
    for (int tick = 100; tick < 130; ++tick) {
        const double time_s = tick * 0.1, later_s = time_s + 0.002;
        follow(spray, ocean, later_s);
        const SurfaceQuery query(ocean.frame_at(time_s), {.tolerance_m = 1e-4});
        for (const SprayDroplet& droplet : spray.droplets_at(later_s)) {
            if (droplet.age_s > 0.002f) continue;
            float height_m = 0, foam = 0;
            query.sample({{&droplet.x_m, 1}, {&droplet.z_m, 1}}, {.height_m = {&height_m, 1}, .foam = {&foam, 1}});
            const double above_m = droplet.y_m - static_cast<double>(height_m);
            EXPECT_LT(above_m, 0.04) << "at " << droplet.x_m << ", " << droplet.z_m;
            ++all;
            on_surface += std::abs(above_m) < 0.04;
            // Foam of 1/2 or more breaks now or broke within the last 1.4 s (snapshot_foam.hpp).
            breaking += foam >= 0.5f;
        }
    }
    EXPECT_GT(all, 100);
    EXPECT_GE(on_surface, 0.9 * all);
    EXPECT_GE(breaking, 0.9 * all);
}

// In the mean over droplets, gusts across the wind cancel. Droplets that are older than most
// relaxation times move with the wind.
TEST(Spray, DriftsWithTheWind) {
    SeaState sea = preset_sea("beaufort-11");
    sea.wind_direction_rad = 2;
    Ocean ocean(sea, {.velocities = true});
    Spray spray;
    double x = 0, z = 0;
    for (const SprayDroplet& droplet : droplets_of(spray, ocean, 30)) {
        if (droplet.age_s < 0.7f) continue;
        x += static_cast<double>(droplet.velocity_x_mps);
        z += static_cast<double>(droplet.velocity_z_mps);
    }
    ASSERT_GT(x * x + z * z, 0);
    EXPECT_NEAR(std::atan2(z, x), 2, 0.1);
}

TEST(Spray, IsEqualAfterAJumpAndStepByStep) {
    Ocean ocean(preset_sea("beaufort-9"), {.velocities = true});
    Spray steps, jump;
    for (int frame = 0; frame < 60; ++frame) droplets_of(steps, ocean, frame / 24.0, 40, -7);
    const double time_s = 59 / 24.0;
    const Droplets expected = droplets_of(jump, ocean, time_s, 40, -7);
    ASSERT_GT(expected.size(), 100u);
    EXPECT_TRUE(same_droplets(droplets_of(steps, ocean, time_s, 40, -7), expected));
    droplets_of(jump, ocean, 500, 40, -7);
    EXPECT_TRUE(same_droplets(droplets_of(jump, ocean, time_s, 40, -7), expected)) << "after a jump back";
    droplets_of(steps, ocean, time_s + 0.9, 40, -7);
    droplets_of(jump, ocean, time_s + 0.31, 40, -7);
    EXPECT_TRUE(same_droplets(droplets_of(jump, ocean, time_s + 0.9, 40, -7),
                              droplets_of(steps, ocean, time_s + 0.9, 40, -7)));
}

class SprayOnEachIsa : public OnEachIsa {};

TEST_P(SprayOnEachIsa, IsBitIdentical) {
    static const Droplets expected = [] {
        Ocean ocean(preset_sea("storm"),
                    {.executor = make_serial_executor(), .isa = isas_here().front(), .velocities = true});
        Spray spray;
        return droplets_of(spray, ocean, 12.34);
    }();
    ASSERT_GT(expected.size(), 100u);
    for (const ExecutorKind& kind : executor_kinds()) {
        Ocean ocean(preset_sea("storm"),
                    {.executor = kind.make(kind.threads), .isa = GetParam(), .velocities = true});
        Spray spray;
        EXPECT_TRUE(same_droplets(droplets_of(spray, ocean, 12.34), expected)) << kind.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Isa, SprayOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

// Positions differ by rounding of times only: 2^-52 * 60 s * 30 m/s < 1e-12 m.
TEST(Spray, RepeatsWithTheLoop) {
    SeaState sea = preset_sea("storm");
    sea.loop_period_s = 30;
    Ocean ocean(sea, {.velocities = true});
    Spray spray({.loop_period_s = 30});
    const Droplets first = droplets_of(spray, ocean, 7.25), next = droplets_of(spray, ocean, 37.25);
    ASSERT_GT(first.size(), 100u);
    ASSERT_EQ(first.size(), next.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_NEAR(first[i].x_m, next[i].x_m, 1e-10);
        EXPECT_NEAR(first[i].y_m, next[i].y_m, 1e-10);
        EXPECT_NEAR(first[i].z_m, next[i].z_m, 1e-10);
    }
}

TEST(Spray, KeepsTheNewestDropletsOfEmitters) {
    Spray spray;
    const SprayEmitter old{.time_s = 1, .x_m = -1, .count = 8192}, fresh{.time_s = 1.01, .x_m = 1, .count = 100};
    spray.emit({&old, 1});
    EXPECT_EQ(spray.droplets_at(1.02).size(), 8192u);
    spray.emit({&fresh, 1});
    const auto droplets = spray.droplets_at(1.02);
    EXPECT_EQ(droplets.size(), 8192u);
    EXPECT_EQ(std::count_if(droplets.begin(), droplets.end(), [](const SprayDroplet& d) { return d.x_m > 0; }), 100);
    EXPECT_GT(droplets.front().x_m, 0);
}

TEST(Spray, OfEmittersOutlastsAJump) {
    Ocean ocean(preset_sea("storm"), {.velocities = true});
    Spray spray;
    const SprayEmitter emitter{.time_s = 50, .extent_m = 2, .spread_mps = 3, .count = 500};
    spray.emit({&emitter, 1});
    const auto of_emitter = [&] { return droplets_of(spray, ocean, 50.2).front(); };
    const SprayDroplet before = of_emitter();
    droplets_of(spray, ocean, 900);
    const SprayDroplet after = of_emitter();
    EXPECT_EQ(std::memcmp(&before, &after, sizeof before), 0);
}

TEST(Spray, RejectsBadInputInOneLine) {
    Spray spray;
    const auto emit = [&](const SprayEmitter& emitter, std::size_t copies = 1) {
        return message_of([&] { spray.emit(std::vector(copies, emitter)); });
    };
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(emit({.x_m = nan}), "x_m nan is out of range [-1e8, 1e8]");
    EXPECT_EQ(emit({.velocity_y_mps = infinity}), "velocity_y_mps inf is out of range [-100, 100]");
    EXPECT_EQ(emit({.count = 9000}), "count 9000 is out of range [0, 8192]");
    EXPECT_EQ(emit({.count = -1}), "count -1 is out of range [0, 8192]");
    EXPECT_EQ(emit({.count = 5000}, 2), "count 10000 is out of range [0, 8192] for all emitters of a call");
    EXPECT_EQ(spray.droplets_at(0).size(), 0u) << "a rejected call changes nothing";
    EXPECT_EQ(message_of([&] { Spray({.reach_m = nan}); }), "reach_m nan is out of range [10, 200]");
    EXPECT_EQ(message_of([] { Spray({.loop_period_s = 0.5}); }),
              "loop_period_s 0.5 is out of range [1, 1e6], or 0 for no loop");
    EXPECT_EQ(message_of([&] { spray.missing_tick_s(nan); }), "time_s nan is out of range [-1e9, 1e9]");
    Ocean still(preset_sea("storm")), moving(preset_sea("storm"), {.velocities = true});
    EXPECT_EQ(message_of([&] { spray.add_tick(still.frame_at(0), 0, 0); }),
              "spray needs frames of an ocean with velocities");
    EXPECT_EQ(message_of([&] { spray.add_tick(moving.frame_at(0.05), 0, 0); }),
              "time_s is 0.05, expected a time of missing_tick_s()");
    EXPECT_EQ(message_of([&] { spray.add_tick(moving.frame_at(0.1), nan, 0); }),
              "center_x_m nan is out of range [-1e8, 1e8]");
}

// Far from the origin and late, cells and ticks still have integers of their own.
TEST(Spray, WorksFarAwayAndLate) {
    Ocean ocean(preset_sea("storm"), {.velocities = true});
    Spray spray;
    for (const SprayDroplet& droplet : droplets_of(spray, ocean, 9.9e8, 9.9e7, -9.9e7)) {
        EXPECT_NEAR(droplet.x_m, 9.9e7, 120);
        EXPECT_NEAR(droplet.z_m, -9.9e7, 120);
    }
    EXPECT_FALSE(spray.missing_tick_s(9.9e8));
}

TEST(Spray, AllocatesInTheConstructorOnly) {
    static int allocations;
    allocations = 0;
    const Allocator counting{
        .allocate = [](void*, std::size_t bytes, std::size_t alignment) -> void* {
            ++allocations;
            return ::operator new (bytes, std::align_val_t{alignment});
        },
        .release = [](void*, void* memory, std::size_t,
                      std::size_t alignment) { ::operator delete (memory, std::align_val_t{alignment}); }};
    Ocean ocean(preset_sea("storm"), {.velocities = true});
    Spray spray({}, counting);
    const int before = allocations;
    EXPECT_GT(before, 0);
    droplets_of(spray, ocean, 5);
    EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace pelagic
