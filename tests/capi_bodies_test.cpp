// Floating bodies through the C interface: saved states, and errors that change nothing.
// CInterfaceGolden compares them with those of the C++ interface.
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/tests/capi_hulls.hpp"
#include "pelagic/tests/potential_flow.hpp"
#include "pelagic/tests/potential_flow_bodies.hpp"

namespace pelagic {
namespace {

constexpr double tick_s = 1.0 / 60;
constexpr DynamicWavesOptions waves_options{.resolution = 64, .side_m = 32, .border_m = 4};

struct DestroyBodies {
    void operator()(pelagic_bodies* bodies) const { pelagic_bodies_destroy(bodies); }
};
using CBodies = std::unique_ptr<pelagic_bodies, DestroyBodies>;

class CInterfaceBodies : public testing::Test {
   protected:
    COceanExecutor serial = executor_of(PELAGIC_EXECUTOR_SERIAL);
    CHull launch = boat_of(6, 2.2, 1.2, 3500), dinghy = boat_of(4, 1.7, 0.8, 350);

    COcean water(double side_m = waves_options.side_m, bool has_waves = true) const {
        auto waves = pelagic_dynamic_waves_options_make();
        waves.resolution = waves_options.resolution;
        waves.side_m = side_m;
        waves.border_m = waves_options.border_m;
        auto options = pelagic_ocean_options_make();
        options.executor = serial.get();
        options.queries = options.depth = 1;
        options.dynamic_waves = has_waves ? &waves : nullptr;
        auto sea = small_sea(32);
        sea.wind_speed_mps = 12;
        return ocean_of(sea, options);
    }
    CBodies bodies_of(const COcean& ocean, bool wakes = true) const {
        auto options = pelagic_bodies_options_make();
        options.wakes = wakes;
        options.executor = serial.get();
        pelagic_bodies* bodies = nullptr;
        EXPECT_EQ(pelagic_bodies_create(ocean.get(), &options, &bodies), PELAGIC_OK) << pelagic_last_error();
        return CBodies(bodies);
    }
    static std::uint32_t add(const CBodies& bodies, const CHull& hull, const pelagic_hull_state& state) {
        std::uint32_t number = 0;
        EXPECT_EQ(pelagic_bodies_add(bodies.get(), hull.get(), &state, &number), PELAGIC_OK) << pelagic_last_error();
        return number;
    }
    static pelagic_hull_state state_of(const CBodies& bodies, std::uint32_t number) {
        pelagic_hull_state state{};
        EXPECT_EQ(pelagic_bodies_get_state(bodies.get(), number, &state), PELAGIC_OK) << pelagic_last_error();
        return state;
    }
    static void push(const CBodies& bodies, std::uint32_t number, double force_x_n) {
        auto inputs = pelagic_hull_inputs_make();
        inputs.force.force_n[0] = force_x_n;
        inputs.wind_mps[2] = 4;
        EXPECT_EQ(pelagic_bodies_set_inputs(bodies.get(), number, &inputs), PELAGIC_OK) << pelagic_last_error();
    }
    /// Completes a frame and advances the bodies in it.
    static void advance(const COcean& ocean, const CBodies& bodies, int tick) {
        complete(ocean, tick * tick_s);
        ASSERT_EQ(pelagic_bodies_press(bodies.get(), tick_s), PELAGIC_OK) << pelagic_last_error();
        ASSERT_EQ(pelagic_bodies_step(bodies.get(), tick_s, nullptr), PELAGIC_OK) << pelagic_last_error();
    }
    static std::vector<std::uint8_t> saved(const CBodies& bodies) {
        std::size_t count = 0;
        EXPECT_EQ(pelagic_bodies_save_state(bodies.get(), nullptr, 0, &count), PELAGIC_OK) << pelagic_last_error();
        std::vector<std::uint8_t> bytes(count);
        EXPECT_EQ(pelagic_bodies_save_state(bodies.get(), bytes.data(), count, &count), PELAGIC_OK);
        return bytes;
    }
    static pelagic_status restore(const CBodies& bodies, std::span<const std::uint8_t> bytes) {
        return pelagic_bodies_restore_state(bodies.get(), bytes.data(), bytes.size());
    }
    static std::uint64_t waves_hash(const COcean& ocean) {
        std::uint64_t hash = 0;
        EXPECT_EQ(pelagic_dynamic_waves_hash(waves_of(ocean.get()), &hash), PELAGIC_OK);
        return hash;
    }
};

// In another process: an ocean and bodies that are new, and know the hulls.
TEST_F(CInterfaceBodies, OfASavedStateContinueBitEqualInAnotherOcean) {
    const COcean ocean = water(), other_ocean = water();
    const CBodies bodies = bodies_of(ocean), other = bodies_of(other_ocean);
    add(bodies, launch, at_rest(launch, -4, 1, 0.2));
    add(bodies, dinghy, at_rest(dinghy, 5, -2, -1));
    add(bodies, launch, at_rest(launch, 0, 8));
    push(bodies, 1, 2000);
    EXPECT_EQ(pelagic_bodies_remove(bodies.get(), 2), PELAGIC_OK);
    for (int tick = 0; tick < 40; ++tick) advance(ocean, bodies, tick);
    complete(ocean, 40 * tick_s);
    const std::vector<std::uint8_t> bytes = saved(bodies);
    std::size_t count = 0;
    ASSERT_EQ(pelagic_dynamic_waves_save_state(waves_of(ocean.get()), nullptr, 0, &count), PELAGIC_OK);
    std::vector<std::uint8_t> waves(count);
    ASSERT_EQ(pelagic_dynamic_waves_save_state(waves_of(ocean.get()), waves.data(), count, &count), PELAGIC_OK);

    expect_rejected(restore(other, bytes),
                    "saved body 1 has an unknown hull, expected one that was added to these bodies");
    add(other, dinghy, at_rest(dinghy, 0, 0));
    add(other, launch, at_rest(launch, 0, 0));
    ASSERT_EQ(pelagic_dynamic_waves_restore_state(waves_of(other_ocean.get()), waves.data(), count), PELAGIC_OK);
    ASSERT_EQ(restore(other, bytes), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(saved(other), bytes);
    EXPECT_EQ(add(bodies, dinghy, at_rest(dinghy, -8, -8)), 4u);
    EXPECT_EQ(add(other, dinghy, at_rest(dinghy, -8, -8)), 4u) << "numbers are restored, too";
    for (int tick = 40; tick < 50; ++tick) advance(other_ocean, other, tick), advance(ocean, bodies, tick);
    EXPECT_TRUE(saved(other) == saved(bodies));
    EXPECT_EQ(waves_hash(other_ocean), waves_hash(ocean));
}

TEST_F(CInterfaceBodies, AreShiftedWithTheOrigin) {
    constexpr double to_x = 1e7, to_z = -2e6;
    const COcean still_ocean = water(), ocean = water();
    const CBodies still = bodies_of(still_ocean), bodies = bodies_of(ocean);
    for (const CBodies* const of : {&still, &bodies}) push(*of, add(*of, launch, at_rest(launch, -4, 1, 0.2)), 2000);
    const auto height = [](const COcean& of, double x, double z) {
        float height_m = 0;
        auto points = pelagic_points_make();
        auto samples = pelagic_samples_make();
        points.count = 1;
        points.x = &x;
        points.z = &z;
        samples.height_m = &height_m;
        EXPECT_EQ(pelagic_ocean_query(of.get(), &points, &samples), PELAGIC_OK) << pelagic_last_error();
        return height_m;
    };
    for (int tick = 0; tick < 30; ++tick) {
        if (tick == 10) {
            EXPECT_EQ(pelagic_ocean_set_origin(ocean.get(), to_x, to_z), PELAGIC_OK);
        }
        complete(ocean, tick * tick_s);
        if (tick == 10) {
            EXPECT_EQ(pelagic_bodies_shift(bodies.get(), -to_x, -to_z), PELAGIC_OK);
        }
        EXPECT_EQ(pelagic_bodies_press(bodies.get(), tick_s), PELAGIC_OK);
        EXPECT_EQ(pelagic_bodies_step(bodies.get(), tick_s, nullptr), PELAGIC_OK);
        advance(still_ocean, still, tick);
    }
    EXPECT_EQ(hash_of(ocean.get()), hash_of(still_ocean.get()));
    // doubles near 1e7 m are 2e-9 m apart
    EXPECT_NEAR(height(ocean, 7 - to_x, -3 - to_z), height(still_ocean, 7, -3), 1e-5);
    const pelagic_hull_state found = state_of(bodies, 1), expected = state_of(still, 1);
    EXPECT_NEAR(found.position_m[0] + to_x, expected.position_m[0], 1e-6);
    EXPECT_NEAR(found.position_m[1], expected.position_m[1], 1e-6);
    EXPECT_NEAR(found.position_m[2] + to_z, expected.position_m[2], 1e-6);
    expect_rejected(pelagic_ocean_set_origin(ocean.get(), 2e8, 0), "origin_x_m 200000000 is out of range [-1e8, 1e8]");
    expect_rejected(pelagic_bodies_shift(bodies.get(), -1e8, 0),
                    "body 1: the hull's position_m is out of range [-1e8, 1e8]");
    EXPECT_EQ(state_of(bodies, 1).position_m[0], found.position_m[0]);
    EXPECT_EQ(pelagic_exact_water_set_origin(nullptr, 0, 0), PELAGIC_INVALID_ARGUMENT);
    EXPECT_EQ(pelagic_ocean_set_origin(nullptr, 0, 0), PELAGIC_INVALID_ARGUMENT);
    EXPECT_EQ(pelagic_bodies_shift(nullptr, 0, 0), PELAGIC_INVALID_ARGUMENT);
}

TEST_F(CInterfaceBodies, DamagedAndForeignStatesAreRejectedAndChangeNothing) {
    const COcean ocean = water();
    const CBodies bodies = bodies_of(ocean);
    add(bodies, dinghy, at_rest(dinghy, 5, -2, -1));
    for (int tick = 0; tick < 3; ++tick) advance(ocean, bodies, tick);
    const std::vector<std::uint8_t> bytes = saved(bodies);
    constexpr const char* damaged = "the saved bodies are damaged, expected the bytes that save_state() returned";
    constexpr const char* format = "the saved bodies have another format, expected what save_state() returned";
    for (std::size_t size = 0; size < bytes.size(); size += 13) {
        ASSERT_EQ(restore(bodies, std::span(bytes).first(size)), PELAGIC_INVALID_ARGUMENT) << size;
        if (size < 40)
            EXPECT_EQ(std::string(pelagic_last_error()),
                      "the saved bodies have a wrong size, expected as many bytes as their counts give");
        else
            EXPECT_STREQ(pelagic_last_error(), damaged);
    }
    for (std::size_t at = 0; at < bytes.size(); at += 7) {
        std::vector<std::uint8_t> flipped = bytes;
        flipped[at] ^= 0x10;
        ASSERT_EQ(restore(bodies, flipped), PELAGIC_INVALID_ARGUMENT) << at;
        EXPECT_STREQ(pelagic_last_error(), at < 8 ? format : damaged);
    }
    std::vector<std::uint8_t> longer = bytes;
    longer.push_back(0);
    expect_rejected(restore(bodies, longer), damaged);
    std::size_t count = 0;
    ASSERT_EQ(pelagic_dynamic_waves_save_state(waves_of(ocean.get()), nullptr, 0, &count), PELAGIC_OK);
    std::vector<std::uint8_t> waves(count);
    ASSERT_EQ(pelagic_dynamic_waves_save_state(waves_of(ocean.get()), waves.data(), count, &count), PELAGIC_OK);
    expect_rejected(restore(bodies, waves), format);
    expect_rejected(pelagic_bodies_restore_state(bodies.get(), nullptr, 100), "bytes is NULL, expected a pointer");

    const CBodies without_wakes = bodies_of(ocean, false);
    add(without_wakes, dinghy, at_rest(dinghy, 0, 0));
    expect_rejected(restore(bodies, saved(without_wakes)),
                    "the saved bodies have no wakes, expected bodies with wakes");
    expect_rejected(restore(without_wakes, bytes), "the saved bodies have wakes, expected bodies without wakes");
    const COcean coarse_ocean = water(64);
    const CBodies coarse = bodies_of(coarse_ocean);
    add(coarse, dinghy, at_rest(dinghy, 0, 0));
    // dinghy of 4 x 1.7 m: 8 x 3 cells on texels of 0.5 m, 4 x 1 on texels of 1 m
    expect_rejected(restore(coarse, bytes), "saved body 1's wake has 4 cells, expected 2 as on these dynamic waves");
    expect_rejected(
        pelagic_bodies_save_state(bodies.get(), waves.data(), bytes.size() - 1, &count),
        "room is " + std::to_string(bytes.size() - 1) + ", expected " + std::to_string(bytes.size()) + " or more");
    EXPECT_TRUE(saved(bodies) == bytes) << "nothing is changed";
}

TEST_F(CInterfaceBodies, InvalidArgumentsAreRejectedAndChangeNothing) {
    const COcean ocean = water();
    const CBodies bodies = bodies_of(ocean);
    EXPECT_EQ(pelagic_bodies_step(bodies.get(), tick_s, nullptr), PELAGIC_WRONG_ORDER);
    EXPECT_EQ(pelagic_bodies_press(bodies.get(), tick_s), PELAGIC_WRONG_ORDER);
    add(bodies, dinghy, at_rest(dinghy, 5, -2));
    const std::uint32_t removed = add(bodies, dinghy, at_rest(dinghy, -5, -2));
    const std::uint32_t last = add(bodies, dinghy, at_rest(dinghy, -5, 6));
    EXPECT_EQ(pelagic_bodies_remove(bodies.get(), removed), PELAGIC_OK);
    EXPECT_EQ(pelagic_bodies_remove(bodies.get(), removed), PELAGIC_OK) << "does nothing";
    complete(ocean, 0);
    const std::vector<std::uint8_t> before = saved(bodies);
    auto state = state_of(bodies, 1);
    auto inputs = pelagic_hull_inputs_make();
    pelagic_hull_loads loads{};
    expect_rejected(pelagic_bodies_get_state(bodies.get(), 2, &state), "number is 2, expected that of a body");
    expect_rejected(pelagic_bodies_set_state(bodies.get(), 0, &state), "number is 0, expected that of a body");
    expect_rejected(pelagic_bodies_set_inputs(bodies.get(), 4, &inputs), "number is 4, expected that of a body");
    expect_rejected(pelagic_bodies_get_loads(bodies.get(), 2, &loads), "number is 2, expected that of a body");
    inputs.force.torque_nm[1] = std::numeric_limits<double>::infinity();
    expect_rejected(pelagic_bodies_set_inputs(bodies.get(), 1, &inputs),
                    "the hull's input torque_nm is out of range [-1e15, 1e15]");
    state.velocity_mps[0] = 2e4;
    expect_rejected(pelagic_bodies_set_state(bodies.get(), 1, &state),
                    "the hull's velocity_mps is out of range [-1e4, 1e4]");
    std::uint32_t number = 77;
    expect_rejected(pelagic_bodies_add(bodies.get(), dinghy.get(), &state, &number),
                    "the hull's velocity_mps is out of range [-1e4, 1e4]");
    EXPECT_EQ(number, 77u);
    const CHull raft = hull_of(HullArrays(box_soup({1500, 2, 2})), hull_options(1e6));
    const pelagic_hull_state rest = at_rest(raft, 0, 0);
    expect_rejected(pelagic_bodies_add(bodies.get(), raft.get(), &rest, &number),
                    "length_m 1500 is out of range [0.001, 1000]");
    expect_rejected(pelagic_bodies_step(bodies.get(), -1, nullptr), "step_s -1 is out of range [0, inf) s");
    expect_rejected(pelagic_bodies_press(bodies.get(), -1), "tick_s -1 is out of range [0, inf) s");
    // 0: no time has passed
    EXPECT_EQ(pelagic_bodies_step(bodies.get(), 0, nullptr), PELAGIC_OK);
    EXPECT_EQ(pelagic_bodies_press(bodies.get(), 0), PELAGIC_OK);
    ASSERT_EQ(pelagic_ocean_schedule(ocean.get(), tick_s), PELAGIC_OK);
    EXPECT_EQ(pelagic_bodies_press(bodies.get(), tick_s), PELAGIC_WRONG_ORDER);
    EXPECT_TRUE(saved(bodies) == before) << "nothing is changed";
    // Bodies that leave the range are named by their number.
    state = state_of(bodies, last);
    state.position_m[0] = 99'999'999, state.position_m[1] = 5000, state.velocity_mps[0] = 9999;
    ASSERT_EQ(pelagic_bodies_set_state(bodies.get(), last, &state), PELAGIC_OK);
    ASSERT_EQ(pelagic_bodies_step(bodies.get(), tick_s, nullptr), PELAGIC_OK);
    const std::vector<std::uint8_t> beyond = saved(bodies);
    std::int32_t is_all = -1;
    expect_rejected(pelagic_bodies_step(bodies.get(), tick_s, &is_all),
                    "body 3: the hull's position_m is out of range [-1e8, 1e8]");
    EXPECT_EQ(is_all, 0);
    EXPECT_TRUE(saved(bodies) == beyond);

    const COcean calm = water(32, false);
    auto options = pelagic_bodies_options_make();
    options.wakes = 1;
    pelagic_bodies* none = bodies.get();
    expect_rejected(pelagic_bodies_create(calm.get(), &options, &none),
                    "the ocean has no dynamic waves: it was created without pelagic_ocean_options.dynamic_waves");
    EXPECT_EQ(none, nullptr);
    expect_rejected(pelagic_bodies_create(nullptr, nullptr, &none), "ocean is NULL, expected a pointer");
    expect_rejected(pelagic_bodies_step(nullptr, tick_s, nullptr), "bodies is NULL, expected a pointer");
}

TEST_F(CInterfaceBodies, OceanAndBodiesAreDestroyedInAnyOrder) {
    COcean ocean = water();
    const CBodies bodies = bodies_of(ocean);
    add(bodies, launch, at_rest(launch, -4, 1));
    launch.reset();  // The set keeps what it needs.
    for (int tick = 0; tick < 3; ++tick) advance(ocean, bodies, tick);
    ocean.reset();
    pelagic_hull_state state{};
    constexpr const char* line = "the ocean of the bodies is destroyed, expected one that exists";
    expect_rejected(pelagic_bodies_step(bodies.get(), tick_s, nullptr), line);
    expect_rejected(pelagic_bodies_press(bodies.get(), tick_s), line);
    expect_rejected(pelagic_bodies_remove(bodies.get(), 1), line);
    expect_rejected(pelagic_bodies_get_state(bodies.get(), 1, &state), line);
}

// Waves without a source decay; those of bodies that are destroyed have none.
TEST_F(CInterfaceBodies, RemovedBodiesPressNoMore) {
    const auto depth_after = [&](bool remove, bool destroy) {
        const COcean ocean = water();
        CBodies bodies = bodies_of(ocean);
        const std::uint32_t number = add(bodies, launch, at_rest(launch, 0, 0));
        int tick = 0;
        while (tick < 180) advance(ocean, bodies, tick++);
        if (remove) {
            EXPECT_EQ(pelagic_bodies_remove(bodies.get(), number), PELAGIC_OK);
        }
        if (destroy) bodies.reset();
        while (tick < 420) complete(ocean, tick++ * tick_s);
        pelagic_dynamic_waves_view view{};
        EXPECT_EQ(pelagic_dynamic_waves_get_view(waves_of(ocean.get()), &view), PELAGIC_OK);
        return -view.height_min_m;
    };
    const float pressed = depth_after(false, false);
    // The pressure has grown for 3 s of its 8 s, to a sixth of the draught of 0.4 m.
    EXPECT_GT(pressed, 0.03f);
    EXPECT_LT(depth_after(true, false), 0.3f * pressed);
    EXPECT_LT(depth_after(false, true), 0.3f * pressed);
}

TEST_F(CInterfaceBodies, HullsWithCoefficientsMoveInSets) {
    const std::string radiation = text_of_source("tests/potential_flow/hemisphere.1"),
                      excitation = text_of_source("tests/potential_flow/hemisphere.3");
    const HullArrays sphere(sphere_mesh(1, 24, 12));
    auto options = hull_options(1025 * sphere_mesh(1, 24, 12).volume_m3() / 2);
    options.radiation_text = radiation.c_str();
    options.excitation_text = excitation.c_str();
    const CHull buoy = hull_of(sphere, options);
    const COcean ocean = water();
    const CBodies bodies = bodies_of(ocean);
    const std::uint32_t number = add(bodies, buoy, at_rest(buoy, 0, 0));
    for (int tick = 0; tick < 30; ++tick) advance(ocean, bodies, tick);
    pelagic_hull_state state = state_of(bodies, number);
    EXPECT_NE(state.velocity_mps[1], 0);
    // setting the state that was read keeps the memory of radiation
    const std::vector<std::uint8_t> before = saved(bodies);
    EXPECT_EQ(pelagic_bodies_set_state(bodies.get(), number, &state), PELAGIC_OK);
    EXPECT_EQ(saved(bodies), before);
    pelagic_hull_loads loads;
    EXPECT_EQ(pelagic_hull_compute_loads(buoy.get(), ocean.get(), &state, 0, nullptr, &loads),
              PELAGIC_INVALID_ARGUMENT);
    EXPECT_STREQ(pelagic_last_error(),
                 "the hull has radiation_text, expected a hull without: it moves in pelagic_bodies");
    options.radiation_text = "1 2";
    const pelagic_hull_mesh mesh = sphere.mesh();
    pelagic_hull* none = nullptr;
    EXPECT_EQ(pelagic_hull_create(&mesh, &options, &none), PELAGIC_INVALID_ARGUMENT);
    EXPECT_STREQ(pelagic_last_error(), "radiation_text: line 1: expected the columns PER I J A(I,J) B(I,J)");
    options.radiation_text = nullptr;
    EXPECT_EQ(pelagic_hull_create(&mesh, &options, &none), PELAGIC_INVALID_ARGUMENT);
    EXPECT_STREQ(pelagic_last_error(), "excitation_text needs radiation_text");
}

}  // namespace
}  // namespace pelagic
