// Sea level and current: a change of frame for queries, rays, dynamic waves, spray and the
// selection of patches, which leaves frames unchanged.
#include "pelagic/sim/water_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "pelagic/quadtree/camera.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/sim/spray/crest_spray.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/sim/surface_ray.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/query_points.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

const WaterFrame drifting{.current_x_mps = 1.37, .current_z_mps = -0.83};

SeaState windy_sea(int cascades) { return {.cascades = cascades, .resolution = 32, .wind_speed_mps = 11}; }

OceanOptions with_all(Isa isa = choose_isa()) {
    return {.executor = make_serial_executor(), .isa = isa, .queries = true, .velocities = Velocities::drawn,
            .foam = true};
}

Samples samples_of(const Frame& frame, const std::vector<double>& x, const std::vector<double>& z,
                   Interpolation interpolation = Interpolation::linear) {
    Samples samples(x.size(), true, true);
    SurfaceQuery(frame, {.interpolation = interpolation}).sample({x, z}, samples.view());
    return samples;
}

std::vector<double> random_places(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> anywhere(-300, 300);
    std::vector<double> places(count);
    for (double& place : places) place = anywhere(random);
    return places;
}

// After a day the water has drifted by 130 km. The queries of an ocean without a current, at
// x - U t in double, have the same bits, and the velocity of the water is larger by U.
TEST(WaterFrame, QueryWithACurrentIsTheQueryUpstream) {
    for (const int cascades : {1, 3})
        for (const Isa isa : isas_here())
            for (const double time_s : {0.0, 7.25, 1e5}) {
                SCOPED_TRACE(std::to_string(cascades) + " cascades, " + std::string(name_of(isa)) +
                             ", t = " + std::to_string(time_s));
                const std::vector<double> x = random_places(300, 1), z = random_places(300, 2);
                std::vector<double> upstream_x, upstream_z;
                for (std::size_t i = 0; i < x.size(); ++i) {
                    upstream_x.push_back(x[i] - drifting.current_x_mps * time_s);
                    upstream_z.push_back(z[i] - drifting.current_z_mps * time_s);
                }
                Ocean with(windy_sea(cascades), with_all(isa)), without(windy_sea(cascades), with_all(isa));
                with.set_water_frame(drifting);
                for (const Interpolation interpolation : {Interpolation::linear, Interpolation::cubic}) {
                    const Samples moved = samples_of(with.frame_at(time_s), x, z, interpolation);
                    const Samples still = samples_of(without.frame_at(time_s), upstream_x, upstream_z, interpolation);
                    EXPECT_EQ(moved.height, still.height);
                    EXPECT_EQ(moved.normal_x, still.normal_x);
                    EXPECT_EQ(moved.normal_z, still.normal_z);
                    EXPECT_EQ(moved.jacobian, still.jacobian);
                    EXPECT_EQ(moved.foam, still.foam);
                    EXPECT_EQ(moved.error, still.error);
                    EXPECT_EQ(moved.converged, still.converged);
                    EXPECT_EQ(moved.velocity_y, still.velocity_y);
                    for (std::size_t i = 0; i < x.size(); ++i) {
                        // A float of 10 m/s has a rounding error of 5e-7.
                        EXPECT_NEAR(static_cast<double>(moved.velocity_x[i]) - drifting.current_x_mps,
                                    static_cast<double>(still.velocity_x[i]), 1e-6);
                        EXPECT_NEAR(static_cast<double>(moved.velocity_z[i]) - drifting.current_z_mps,
                                    static_cast<double>(still.velocity_z[i]), 1e-6);
                    }
                }
            }
}

TEST(WaterFrame, SeaLevelLiftsHeightsAndNothingElse) {
    Ocean with(windy_sea(3), with_all()), without(windy_sea(3), with_all());
    with.set_water_frame({.sea_level_m = 3});
    const std::vector<double> x = random_places(300, 3), z = random_places(300, 4);
    const Samples lifted = samples_of(with.frame_at(5), x, z), still = samples_of(without.frame_at(5), x, z);
    for (std::size_t i = 0; i < x.size(); ++i)
        EXPECT_EQ(lifted.height[i], static_cast<float>(static_cast<double>(still.height[i]) + 3)) << i;
    EXPECT_EQ(lifted.normal_x, still.normal_x);
    EXPECT_EQ(lifted.velocity_x, still.velocity_x);
    EXPECT_EQ(lifted.velocity_y, still.velocity_y);
    EXPECT_EQ(lifted.foam, still.foam);
}

