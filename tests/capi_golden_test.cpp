// The C interface returns the values of tests/golden/values.txt, which GoldenValues computes by the
// same calls of C++ (golden_values_test.cpp).
#include <array>
#include <bit>
#include <string>
#include <vector>

#include "pelagic/tests/capi_sea.hpp"
#include "pelagic/tests/golden.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

constexpr std::array<double, 8> golden_x = {1.5, -7.25, 12, 3, 60, 150.5, -60, 400},
                                golden_z = {0.25, 4, -9.75, -2, 40.5, 10, 100, -1000};

pelagic_sea golden_sea() {
    pelagic_sea sea = stack_sea(3);
    sea.wind_speed_mps = 8;
    sea.loop_period_s = 40;
    return sea;
}

pelagic_dynamic_waves_options golden_grid(double side_m, double border_m) {
    auto waves = pelagic_dynamic_waves_options_make();
    waves.resolution = 64, waves.side_m = side_m, waves.border_m = border_m;
    return waves;
}

pelagic_disturbance golden_disturbance(std::int32_t mode, double x_m, double z_m, double radius_m, double height_m) {
    auto disturbance = pelagic_disturbance_make();
    disturbance.mode = mode;
    disturbance.x_m = x_m, disturbance.z_m = z_m;
    disturbance.radius_m = radius_m, disturbance.height_m = height_m;
    return disturbance;
}

pelagic_points golden_points(std::int32_t interpolation = PELAGIC_INTERPOLATION_LINEAR) {
    auto points = pelagic_points_make();
    points.count = golden_x.size();
    points.x = golden_x.data(), points.z = golden_z.data();
    points.interpolation = interpolation;
    return points;
}

TEST(CInterfaceGolden, Spray) {
    pelagic_sea sea = golden_sea();
    sea.wind_speed_mps = 18;
    auto spray = pelagic_spray_options_make();
    auto bow = pelagic_spray_emitter_make();
    auto options = pelagic_ocean_options_make();
    options.spray = &spray;
    const COcean ocean = ocean_of(sea, options);
    ASSERT_EQ(pelagic_ocean_set_spray_center(ocean.get(), 5, -3), PELAGIC_OK);
    bow.time_s = 2, bow.x_m = 1, bow.y_m = 2, bow.z_m = -4, bow.extent_m = 0.5;
    bow.velocity_x_mps = 3, bow.velocity_y_mps = 4, bow.spread_mps = 1, bow.radius_m = 0.0625, bow.count = 10;
    ASSERT_EQ(pelagic_ocean_emit(ocean.get(), &bow, 1), PELAGIC_OK) << pelagic_last_error();
    GoldenRows hashes("spray"), droplets("droplet");
    for (const std::string time : {"2.0625", "7.25"}) {
        const pelagic_frame frame = complete(ocean, std::stod(time));
        const std::size_t count = frame.droplet_count;
        ASSERT_GT(count, 0u);
        hashes.row(time, {hash_of(ocean.get(), PELAGIC_HASH_SPRAY), std::uint64_t{count}});
        for (const std::size_t i : {std::size_t{0}, count - 1}) {
            const pelagic_droplet& droplet = frame.droplets[i];
            droplets.begin(time + (i == 0 ? "-first" : "-last"));
            for (const double place : droplet.position_m) droplets.add(place);
            for (const float velocity : droplet.velocity_mps) droplets.add(velocity);
            for (const float value : {droplet.radius_m, droplet.opacity, droplet.age_s}) droplets.add(value);
        }
    }
    hashes.expect();
    droplets.expect();

    std::size_t bytes = 0;
    ASSERT_EQ(pelagic_ocean_save_spray(ocean.get(), nullptr, 0, &bytes), PELAGIC_OK);
    std::vector<std::uint8_t> saved(bytes);
    ASSERT_EQ(pelagic_ocean_save_spray(ocean.get(), saved.data(), bytes, &bytes), PELAGIC_OK);
    const COcean other = ocean_of(sea, options), without = ocean_of(sea, pelagic_ocean_options_make());
    ASSERT_EQ(pelagic_ocean_restore_spray(other.get(), saved.data(), bytes), PELAGIC_OK) << pelagic_last_error();
    ASSERT_EQ(pelagic_ocean_set_spray_center(other.get(), 5, -3), PELAGIC_OK);
    complete(other, 2.0625);
    complete(ocean, 2.0625);
    EXPECT_EQ(hash_of(other.get(), PELAGIC_HASH_SPRAY), hash_of(ocean.get(), PELAGIC_HASH_SPRAY));
    bow.count = -1;
    EXPECT_EQ(pelagic_ocean_emit(ocean.get(), &bow, 1), PELAGIC_INVALID_ARGUMENT);
    EXPECT_STREQ(pelagic_last_error(), "emitters[0].count -1 is out of range [0, 8192]");
    complete(without, 0);
    std::uint64_t hash = 0;
    EXPECT_EQ(pelagic_ocean_frame_hash(without.get(), 0, PELAGIC_HASH_SPRAY, &hash), PELAGIC_INVALID_ARGUMENT);
    EXPECT_STREQ(pelagic_last_error(), "the ocean has no spray: it was created without pelagic_ocean_options.spray");
}

