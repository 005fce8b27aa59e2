// Hulls through the C interface: bit-identical to those of the C++ interface, and one line for each
// unusable mesh.
#include <limits>
#include <string>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/capi_hulls.hpp"

namespace pelagic {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

TEST(CInterfaceHull, SinksIfItIsHeavierThanItsVolume) {
    const CHull stone = hull_of(HullArrays(box_soup({4, 1, 2})), hull_options(20'000));
    pelagic_hull_info info{};
    ASSERT_EQ(pelagic_hull_describe(stone.get(), &info), PELAGIC_OK);
    EXPECT_EQ(info.floats, 0);
    EXPECT_EQ(info.draught_m, 0);
    EXPECT_EQ(info.vertex_count, 8) << "24 corners of faces, merged";
    EXPECT_EQ(info.triangle_count, 12);
}

TEST(CInterfaceHull, OptionsHaveTheDefaultsAndEffectsOfTheCppInterface) {
    const HullArrays arrays(boat_mesh(6, 2.2, 1.2));
    const double centre[] = {-0.2, 0.5, 0.01}, inertia[] = {900, 4000, 3500};
    double added[36] = {};
    HullMatrix matrix{};
    for (std::size_t i = 0; i < 6; ++i) added[7 * i] = matrix[i][i] = 100.0 * static_cast<double>(i + 1);
    added[1 * 6 + 5] = added[5 * 6 + 1] = matrix[1][5] = matrix[5][1] = 30;
    auto options = hull_options(2500);
    const auto digest_of = [&] {
        pelagic_hull_info info{};
        EXPECT_EQ(pelagic_hull_describe(hull_of(arrays, options).get(), &info), PELAGIC_OK);
        return info.digest;
    };
    EXPECT_EQ(digest_of(), Hull(boat_mesh(6, 2.2, 1.2), {.mass_kg = 2500}).digest());
    options.centre_of_mass_m = centre;
    options.inertia_kgm2 = inertia;
    options.added_mass = added;
    options.heave_damping = 0.3, options.roll_damping = 0.1, options.pressure_coefficient = 0.5;
    options.suction_coefficient = 0.2, options.friction_coefficient = 0.01, options.air_coefficient = 1.2;
    options.water_density_kgpm3 = 1000, options.air_density_kgpm3 = 1.3;
    options.skeg_m2 = 0.5, options.skeg_x_m = -2, options.skeg_y_m = 0.1;
    EXPECT_EQ(digest_of(), Hull(boat_mesh(6, 2.2, 1.2), {.mass_kg = 2500,
                                                         .centre_of_mass_m = glm::dvec3(-0.2, 0.5, 0.01),
                                                         .inertia_kgm2 = glm::dvec3(900, 4000, 3500),
                                                         .added_mass = matrix,
                                                         .heave_damping = 0.3,
                                                         .roll_damping = 0.1,
                                                         .pressure_coefficient = 0.5,
                                                         .suction_coefficient = 0.2,
                                                         .friction_coefficient = 0.01,
                                                         .air_coefficient = 1.2,
                                                         .water_density_kgpm3 = 1000,
                                                         .air_density_kgpm3 = 1.3,
                                                         .skeg_m2 = 0.5,
                                                         .skeg_x_m = -2,
                                                         .skeg_y_m = 0.1})
                               .digest());
    // The digest contains each of them.
    const std::uint64_t all = digest_of();
    for (double pelagic_hull_options::*const member :
         {&pelagic_hull_options::mass_kg, &pelagic_hull_options::heave_damping, &pelagic_hull_options::roll_damping,
          &pelagic_hull_options::pressure_coefficient, &pelagic_hull_options::suction_coefficient,
          &pelagic_hull_options::friction_coefficient, &pelagic_hull_options::air_coefficient,
          &pelagic_hull_options::water_density_kgpm3, &pelagic_hull_options::air_density_kgpm3,
          &pelagic_hull_options::skeg_m2, &pelagic_hull_options::skeg_x_m, &pelagic_hull_options::skeg_y_m}) {
        const double before = options.*member;
        options.*member *= 0.9;
        EXPECT_NE(digest_of(), all);
        options.*member = before;
    }
    added[14] += 1;
    EXPECT_NE(digest_of(), all);
}

TEST(CInterfaceHull, LoadsAndVelocitiesEqualThoseOfTheCppInterface) {
    const SeaState sea{.resolution = 32, .patch_size_m = 250, .wind_speed_mps = 14};
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .depth = true});
    auto c_sea = small_sea(32);
    c_sea.wind_speed_mps = 14;
    const COcean c_ocean = ocean_of(c_sea, executor_of(PELAGIC_EXECUTOR_SERIAL).get());
    const Hull hull(boat_mesh(6, 2.2, 1.2), {.mass_kg = 3500});
    const CHull c_hull = boat_of(6, 2.2, 1.2, 3500);
    HullState state = hull.at_rest(3, -2, 0.4);
    pelagic_hull_state c_state = at_rest(c_hull, 3, -2, 0.4);
    HullWorkspace workspace;
    const HullInputs inputs{.force = {.force_n = {900, 0, -100}, .torque_nm = {0, 50, 0}}, .wind_mps = {6, 0, 2}};
    auto c_inputs = pelagic_hull_inputs_make();
    c_inputs.force = {{900, 0, -100}, {0, 50, 0}};
    c_inputs.wind_mps[0] = 6, c_inputs.wind_mps[2] = 2;
    pelagic_hull_loads loads{};
    EXPECT_EQ(pelagic_hull_compute_loads(c_hull.get(), c_ocean.get(), &c_state, 1.0 / 60, &c_inputs, &loads),
              PELAGIC_WRONG_ORDER);
    for (int i = 0; i < 40; ++i) {
        pelagic_frame frame{};
        ASSERT_EQ(pelagic_ocean_schedule(c_ocean.get(), i / 60.0), PELAGIC_OK);
        ASSERT_EQ(pelagic_ocean_complete(c_ocean.get(), &frame), PELAGIC_OK);
        const WaterQuery water(ocean.frame_at(i / 60.0));
        const HullLoads expected = hull.loads(water, state, 1.0 / 60, inputs, workspace);
        if (i % 2 == 0) {
            ASSERT_EQ(pelagic_hull_compute_loads(c_hull.get(), c_ocean.get(), &c_state, 1.0 / 60, &c_inputs, &loads),
                      PELAGIC_OK)
                << pelagic_last_error();
        } else {
            hull.accelerate(state, expected, 1.0 / 60, inputs);
            ASSERT_EQ(pelagic_hull_accelerate(c_hull.get(), c_ocean.get(), &c_state, 1.0 / 60, &c_inputs, &loads),
                      PELAGIC_OK);
        }
        ASSERT_EQ(difference(c_state, state), "") << i;
        const HullForce total = expected.total();
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_EQ(loads.total.force_n[axis], total.force_n[axis]);
            ASSERT_EQ(loads.total.torque_nm[axis], total.torque_nm[axis]);
            ASSERT_EQ(loads.pressure.force_n[axis], expected.pressure.force_n[axis]);
            ASSERT_EQ(loads.added_mass.torque_nm[axis], expected.added_mass.torque_nm[axis]);
            ASSERT_EQ(loads.drag.force_n[axis], expected.drag.force_n[axis]);
            ASSERT_EQ(loads.slamming.force_n[axis], expected.slamming.force_n[axis]);
            ASSERT_EQ(loads.water_velocity_mps[axis], expected.water_velocity_mps[axis]);
            ASSERT_EQ(loads.water_acceleration_mps2[axis], expected.water_acceleration_mps2[axis]);
        }
        ASSERT_EQ(loads.displaced_m3, expected.displaced_m3);
        ASSERT_EQ(loads.submersion, expected.submersion);
        ASSERT_EQ(loads.water_height_m, expected.water_height_m);
        ASSERT_EQ(loads.water_slope_x, expected.water_slope_x);
        ASSERT_EQ(loads.water_slope_z, expected.water_slope_z);
    }
    const pelagic_hull_state before = c_state;
    expect_rejected(pelagic_hull_accelerate(c_hull.get(), c_ocean.get(), &c_state, -0.1, nullptr, nullptr),
                    "step_s -0.1 is out of range [0, inf) s");
    c_state.orientation[0] = 0.5;
    expect_rejected(pelagic_hull_accelerate(c_hull.get(), c_ocean.get(), &c_state, 0.01, nullptr, nullptr),
                    "the hull's orientation is not a unit quaternion");
    c_state = before;
    c_inputs.wind_mps[1] = not_a_number;
    expect_rejected(pelagic_hull_compute_loads(c_hull.get(), c_ocean.get(), &c_state, 0.01, &c_inputs, &loads),
                    "the hull's input wind_mps is out of range [-1e3, 1e3]");
    expect_rejected(pelagic_hull_compute_loads(c_hull.get(), c_ocean.get(), &c_state, 0.01, nullptr, nullptr),
                    "loads is NULL, expected a pointer");
    EXPECT_EQ(difference(c_state, state), "") << "nothing is changed";
    EXPECT_EQ(pelagic_hull_accelerate(c_hull.get(), c_ocean.get(), &c_state, 0.01, nullptr, nullptr), PELAGIC_OK);
}