TEST(WaterFrame, LeavesFramesUnchanged) {
    Ocean with(windy_sea(3), with_all()), without(windy_sea(3), with_all());
    with.set_water_frame({2, 1.5, -0.5});
    for (const double time_s : {0.0, 3.0, 20.0}) {
        const Frame &there = with.frame_at(time_s), &here = without.frame_at(time_s);
        EXPECT_EQ(hash_of(there), hash_of(here));
        EXPECT_EQ(foam_hash_of(there), foam_hash_of(here));
        EXPECT_EQ(there.bounds.height_max_m, here.bounds.height_max_m);
        EXPECT_EQ(there.water_frame, (WaterFrame{2, 1.5, -0.5}));
        EXPECT_EQ(here.water_frame, WaterFrame{});
    }
}

// A tide changes between frames, and a frame keeps the value of its schedule().
TEST(WaterFrame, IsThatOfTheSchedule) {
    Ocean ocean(windy_sea(2), with_all());
    ocean.set_water_frame({.sea_level_m = 1});
    ocean.schedule(0);
    ocean.set_water_frame({.sea_level_m = 2});
    EXPECT_EQ(ocean.complete().water_frame.sea_level_m, 1);
    EXPECT_EQ(ocean.frame_at(0).water_frame.sea_level_m, 2);
    EXPECT_EQ(ocean.water_frame().sea_level_m, 2);
}

TEST(WaterFrame, RayMeetsTheLiftedWater) {
    Ocean ocean(windy_sea(3), with_all());
    ocean.set_water_frame({.sea_level_m = 40, .current_x_mps = 2});
    const SurfaceQuery query(ocean.frame_at(100));
    EXPECT_NEAR(static_cast<double>(query.bounds().height_max_m - query.frame().bounds.height_max_m), 40, 1e-5);
    for (const double x : {-31.0, 0.0, 57.5}) {
        const double z = 12;
        float height_m = 0;
        query.sample({{&x, 1}, {&z, 1}}, {.height_m = {&height_m, 1}});
        const auto hit = first_hit(query, {.origin_m = {x, 100, z}, .direction = {0, -1, 0}, .reach_m = 100});
        ASSERT_TRUE(hit);
        // to the query's tolerance
        EXPECT_NEAR(hit->position_m[1], static_cast<double>(height_m), 1e-3);
        EXPECT_NEAR(hit->distance_m, 100 - static_cast<double>(height_m), 1e-3);
    }
}

// A drop makes rings around itself. Their centre drifts with the current: the mean position of the
// squared heights, in the world, is that of the drop plus U t.
TEST(WaterFrame, RingsDriftWithTheCurrent) {
    for (const WaterFrame& water : {WaterFrame{}, WaterFrame{0, 1.5, -0.75}}) {
        DynamicWaves waves({.resolution = 128, .side_m = 32, .border_m = 4},
                           DynamicWaves::Resources{.executor = make_serial_executor()});
        constexpr double drop_s = 1000, x_m = 5, z_m = -3;
        waves.set_current(water.current_x_mps, water.current_z_mps);
        waves.set_center(x_m, z_m);
        waves.advance(drop_s);
        waves.add_impulse(
            {.mode = Disturbance::Mode::impulse, .x_m = x_m, .z_m = z_m, .radius_m = 0.8, .height_m = 0.3});
        const double later_s = drop_s + 1.5;
        for (double t = drop_s; t < later_s; t += 0.25) waves.advance(t);
        const DynamicWavesView& view = waves.advance(later_s);
        const WaterFrame::Origin origin = water.origin_at(later_s);
        double all = 0, sum_x = 0, sum_z = 0;
        for (std::int64_t j = view.first_z; j < view.first_z + view.resolution; ++j)
            for (std::int64_t i = view.first_x; i < view.first_x + view.resolution; ++i) {
                const double x = static_cast<double>(i) * view.texel_m, z = static_cast<double>(j) * view.texel_m;
                const double height = sample(view, x, z).height_m;
                all += height * height;
                sum_x += height * height * (x + origin.x_m);
                sum_z += height * height * (z + origin.z_m);
            }
        ASSERT_GT(all, 1e-3);
        // The drop acts a tick, 1/60 s, after the first advance. Meanwhile the water moves by 3 cm.
        EXPECT_NEAR(sum_x / all, x_m + water.current_x_mps * (later_s - drop_s), 0.03);
        EXPECT_NEAR(sum_z / all, z_m + water.current_z_mps * (later_s - drop_s), 0.03);
    }
}