TEST(CInterfaceGolden, AnOceanWithDynamicWavesAndAShore) {
    const ShoreOptions floor = bay();
    auto shore = pelagic_shore_options_make();
    shore.columns = floor.columns, shore.rows = floor.rows;
    shore.heights_m = floor.heights_m.data();
    shore.metres_per_sample = floor.metres_per_sample;
    shore.corner_x_m = floor.corner_x_m, shore.corner_z_m = floor.corner_z_m;
    shore.resolution = floor.resolution;
    const pelagic_dynamic_waves_options grid = golden_grid(64, 8);
    auto options = pelagic_ocean_options_make();
    options.queries = options.velocities = options.foam = 1;
    options.dynamic_waves = &grid;
    options.shore = &shore;
    const COcean ocean = ocean_of(golden_sea(), options);
    pelagic_dynamic_waves* const waves = waves_of(ocean.get());

    const pelagic_disturbance stone = golden_disturbance(PELAGIC_DISTURBANCE_IMPULSE, 3, -2, 2, 0.4),
                              foam = golden_disturbance(PELAGIC_DISTURBANCE_FOAM, 12, -10, 1, 0.3);
    pelagic_disturbance boat = golden_disturbance(PELAGIC_DISTURBANCE_PRESSURE, -10, 5, 1, -0.5);
    boat.shape = PELAGIC_SHAPE_HULL;
    boat.length_m = 4, boat.velocity_x_mps = 6;
    auto dry = pelagic_rain_make();
    pelagic_rain rain = dry;
    rain.drops_per_m2_s = 0.5, rain.radius_m = 1, rain.height_m = 0.1, rain.seed = 3;
    std::uint32_t number = 0;
    pelagic_status status = pelagic_dynamic_waves_set_center(waves, 0.75, -1);
    const auto then = [&](pelagic_status next) { status = status == PELAGIC_OK ? next : status; };
    GoldenRows hashes("waves"), rays("ray");
    for (int tick = 0; tick <= 60; ++tick) {
        if (tick == 3) then(pelagic_dynamic_waves_add_impulse(waves, &stone));
        if (tick == 5) then(pelagic_dynamic_waves_add_source(waves, &boat, &number));
        if (tick == 20) boat.height_m = -1, then(pelagic_dynamic_waves_set_source(waves, number, &boat));
        if (tick == 25) then(pelagic_dynamic_waves_set_rain(waves, &rain));
        if (tick == 30) then(pelagic_dynamic_waves_add_impulse(waves, &foam));
        if (tick == 40) then(pelagic_dynamic_waves_remove_source(waves, number));
        if (tick == 40) then(pelagic_dynamic_waves_set_rain(waves, &dry));
        complete(ocean, tick / 60.0);
        if (tick % 10 == 0)
            hashes.row(std::to_string(tick), {hash_of(ocean.get()), hash_of(ocean.get(), PELAGIC_HASH_FOAM),
                                              hash_of(ocean.get(), PELAGIC_HASH_DYNAMIC_WAVES),
                                              hash_of(ocean.get(), PELAGIC_HASH_SHORE)});
    }
    ASSERT_EQ(status, PELAGIC_OK) << pelagic_last_error();
    hashes.expect();

    for (const std::int32_t interpolation : {PELAGIC_INTERPOLATION_LINEAR, PELAGIC_INTERPOLATION_CUBIC}) {
        std::array<std::array<float, 8>, 10> of{};
        std::array<std::uint8_t, 8> converged{};
        auto samples = pelagic_samples_make();
        samples.height_m = of[0].data();
        samples.normal_x = of[1].data(), samples.normal_y = of[2].data(), samples.normal_z = of[3].data();
        samples.velocity_x_mps = of[4].data(), samples.velocity_y_mps = of[5].data();
        samples.velocity_z_mps = of[6].data();
        samples.jacobian = of[7].data(), samples.error_m = of[8].data(), samples.foam = of[9].data();
        samples.converged = converged.data();
        const pelagic_points points = golden_points(interpolation);
        ASSERT_EQ(pelagic_ocean_query(ocean.get(), &points, &samples), PELAGIC_OK) << pelagic_last_error();
        GoldenRows rows(interpolation == PELAGIC_INTERPOLATION_LINEAR ? "linear" : "cubic");
        for (std::size_t i = 0; i < golden_x.size(); ++i) {
            rows.begin(std::to_string(i));
            for (const auto& values : of) rows.add(values[i]);
            rows.add(static_cast<float>(converged[i]));
        }
        rows.expect();
    }

    pelagic_hit hit{};
    auto ray = pelagic_ray_make();
    ray.origin_m[1] = 12, ray.origin_m[2] = -7;
    ray.direction[0] = 1, ray.direction[1] = -0.5, ray.direction[2] = 0.25;
    ray.reach_m = 500;
    for (const double x : {1.5, 150.5}) {
        ray.origin_m[0] = x;
        ASSERT_EQ(pelagic_ocean_first_hit(ocean.get(), &ray, &hit), PELAGIC_OK) << pelagic_last_error();
        EXPECT_TRUE(hit.is_hit && !hit.from_below);
        rays.row(x < 100 ? "0" : "1", {hit.distance_m, hit.position_m[0], hit.position_m[1], hit.position_m[2]});
    }
    rays.expect();
    ray.direction[1] = 2;
    ASSERT_EQ(pelagic_ocean_first_hit(ocean.get(), &ray, &hit), PELAGIC_OK);
    EXPECT_FALSE(hit.is_hit);
}

