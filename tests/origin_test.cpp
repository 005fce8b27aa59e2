// Shifts of the world's origin: queries, dynamic waves, spray and bodies are those of a world without a
// shift at the same places of the sea, and frames keep their bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/quadtree/camera.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/exact_water.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/sim/surface_ray.hpp"
#include "pelagic/sim/water_query.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/hull_meshes.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/query_points.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

struct OriginPlace {
    double x_m, z_m;
};
// Doubles near 1e7 m are 2e-9 m apart.
constexpr OriginPlace shifted_origins[] = {{2048, -4096}, {-123'456.75, 700'000.1}, {1e7, -1e7}};

const SeaState origin_sea{.cascades = 3, .resolution = 32, .wind_speed_mps = 11};
const WaterFrame origin_tide{.sea_level_m = 1.5, .current_x_mps = 1.37, .current_z_mps = -0.83};
constexpr double origin_time_s = 7.25;

OceanOptions origin_options(Isa isa = choose_isa()) {
    return {.executor = make_serial_executor(), .isa = isa, .queries = true, .velocities = Velocities::drawn,
            .depth = true, .foam = true};
}

/// The points' places of the sea, in coordinates with another origin.
Points seen_from(const Points& points, OriginPlace origin) {
    Points moved = points;
    for (double& x : moved.x) x -= origin.x_m;
    for (double& z : moved.z) z -= origin.z_m;
    return moved;
}

double largest_gap(std::span<const float> a, std::span<const float> b) {
    EXPECT_EQ(a.size(), b.size());
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::fabs(static_cast<double>(a[i]) - static_cast<double>(b[i])));
    return largest;
}

/// Metres, metres per second, and shares of 1.
constexpr double same_within = 1e-5;

void expect_same(const Samples& found, const Samples& expected, double bound) {
    for (const auto member : {&Samples::height, &Samples::normal_x, &Samples::normal_y, &Samples::normal_z,
                              &Samples::velocity_x, &Samples::velocity_y, &Samples::velocity_z, &Samples::foam})
        EXPECT_LE(largest_gap(found.*member, expected.*member), bound);
    EXPECT_EQ(found.converged, expected.converged);
}

Samples samples_at(const Frame& frame, const Points& points, const SurfaceQueryOptions& options = {}) {
    Samples samples(points.x.size(), true, true);
    SurfaceQuery(frame, options).sample(points.view(), samples.view());
    return samples;
}

TEST(Origin, QueriesAgreeWithAndWithoutAShift) {
    const Points points = random_points(500, 300, 1);
    for (const Isa isa : isas_here())
        for (const Interpolation interpolation : {Interpolation::linear, Interpolation::cubic}) {
            Ocean still(origin_sea, origin_options(isa)), shifted(origin_sea, origin_options(isa));
            still.set_water_frame(origin_tide);
            shifted.set_water_frame(origin_tide);
            const Frame& before = still.frame_at(origin_time_s);
            const Samples expected = samples_at(before, points, {.interpolation = interpolation});
            for (const OriginPlace& origin : shifted_origins) {
                SCOPED_TRACE(std::string(name_of(isa)) + ", origin " + std::to_string(origin.x_m));
                shifted.set_origin(origin.x_m, origin.z_m);
                const Frame& after = shifted.frame_at(origin_time_s);
                EXPECT_EQ(hash_of(after), hash_of(before));
                EXPECT_EQ(foam_hash_of(after), foam_hash_of(before));
                expect_same(samples_at(after, seen_from(points, origin), {.interpolation = interpolation}), expected,
                            same_within);
                // The points themselves are elsewhere.
                EXPECT_GT(largest_gap(samples_at(after, points).height, expected.height), 0.3);
            }
        }
}

// Multiples of 2^-20 m at whole origins are doubles, so that no result has another bit.
TEST(Origin, ExactPositionsGiveTheSameBits) {
    Points points = random_points(500, 300, 2);
    for (auto* const all : {&points.x, &points.z})
        for (double& at : *all) at = std::round(at * 0x1p20) * 0x1p-20;
    Ocean ocean(origin_sea, origin_options());
    const Samples expected = samples_at(ocean.frame_at(origin_time_s), points);
    ocean.set_origin(1e7, -9'876'543);
    EXPECT_EQ(samples_at(ocean.frame_at(origin_time_s), seen_from(points, {1e7, -9'876'543})), expected);
}