TEST(CInterfaceHull, UnusableMeshesAndOptionsAreRejectedWithALine) {
    const HullArrays box(box_soup({2, 1, 1}));
    pelagic_hull* hull = nullptr;
    auto options = hull_options(500);
    const auto rejects = [&](const HullArrays& arrays, const std::string& line) {
        const pelagic_hull_mesh mesh = arrays.mesh();
        hull = reinterpret_cast<pelagic_hull*>(&options);
        expect_rejected(pelagic_hull_create(&mesh, &options, &hull), line);
        EXPECT_EQ(hull, nullptr);
    };
    HullArrays open = box;
    open.triangles.resize(open.triangles.size() - 3);
    rejects(open,
            "the hull is open at the edge between vertices 3 and 7, expected a closed mesh (close an open boat "
            "with a lid)");
    // Counts are checked before arrays are read, which do not exist here.
    auto mesh = box.mesh();
    mesh.triangle_count = 1'000'000;
    expect_rejected(pelagic_hull_create(&mesh, &options, &hull),
                    "the hull has 1000000 triangles, expected 4 to 4096");
    mesh.triangle_count = std::numeric_limits<std::size_t>::max();
    EXPECT_EQ(pelagic_hull_create(&mesh, &options, &hull), PELAGIC_INVALID_ARGUMENT);
    mesh = box.mesh();
    mesh.vertex_count = 12'289;
    expect_rejected(pelagic_hull_create(&mesh, &options, &hull),
                    "the hull has 12289 vertices, expected at most 12288");
    mesh = box.mesh();
    mesh.vertices_m = nullptr;
    expect_rejected(pelagic_hull_create(&mesh, &options, &hull), "mesh.vertices_m is NULL, expected a pointer");
    mesh.vertex_count = 0;
    expect_rejected(pelagic_hull_create(&mesh, &options, &hull),
                    "triangle 0 of the hull has vertex 0, expected less than 0");

    options.mass_kg = 0;
    rejects(box, "mass_kg 0 is out of range [1e-6, 1e10]");
    options.mass_kg = not_a_number;
    rejects(box, "mass_kg nan is out of range [1e-6, 1e10]");
    options.mass_kg = 500;
    options.heave_damping = 1;
    rejects(box, "heave_damping 1 is out of range [0, 0.999]");
    options = hull_options(500);
    const double outside[] = {0, 3, 0};
    options.centre_of_mass_m = outside;
    rejects(box, "centre_of_mass_m.y is 3, expected a position within the mesh, -0.5 to 0.5");
    options = hull_options(500);
    double added[36] = {};
    added[1] = 1;
    options.added_mass = added;
    rejects(box, "added_mass[0][1] is 1, expected 0, a symmetric matrix");

    options = hull_options(500);
    const CHull usable = hull_of(box, options);
    pelagic_hull_state state{};
    expect_rejected(pelagic_hull_at_rest(usable.get(), 0, 2e8, 0, &state),
                    "the hull's position_m is out of range [-1e8, 1e8]");
    expect_rejected(pelagic_hull_at_rest(usable.get(), 0, 0, not_a_number, &state),
                    "heading_rad is nan, expected a finite number");
    EXPECT_EQ(state.orientation[3], 0) << "nothing is written";
    expect_rejected(pelagic_hull_describe(nullptr, nullptr), "hull is NULL, expected a pointer");
    pelagic_hull_destroy(nullptr);
}