TEST(CInterfaceGolden, ExactWater) {
    constexpr std::array<double, 8> y = {-1.5, -0.25, -20, 0, 1, -3, -100, -4000};
    const COceanExecutor executor = executor_of(PELAGIC_EXECUTOR_THREADS, 2);
    auto options = pelagic_exact_water_options_make();
    options.executor = executor.get();
    const pelagic_sea sea = golden_sea();
    pelagic_exact_water* water = nullptr;
    ASSERT_EQ(pelagic_exact_water_create(&sea, &options, &water), PELAGIC_OK) << pelagic_last_error();
    ASSERT_EQ(pelagic_exact_water_set_time(water, 12.5), PELAGIC_OK);
    std::array<std::array<float, 8>, 8> of{};
    std::array<std::array<float, 8>, 4> surface{};
    for (const std::int32_t parallel : {0, 1}) {
        auto points = pelagic_water_points_make();
        points.count = y.size(), points.parallel = parallel;
        points.x = golden_x.data(), points.y = y.data(), points.z = golden_z.data();
        auto samples = pelagic_water_samples_make();
        samples.depth_m = of[0].data(), samples.pressure_pa = of[1].data();
        samples.velocity_x_mps = of[2].data(), samples.velocity_y_mps = of[3].data();
        samples.velocity_z_mps = of[4].data(), samples.acceleration_x_mps2 = of[5].data();
        samples.acceleration_y_mps2 = of[6].data(), samples.acceleration_z_mps2 = of[7].data();
        ASSERT_EQ(pelagic_exact_water_sample(water, &points, &samples), PELAGIC_OK) << pelagic_last_error();
        pelagic_points above = golden_points();
        above.parallel = parallel;
        auto there = pelagic_samples_make();
        there.height_m = surface[0].data(), there.velocity_x_mps = surface[1].data();
        there.velocity_y_mps = surface[2].data(), there.velocity_z_mps = surface[3].data();
        ASSERT_EQ(pelagic_exact_water_sample_surface(water, &above, &there), PELAGIC_OK) << pelagic_last_error();
        GoldenRows below_rows("exact"), surface_rows("exact-surface");
        for (std::size_t i = 0; i < y.size(); ++i) {
            below_rows.begin(std::to_string(i));
            for (const auto& values : of) below_rows.add(values[i]);
            surface_rows.begin(std::to_string(i));
            for (const auto& values : surface) surface_rows.add(values[i]);
        }
        below_rows.expect();
        surface_rows.expect();

        const double deep = -4001;
        points.count = 1, points.y = &deep;
        expect_rejected(pelagic_exact_water_sample(water, &points, &samples),
                        "y[0] is -4001, expected at least -4000, the sea floor");
        points.y = nullptr;
        expect_rejected(pelagic_exact_water_sample(water, &points, &samples),
                        "points.y is NULL, expected a pointer");
        there.foam = of[0].data();
        expect_rejected(pelagic_exact_water_sample_surface(water, &above, &there), "exact water has no foam");
    }
    expect_rejected(pelagic_exact_water_set_time(water, std::bit_cast<double>(0x7ff8000000000000)),
                    "time_s is nan, expected a finite number");
    pelagic_exact_water_destroy(water);
    pelagic_sea pond = golden_sea();
    pond.waves = PELAGIC_WAVES_POND, pond.cascades = 0;
    expect_rejected(pelagic_exact_water_create(&pond, nullptr, &water),
                    "waves is pond, expected spectrum, analytic or regular");
    EXPECT_EQ(water, nullptr);
    options.water_density_kgpm3 = 0;
    expect_rejected(pelagic_exact_water_create(&sea, &options, &water),
                    "water_density_kgpm3 0 is out of range [500, 2000]");
    pelagic_exact_water_destroy(nullptr);
}