// A moored boat in a current has the wake of a boat that moves against still water.
TEST(WaterFrame, MooredBoatHasTheWakeOfAMovingOne) {
    const DynamicWavesOptions options{.resolution = 64, .side_m = 32, .border_m = 6};
    const auto resources = [] { return DynamicWaves::Resources{.executor = make_serial_executor()}; };
    DynamicWaves river(options, resources()), lake(options, resources());
    Disturbance boat{.shape = Disturbance::Shape::hull, .radius_m = 0.8, .length_m = 2, .height_m = -0.3};
    river.set_current(2, 0.5);
    river.advance(0);
    lake.advance(0);
    river.add_source(boat);
    // The first tick is at 1/60 s.
    boat.x_m = -2.0 / 60;
    boat.z_m = -0.5 / 60;
    boat.velocity_x_mps = -2;
    boat.velocity_z_mps = -0.5;
    lake.add_source(boat);
    for (int frame = 1; frame <= 120; ++frame) {
        const double t = frame / 60.0;
        const double at_x = -2 * (frame / 60.0), at_z = -0.5 * (frame / 60.0);
        river.set_center(0, 0);
        lake.set_center(at_x, at_z);
        river.advance(t);
        lake.advance(t);
    }
    float largest = 0;
    double difference = 0;
    ASSERT_EQ(river.view().first_x, lake.view().first_x);
    ASSERT_EQ(river.view().first_z, lake.view().first_z);
    for (std::size_t i = 0; i < river.view().height_m.size(); ++i) {
        largest = std::max(largest, std::fabs(lake.view().height_m[i]));
        difference = std::max(difference, std::fabs(static_cast<double>(river.view().height_m[i]) -
                                                    static_cast<double>(lake.view().height_m[i])));
    }
    EXPECT_GT(largest, 0.05f);
    EXPECT_LT(difference, 1e-4);  // positions differ in their last bits
}

TEST(WaterFrame, QueriesSeeTheDynamicWavesInPlace) {
    OceanOptions options = with_all();
    options.dynamic_waves = DynamicWavesOptions{.resolution = 64, .side_m = 32, .border_m = 6};
    Ocean ocean({.cascades = 2, .resolution = 32, .wind_speed_mps = 0.5}, options);
    ocean.set_water_frame({.sea_level_m = -5, .current_x_mps = 3});
    constexpr double start_s = 400;
    ocean.dynamic_waves().set_center(10, 0);
    ocean.frame_at(start_s);
    // A relaxation to a bulge of 1 m that is fixed in the world.
    ocean.dynamic_waves().add_source(
        {.mode = Disturbance::Mode::relaxation, .x_m = 10, .radius_m = 2, .height_m = 1, .rate_per_s = 100});
    for (int frame = 1; frame <= 30; ++frame) {
        ocean.dynamic_waves().set_center(10, 0);
        ocean.frame_at(start_s + frame / 60.0);
    }
    const SurfaceQuery query(ocean.complete());
    const std::vector<double> x{10, 22}, z{0, 0};
    std::vector<float> height_m(2);
    query.sample({x, z}, {.height_m = height_m});
    // Water flows through the bulge, and rises to more than 0.3 of it.
    EXPECT_GT(height_m[0], -4.7f);
    EXPECT_NEAR(static_cast<double>(height_m[1]), -5, 0.2);
}

