// Dynamic waves in an ocean: their effect on cascades, queries and rays, and ticks at any frame
// rate.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/sim/surface_ray.hpp"
#include "pelagic/tests/message_of.hpp"

namespace pelagic {
namespace {

const DynamicWavesOptions small{.resolution = 64, .side_m = 32, .border_m = 6, .foam_height_m = 0.1};
const SeaState breeze{.cascades = 2, .resolution = 32, .wind_speed_mps = 6, .loop_period_s = 20};

OceanOptions with_dynamic_waves(Isa isa = choose_isa(), std::shared_ptr<Executor> executor = make_serial_executor()) {
    return {.executor = std::move(executor), .isa = isa, .queries = true, .velocities = Velocities::drawn,
            .dynamic_waves = small};
}

const Disturbance boat{
    .shape = Disturbance::Shape::hull, .radius_m = 0.9, .length_m = 2.4, .height_m = -0.4, .velocity_x_mps = 2};

Disturbance drop(double height_m) {
    return {.mode = Disturbance::Mode::impulse, .x_m = 1, .radius_m = 0.8, .height_m = height_m};
}

/// Moves a boat, followed by the grid, and adds drops; computes frames `from` to `to` at 72
/// frames/s. Returns the last one.
const Frame& run_frames(Ocean& ocean, int from, int to) {
    const Frame* last = nullptr;
    for (int frame = from; frame < to; ++frame) {
        const double t = frame / 72.0;
        if (frame == 0) ocean.dynamic_waves().add_source(boat);
        ocean.dynamic_waves().set_center(2 * t, 0);
        if (frame % 11 == 3)
            ocean.dynamic_waves().add_impulse(
                {.mode = Disturbance::Mode::impulse, .x_m = 2 * t + 4, .z_m = -3, .radius_m = 0.8, .height_m = 0.5});
        last = &ocean.frame_at(t);
    }
    return *last;
}

TEST(DynamicWaves, DoNotChangeTheCascades) {
    Ocean with(breeze, with_dynamic_waves()), without(breeze, {.executor = make_serial_executor()});
    run_frames(with, 0, 90);
    const Frame& frame = with.frame_at(2.5);
    EXPECT_EQ(hash_of(frame), hash_of(without.frame_at(2.5)));
    EXPECT_NE(hash_of(frame.dynamic_waves), 0U);
    EXPECT_EQ(hash_of(without.frame_at(2.5).dynamic_waves), 0U);
}

// Ticks are independent of frames: constant sources give equal states at equal times for any number
// of frames.
TEST(DynamicWaves, DoNotDependOnTheFrameRate) {
    const auto after_two_seconds = [](int frames_per_second) {
        Ocean ocean(breeze, with_dynamic_waves());
        ocean.dynamic_waves().add_source(boat);
        for (int frame = 0; frame <= 2 * frames_per_second; ++frame)
            ocean.frame_at(frame / static_cast<double>(frames_per_second));
        return hash_of(ocean.frame_at(2.0).dynamic_waves);
    };
    const std::uint64_t expected = after_two_seconds(60);
    for (const int frames_per_second : {7, 24, 30, 72, 90, 144})
        EXPECT_EQ(after_two_seconds(frames_per_second), expected);
}

// A frame between two ticks shows the last two ticks, interpolated linearly.
TEST(DynamicWaves, AreInterpolatedLinearlyBetweenTicks) {
    Ocean ocean(breeze, with_dynamic_waves());
    ocean.dynamic_waves().add_source(boat);
    for (int tick = 0; tick <= 60; ++tick) ocean.frame_at(tick / 60.0);
    const auto heights_at = [&](double tick) {
        const DynamicWavesView& water = ocean.frame_at(tick / 60).dynamic_waves;
        return std::vector<float>(water.height_m.begin(), water.height_m.end());
    };
    const std::vector<float> begin = heights_at(60), quarter = heights_at(60.25), half = heights_at(60.5),
                             end = heights_at(61);
    double largest_change = 0;
    for (std::size_t i = 0; i < begin.size(); ++i) {
        largest_change = std::max(largest_change, std::fabs(static_cast<double>(end[i]) - begin[i]));
        EXPECT_NEAR(quarter[i], begin[i] + 0.25 * (end[i] - begin[i]), 1e-5);
        EXPECT_NEAR(half[i], begin[i] + 0.5 * (end[i] - begin[i]), 1e-5);
    }
    EXPECT_GT(largest_change, 1e-3);
}

TEST(DynamicWaves, StopAtEarlierTimesAndAdvanceHalfASecondInAJump) {
    Ocean ocean(breeze, with_dynamic_waves());
    run_frames(ocean, 0, 72);
    const std::uint64_t there = hash_of(ocean.frame_at(1.0).dynamic_waves);
    ocean.frame_at(0.3);
    EXPECT_EQ(hash_of(ocean.frame_at(0.3).dynamic_waves), there);
    Ocean jumps(breeze, with_dynamic_waves()), walks(breeze, with_dynamic_waves());
    for (Ocean* each : {&jumps, &walks}) {
        each->frame_at(0);
        each->dynamic_waves().add_impulse({.mode = Disturbance::Mode::impulse, .height_m = 0.5});
    }
    jumps.frame_at(1e6);
    for (int tick = 1; tick <= 30; ++tick) walks.frame_at(tick / 60.0);
    EXPECT_EQ(hash_of(jumps.frame_at(1e6).dynamic_waves), hash_of(walks.frame_at(0.5).dynamic_waves));
}

TEST(DynamicWaves, AreIncludedInQueries) {
    for (const SeaState& sea : {breeze, SeaState{.resolution = 32, .patch_size_m = 60, .wind_speed_mps = 6}}) {
        Ocean with(sea, with_dynamic_waves()), without(sea, with_dynamic_waves());
        const Frame& moved = run_frames(with, 0, 100);
        const Frame& still = without.frame_at(moved.time_s);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> place(-20, 20);
        std::vector<double> x(2000), z(2000);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = 2.7 + place(random), z[i] = place(random);
        const std::size_t n = x.size();
        std::vector<float> a(n), b(n), vertical_velocity_a(n), vertical_velocity_b(n), nx(n), ny(n), nz(n), mx(n),
            my(n), mz(n), foam(n);
        SurfaceQuery(moved).sample({x, z}, {.height_m = a,
                                            .normal_x = nx,
                                            .normal_y = ny,
                                            .normal_z = nz,
                                            .velocity_y_mps = vertical_velocity_a,
                                            .foam = foam});
        SurfaceQuery(still).sample(
            {x, z},
            {.height_m = b, .normal_x = mx, .normal_y = my, .normal_z = mz, .velocity_y_mps = vertical_velocity_b});
        double largest = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const DynamicWavesSample dynamic_waves = sample(moved.dynamic_waves, x[i], z[i]);
            largest = std::max(largest, std::fabs(dynamic_waves.height_m));
            EXPECT_NEAR(a[i] - b[i], dynamic_waves.height_m, 1e-6);
            EXPECT_NEAR(vertical_velocity_a[i] - vertical_velocity_b[i], dynamic_waves.vertical_velocity_mps, 1e-6);
            EXPECT_EQ(foam[i], static_cast<float>(dynamic_waves.foam));
            // The slopes add, for any slope of the cascades.
            EXPECT_NEAR(-nx[i] / ny[i], -mx[i] / my[i] + dynamic_waves.slope_x, 1e-5);
            EXPECT_NEAR(-nz[i] / ny[i], -mz[i] / my[i] + dynamic_waves.slope_z, 1e-5);
            EXPECT_NEAR(std::hypot(nx[i], ny[i], nz[i]), 1, 1e-6);
        }
        EXPECT_GT(largest, 0.1);
    }
}

// Slopes at texels, compared with differences of heights over two texels.
TEST(DynamicWaves, SlopesMatchDifferencesOfHeights) {
    Ocean ocean(breeze, with_dynamic_waves());
    const DynamicWavesView& water = run_frames(ocean, 0, 100).dynamic_waves;
    for (std::int64_t z = water.first_z + 2; z < water.first_z + 60; z += 3)
        for (std::int64_t x = water.first_x + 2; x < water.first_x + 60; x += 3) {
            const double step = water.texel_m, at_x = static_cast<double>(x) * step,
                         at_z = static_cast<double>(z) * step;
            const auto height = [&](double dx, double dz) { return sample(water, at_x + dx, at_z + dz).height_m; };
            EXPECT_NEAR(sample(water, at_x, at_z).slope_x, (height(step, 0) - height(-step, 0)) / (2 * step), 1e-6);
            EXPECT_NEAR(sample(water, at_x, at_z).slope_z, (height(0, step) - height(0, -step)) / (2 * step), 1e-6);
        }
    EXPECT_EQ(sample(water, std::numeric_limits<double>::quiet_NaN(), 0).height_m, 0);
    EXPECT_EQ(sample(water, 1e300, 0).height_m, 0);
    EXPECT_EQ(sample(water, static_cast<double>(water.first_x - 1) * water.texel_m, 0).height_m, 0);
}

TEST(DynamicWaves, StopsRays) {
    Ocean ocean(breeze, with_dynamic_waves());
    // a bulge higher than all waves
    ocean.dynamic_waves().add_source({.radius_m = 2, .height_m = 3});
    const Frame* frame = nullptr;
    for (int tick = 0; tick < 240; ++tick) frame = &ocean.frame_at(tick / 60.0);
    const SurfaceQuery query(*frame);
    float height = 0;
    const double zero = 0;
    query.sample({{&zero, 1}, {&zero, 1}}, {.height_m = {&height, 1}});
    ASSERT_GT(height, 2);
    EXPECT_GE(frame->bounds.height_max_m, height);
    const auto down = first_hit(query, {.origin_m = {0, 50, 0}, .direction = {0, -1, 0}, .reach_m = 100});
    ASSERT_TRUE(down);
    EXPECT_NEAR(down->distance_m, 50 - static_cast<double>(height), 2e-3);
    // A ray above the sea's waves that hits the side of the bulge.
    const auto along = first_hit(query, {.origin_m = {-40, 1.8, 0}, .direction = {1, 0, 0}, .reach_m = 80});
    ASSERT_TRUE(along);
    EXPECT_GT(along->position_m[0], -3);
    EXPECT_LT(along->position_m[0], 0);
}

TEST(DynamicWaves, RestoredStateContinuesBitIdentically) {
    Ocean continuous(breeze, with_dynamic_waves()), rolled_back(breeze, with_dynamic_waves()),
        late(breeze, with_dynamic_waves());
    for (Ocean* rains : {&continuous, &rolled_back})
        rains->dynamic_waves().set_rain({.drops_per_m2_s = 2, .radius_m = 0.5, .seed = 5});
    const std::uint64_t expected = hash_of(run_frames(continuous, 0, 150).dynamic_waves);
    run_frames(rolled_back, 0, 70);
    const std::vector<std::uint8_t> saved = rolled_back.dynamic_waves().save_state();
    run_frames(rolled_back, 70, 110);
    rolled_back.dynamic_waves().add_impulse({.height_m = 1});  // undone by the restore
    rolled_back.dynamic_waves().set_rain({.drops_per_m2_s = 1});
    rolled_back.dynamic_waves().restore_state(saved);
    EXPECT_EQ(hash_of(run_frames(rolled_back, 70, 150).dynamic_waves), expected);
    late.dynamic_waves().restore_state(saved);
    EXPECT_EQ(hash_of(run_frames(late, 70, 150).dynamic_waves), expected);
    EXPECT_GT(late.dynamic_waves().add_source(boat), 1U) << "the boat's number is taken";
}

TEST(DynamicWaves, RestoredStateIncludesPendingImpulses) {
    Ocean continuous(breeze, with_dynamic_waves()), late(breeze, with_dynamic_waves());
    continuous.frame_at(0.5);
    continuous.dynamic_waves().add_impulse(drop(0.3));
    continuous.frame_at(0.501);  // no tick
    const std::vector<std::uint8_t> saved = continuous.dynamic_waves().save_state();
    late.dynamic_waves().restore_state(saved);
    for (Ocean* ocean : {&continuous, &late}) {
        ocean->dynamic_waves().add_impulse(drop(0.2));
        ocean->frame_at(0.501);  // no time passes for either
    }
    EXPECT_GT(continuous.frame_at(0.55).dynamic_waves.bounds.height_max_m, 0.2f);
    EXPECT_EQ(hash_of(late.frame_at(0.55).dynamic_waves), hash_of(continuous.frame_at(0.55).dynamic_waves));
}

/// Returns the hash of the dynamic waves at 0.6 s, after a frame at 0.5 s and the given frames. The
/// drops of a frame are added while the previous frame is in flight.
struct FrameWithDrops {
    double time_s;
    std::vector<double> drops_m;
};
std::uint64_t hash_after(const std::vector<FrameWithDrops>& frames) {
    Ocean ocean(breeze, with_dynamic_waves(choose_isa(), make_thread_executor(2)));
    ocean.schedule(0.5);
    for (const FrameWithDrops& frame : frames) {
        for (const double height_m : frame.drops_m) ocean.dynamic_waves().add_impulse(drop(height_m));
        ocean.complete();
        ocean.schedule(frame.time_s);
    }
    ocean.complete();
    return hash_of(ocean.frame_at(0.6).dynamic_waves);
}

// Ticks are at 0.5 s and 0.517 s.
TEST(DynamicWaves, ImpulsesOfFramesBetweenTicksAreSummed) {
    const std::uint64_t at_once = hash_after({{0.52, {0.1, -0.2, 0.3, 0.05}}});
    EXPECT_EQ(hash_after({{0.505, {0.1}}, {0.51, {-0.2, 0.3}}, {0.515, {}}, {0.52, {0.05}}}), at_once);
    EXPECT_NE(hash_after({{0.52, {0.1, -0.2, 0.3}}}), at_once);
}

TEST(DynamicWaves, OnlyTheLastFramesImpulsesCountWhileTimeStandsStill) {
    const std::uint64_t expected = hash_after({{0.52, {0.1, 0.3, 0.05}}});
    EXPECT_EQ(hash_after({{0.505, {0.1}}, {0.505, {-0.2}}, {0.505, {0.3}}, {0.505, {}}, {0.52, {0.05}}}), expected);
    EXPECT_EQ(hash_after({{0.505, {0.1}}, {0.504, {-0.2, 1}}, {0.503, {0.3}}, {0.52, {0.05}}}), expected);
    // One second of a paused application: a thousand frames of five drops each.
    std::vector<FrameWithDrops> paused(1000, {0.5, {0.01, 0.02, 0.03, 0.04, 0.05}});
    paused.push_back({0.52, {0.3}});
    EXPECT_EQ(hash_after(paused), hash_after({{0.52, {0.01, 0.02, 0.03, 0.04, 0.05, 0.3}}}));
}

TEST(DynamicWaves, ATickTakesAtMost4096Impulses) {
    Ocean ocean(breeze, with_dynamic_waves(choose_isa(), make_thread_executor(2)));
    const auto disturb = [&](int times) {
        for (int i = 0; i < times; ++i) ocean.dynamic_waves().add_impulse(drop(1e-4));
    };
    const auto expect_full = [&] {
        EXPECT_EQ(message_of([&] { ocean.dynamic_waves().add_impulse(drop(1e-4)); }),
                  "the number of impulses of a tick is 4097, expected at most 4096");
    };
    ocean.frame_at(0.5);
    for (int frame = 0; frame < 3; ++frame) {  // no time passes
        disturb(4096);
        expect_full();
        ocean.frame_at(0.5);
    }
    disturb(4000);
    ocean.frame_at(0.505);  // no tick, and both do not fit into one
    disturb(96);
    expect_full();
    ocean.frame_at(0.51);
    expect_full();
    ocean.frame_at(0.52);  // a tick
    disturb(4096);
    ocean.frame_at(0.54);
}

TEST(DynamicWaves, RemovedSourcesFreeTheirPlace) {
    Ocean ocean(breeze, with_dynamic_waves(choose_isa(), make_thread_executor(2)));
    const Disturbance press{.radius_m = 1, .height_m = 1e-4};
    std::vector<std::uint32_t> numbers;
    const auto add = [&] { numbers.push_back(ocean.dynamic_waves().add_source(press)); };
    const auto expect_full = [&] { EXPECT_THROW(ocean.dynamic_waves().add_source(press), std::invalid_argument); };
    for (int i = 0; i < 4096; ++i) add();
    expect_full();
    for (int frame = 0; frame < 3; ++frame) {
        ocean.schedule(frame / 60.0);
        for (const std::size_t place : {0U, 2000U}) {
            ocean.dynamic_waves().remove_source(numbers[place]);
            ocean.dynamic_waves().remove_source(numbers[place]);  // frees a place only once
            numbers.erase(numbers.begin() + static_cast<std::ptrdiff_t>(place));
            ocean.dynamic_waves().remove_source(1'000'000);
            add();
            expect_full();
        }
        ocean.dynamic_waves().remove_source(numbers.back());  // a source added in this frame
        numbers.pop_back();
        add();
        expect_full();
        ocean.complete();
    }
    ocean.frame_at(0.05);
    const std::vector<std::uint8_t> saved = ocean.dynamic_waves().save_state();
    ocean.dynamic_waves().remove_source(numbers.front());
    ocean.dynamic_waves().restore_state(saved);  // restores the removed source
    expect_full();
    for (const std::uint32_t number : numbers) ocean.dynamic_waves().remove_source(number);
    for (int i = 0; i < 4096; ++i) add();
    expect_full();
    ocean.frame_at(0.1);
}

TEST(DynamicWaves, StateOfOtherOptionsIsRejected) {
    OceanOptions set = with_dynamic_waves();
    set.dynamic_waves->step = DynamicWavesStep::verlet;
    const auto saved_with = [&](auto change) {
        OceanOptions changed = set;
        change(*changed.dynamic_waves);
        Ocean ocean(breeze, changed);
        ocean.dynamic_waves().add_impulse(drop(0.3));
        ocean.frame_at(0);
        ocean.frame_at(0.1);
        return ocean.dynamic_waves().save_state();
    };
    Ocean ocean(breeze, set);
    ocean.frame_at(0);
    const std::vector<std::uint8_t> before = ocean.dynamic_waves().save_state();
    const auto refuses = [&](auto change, const char* what) {
        EXPECT_EQ(message_of([&] { ocean.dynamic_waves().restore_state(saved_with(change)); }),
                  "the saved state has other options, expected those of these dynamic waves")
            << what;
        EXPECT_EQ(ocean.dynamic_waves().save_state(), before) << what;
    };
    using Options = DynamicWavesOptions;
    refuses([](Options& o) { o.step = DynamicWavesStep::spectral; }, "step");
    refuses([](Options& o) { o.resolution = 128; }, "resolution");
    refuses([](Options& o) { o.side_m = 33; }, "side_m");
    refuses([](Options& o) { o.ticks_per_s = 61; }, "ticks_per_s");
    refuses([](Options& o) { o.border_m = 5; }, "border_m");
    refuses([](Options& o) { o.depth_m = 10; }, "depth_m");
    refuses([](Options& o) { o.viscosity_m2ps = 0; }, "viscosity_m2ps");
    refuses([](Options& o) { o.wave_speed_mps = 2; }, "wave_speed_mps");
    refuses([](Options& o) { o.decay_per_s = 0.02; }, "decay_per_s");
    refuses([](Options& o) { o.foam_height_m = 0.3; }, "foam_height_m");
    static_assert(sizeof(Options) == 72, "each field above");
    EXPECT_NO_THROW(ocean.dynamic_waves().restore_state(saved_with([](Options&) {})));
}

// Dynamic waves do not depend on the wind waves.
TEST(DynamicWaves, StateCanBeRestoredInAnOceanOfAnotherSea) {
    Ocean there(breeze, with_dynamic_waves()),
        here({.cascades = 1, .resolution = 64, .wind_speed_mps = 12}, with_dynamic_waves());
    run_frames(there, 0, 40);
    here.dynamic_waves().restore_state(there.dynamic_waves().save_state());
    EXPECT_EQ(hash_of(run_frames(here, 40, 60).dynamic_waves), hash_of(run_frames(there, 40, 60).dynamic_waves));
}

// A bit of any byte, in the header, the texels and the sources.
TEST(DynamicWaves, DamagedStateIsRejected) {
    Ocean ocean(breeze, with_dynamic_waves());
    ocean.dynamic_waves().set_rain({.drops_per_m2_s = 2});
    run_frames(ocean, 0, 20);
    const std::vector<std::uint8_t> saved = ocean.dynamic_waves().save_state();
    const auto message_for = [&](std::span<const std::uint8_t> bytes) {
        return message_of([&] { ocean.dynamic_waves().restore_state(bytes); });
    };
    constexpr const char* damaged = "the saved state is damaged, expected the bytes that save_state() returned";
    std::mt19937 random(9);
    for (int i = 0; i < 300; ++i) {
        const std::size_t at = i < 100   ? static_cast<std::size_t>(i)
                               : i < 200 ? random() % saved.size()
                                         : saved.size() - static_cast<std::size_t>(i - 199);
        std::vector<std::uint8_t> bytes = saved;
        bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1u << random() % 8));
        ASSERT_EQ(message_for(bytes), damaged) << at;
    }
    EXPECT_EQ(message_for(std::span(saved).first(saved.size() - 1)), damaged);
    EXPECT_THROW(ocean.dynamic_waves().restore_state({}), std::invalid_argument);
    EXPECT_EQ(ocean.dynamic_waves().save_state(), saved);
    EXPECT_EQ(message_for(saved), "");
}