struct WaterArrays {
    explicit WaterArrays(std::size_t count)
        : depth(count), pressure(count), velocity{depth, depth, depth}, acceleration{depth, depth, depth} {}
    WaterSamples view() {
        return {depth,       pressure,        velocity[0],     velocity[1],
                velocity[2], acceleration[0], acceleration[1], acceleration[2]};
    }
    std::vector<float> depth, pressure, velocity[3], acceleration[3];
};

void expect_same_water(const WaterArrays& found, const WaterArrays& expected) {
    EXPECT_LE(largest_gap(found.depth, expected.depth), same_within);
    // a float of some 1e5 Pa has a step of 0.008
    EXPECT_LE(largest_gap(found.pressure, expected.pressure), same_within * 1025 * 9.81);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(largest_gap(found.velocity[axis], expected.velocity[axis]), same_within);
        EXPECT_LE(largest_gap(found.acceleration[axis], expected.acceleration[axis]), same_within);
    }
}

TEST(Origin, WaterBelowTheSurfaceAgrees) {
    const Points points = random_points(300, 300, 3);
    std::vector<double> y;
    for (std::size_t i = 0; i < points.x.size(); ++i) y.push_back(0.5 - 0.03 * static_cast<double>(i));
    Ocean ocean(origin_sea, origin_options());
    ExactWater exact(origin_sea, {.water_frame = origin_tide});
    ocean.set_water_frame(origin_tide);
    exact.set_time(origin_time_s);
    WaterArrays expected(y.size()), expected_exact(y.size());
    Samples expected_surface(y.size());
    WaterQuery(ocean.frame_at(origin_time_s)).sample({points.x, y, points.z}, expected.view());
    exact.sample({points.x, y, points.z}, expected_exact.view());
    exact.sample_surface(points.view(), expected_surface.view());
    for (const OriginPlace& origin : shifted_origins) {
        SCOPED_TRACE(origin.x_m);
        const Points moved = seen_from(points, origin);
        WaterArrays found(y.size());
        ocean.set_origin(origin.x_m, origin.z_m);
        WaterQuery(ocean.frame_at(origin_time_s)).sample({moved.x, y, moved.z}, found.view());
        expect_same_water(found, expected);
        exact.set_origin(origin.x_m, origin.z_m);
        exact.sample({moved.x, y, moved.z}, found.view());
        expect_same_water(found, expected_exact);
        Samples surface(y.size());
        exact.sample_surface(moved.view(), surface.view());
        expect_same(surface, expected_surface, same_within);
        // A copy at another time, and its way back.
        exact.at(3).at(origin_time_s).sample({moved.x, y, moved.z}, found.view());
        expect_same_water(found, expected_exact);
    }
}

TEST(Origin, RaysMeetTheSameWater) {
    Ocean ocean(origin_sea, origin_options());
    ocean.set_water_frame(origin_tide);
    std::vector<SurfaceHit> expected;
    const auto hit = [&](OriginPlace origin, int number) {
        const SurfaceRay ray{.origin_m = {13.7 * number - origin.x_m, 9, -5.3 * number - origin.z_m},
                             .direction = {0.3, -0.2, 0.05 * number},
                             .reach_m = 400};
        return first_hit(SurfaceQuery(ocean.complete(), 1e-6), ray);
    };
    ocean.frame_at(origin_time_s);
    for (int number = 0; number < 20; ++number) {
        const auto found = hit({0, 0}, number);
        ASSERT_TRUE(found);
        expected.push_back(*found);
    }
    for (const OriginPlace& origin : shifted_origins) {
        ocean.set_origin(origin.x_m, origin.z_m);
        ocean.frame_at(origin_time_s);
        for (int number = 0; number < 20; ++number) {
            const auto found = hit(origin, number);
            ASSERT_TRUE(found);
            const SurfaceHit& before = expected[static_cast<std::size_t>(number)];
            EXPECT_NEAR(found->distance_m, before.distance_m, same_within) << origin.x_m << ", " << number;
            EXPECT_NEAR(found->position_m[0], before.position_m[0] - origin.x_m, same_within);
            EXPECT_NEAR(found->position_m[1], before.position_m[1], same_within);
            EXPECT_NEAR(found->position_m[2], before.position_m[2] - origin.z_m, same_within);
        }
    }
}

