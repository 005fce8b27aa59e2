// The window's boat on analytic waves and on dynamic waves, and the position of a click on the
// water.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/viewer/picked_place.hpp"
#include "pelagic/viewer/steered_boat.hpp"
#include "pelagic/viewer/view_camera.hpp"

namespace pelagic::viewer {
namespace {

constexpr double pi = 3.14159265358979323846;

double calm(double, double) { return 0; }

// Thrust equals drag: 1.6 = 1.6 / 6 (0.9 v^2 / 6 + 0.1 v) at v = 6.
TEST(SteeredBoat, ReachesItsTopSpeedAndStopsByItself) {
    SteeredBoat boat({0, 0}, 0.5);
    double before = 0;
    for (int i = 0; i < 60 * 60; ++i) {
        boat.step(1 / 60., {.thrust = 1}, calm, 0);
        ASSERT_GT(boat.speed_mps(), before);
        before = boat.speed_mps() - 1e-12;
    }
    EXPECT_NEAR(boat.speed_mps(), SteeredBoat::top_speed_mps, 1e-3);
    EXPECT_NEAR(std::atan2(boat.place_m().y, boat.place_m().x), 0.5, 1e-9);
    for (int i = 0; i < 60 * 240; ++i) boat.step(1 / 60., {}, calm, 0);
    EXPECT_NEAR(boat.speed_mps(), 0, 0.1);
    EXPECT_GE(boat.speed_mps(), 0);
}

TEST(SteeredBoat, PathDoesNotDependOnTheFrameRate) {
    SteeredBoat slow({0, 0}, 0), fast({0, 0}, 0);
    const Helm helm{.thrust = 0.8, .rudder = 0.3};
    for (int i = 0; i < 150; ++i) slow.step(0.1, helm, calm, 0);
    for (int i = 0; i < 1800; ++i) fast.step(1 / 120., helm, calm, 0);
    // After a turn of 80 m; both take steps of 1/120 s.
    EXPECT_LT(glm::length(slow.place_m() - fast.place_m()), 1e-6);
}

// Starboard is +z for a boat that heads along +x. The radius of the circle is speed over turn rate.
TEST(SteeredBoat, TurnsToStarboardInACircleOnlyWhileMoving) {
    SteeredBoat boat({0, 0}, 0);
    for (int i = 0; i < 60; ++i) boat.step(1 / 60., {.rudder = 1}, calm, 0);
    EXPECT_EQ(boat.heading_rad(), 0);
    for (int i = 0; i < 60 * 20; ++i) boat.step(1 / 60., {.thrust = 0.5, .rudder = 1}, calm, 0);
    double max_x = -1e9, min_x = 1e9;
    const double from = boat.heading_rad();
    ASSERT_GT(from, 1);
    while (boat.heading_rad() < from + 2 * pi) {
        boat.step(1 / 60., {.thrust = 0.5, .rudder = 1}, calm, 0);
        max_x = std::max(max_x, boat.place_m().x);
        min_x = std::min(min_x, boat.place_m().x);
    }
    EXPECT_NEAR(max_x - min_x, 22, 0.5);
}

// On a plane of water, a boat lies in the plane with its own axes.
TEST(SteeredBoat, LiesInThePlaneOfTheWater) {
    const double heading = 0.7, along = 0.12, across = -0.07;
    const glm::dvec2 forward(std::cos(heading), std::sin(heading)), starboard(-forward.y, forward.x);
    SteeredBoat boat({12, -5}, heading);
    const auto plane = [&](double x, double z) {
        const glm::dvec2 from = glm::dvec2(x, z) - boat.place_m();
        return 0.4 + along * glm::dot(from, forward) + across * glm::dot(from, starboard);
    };
    boat.step(0.1, {}, plane, 0);
    EXPECT_NEAR(boat.height_m(), 0.4, 1e-9);
    EXPECT_NEAR(boat.pitch_rad(), std::atan(along), 1e-9);
    EXPECT_NEAR(boat.roll_rad(), std::atan(-across), 1e-9);
    const glm::dmat4 pose = boat.world_from_boat();
    const auto placed = [&](glm::dvec3 at) { return glm::dvec3(pose * glm::dvec4(at, 1)); };
    for (const glm::dvec3 at : {glm::dvec3(3, 0, 0), {-3, 0, 0}, {0, 0, 1.2}, {0, 0, -1.2}}) {
        const glm::dvec3 world = placed(at);
        // Pitch and roll are composed rotations.
        EXPECT_NEAR(world.y, plane(world.x, world.z), 0.01);
    }
    EXPECT_GT(glm::dot(placed({0, 1, 0}) - placed({0, 0, 0}), glm::dvec3(0, 1, 0)), 0.98);
    // The boat follows falling water slowly.
    boat.step(0.05, {}, calm, 0);
    EXPECT_GT(boat.height_m(), 0.3);
    for (int i = 0; i < 100; ++i) boat.step(0.05, {}, calm, 0);
    EXPECT_NEAR(boat.height_m(), 0, 1e-6);
    EXPECT_NEAR(boat.pitch_rad(), 0, 1e-5);
}

/// A boat on dynamic waves, as in the window: 30 frames a second, on ripples of millimetres.
struct Voyage {
    Ocean ocean{{.resolution = 16, .patch_size_m = 100, .wind_speed_mps = 0.05},
                {.executor = make_serial_executor(),
                 .queries = true,
                 .dynamic_waves = DynamicWavesOptions{.resolution = 128, .side_m = 64}}};
    SteeredBoat boat{{0, 0}, 0};
    std::uint32_t source = ocean.dynamic_waves().add_source(boat.press(0, 1 / 60.));
    double time_s = 0;