TEST(CInterfaceGolden, ASeaLevelAndACurrent) {
    auto options = pelagic_ocean_options_make();
    options.queries = 1;
    const COcean ocean = ocean_of(golden_sea(), options);
    auto water = pelagic_water_frame_make();
    water.sea_level_m = 3, water.current_x_mps = 1.5, water.current_z_mps = -0.5;
    ASSERT_EQ(pelagic_ocean_set_water_frame(ocean.get(), &water), PELAGIC_OK) << pelagic_last_error();
    complete(ocean, 10);
    std::array<float, 8> height{};
    auto samples = pelagic_samples_make();
    samples.height_m = height.data();
    const pelagic_points points = golden_points();
    ASSERT_EQ(pelagic_ocean_query(ocean.get(), &points, &samples), PELAGIC_OK) << pelagic_last_error();
    GoldenRows rows("lifted");
    for (std::size_t i = 0; i < height.size(); ++i) rows.row(std::to_string(i), {height[i]});
    rows.expect();
    samples.foam = height.data();
    expect_rejected(pelagic_ocean_query(ocean.get(), &points, &samples),
                    "the frame has no foam: the ocean was created without pelagic_ocean_options.foam");
    water.sea_level_m = std::bit_cast<double>(0x7ff8000000000000);
    expect_rejected(pelagic_ocean_set_water_frame(ocean.get(), &water),
                    "sea_level_m nan is out of range [-1000, 1000]");
}

TEST(CInterfaceGolden, ATransition) {
    auto options = pelagic_ocean_options_make();
    const COcean ocean = ocean_of(golden_sea(), options);
    pelagic_sea later = golden_sea();
    later.wind_speed_mps = 6;
    auto change = pelagic_change_make();
    change.sea = &later;
    change.from_s = 10, change.over_s = 20;
    ASSERT_EQ(pelagic_ocean_schedule_change(ocean.get(), &change), PELAGIC_OK) << pelagic_last_error();
    GoldenRows rows("transition");
    for (const std::string time : {"5", "17.5", "40"}) rows.row(time, {hash_at(ocean, std::stod(time))});
    rows.expect();
}

