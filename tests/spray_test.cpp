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

#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/spray/droplets.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

SeaState preset_sea(std::string_view preset) {
    SeaState sea = sea_preset_named(preset)->sea;
    sea.resolution = 128;
    return sea;
}

OceanOptions with_spray(const SprayOptions& options = {}) {
    return {.executor = make_serial_executor(), .spray = options};
}

using Droplets = std::vector<SprayDroplet>;

Droplets copied(const Frame& frame) { return {frame.droplets.begin(), frame.droplets.end()}; }

/// One droplet that leaves the point (1, 2, 3) at time 10, in still air.
SprayDroplet single(const SprayEmitter& emitter, double age_s) {
    DropletRing emitted(Allocator{}), none(Allocator{});
    leave_emitter(emitter, 0, 1, {}, {}, emitted);
    SprayDroplet droplet;
    const std::size_t count = write_droplets(emitted, none, {.time_s = 10 + age_s}, {}, {&droplet, 1});
    return count == 1 ? droplet : SprayDroplet{.y_m = std::numeric_limits<double>::quiet_NaN()};
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
    EXPECT_TRUE(std::isnan(single(emitter, max_spray_lifetime_s).y_m));
}

TEST(Spray, IsAbsentFromACalmSeaAndDenseInAStorm) {
    const auto count = [](std::string_view preset) {
        return Ocean(preset_sea(preset), with_spray()).frame_at(20).droplets.size();
    };
    EXPECT_EQ(count("beaufort-2"), 0u);
    EXPECT_EQ(count("swell"), 0u);
    const std::size_t gale = count("beaufort-8"), storm = count("beaufort-10");
    EXPECT_GT(gale, 200u);
    EXPECT_GT(storm, gale);
    EXPECT_LE(storm, max_spray_droplets);
}