    template <class EachFrame>
    void go(double seconds, const Helm& helm, const EachFrame& each_frame) {
        for (const double end_s = time_s + seconds; time_s < end_s; time_s += 1 / 30.) {
            const Frame& frame = ocean.frame_at(time_s);
            const SurfaceQuery query(frame);
            const auto height = [&](double x, double z) {
                float height_m = 0;
                query.sample({{&x, 1}, {&z, 1}}, {.height_m = {&height_m, 1}});
                return static_cast<double>(height_m);
            };
            boat.step(1 / 30., helm, height, frame.time_s);
            each_frame(frame);
            ocean.dynamic_waves().set_source(source, boat.press(frame.time_s, 1 / 60.));
            ocean.dynamic_waves().set_center(boat.place_m().x, boat.place_m().y);
        }
    }
};

// The water under the boat is half a metre lower; the boat floats at the height without that
// depression.
TEST(SteeredBoat, IsNotLoweredByItsOwnDepression) {
    Voyage voyage;
    double deepest = 0, lowest = 0;
    voyage.go(20, {}, [&](const Frame& frame) {
        if (frame.time_s < 15) return;
        deepest = std::min(deepest, sample(frame.dynamic_waves, 0, 0).height_m);
        lowest = std::min(lowest, voyage.boat.height_m());
    });
    EXPECT_NEAR(deepest, -0.45, 0.05);
    EXPECT_GT(lowest, -0.03);
    // Also at 4 m/s ahead, where the depression does not quite have the shape of the pressure.
    double sunk = 0;
    voyage.go(20, {.thrust = 0.5}, [&](const Frame& frame) {
        if (frame.time_s > 30) sunk = std::min(sunk, voyage.boat.height_m());
    });
    EXPECT_GT(voyage.boat.speed_mps(), 4);
    EXPECT_GT(sunk, -0.2);
}

// There are waves behind the boat and none ahead of it.
TEST(SteeredBoat, LeavesAWake) {
    Voyage voyage;
    voyage.go(12, {.thrust = 1}, [](const Frame&) {});
    const Frame& frame = voyage.ocean.complete();
    const auto max_between = [&](double from_m, double to_m) {
        double max = 0;
        for (double x = from_m; x < to_m; x += 0.25)
            for (double z = -8; z < 8; z += 0.25)
                max = std::max(max, std::fabs(sample(frame.dynamic_waves, voyage.boat.place_m().x + x, z).height_m));
        return max;
    };
    EXPECT_GT(max_between(-18, -8), 0.1);
    EXPECT_LT(max_between(8, 18), 0.03);
}

// The camera's matrix projects the position of a click to the clicked pixel.
TEST(PickedPlace, ProjectsToTheClickedPixel) {
    Ocean ocean({.resolution = 64, .patch_size_m = 100, .wind_speed_mps = 8},
                {.executor = make_serial_executor(), .queries = true});
    const SurfaceQuery query(ocean.frame_at(2));
    const glm::dvec2 window(1280, 720);
    const Camera camera{.position_m = {3, 7, -2}, .target_m = {30, 1, 11}, .vertical_view_rad = 0.9};
    for (const glm::dvec2 pixel : {glm::dvec2(640, 400), {100, 700}, {1200, 500}, {333, 555}}) {
        const auto place = picked_place(query, camera, pixel, window, 500);
        ASSERT_TRUE(place);
        float height = 0;
        query.sample({{&place->x, 1}, {&place->y, 1}}, {.height_m = {&height, 1}});
        const glm::dvec4 clip =
            camera.clip_from_world(window.x / window.y) * glm::dvec4(place->x, height, place->y, 1);
        EXPECT_NEAR((clip.x / clip.w + 1) / 2 * window.x, pixel.x, 0.5);
        EXPECT_NEAR((1 - clip.y / clip.w) / 2 * window.y, pixel.y, 0.5);
    }
    EXPECT_FALSE(picked_place(query, camera, {640, 5}, window, 500));
}

// A camera that follows a boat keeps it at the same position in the image.
TEST(ViewCamera, FollowsABoat) {
    for (const auto mode : {ViewCamera::Mode::orbit, ViewCamera::Mode::fly}) {
        ViewCamera camera({.position_m = {0, 5, 0}, .target_m = {100, 0, 0}});
        camera.set_mode(mode);
        camera.look_at({20, 1, 15});
        EXPECT_LT(glm::length(camera.camera().target_m - glm::dvec3(20, 1, 15)), 1e-9);
        EXPECT_EQ(camera.camera().position_m, glm::dvec3(0, 5, 0));
        camera.go_along({3, -4});
        EXPECT_LT(glm::length(camera.camera().target_m - glm::dvec3(23, 1, 11)), 1e-9);
        EXPECT_EQ(camera.camera().position_m, glm::dvec3(3, 5, -4));
    }
}

}  // namespace
}  // namespace pelagic::viewer