TEST(DynamicWaves, SourcesMoveStopAndAreRemoved) {
    Ocean ocean(breeze, with_dynamic_waves());
    const std::uint32_t source =
        ocean.dynamic_waves().add_source({.radius_m = 1.5, .height_m = 0.5, .velocity_x_mps = 1});
    const auto highest_at = [&](double x, const Frame& frame) {
        return sample(frame.dynamic_waves, x, 0).height_m > 0.8 * 0.5;
    };
    int frame = 0;
    const auto run_to = [&](int ticks) -> const Frame& {
        for (; frame < ticks; ++frame) ocean.frame_at(frame / 60.0);
        return ocean.frame_at(frame / 60.0);
    };
    const Frame& moved = run_to(240);  // four metres in four seconds
    EXPECT_TRUE(highest_at(3.9, moved));
    EXPECT_FALSE(highest_at(0, moved));
    ocean.dynamic_waves().set_source(source, {.x_m = -5, .radius_m = 1.5, .height_m = 0.5});
    EXPECT_TRUE(highest_at(-5, run_to(600)));
    // After set_source() the source moves from its new position, from that time on.
    ocean.dynamic_waves().set_source(source, {.x_m = -5, .radius_m = 1.5, .height_m = 0.5, .velocity_x_mps = 1});
    EXPECT_TRUE(highest_at(-3.1, run_to(720)));
    ocean.dynamic_waves().remove_source(source);
    EXPECT_LT(run_to(1600).dynamic_waves.bounds.height_max_m, 0.02f);
    // Commands for a removed source, or for a number that never existed, have no effect.
    ocean.dynamic_waves().set_source(source, {.radius_m = 1.5, .height_m = 0.5});
    ocean.dynamic_waves().set_source(77, {.radius_m = 1.5, .height_m = 0.5});
    EXPECT_LT(run_to(1800).dynamic_waves.bounds.height_max_m, 0.02f);
}