TEST(Origin, AShoreKeepsItsPlace) {
    OceanOptions options = origin_options();
    options.shore = bay();
    Ocean ocean({.cascades = 3, .resolution = 32, .wind_speed_mps = 8}, options);
    const Points points = random_points(400, 140, 4);
    const Frame& before = ocean.frame_at(origin_time_s);
    const Samples expected = samples_at(before, points);
    const std::uint64_t shore = shore_hash_of(before);
    for (const OriginPlace& origin : shifted_origins) {
        SCOPED_TRACE(origin.x_m);
        ocean.set_origin(origin.x_m, origin.z_m);
        const Frame& after = ocean.frame_at(origin_time_s);
        EXPECT_EQ(shore_hash_of(after), shore);
        expect_same(samples_at(after, seen_from(points, origin)), expected, same_within);
    }
    ocean.set_water_frame({});
    EXPECT_EQ(ocean.water_frame().origin_x_m, 1e7);
    EXPECT_EQ(message_of([&] { ocean.set_water_frame({.sea_level_m = 1}); }),
              "WaterFrame::sea_level_m cannot be combined with OceanOptions::shore");
}

// Commands wait at each shift: given before it, in the old coordinates. Sources and the grid stay, too.
TEST(Origin, DynamicWavesKeepTheirPlaces) {
    OceanOptions options = origin_options();
    options.dynamic_waves = DynamicWavesOptions{.resolution = 64, .side_m = 32, .border_m = 4};
    Ocean still(origin_sea, options), shifted(origin_sea, options);
    std::uint32_t moored = 0;
    OriginPlace origin{0, 0};
    for (int tick = 0; tick < 60; ++tick) {
        for (Ocean* const ocean : {&still, &shifted}) {
            const OriginPlace from = ocean == &still ? OriginPlace{0, 0} : origin;
            DynamicWaves& waves = ocean->dynamic_waves();
            ocean->set_water_frame(origin_tide);
            const double at_s = tick / 60.0;
            const double drift_x = origin_tide.current_x_mps * at_s, drift_z = origin_tide.current_z_mps * at_s;
            waves.set_center(drift_x - from.x_m, drift_z - from.z_m);
            if (tick == 0)
                moored = waves.add_source({.x_m = 3, .z_m = -2, .radius_m = 1, .height_m = -0.3, .velocity_x_mps = 2});
            if (tick == 40)
                waves.set_source(moored, {.x_m = 4 - from.x_m, .z_m = 1 - from.z_m, .radius_m = 1, .height_m = -0.2});
            if (tick % 7 == 0)
                waves.add_impulse({.mode = Disturbance::Mode::impulse,
                                   .x_m = 0.1 * tick - from.x_m,
                                   .z_m = -3 - from.z_m,
                                   .radius_m = 0.7,
                                   .height_m = 0.2});
        }
        if (tick % 14 == 0) {
            origin = shifted_origins[static_cast<std::size_t>(tick / 14) % 3];
            shifted.set_origin(origin.x_m, origin.z_m);
        }
        still.frame_at(tick / 60.0);
        shifted.frame_at(tick / 60.0);
    }
    const DynamicWavesView &expected = still.dynamic_waves().view(), &found = shifted.dynamic_waves().view();
    EXPECT_EQ(found.first_x, expected.first_x);
    EXPECT_EQ(found.first_z, expected.first_z);
    EXPECT_GT(*std::max_element(expected.height_m.begin(), expected.height_m.end()), 0.03f);
    EXPECT_LE(largest_gap(found.height_m, expected.height_m), same_within);
    const Points points = random_points(300, 14, 5);
    expect_same(samples_at(shifted.complete(), seen_from(points, origin)), samples_at(still.complete(), points),
                same_within);
}

