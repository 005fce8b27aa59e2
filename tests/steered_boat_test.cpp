// The window's boat, and the position of a click on the water.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>
#include <sstream>
#include <string>

#include "pelagic/gl/meshes/boat.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/tests/test_paths.hpp"
#include "pelagic/viewer/picked_place.hpp"
#include "pelagic/viewer/steered_boat.hpp"
#include "pelagic/viewer/view_camera.hpp"

namespace pelagic::viewer {
namespace {

using std::numbers::pi;

/// Ripples of millimetres.
const SeaState level{.resolution = 16, .patch_size_m = 100, .wind_speed_mps = 0.05};

/// A boat on dynamic waves, as in the window.
struct Voyage {
    Ocean ocean;
    double time_s = 0;
    SteeredBoat boat{ocean.frame_at(0), {0, 0}, 0.5};

    explicit Voyage(const SeaState& sea = level, bool makes_waves = true)
        : ocean(sea, {.executor = make_serial_executor(),
                      .queries = true,
                      .depth = true,
                      .dynamic_waves = DynamicWavesOptions{.resolution = 128, .side_m = 64}}) {
        if (makes_waves) boat.float_on(ocean.dynamic_waves());
    }

    /// \param frame_s  time between frames
    template <class EachFrame>
    void go(double seconds, const Helm& helm, double frame_s, const EachFrame& each_frame) {
        for (const double end_s = time_s + seconds; time_s < end_s;) {
            time_s += frame_s;
            const Frame& frame = ocean.frame_at(time_s);
            boat.advance(frame, frame_s, helm);
            each_frame(frame);
            ocean.dynamic_waves().set_center(boat.place_m().x, boat.place_m().y);
        }
    }
    void go(double seconds, const Helm& helm, double frame_s = 1 / 30.) {
        go(seconds, helm, frame_s, [](const Frame&) {});
    }
    double height_m() const { return boat.state().position_m.y - boat.hull().afloat().height_m; }
};

// The paint's waterline is at y = 0 of the boat, and its deck is level.
TEST(SteeredBoat, FloatsAtItsWaterlineAndLevel) {
    Voyage voyage;
    double deepest = 0, highest = 0, steepest = 0;
    voyage.go(25, {}, 1 / 30., [&](const Frame& frame) {
        if (frame.time_s < 20) return;
        deepest = std::min(deepest, sample(frame.dynamic_waves, 0, 0).height_m);
        highest = std::max(highest, std::fabs(voyage.height_m()));
        steepest = std::max(steepest, std::fabs(voyage.boat.world_from_boat()[0].y));
    });
    EXPECT_NEAR(voyage.boat.world_from_boat()[3].y, 0, 0.03);
    EXPECT_LT(steepest, 0.02);
    // It presses the water down, and is not lowered by that.
    EXPECT_LT(deepest, -0.3);
    EXPECT_LT(highest, 0.01);
}

// Below 4 m/s a boat of this length pushes its bow wave, and above it planes.
TEST(SteeredBoat, PlanesAndStopsByItself) {
    Voyage voyage;
    voyage.go(30, {.thrust = 0.5});
    EXPECT_GT(voyage.boat.speed_mps(), 2.5);
    EXPECT_LT(voyage.boat.speed_mps(), 4);
    EXPECT_GT(voyage.height_m(), -0.2);
    voyage.go(40, {.thrust = 1});
    EXPECT_GT(voyage.boat.speed_mps(), 6.5);
    EXPECT_GT(voyage.height_m(), -0.02) << "out of its trough, up to its height at rest";
    // It wanders a little without a helmsman, but the skeg keeps it from turning.
    EXPECT_NEAR(std::atan2(voyage.boat.place_m().y, voyage.boat.place_m().x), 0.5, 0.2);
    voyage.go(10, {});
    EXPECT_LT(voyage.boat.speed_mps(), 3);
    EXPECT_GT(voyage.boat.speed_mps(), 0);
    voyage.go(20, {.thrust = -1});
    EXPECT_LT(voyage.boat.speed_mps(), -1);
}

// Starboard is +z for a boat that heads along +x.
TEST(SteeredBoat, TurnsToStarboardOnlyWhileMoving) {
    Voyage voyage;
    voyage.go(5, {.rudder = 1});
    EXPECT_NEAR(voyage.boat.heading_rad(), 0.5, 1e-3);
    voyage.go(15, {.thrust = 0.6, .rudder = 1});
    double turned = 0, last = voyage.boat.heading_rad(), max_x = -1e9, min_x = 1e9;
    while (turned < 2 * pi && voyage.time_s < 120) {
        voyage.go(1 / 30., {.thrust = 0.6, .rudder = 1});
        turned += std::remainder(voyage.boat.heading_rad() - last, 2 * pi);
        last = voyage.boat.heading_rad();
        max_x = std::max(max_x, voyage.boat.place_m().x);
        min_x = std::min(min_x, voyage.boat.place_m().x);
    }
    EXPECT_GT(turned, 2 * pi);
    // Small boats turn in about two to five lengths.
    EXPECT_GT(max_x - min_x, 1.8 * gl::Boat::length_m);
    EXPECT_LT(max_x - min_x, 5 * gl::Boat::length_m);
}

// At 12 frames a second a boat takes the way that it takes at 90.
TEST(SteeredBoat, PathHardlyDependsOnTheFrameRate) {
    Voyage slow, fast;
    for (Voyage* voyage : {&slow, &fast}) {
        const double frame_s = voyage == &slow ? 1 / 12. : 1 / 90.;
        voyage->go(15, {.thrust = 0.4}, frame_s);
        voyage->go(15, {.thrust = 0.4, .rudder = 0.3}, frame_s);
    }
    const double way = glm::length(fast.boat.place_m());
    RecordProperty("apart", std::to_string(glm::length(slow.boat.place_m() - fast.boat.place_m()) / way));
    EXPECT_GT(way, 30);
    // Thrust and rudder are constant over a step of up to 0.08 s, which moves the turn. The
    // difference was 5.8 %.
    EXPECT_LT(glm::length(slow.boat.place_m() - fast.boat.place_m()), 0.1 * way);
}

// A boat under way at half thrust in a rough sea rolls by the waves of the wind, not by its own. The
// wake slows the boat, which then meets other waves, so seeds are compared together.
TEST(SteeredBoat, DoesNotRollInItsOwnWake) {
    SeaState sea = sea_preset_named("rough")->sea;
    sea.resolution = 64;
    const auto largest_heels = [&](bool makes_waves) {
        double sum = 0;
        for (sea.seed = 1; sea.seed <= 4; ++sea.seed) {
            Voyage voyage(sea, makes_waves);
            double least_upright = 1;
            voyage.go(60, {.thrust = 0.5}, 1 / 30., [&](const Frame&) {
                least_upright = std::min(least_upright, voyage.boat.world_from_boat()[1].y);
            });
            std::printf("seed %u, %s: %.1f degrees\n", sea.seed, makes_waves ? "wake" : "no wake",
                        std::acos(least_upright) * 180 / pi);
            sum += std::acos(least_upright) * 180 / pi;
        }
        return sum / 4;
    };
    const double without = largest_heels(false), with = largest_heels(true);
    RecordProperty("heel_without_deg", std::to_string(without));
    RecordProperty("heel_with_deg", std::to_string(with));
    EXPECT_GT(without, 5);
    // A hull that slid down the wave ahead of its pressure rolled twice as far.
    EXPECT_LT(with, 1.25 * without);
}

// There are waves behind the boat and none ahead of it.
TEST(SteeredBoat, LeavesAWake) {
    Voyage voyage;
    voyage.go(16, {.thrust = 1});
    const Frame& frame = voyage.ocean.complete();
    const glm::dvec2 ahead(std::cos(0.5), std::sin(0.5));
    const auto max_between = [&](double from_m, double to_m) {
        double max = 0;
        for (double along = from_m; along < to_m; along += 0.25)
            for (double across = -8; across < 8; across += 0.25) {
                const glm::dvec2 at = voyage.boat.place_m() + along * ahead + across * glm::dvec2(-ahead.y, ahead.x);
                max = std::max(max, std::fabs(sample(frame.dynamic_waves, at.x, at.y).height_m));
            }
        return max;
    };
    EXPECT_GT(max_between(-18, -8), 0.1);
    EXPECT_LT(max_between(8, 18), 0.03);
}

// examples/boat/boat.obj, in millimetres.
TEST(SteeredBoat, HasTheHullOfTheExampleFile) {
    std::ifstream file(in_sources("examples/boat/boat.obj"));
    const gl::Boat::Surface hull = gl::Boat::hull();
    std::size_t vertices = 0, triangles = 0;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string keyword;
        words >> keyword;
        if (keyword == "v") {
            glm::dvec3 at;
            words >> at.x >> at.y >> at.z;
            ASSERT_LT(vertices, hull.vertices.size());
            EXPECT_LT(glm::length(at - hull.vertices[vertices++]), 1e-3);
        } else if (keyword == "f") {
            std::array<std::uint32_t, 3> corners{};
            for (std::uint32_t& corner : corners) words >> corner, --corner;
            ASSERT_LT(triangles, hull.triangles.size());
            EXPECT_EQ(corners, hull.triangles[triangles++]);
        }
    }
    EXPECT_EQ(vertices, hull.vertices.size());
    EXPECT_EQ(triangles, hull.triangles.size());
}

// A boat that is removed leaves the water level.
TEST(SteeredBoat, LeavesTheWater) {
    Voyage voyage;
    voyage.go(15, {});
    voyage.boat.leave_water();
    for (int i = 0; i < 40 * 60; ++i) voyage.ocean.frame_at(voyage.time_s += 1 / 60.);
    EXPECT_LT(std::fabs(sample(voyage.ocean.complete().dynamic_waves, 0, 0).height_m), 0.01);
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