TEST(CInterfaceGolden, Bodies) {
    std::vector<double> corners;
    for (const double x : {-2.0, 2.0})
        for (const double y : {-0.5, 0.5})
            for (const double z : {-1.0, 1.0}) corners.insert(corners.end(), {x, y, z});
    constexpr std::uint32_t triangles[] = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                           2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    constexpr double centre[] = {0, -0.125, 0};
    auto options = pelagic_hull_options_make();
    if (!has_hulls()) GTEST_SKIP() << pelagic_last_error();
    options.mass_kg = 2500, options.roll_damping = 0.125, options.centre_of_mass_m = centre;
    auto mesh = pelagic_hull_mesh_make();
    mesh.vertex_count = 8, mesh.vertices_m = corners.data();
    mesh.triangle_count = 12, mesh.triangles = triangles;
    pelagic_hull* hull = nullptr;
    ASSERT_EQ(pelagic_hull_create(&mesh, &options, &hull), PELAGIC_OK) << pelagic_last_error();
    pelagic_hull_info info{};
    ASSERT_EQ(pelagic_hull_describe(hull, &info), PELAGIC_OK);
    GoldenRows hulls("hull"), states("body"), forces("force");
    hulls.row("box", {info.volume_m3, info.draught_m, info.height_m, info.waterplane_m2, info.roll_gm_m,
                      info.pitch_gm_m});
    EXPECT_TRUE(info.floats && info.mass_kg == 2500 && info.minimum_m[0] == -2 && info.maximum_m[2] == 1);

    const pelagic_dynamic_waves_options grid = golden_grid(32, 4);
    auto with_waves = pelagic_ocean_options_make();
    with_waves.queries = with_waves.depth = 1;
    with_waves.dynamic_waves = &grid;
    const COcean ocean = ocean_of(golden_sea(), with_waves);
    auto wakes = pelagic_bodies_options_make();
    wakes.wakes = 1;
    pelagic_bodies* bodies = nullptr;
    ASSERT_EQ(pelagic_bodies_create(ocean.get(), &wakes, &bodies), PELAGIC_OK) << pelagic_last_error();
    pelagic_hull_state state{};
    std::uint32_t number = 0;
    for (const auto& [x_m, z_m, heading_rad] : {std::array{1.0, -2.0, 0.25}, {-5.0, 4.0, 0.0}}) {
        EXPECT_EQ(pelagic_hull_at_rest(hull, x_m, z_m, heading_rad, &state), PELAGIC_OK);
        EXPECT_EQ(pelagic_bodies_add(bodies, hull, &state, &number), PELAGIC_OK);
    }
    auto inputs = pelagic_hull_inputs_make();
    inputs.force.force_n[0] = 900, inputs.wind_mps[2] = 5;
    EXPECT_EQ(pelagic_bodies_set_inputs(bodies, number, &inputs), PELAGIC_OK);
    for (int tick = 0; tick < 40; ++tick) {
        complete(ocean, tick / 60.0);
        EXPECT_EQ(pelagic_bodies_press(bodies, 1 / 60.0), PELAGIC_OK);
        EXPECT_EQ(pelagic_bodies_step(bodies, 1 / 60.0, nullptr), PELAGIC_OK);
    }
    for (number = 1; number <= 2; ++number) {
        pelagic_hull_loads loads{};
        EXPECT_EQ(pelagic_bodies_get_state(bodies, number, &state), PELAGIC_OK);
        EXPECT_EQ(pelagic_bodies_get_loads(bodies, number, &loads), PELAGIC_OK);
        states.begin(std::to_string(number));
        for (const double part : state.position_m) states.add(part);
        for (const double part : state.orientation) states.add(part);
        for (const double part : state.velocity_mps) states.add(part);
        for (const double part : state.angular_velocity_radps) states.add(part);
        forces.begin(std::to_string(number));
        for (const double part : loads.total.force_n) forces.add(part);
        for (const double part : loads.total.torque_nm) forces.add(part);
    }
    for (const GoldenRows* rows : {&hulls, &states, &forces}) rows->expect();
    pelagic_bodies_destroy(bodies);
    pelagic_hull_destroy(hull);
}

}  // namespace
}  // namespace pelagic