TEST(Origin, SprayKeepsItsPlace) {
    const SeaState storm{.cascades = 3, .resolution = 64, .wind_speed_mps = 24};
    OceanOptions options = origin_options();
    options.spray = SprayOptions{};
    Ocean still(storm, options), shifted(storm, options);
    const OriginPlace origin = shifted_origins[2];
    SprayEmitter bow{.time_s = 50, .x_m = 1, .y_m = 2, .velocity_x_mps = 3, .count = 5};
    for (Ocean* const ocean : {&still, &shifted}) {
        ocean->set_water_frame(origin_tide);
        ocean->emit({&bow, 1});
        ocean->set_spray_center(60, 40);
        ocean->frame_at(49.9);
    }
    shifted.set_origin(origin.x_m, origin.z_m);
    bow.time_s = 50.01;
    still.emit({&bow, 1});
    bow.x_m -= origin.x_m;
    bow.z_m -= origin.z_m;
    shifted.emit({&bow, 1});
    for (const double t : {49.97, 50.05, 50.1}) {
        const auto expected = still.frame_at(t).droplets, found = shifted.frame_at(t).droplets;
        ASSERT_EQ(found.size(), expected.size());
        ASSERT_GT(found.size(), 100u);
        for (std::size_t i = 0; i < found.size(); ++i) {
            // The emitters' random numbers do not depend on the position.
            EXPECT_NEAR(found[i].x_m + origin.x_m, expected[i].x_m, 1e-7) << i;
            EXPECT_EQ(found[i].y_m, expected[i].y_m) << i;
            EXPECT_NEAR(found[i].z_m + origin.z_m, expected[i].z_m, 1e-7) << i;
        }
    }
}

/// A boat with a wake and an engine in waves, which the origin may follow.
struct ShiftedBoat {
    ShiftedBoat()
        : ocean(origin_sea,
                {.executor = make_serial_executor(),
                 .queries = true,
                 .depth = true,
                 .dynamic_waves = DynamicWavesOptions{.resolution = 128, .side_m = 64, .border_m = 12}}),
          bodies(make_serial_executor(), &ocean.dynamic_waves()) {
        const Hull hull(boat_mesh(6, 2.2, 1.2), {.mass_kg = 3000});
        bodies.add(hull, hull.at_rest(2, -3));
        ocean.set_water_frame(origin_tide);
        HullState state = bodies.state(1);
        state.position_m.y += origin_tide.sea_level_m;
        bodies.set_state(1, state);
        HullInputs engine;
        engine.force.force_n = {4000, 0, 1500};
        bodies.set_inputs(1, engine);
        ocean.schedule(0);
    }
    void advance(bool shifts) {
        const Frame& frame = ocean.complete();
        const OriginPlace arrived{frame.water_frame.origin_x_m, frame.water_frame.origin_z_m};
        if (arrived.x_m != origin.x_m || arrived.z_m != origin.z_m)
            bodies.shift(origin.x_m - arrived.x_m, origin.z_m - arrived.z_m);
        origin = arrived;
        bodies.press(frame, 1.0 / 60);
        ocean.dynamic_waves().set_center(bodies.state(1).position_m.x, bodies.state(1).position_m.z);
        if (shifts) {
            const OriginPlace& next = shifted_origins[static_cast<std::size_t>(tick / 100) % 3];
            ocean.set_origin(next.x_m, next.z_m);
        }
        ocean.schedule(++tick / 60.0);
        bodies.step(frame, 1.0 / 60);
    }
    glm::dvec3 place_m() const { return bodies.state(1).position_m + glm::dvec3(origin.x_m, 0, origin.z_m); }

    Ocean ocean;
    FloatingBodies bodies;
    OriginPlace origin{0, 0};
    int tick = 0;
};

// Roundings of 2e-9 m at each shift grow with the boat's motion, to 3e-7 m in ten seconds.
TEST(Origin, AShiftedBodyWithAWakeFollowsTheSamePath) {
    ShiftedBoat still, shifted;
    double largest = 0;
    for (int tick = 0; tick < 600; ++tick) {
        still.advance(false);
        shifted.advance(tick % 100 == 50);
        largest = std::max(largest, glm::length(shifted.place_m() - still.place_m()));
    }
    std::printf("the paths differ by at most %g m\n", largest);
    EXPECT_LE(largest, 1e-6);
    EXPECT_GT(glm::length(still.place_m() - glm::dvec3(2, 0, -3)), 10);
    EXPECT_EQ(shifted.origin.x_m, shifted_origins[2].x_m);
    EXPECT_LE(largest_gap(shifted.ocean.complete().dynamic_waves.height_m,
                          still.ocean.complete().dynamic_waves.height_m),
              same_within);
}

