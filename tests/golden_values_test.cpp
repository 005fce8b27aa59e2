// Values of oceans, queries and hulls in tests/golden/values.txt, which every platform reproduces
// and every binding must return for the same calls.
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/sim/exact_water.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_ray.hpp"
#include "pelagic/tests/each_executor.hpp"
#include "pelagic/tests/golden.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

const SeaState golden_sea{.cascades = 3, .resolution = 32, .wind_speed_mps = 8, .loop_period_s = 40};

/// On dynamic waves, on the shore and its land, and outside; floats hold them exactly.
const std::vector<double> golden_x = {1.5, -7.25, 12, 3, 60, 150.5, -60, 400},
                          golden_z = {0.25, 4, -9.75, -2, 40.5, 10, 100, -1000};

void add_samples(GoldenRows& rows, const Frame& frame, Interpolation interpolation) {
    std::array<std::array<float, 8>, 10> of{};
    std::array<std::uint8_t, 8> converged{};
    SurfaceQuery(frame, {.interpolation = interpolation})
        .sample({golden_x, golden_z}, {.height_m = of[0],
                                       .normal_x = of[1],
                                       .normal_y = of[2],
                                       .normal_z = of[3],
                                       .jacobian = of[7],
                                       .velocity_x_mps = of[4],
                                       .velocity_y_mps = of[5],
                                       .velocity_z_mps = of[6],
                                       .error_m = of[8],
                                       .converged = converged,
                                       .foam = of[9]});
    for (std::size_t i = 0; i < golden_x.size(); ++i) {
        rows.begin(std::to_string(i));
        for (const auto& values : of) rows.add(values[i]);
        rows.add(static_cast<float>(converged[i]));
    }
}

class GoldenValues : public testing::TestWithParam<Computing> {};

INSTANTIATE_TEST_SUITE_P(On, GoldenValues, testing::ValuesIn(computings()), [](const auto& on) {
    std::string name = on.param.name;
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
});

// Ticks of 1/60 s, with commands before the frame of a tick.
TEST_P(GoldenValues, OfAnOceanWithDynamicWavesAndAShore) {
    Ocean ocean(golden_sea, {.executor = GetParam().executor(),
                             .isa = GetParam().isa,
                             .queries = true,
                             .velocities = Velocities::drawn,
                             .foam = true,
                             .dynamic_waves = DynamicWavesOptions{.resolution = 64, .border_m = 8},
                             .shore = bay()});
    DynamicWaves& waves = ocean.dynamic_waves();
    const Disturbance stone{
        .mode = Disturbance::Mode::impulse, .x_m = 3, .z_m = -2, .radius_m = 2, .height_m = 0.4};
    Disturbance boat{.shape = Disturbance::Shape::hull,
                     .x_m = -10,
                     .z_m = 5,
                     .radius_m = 1,
                     .length_m = 4,
                     .height_m = -0.5,
                     .velocity_x_mps = 6};
    waves.set_center(0.75, -1);
    std::uint32_t number = 0;
    GoldenRows hashes("waves"), linear("linear"), cubic("cubic"), rays("ray");
    for (int tick = 0; tick <= 60; ++tick) {
        if (tick == 3) waves.add_impulse(stone);
        if (tick == 5) number = waves.add_source(boat);
        if (tick == 20) boat.height_m = -1, waves.set_source(number, boat);
        if (tick == 25) waves.set_rain({.drops_per_m2_s = 0.5, .radius_m = 1, .height_m = 0.1, .seed = 3});
        if (tick == 30) waves.add_impulse({.mode = Disturbance::Mode::foam, .x_m = 12, .z_m = -10, .height_m = 0.3});
        if (tick == 40) waves.remove_source(number), waves.set_rain({});
        const Frame& frame = ocean.frame_at(tick / 60.0);
        if (tick % 10 == 0)
            hashes.row(std::to_string(tick),
                       {hash_of(frame), foam_hash_of(frame), hash_of(frame.dynamic_waves), shore_hash_of(frame)});
    }
    const Frame& frame = ocean.frame_at(1);
    add_samples(linear, frame, Interpolation::linear);
    add_samples(cubic, frame, Interpolation::cubic);
    for (const double x : {1.5, 150.5}) {
        const auto hit = first_hit(SurfaceQuery(frame), {{x, 12, -7}, {1, -0.5, 0.25}, 500});
        rays.row(x < 100 ? "0" : "1", {hit->distance_m, hit->position_m[0], hit->position_m[1], hit->position_m[2]});
    }
    for (const GoldenRows* rows : {&hashes, &linear, &cubic, &rays}) rows->expect();
}

TEST_P(GoldenValues, OfASeaLevelAndACurrent) {
    Ocean ocean(golden_sea, {.executor = GetParam().executor(), .isa = GetParam().isa, .queries = true});
    ocean.set_water_frame({.sea_level_m = 3, .current_x_mps = 1.5, .current_z_mps = -0.5});
    std::array<float, 8> height{};
    SurfaceQuery(ocean.frame_at(10)).sample({golden_x, golden_z}, {.height_m = height});
    GoldenRows rows("lifted");
    for (std::size_t i = 0; i < height.size(); ++i) rows.row(std::to_string(i), {height[i]});
    rows.expect();
}