TEST(WaterFrame, SprayIsCarriedAlong) {
    const SeaState storm{.cascades = 3, .resolution = 64, .wind_speed_mps = 24};
    const WaterFrame water{4, 1.5, -2};
    OceanOptions options = with_all();
    options.spray = SprayOptions{};
    Ocean with(storm, options), without(storm, options);
    with.set_water_frame(water);
    constexpr double time_s = 50.03;
    SprayEmitter bow{.time_s = 50, .x_m = 1, .y_m = 2, .velocity_x_mps = 3, .count = 5};
    without.emit({&bow, 1});
    bow.x_m += water.current_x_mps * bow.time_s;
    bow.y_m += water.sea_level_m;
    bow.z_m += water.current_z_mps * bow.time_s;
    bow.velocity_x_mps += water.current_x_mps;
    bow.velocity_z_mps += water.current_z_mps;
    with.emit({&bow, 1});
    without.set_spray_center(7.3, 0);
    const TickClock clock(storm.loop_period_s, 2);
    const std::int64_t last = clock.at(time_s).number;
    for (std::int64_t tick = last - CrestSpray::kept_ticks; tick <= last; ++tick) {
        const double at_s = clock.time_s(tick);
        with.set_spray_center(7.3 + water.current_x_mps * at_s, water.current_z_mps * at_s);
        with.frame_at(at_s);
    }
    const auto moved = with.frame_at(time_s).droplets, still = without.frame_at(time_s).droplets;
    ASSERT_EQ(moved.size(), still.size());
    ASSERT_GT(moved.size(), 100u);
    for (std::size_t i = 0; i < moved.size(); ++i) {
        EXPECT_NEAR(moved[i].x_m, still[i].x_m + water.current_x_mps * time_s, 1e-9) << i;
        EXPECT_NEAR(moved[i].y_m, still[i].y_m + 4, 1e-9) << i;
        EXPECT_NEAR(moved[i].z_m, still[i].z_m + water.current_z_mps * time_s, 1e-9) << i;
        EXPECT_NEAR(static_cast<double>(moved[i].velocity_x_mps),
                    static_cast<double>(still[i].velocity_x_mps) + water.current_x_mps, 1e-5)
            << i;
    }
}

// A camera 2 m above a sea level of 40 m selects the patches of a camera at 2 m.
TEST(WaterFrame, SelectionFollowsTheSeaLevel) {
    const Camera low{.position_m = {3, 2, 5}, .target_m = {60, 0, 40}};
    Camera high = low;
    high.position_m.y += 40;
    high.target_m.y += 40;
    Selection at_sea(quadtree_preset_named("high")->options(2048)), on_lake(at_sea.options());
    const glm::dmat4 low_view = low.clip_from_world(1.5), high_view = high.clip_from_world(1.5);
    const FrameBounds bounds{-1, 1.5, 2, 2};
    const DrawList& expected = at_sea.select({.viewer_m = low.position_m, .views = {&low_view, 1}, .bounds = bounds});
    const DrawList& found =
        on_lake.select({.viewer_m = high.position_m, .views = {&high_view, 1}, .bounds = bounds, .sea_level_m = 40});
    EXPECT_EQ(found.instances, expected.instances);
    EXPECT_GT(found.instances.size(), 10u);
    EXPECT_EQ(
        message_of([&] {
            on_lake.select({.viewer_m = high.position_m, .sea_level_m = std::numeric_limits<double>::quiet_NaN()});
        }),
        "sea_level_m holds nan, expected finite numbers within 1e8 m of the origin");
}

TEST(WaterFrame, InvalidValuesAreNamedAndChangeNothing) {
    Ocean ocean(windy_sea(2), with_all());
    ocean.set_water_frame({1, 2, 3});
    const auto message = [&](const WaterFrame& water) { return message_of([&] { ocean.set_water_frame(water); }); };
    EXPECT_EQ(message({.sea_level_m = 2000}), "sea_level_m 2000 is out of range [-1000, 1000]");
    EXPECT_EQ(message({.current_x_mps = -11}), "current_x_mps -11 is out of range [-10, 10]");
    EXPECT_EQ(message({.current_z_mps = std::numeric_limits<double>::infinity()}),
              "current_z_mps inf is out of range [-10, 10]");
    EXPECT_EQ(message({.sea_level_m = std::numeric_limits<double>::quiet_NaN()}),
              "sea_level_m nan is out of range [-1000, 1000]");
    EXPECT_EQ(ocean.water_frame(), (WaterFrame{1, 2, 3}));
}

TEST(WaterFrame, IsRefusedWithAShore) {
    ShoreOptions shore = shore_of(41, 41, 10, [](double x, double) { return -12 + x * 0.05; });
    shore.resolution = 64;
    OceanOptions options = with_all();
    options.shore = shore;
    Ocean ocean({.cascades = 3, .resolution = 32, .wind_speed_mps = 8}, options);
    const auto message = [&](const WaterFrame& water) { return message_of([&] { ocean.set_water_frame(water); }); };
    EXPECT_EQ(message({.sea_level_m = 1}), "WaterFrame::sea_level_m cannot be combined with OceanOptions::shore");
    EXPECT_EQ(message({.current_z_mps = 1}),
              "WaterFrame::current_x_mps and current_z_mps cannot be combined with OceanOptions::shore");
    ocean.set_water_frame({});
}

}  // namespace
}  // namespace pelagic