// Droplets that left within 2 ms of a tick have moved at most 2 ms * 15 m/s = 3 cm. Where the
// surface intersects itself, a query returns the highest point, and a droplet may have left a lower
// one.
TEST(Spray, LeavesTheSurfaceWhereItBreaks) {
    const SeaState sea = preset_sea("storm");
    Ocean ocean(sea, {.queries = true, .foam = true, .spray = SprayOptions{.amount = 10}});
    const TickClock clock(sea.loop_period_s, 2);
    int all = 0, on_surface = 0, breaking = 0;
    for (int tick = 100; tick < 130; ++tick) {
        const Droplets droplets = copied(ocean.frame_at(clock.time_s(tick) + 0.002));
        const SurfaceQuery query(ocean.frame_at(clock.time_s(tick)), {.tolerance_m = 1e-4});
        for (const SprayDroplet& droplet : droplets) {
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
    Ocean ocean(sea, with_spray());
    double x = 0, z = 0;
    for (const SprayDroplet& droplet : ocean.frame_at(30).droplets) {
        if (droplet.age_s < 0.7f) continue;
        x += static_cast<double>(droplet.velocity_x_mps);
        z += static_cast<double>(droplet.velocity_z_mps);
    }
    ASSERT_GT(x * x + z * z, 0);
    EXPECT_NEAR(std::atan2(z, x), 2, 0.1);
}

TEST(Spray, IsEqualAfterAJumpAndStepByStep) {
    for (const bool has_foam : {false, true}) {
        OceanOptions options = with_spray();
        options.foam = has_foam;
        Ocean steps(preset_sea("beaufort-9"), options), jump(preset_sea("beaufort-9"), options);
        steps.set_spray_center(40, -7);
        jump.set_spray_center(40, -7);
        for (int frame = 0; frame < 60; ++frame) steps.frame_at(frame / 24.0);
        const double time_s = 59 / 24.0;
        const std::uint64_t expected = spray_hash_of(jump.frame_at(time_s));
        ASSERT_GT(jump.complete().droplets.size(), 100u);
        EXPECT_EQ(spray_hash_of(steps.complete()), expected);
        jump.frame_at(500);
        EXPECT_EQ(spray_hash_of(jump.frame_at(time_s)), expected) << "after a jump back";
        steps.frame_at(time_s + 0.9);
        jump.frame_at(time_s + 0.31);
        EXPECT_EQ(spray_hash_of(jump.frame_at(time_s + 0.9)), spray_hash_of(steps.complete()));
        if (has_foam) {
            EXPECT_EQ(foam_hash_of(jump.complete()), foam_hash_of(steps.complete()));
        }
    }
}

// The ticks of spray change nothing else, and those of foam do not change spray.
TEST(Spray, IsIndependentOfTheOtherParts) {
    const SeaState sea{.cascades = 3, .resolution = 32, .wind_speed_mps = 22, .loop_period_s = 40};
    OceanOptions all = with_spray(), without = with_spray(), foam_alone = with_spray();
    all.queries = all.foam = foam_alone.foam = true;
    all.velocities = Velocities::drawn;
    all.dynamic_waves = DynamicWavesOptions{.resolution = 64, .border_m = 8};
    foam_alone.spray.reset();
    Ocean with(sea, all), alone(sea, without), foam(sea, foam_alone);
    for (const double time_s : {3.0, 3.011, 3.1, 3.19, 3.3, 20.0, 1.0}) {
        const Frame& frame = with.frame_at(time_s);
        EXPECT_EQ(hash_of(frame), hash_of(foam.frame_at(time_s)));
        EXPECT_EQ(foam_hash_of(frame), foam_hash_of(foam.complete()));
        EXPECT_EQ(spray_hash_of(frame), spray_hash_of(alone.frame_at(time_s)));
        EXPECT_EQ(spray_hash_of(foam.complete()), spray_hash_of(Frame{})) << "none without the option";
    }
    EXPECT_GT(with.complete().droplets.size(), 100u);
}

// Foam that waits for a tick of spray, and spray that waits for one of foam, in a forecast.
TEST(Spray, FollowsAChangeOfTheSea) {
    const SeaState before{.cascades = 2, .resolution = 32, .wind_speed_mps = 20, .loop_period_s = 40};
    SeaState after = before;
    after.wind_speed_mps = 12;
    OceanOptions options = with_spray();
    options.foam = true;
    Ocean steps(before, options);
    for (double time_s = 0; time_s < 5; time_s += 0.07) steps.frame_at(time_s);
    steps.schedule_sea(after, 5.5, 1);
    Ocean jumps({.first = before, .changes = {{.sea = after, .from_s = 5.5, .over_s = 1}}}, options);
    for (double time_s = 5; time_s < 9; time_s += 0.35) {
        const Frame& frame = steps.frame_at(time_s);
        EXPECT_EQ(spray_hash_of(frame), spray_hash_of(jumps.frame_at(time_s))) << time_s;
        EXPECT_EQ(foam_hash_of(frame), foam_hash_of(jumps.complete())) << time_s;
    }
}

// 25.25 and 30 are exact, so that the fraction of a tick is equal.
TEST(Spray, RepeatsWithTheLoopBitForBit) {
    SeaState sea = preset_sea("storm");
    sea.loop_period_s = 30;
    Ocean ocean(sea, with_spray());
    const std::uint64_t first = spray_hash_of(ocean.frame_at(7.25));
    ASSERT_GT(ocean.complete().droplets.size(), 100u);
    for (const double loops : {1.0, 40.0, -3.0})
        EXPECT_EQ(spray_hash_of(ocean.frame_at(7.25 + loops * 30)), first) << loops;
}

// A shore attenuates cascades, so that no crest breaks on land: a beach of slope 0.2, from a depth of
// 60 m to 20 m above the sea. Run-up and flight reach 2 m up the beach at most.
TEST(Spray, LeavesTheWaterOfAShore) {
    const SeaState sea{.cascades = 3, .resolution = 64, .wind_speed_mps = 20};
    OceanOptions options = with_spray();
    options.queries = true;
    options.shore = shore_of(81, 61, 5, [](double x, double) { return -60 + x * 0.2; });
    options.shore->resolution = 64;
    Ocean ocean(sea, options), again(sea, options);
    for (Ocean* of : {&ocean, &again}) of->set_spray_center(240, 150);
    const double time_s = 3.0;
    const Frame& frame = ocean.frame_at(time_s);
    EXPECT_GT(frame.droplets.size(), 50u);
    for (const SprayDroplet& droplet : frame.droplets)
        EXPECT_GT(sample(frame.shore, droplet.x_m, droplet.z_m).depth_m, -2) << droplet.x_m << ", " << droplet.z_m;
    for (double at_s = 0; at_s < time_s; at_s += 0.13) again.frame_at(at_s);
    EXPECT_EQ(spray_hash_of(again.frame_at(time_s)), spray_hash_of(frame));
    EXPECT_EQ(shore_hash_of(again.complete()), shore_hash_of(frame));
}

TEST(Spray, KeepsTheNewestDropletsOfEmitters) {
    Ocean ocean({.resolution = 16}, with_spray());
    const SprayEmitter old{.time_s = 1, .x_m = -1, .count = 8192}, fresh{.time_s = 1.01, .x_m = 1, .count = 100};
    ocean.emit({&old, 1});
    EXPECT_EQ(ocean.frame_at(1.02).droplets.size(), 8192u);
    ocean.emit({&fresh, 1});
    const auto droplets = ocean.frame_at(1.02).droplets;
    EXPECT_EQ(droplets.size(), 8192u);
    EXPECT_EQ(std::count_if(droplets.begin(), droplets.end(), [](const SprayDroplet& d) { return d.x_m > 0; }), 100);
    EXPECT_GT(droplets.front().x_m, 0);
}

TEST(Spray, OfEmittersTakesEffectAtTheNextScheduleAndOutlastsAJump) {
    Ocean ocean(preset_sea("storm"), with_spray());
    const SprayEmitter emitter{.time_s = 50, .extent_m = 2, .spread_mps = 3, .count = 500};
    ocean.schedule(50.2);
    ocean.emit({&emitter, 1});
    ocean.set_spray_center(1000, 0);
    const Droplets of_crests = copied(ocean.complete());
    EXPECT_LT(of_crests.front().x_m, 500);
    const SprayDroplet before = ocean.frame_at(50.2).droplets.front();
    EXPECT_EQ(ocean.complete().droplets.size(), 500 + of_crests.size());
    ocean.frame_at(900);
    const SprayDroplet after = ocean.frame_at(50.2).droplets.front();
    EXPECT_EQ(std::memcmp(&before, &after, sizeof before), 0);
}

TEST(Spray, OfEmittersIsSavedAndRestored) {
    Ocean ocean(preset_sea("beaufort-9"), with_spray()), other(preset_sea("beaufort-9"), with_spray());
    const SprayEmitter bow{.time_s = 2, .extent_m = 1, .velocity_y_mps = 5, .count = 40};
    ocean.emit({&bow, 1});
    ocean.frame_at(2.1);
    const SprayEmitter stern{.time_s = 2.2, .x_m = -5, .count = 7};
    ocean.emit({&stern, 1});
    const std::vector<std::uint8_t> saved = ocean.save_spray();
    other.emit({&stern, 1});
    other.restore_spray(saved);
    EXPECT_EQ(other.save_spray(), saved);
    EXPECT_EQ(spray_hash_of(other.frame_at(2.25)), spray_hash_of(ocean.frame_at(2.25)));
    for (std::size_t byte = 0; byte < saved.size(); byte += 97) {
        std::vector<std::uint8_t> damaged = saved;
        damaged[byte] ^= 1;
        EXPECT_EQ(message_of([&] { other.restore_spray(damaged); }),
                  "the saved spray is damaged, expected the bytes that save_spray() returned");
    }
    EXPECT_EQ(message_of([&] { other.restore_spray({saved.data(), 3}); }),
              "the saved spray is 3 bytes, expected more");
    EXPECT_EQ(other.save_spray(), saved) << "a rejected call changes nothing";
    ocean.schedule(3);
    EXPECT_THROW(ocean.save_spray(), std::logic_error);
    EXPECT_THROW(ocean.restore_spray(saved), std::logic_error);
}

TEST(Spray, RejectsBadInputInOneLine) {
    Ocean ocean({.resolution = 16}, with_spray()), without({.resolution = 16});
    const auto emit = [&](const SprayEmitter& emitter, std::size_t copies = 1) {
        return message_of([&] { ocean.emit(std::vector(copies, emitter)); });
    };
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(emit({.x_m = nan}), "x_m nan is out of range [-1e8, 1e8]");
    EXPECT_EQ(emit({.velocity_y_mps = infinity}), "velocity_y_mps inf is out of range [-100, 100]");
    EXPECT_EQ(emit({.count = 9000}), "count 9000 is out of range [0, 8192]");
    EXPECT_EQ(emit({.count = -1}), "count -1 is out of range [0, 8192]");
    EXPECT_EQ(emit({.count = 5000}, 2), "count 10000 is out of range [0, 8192] for all emitters of a call");
    EXPECT_EQ(ocean.frame_at(0).droplets.size(), 0u) << "a rejected call changes nothing";
    const auto created = [](const OceanOptions& options) {
        return message_of([&] { Ocean({.resolution = 16}, options); });
    };
    EXPECT_EQ(created(with_spray({.reach_m = nan})), "reach_m nan is out of range [10, 200]");
    OceanOptions textures = with_spray();
    textures.planes = false;
    EXPECT_EQ(created(textures), "spray cannot be combined with an ocean without planes");
    EXPECT_EQ(message_of([&] { ocean.set_spray_center(nan, 0); }), "x_m nan is out of range [-1e8, 1e8]");
    const std::string off = "the ocean has no spray: it was created without OceanOptions::spray";
    EXPECT_EQ(message_of([&] { without.set_spray_center(0, 0); }), off);
    EXPECT_EQ(message_of([&] { without.emit({}); }), off);
    EXPECT_EQ(message_of([&] { without.save_spray(); }), off);
    EXPECT_EQ(message_of([&] { without.restore_spray({}); }), off);
}

// Far from the origin and late, cells and ticks still have integers of their own.
TEST(Spray, WorksFarAwayAndLate) {
    Ocean ocean(preset_sea("storm"), with_spray());
    ocean.set_spray_center(9.9e7, -9.9e7);
    const Frame& frame = ocean.frame_at(9.9e8);
    EXPECT_GT(frame.droplets.size(), 100u);
    for (const SprayDroplet& droplet : frame.droplets) {
        EXPECT_NEAR(droplet.x_m, 9.9e7, 120);
        EXPECT_NEAR(droplet.z_m, -9.9e7, 120);
    }
    ocean.set_water_frame({.current_x_mps = 10});
    EXPECT_EQ(ocean.frame_at(1e300).droplets.size(), 0u) << "no centre in the water";
}

}  // namespace
}  // namespace pelagic