TEST_P(GoldenValues, OfExactWater) {
    const ExactWater water =
        ExactWater(golden_sea, {.executor = GetParam().executor(), .isa = GetParam().isa}).at(12.5);
    const std::vector<double> y = {-1.5, -0.25, -20, 0, 1, -3, -100, -4000};
    std::array<std::array<float, 8>, 8> of{};
    std::array<std::array<float, 8>, 4> surface{};
    water.sample({golden_x, y, golden_z}, {of[0], of[1], of[2], of[3], of[4], of[5], of[6], of[7]});
    water.sample_surface({golden_x, golden_z}, {.height_m = surface[0],
                                                .velocity_x_mps = surface[1],
                                                .velocity_y_mps = surface[2],
                                                .velocity_z_mps = surface[3]});
    GoldenRows below("exact"), above("exact-surface");
    for (std::size_t i = 0; i < y.size(); ++i) {
        below.begin(std::to_string(i));
        for (const auto& values : of) below.add(values[i]);
        above.begin(std::to_string(i));
        for (const auto& values : surface) above.add(values[i]);
    }
    below.expect();
    above.expect();
}

// Between two ticks, with droplets of an emitter first.
TEST_P(GoldenValues, OfSpray) {
    SeaState sea = golden_sea;
    sea.wind_speed_mps = 18;
    Ocean ocean(sea, {.executor = GetParam().executor(), .isa = GetParam().isa, .spray = SprayOptions{}});
    ocean.set_spray_center(5, -3);
    const SprayEmitter bow{.time_s = 2, .x_m = 1, .y_m = 2, .z_m = -4, .extent_m = 0.5, .velocity_x_mps = 3,
                           .velocity_y_mps = 4, .spread_mps = 1, .radius_m = 0.0625, .count = 10};
    ocean.emit({&bow, 1});
    GoldenRows hashes("spray"), droplets("droplet");
    for (const std::string time : {"2.0625", "7.25"}) {
        const Frame& frame = ocean.frame_at(std::stod(time));
        hashes.row(time, {spray_hash_of(frame), std::uint64_t{frame.droplets.size()}});
        for (const std::size_t i : {std::size_t{0}, frame.droplets.size() - 1}) {
            const SprayDroplet& at = frame.droplets[i];
            droplets.begin(time + (i == 0 ? "-first" : "-last"));
            for (const double place : {at.x_m, at.y_m, at.z_m}) droplets.add(place);
            for (const float value : {at.velocity_x_mps, at.velocity_y_mps, at.velocity_z_mps, at.radius_m,
                                      at.opacity, at.age_s})
                droplets.add(value);
        }
    }
    hashes.expect();
    droplets.expect();
}

TEST_P(GoldenValues, OfATransition) {
    SeaState later = golden_sea;
    later.wind_speed_mps = 6;
    Ocean ocean(golden_sea, {.executor = GetParam().executor(), .isa = GetParam().isa});
    ocean.schedule_sea(later, 10, 20);
    GoldenRows rows("transition");
    for (const std::string time : {"5", "17.5", "40"}) rows.row(time, {hash_of(ocean.frame_at(std::stod(time)))});
    rows.expect();
}

TEST_P(GoldenValues, OfBodies) {
    std::vector<glm::dvec3> corners;
    for (const double x : {-2.0, 2.0})
        for (const double y : {-0.5, 0.5})
            for (const double z : {-1.0, 1.0}) corners.emplace_back(x, y, z);
    const std::vector<HullMesh::Triangle> triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5},
                                                       {0, 4, 5}, {0, 5, 1}, {2, 3, 7}, {2, 7, 6},
                                                       {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    const Hull hull(HullMesh(corners, triangles),
                    {.mass_kg = 2500, .centre_of_mass_m = glm::dvec3(0, -0.125, 0), .roll_damping = 0.125});
    const HullAfloat& afloat = hull.afloat();
    GoldenRows hulls("hull"), bodies("body"), forces("force");
    hulls.row("box", {hull.mesh().volume_m3(), afloat.draught_m, afloat.height_m, afloat.waterplane_m2,
                      afloat.roll_gm_m, afloat.pitch_gm_m});
    Ocean ocean(golden_sea, {.executor = GetParam().executor(),
                             .isa = GetParam().isa,
                             .queries = true,
                             .depth = true,
                             .dynamic_waves = DynamicWavesOptions{.resolution = 64, .side_m = 32, .border_m = 4}});
    FloatingBodies floating(GetParam().executor(), &ocean.dynamic_waves());
    floating.add(hull, hull.at_rest(1, -2, 0.25));
    floating.add(hull, hull.at_rest(-5, 4));
    floating.set_inputs(2, {.force = {.force_n = {900, 0, 0}}, .wind_mps = {0, 0, 5}});
    for (int tick = 0; tick < 40; ++tick) {
        const Frame& frame = ocean.frame_at(tick / 60.0);
        floating.press(frame, 1 / 60.0);
        floating.step(frame, 1 / 60.0);
    }
    for (const std::uint32_t number : {1u, 2u}) {
        const HullState& at = floating.state(number);
        const glm::dquat& q = at.orientation;
        bodies.row(std::to_string(number),
                   {at.position_m.x, at.position_m.y, at.position_m.z, q.x, q.y, q.z, q.w, at.velocity_mps.x,
                    at.velocity_mps.y, at.velocity_mps.z, at.angular_velocity_radps.x, at.angular_velocity_radps.y,
                    at.angular_velocity_radps.z});
        const HullForce total = floating.loads(number).total();
        forces.row(std::to_string(number), {total.force_n.x, total.force_n.y, total.force_n.z, total.torque_nm.x,
                                            total.torque_nm.y, total.torque_nm.z});
    }
    for (const GoldenRows* rows : {&hulls, &bodies, &forces}) rows->expect();
}

}  // namespace
}  // namespace pelagic