TEST(CInterfaceHull, LoadsNeedQueriesAndDepth) {
    const CHull hull = boat_of(6, 2.2, 1.2, 3500);
    pelagic_hull_state state = at_rest(hull, 0, 0);
    pelagic_hull_loads loads{};
    pelagic_frame frame{};
    const COceanExecutor serial = executor_of(PELAGIC_EXECUTOR_SERIAL);
    for (const bool queries : {false, true}) {
        auto options = pelagic_ocean_options_make();
        options.executor = serial.get();
        options.queries = queries;
        const COcean ocean = ocean_of(small_sea(), options);
        ASSERT_EQ(pelagic_ocean_schedule(ocean.get(), 0), PELAGIC_OK);
        ASSERT_EQ(pelagic_ocean_complete(ocean.get(), &frame), PELAGIC_OK);
        expect_rejected(pelagic_hull_compute_loads(hull.get(), ocean.get(), &state, 0.01, nullptr, &loads),
                        queries
                            ? "the frame has no water below its surface: the ocean was created without "
                              "pelagic_ocean_options.depth"
                            : "the ocean cannot be queried: it was created without pelagic_ocean_options.queries");
        pelagic_bodies* bodies = nullptr;
        expect_rejected(pelagic_bodies_create(ocean.get(), nullptr, &bodies),
                        "bodies need queries and depth, which the ocean was created without");
    }
}

}  // namespace
}  // namespace pelagic
