// Boxes make wakes and respond to the wakes of others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "pelagic/examples/buoyancy/box_wake.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic::buoyancy {
namespace {

constexpr double step_s = 1.0 / 60;
constexpr double degree = std::numbers::pi / 180;

/// Waves of a millimetre, so that only the boxes move the water.
const SeaState still{.resolution = 16, .patch_size_m = 100, .wind_speed_mps = 0.05};

const BoxOptions launch{.length_m = 6, .height_m = 1.5, .beam_m = 2.5, .mass_kg = 6000, .centre_of_mass_m = -0.2};

glm::dquat heading(double angle_rad) {
    // A rotation from +x towards +z is about -y.
    return glm::dquat(std::cos(angle_rad / 2), 0, -std::sin(angle_rad / 2), 0);
}

/// Moves boxes on a grid of 64 m; `each_step` steers them.
template <class EachStep>
void sail(std::vector<FloatingBox>& boxes, double seconds, EachStep each_step) {
    Ocean ocean(still, {.executor = make_serial_executor(),
                        .queries = true,
                        .velocities = true,
                        .dynamic_waves = DynamicWavesOptions{.resolution = 128, .side_m = 64, .border_m = 12}});
    std::vector<BoxWake> wakes;
    for (const FloatingBox& box : boxes) wakes.emplace_back(ocean, box);
    HullWater hull;
    ocean.schedule(0);
    for (int i = 1; i <= seconds / step_s; ++i) {
        const Frame& frame = ocean.complete();
        for (std::size_t box = 0; box < boxes.size(); ++box) wakes[box].press(ocean, boxes[box], step_s);
        ocean.schedule(i * step_s);
        step(boxes, SurfaceQuery(frame), step_s, hull, wakes);
        each_step(i * step_s);
    }
    ocean.complete();
}

TEST(Wake, ReturnsTheHeadingOfABox) {
    FloatingBox box(launch);
    for (int angle = -179; angle <= 180; ++angle) {
        box.state().orientation = heading(angle * degree);
        EXPECT_NEAR(heading_rad(box.state()), angle * degree, 1e-12) << angle;
    }
}

TEST(Wake, ThePressureIsTheWaterThatTheBoxDisplaces) {
    const Disturbance press = pressure_of(FloatingBox(launch));
    double volume = 0;
    const double step = 0.01;
    for (double x = -3.5; x < 3.5; x += step)
        for (double z = -1.5; z < 1.5; z += step) volume -= shape_at(press, x, z) * step * step;
    EXPECT_NEAR(volume * water_density_kgpm3, launch.mass_kg, 1e-3 * launch.mass_kg);
}

// The depression of its own pressure supports the box and has no other effect, once the initial
// waves have left.
TEST(Wake, ABoxAtRestKeepsItsHeight) {
    std::vector<FloatingBox> boxes = {FloatingBox(launch)};
    double highest = 0;
    sail(boxes, 25, [&](double time_s) {
        if (time_s > 20) highest = std::max(highest, std::fabs(boxes[0].heave_m()));
    });
    // Bilinear texels of half a metre do not exactly represent the lower half of the ellipsoid,
    // which is 0.75 m deep.
    RecordProperty("highest_m", std::to_string(highest));
    EXPECT_LT(highest, 0.03);
    EXPECT_NEAR(boxes[0].displaced_kg() / launch.mass_kg, 1, 0.01);
}

// A launch passes at 4 m/s, 7 m from another launch, which heaves when the wake arrives.
TEST(Wake, APassingBoxMakesAnotherHeave) {
    const auto heave_of_the_other = [](bool goes_by) {
        std::vector<FloatingBox> boxes = {FloatingBox(launch)};
        if (goes_by) boxes.emplace_back(launch);
        if (goes_by) boxes[1].state().position_m = {-16, boxes[1].floating_height_m(), 7};
        std::vector<double> heave;
        sail(boxes, 14, [&](double time_s) {
            heave.push_back(boxes[0].heave_m());
            if (!goes_by) return;
            // Towed along +x, after five seconds in which both have come to rest.
            boxes[1].state().velocity_mps.x = time_s < 5 ? 0 : 4;
            boxes[1].state().velocity_mps.z = 0;
            boxes[1].state().orientation = heading(0);
            boxes[1].state().spin_radps = {};
        });
        return heave;
    };
    const std::vector<double> with = heave_of_the_other(true), without = heave_of_the_other(false);
    double before = 0, after = 0;
    for (std::size_t i = 0; i < with.size(); ++i) {
        const double time_s = static_cast<double>(i) * step_s, moved = std::fabs(with[i] - without[i]);
        // 7 m beside the boat's track, a wake of 19.47 degrees is 20 m behind the boat. The boat
        // sets out at 5 s, 16 m short of the other box.
        if (time_s > 4 && time_s < 6) before = std::max(before, moved);
        if (time_s > 9) after = std::max(after, moved);
    }
    RecordProperty("before_m", std::to_string(before));
    RecordProperty("after_m", std::to_string(after));
    EXPECT_GT(after, 0.05);
    EXPECT_LT(before, after / 3);
}

// A lighter of 190 t floats in a wind sea, which moves it by metres. It moves with the water, so it
// makes only the initial waves, those of its small slip, and those that `return_s` passes.
TEST(Wake, ABoxThatDriftsWithTheWavesMakesFewWaves) {
    std::vector<FloatingBox> boxes = {
        FloatingBox({.length_m = 20, .height_m = 3, .beam_m = 6, .mass_kg = 190e3, .centre_of_mass_m = -0.3})};
    Ocean ocean({.resolution = 64, .patch_size_m = 250, .wind_speed_mps = 14},
                {.executor = make_serial_executor(),
                 .queries = true,
                 .velocities = true,
                 .dynamic_waves = DynamicWavesOptions{.resolution = 128, .side_m = 128, .border_m = 24}});
    std::vector<BoxWake> wakes = {BoxWake(ocean, boxes[0])};
    HullWater hull;
    double highest = 0, fastest = 0;
    const int steps = is_sanitized ? 300 : 2400;
    ocean.schedule(0);
    for (int i = 1; i <= steps; ++i) {
        const Frame& frame = ocean.complete();
        const glm::dvec3 at = boxes[0].state().position_m;
        wakes[0].press(ocean, boxes[0], step_s);
        ocean.dynamic_waves().set_center(at.x, at.z);
        ocean.schedule(i * step_s);
        step(boxes, SurfaceQuery(frame), step_s, hull, wakes);
        for (int direction = 0; direction < 12; ++direction) {
            const auto to = det::sine_cosine_of_turns(direction / 12.0);
            const double height = sample(frame.dynamic_waves, at.x + 20 * to.cosine, at.z + 20 * to.sine).height_m;
            highest = std::max(highest, std::fabs(height));
        }
        fastest = std::max(fastest, std::hypot(boxes[0].state().velocity_mps.x, boxes[0].state().velocity_mps.z));
    }
    ocean.complete();
    RecordProperty("highest_m", std::to_string(highest));
    RecordProperty("fastest_mps", std::to_string(fastest));
    EXPECT_GT(fastest, is_sanitized ? 0.1 : 0.5);
    EXPECT_LT(highest, 0.025 * -pressure_of(boxes[0]).height_m);
}

}  // namespace
}  // namespace pelagic::buoyancy