// A rollback across a shift, as docs/integrations/engine.md has it.
TEST(Origin, ASaveIsRestoredWithItsOrigin) {
    constexpr int saved_tick = 20;
    ShiftedBoat boat;
    const auto run = [&] {
        for (int tick = 0; tick < 20; ++tick) boat.advance(tick == 5);
        return hash_of(boat.ocean.complete().dynamic_waves);
    };
    for (int tick = 0; tick < saved_tick; ++tick) boat.advance(false);
    boat.ocean.complete();
    const auto waves = boat.ocean.dynamic_waves().save_state(), boats = boat.bodies.save_state();
    const std::uint64_t expected = run();
    const glm::dvec3 place_m = boat.place_m();
    EXPECT_EQ(boat.origin.x_m, shifted_origins[0].x_m);

    boat.ocean.set_origin(0, 0);
    boat.ocean.dynamic_waves().restore_state(waves);
    boat.bodies.restore_state(boats);
    boat.ocean.frame_at(saved_tick / 60.0);
    boat.origin = {0, 0};
    boat.tick = saved_tick;
    EXPECT_EQ(run(), expected);
    EXPECT_EQ(boat.place_m(), place_m);
}

TEST(Origin, ABodyThatWouldBeOutOfRangeStays) {
    ShiftedBoat boat;
    const glm::dvec3 before = boat.place_m();
    EXPECT_EQ(message_of([&] { boat.bodies.shift(2e8, 0); }),
              "body 1: the hull's position_m is out of range [-1e8, 1e8]");
    EXPECT_EQ(boat.place_m(), before);
}

// Frames in flight have the origin of their schedule, and a new level keeps it.
TEST(Origin, IsThatOfTheSchedule) {
    Ocean ocean(origin_sea, origin_options());
    ocean.set_origin(1, 2);
    ocean.schedule(0);
    ocean.set_origin(3, 4);
    ocean.set_water_frame({.sea_level_m = 2});
    EXPECT_EQ(ocean.complete().water_frame.origin_x_m, 1);
    const WaterFrame& next = ocean.frame_at(0).water_frame;
    EXPECT_EQ(next.origin_x_m, 3);
    EXPECT_EQ(next.origin_z_m, 4);
    EXPECT_EQ(next.sea_level_m, 2);
}

TEST(Origin, InvalidValuesAreNamedAndChangeNothing) {
    Ocean ocean(origin_sea, origin_options());
    ExactWater exact(origin_sea);
    ocean.set_origin(5, 6);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(message_of([&] { ocean.set_origin(2e8, 0); }), "origin_x_m 200000000 is out of range [-1e8, 1e8]");
    EXPECT_EQ(message_of([&] { ocean.set_origin(0, nan); }), "origin_z_m nan is out of range [-1e8, 1e8]");
    EXPECT_EQ(message_of([&] { exact.set_origin(0, -2e8); }), "origin_z_m -200000000 is out of range [-1e8, 1e8]");
    EXPECT_EQ(ocean.water_frame().origin_x_m, 5);
    EXPECT_EQ(ocean.water_frame().origin_z_m, 6);
}

// The mesh's vertices stay for shifts by multiples of its steps.
TEST(Origin, SelectionShiftsByStepsOfTheMesh) {
    const Camera here{.position_m = {3, 2, 5}, .target_m = {60, 0, 40}};
    Camera there = here;
    for (glm::dvec3* const point : {&there.position_m, &there.target_m}) *point -= glm::dvec3(1e6 * 16, 0, -1e6 * 16);
    Selection first(quadtree_preset_named("high")->options(2048)), second(first.options());
    const glm::dmat4 here_view = here.clip_from_world(1.5), there_view = there.clip_from_world(1.5);
    const FrameBounds bounds{-1, 1.5, 2, 2};
    const DrawList& expected = first.select({.viewer_m = here.position_m, .views = {&here_view, 1}, .bounds = bounds});
    const DrawList& found = second.select({.viewer_m = there.position_m, .views = {&there_view, 1}, .bounds = bounds});
    EXPECT_EQ(found.instances, expected.instances);
    EXPECT_EQ(glm::dvec2(found.grid.corner) * found.grid.step_m,
              glm::dvec2(expected.grid.corner) * expected.grid.step_m + glm::dvec2(-16e6, 16e6));
}

}  // namespace
}  // namespace pelagic