TEST(DynamicWaves, InvalidArgumentsAreRejected) {
    Ocean plain(breeze, {.executor = make_serial_executor()});
    EXPECT_THROW(plain.dynamic_waves().add_impulse({}), std::invalid_argument);
    EXPECT_THROW(plain.dynamic_waves().set_center(0, 0), std::invalid_argument);
    EXPECT_THROW(plain.dynamic_waves().set_rain({}), std::invalid_argument);
    EXPECT_THROW(plain.dynamic_waves().save_state(), std::invalid_argument);
    OceanOptions wrong = with_dynamic_waves();
    wrong.dynamic_waves->resolution = 65;
    EXPECT_EQ(message_of([&] { const Ocean ocean(breeze, wrong); }),
              "resolution is 65, expected 64, 128, 256, 512 or 1024");
    Ocean ocean(breeze, with_dynamic_waves());
    run_frames(ocean, 0, 20);
    const std::uint64_t before = hash_of(ocean.frame_at(0.3).dynamic_waves);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {nan, 1e300}) {
        EXPECT_THROW(ocean.dynamic_waves().add_impulse({.x_m = bad}), std::invalid_argument);
        EXPECT_THROW(ocean.dynamic_waves().add_source({.height_m = bad}), std::invalid_argument);
        EXPECT_THROW(ocean.dynamic_waves().set_source(1, {.radius_m = bad}), std::invalid_argument);
        EXPECT_THROW(ocean.dynamic_waves().set_center(bad, 0), std::invalid_argument);
    }
    EXPECT_EQ(hash_of(ocean.frame_at(0.3).dynamic_waves), before);
    for (std::size_t i = 0; i < 4096; ++i) ocean.dynamic_waves().add_impulse({.height_m = 0.01});
    EXPECT_THROW(ocean.dynamic_waves().add_impulse({.height_m = 0.01}), std::invalid_argument);
    ocean.frame_at(0.31);  // may have no tick, in which case they wait for the next one
    for (std::uint32_t number = 1000; number < 10000; ++number)
        ocean.dynamic_waves().set_source(number, {.height_m = 0.01});
    EXPECT_NO_THROW(ocean.frame_at(0.5));
}

}  // namespace
}  // namespace pelagic
