// Dynamic waves through the C interface: saved states, waves without an ocean, and errors.
#include <limits>
#include <vector>

#include "pelagic/tests/capi_sea.hpp"

namespace pelagic {
namespace {

class CInterfaceDynamicWaves : public testing::Test {
   protected:
    COceanExecutor serial = executor_of(PELAGIC_EXECUTOR_SERIAL);

    COcean with_dynamic_waves(bool has_dynamic_waves = true, double side_m = 32) const {
        auto dynamic_waves = pelagic_dynamic_waves_options_make();
        dynamic_waves.resolution = 64;
        dynamic_waves.side_m = side_m;
        dynamic_waves.border_m = 6;
        auto options = pelagic_ocean_options_make();
        options.executor = serial.get();
        options.queries = 1;
        options.dynamic_waves = has_dynamic_waves ? &dynamic_waves : nullptr;
        return ocean_of(small_sea(), options);
    }
    static pelagic_disturbance drop(double height_m = 0.5) {
        auto drop = pelagic_disturbance_make();
        drop.mode = PELAGIC_DISTURBANCE_IMPULSE;
        drop.height_m = height_m;
        return drop;
    }
    static pelagic_disturbance boat() {
        pelagic_disturbance boat = drop(-0.3);
        boat.mode = PELAGIC_DISTURBANCE_PRESSURE;
        boat.shape = PELAGIC_SHAPE_HULL;
        boat.length_m = 2;
        boat.velocity_x_mps = 1.5;
        return boat;
    }
    static void run(const COcean& ocean, int from, int to) {
        for (int frame = from; frame < to; ++frame) {
            if (frame % 9 == 4) {
                const pelagic_disturbance each = drop();
                ASSERT_EQ(pelagic_dynamic_waves_add_impulse(waves_of(ocean.get()), &each), PELAGIC_OK);
            }
            ASSERT_EQ(pelagic_dynamic_waves_set_center(waves_of(ocean.get()), 0.02 * frame, 0), PELAGIC_OK);
            complete(ocean, frame / 60.0);
        }
    }
    static std::uint64_t dynamic_waves_hash(const COcean& ocean) {
        std::uint64_t hash = 0;
        EXPECT_EQ(pelagic_dynamic_waves_hash(waves_of(ocean.get()), &hash), PELAGIC_OK) << pelagic_last_error();
        return hash;
    }
};

TEST_F(CInterfaceDynamicWaves, InvalidRainIsRejected) {
    auto rain = pelagic_rain_make();
    const COcean ocean = with_dynamic_waves();
    rain.drops_per_m2_s = 4, rain.radius_m = 3;
    expect_rejected(pelagic_dynamic_waves_set_rain(waves_of(ocean.get()), &rain), PELAGIC_INVALID_ARGUMENT,
                    "radius_m 3 is out of range [0.001, 2], to a 16th of side_m");
    rain.radius_m = 0.6, rain.height_m = 11;
    expect_rejected(pelagic_dynamic_waves_set_rain(waves_of(ocean.get()), &rain), PELAGIC_INVALID_ARGUMENT,
                    "height_m 11 is out of range [-10, 10]");
    // drops ten texels wide, half a metre per texel
    rain.height_m = 0.1, rain.drops_per_m2_s = 100;
    expect_rejected(pelagic_dynamic_waves_set_rain(waves_of(ocean.get()), &rain), PELAGIC_INVALID_ARGUMENT,
                    "drops_per_m2_s 100 is out of range [0, 38.4] for drops of this radius on this grid");
    rain.drops_per_m2_s = 1;
    EXPECT_EQ(pelagic_dynamic_waves_set_rain(waves_of(with_dynamic_waves(false).get()), &rain),
              PELAGIC_INVALID_ARGUMENT);
    EXPECT_EQ(pelagic_dynamic_waves_set_rain(waves_of(ocean.get()), nullptr), PELAGIC_INVALID_ARGUMENT);
}

TEST_F(CInterfaceDynamicWaves, RestoreASavedState) {
    const COcean continuous = with_dynamic_waves(), rolled_back = with_dynamic_waves();
    for (const COcean* ocean : {&continuous, &rolled_back}) {
        std::uint32_t number = 0;
        const pelagic_disturbance source = boat();
        ASSERT_EQ(pelagic_dynamic_waves_add_source(waves_of(ocean->get()), &source, &number), PELAGIC_OK);
        run(*ocean, 0, 30);
    }
    std::size_t count = 0;
    ASSERT_EQ(pelagic_dynamic_waves_save_state(waves_of(rolled_back.get()), nullptr, 0, &count), PELAGIC_OK);
    std::vector<std::uint8_t> saved(count);
    expect_rejected(pelagic_dynamic_waves_save_state(waves_of(rolled_back.get()), saved.data(), count - 1, &count),
                    PELAGIC_INVALID_ARGUMENT,
                    "room is " + std::to_string(count - 1) + ", expected " + std::to_string(count) + " or more");
    ASSERT_EQ(pelagic_dynamic_waves_save_state(waves_of(rolled_back.get()), saved.data(), saved.size(), &count),
              PELAGIC_OK);
    const pelagic_disturbance stone = drop(3);
    ASSERT_EQ(pelagic_dynamic_waves_add_impulse(waves_of(rolled_back.get()), &stone), PELAGIC_OK);
    run(rolled_back, 30, 50);
    ASSERT_EQ(pelagic_dynamic_waves_remove_source(waves_of(rolled_back.get()), 1), PELAGIC_OK);
    ASSERT_EQ(pelagic_dynamic_waves_restore_state(waves_of(rolled_back.get()), saved.data(), saved.size()),
              PELAGIC_OK)
        << pelagic_last_error();
    run(rolled_back, 30, 80);
    run(continuous, 30, 80);
    EXPECT_EQ(dynamic_waves_hash(rolled_back), dynamic_waves_hash(continuous));
    EXPECT_EQ(pelagic_dynamic_waves_restore_state(waves_of(rolled_back.get()), saved.data(), saved.size() - 1),
              PELAGIC_INVALID_ARGUMENT);
    expect_rejected(
        pelagic_dynamic_waves_restore_state(waves_of(with_dynamic_waves(true, 48).get()), saved.data(), saved.size()),
        PELAGIC_INVALID_ARGUMENT, "the saved state has other options, expected those of these dynamic waves");
    ASSERT_EQ(pelagic_ocean_schedule(rolled_back.get(), 2), PELAGIC_OK);
    EXPECT_EQ(pelagic_dynamic_waves_save_state(waves_of(rolled_back.get()), saved.data(), saved.size(), &count),
              PELAGIC_WRONG_ORDER);
    EXPECT_EQ(pelagic_dynamic_waves_restore_state(waves_of(rolled_back.get()), saved.data(), saved.size()),
              PELAGIC_WRONG_ORDER);
}

// Waves without an ocean that get identical commands at identical times are bit-identical.
TEST_F(CInterfaceDynamicWaves, StandaloneWavesEqualThoseOfAnOcean) {
    const COcean ocean = with_dynamic_waves();
    auto options = pelagic_dynamic_waves_options_make();
    options.resolution = 64, options.side_m = 32, options.border_m = 6;
    auto one_thread = pelagic_executor_options_make();
    one_thread.kind = PELAGIC_EXECUTOR_SERIAL;
    pelagic_executor* executor = nullptr;
    ASSERT_EQ(pelagic_executor_create(&one_thread, &executor), PELAGIC_OK);
    auto resources = pelagic_dynamic_waves_resources_make();
    resources.executor = executor;
    resources.isa = "avx3";
    pelagic_dynamic_waves* alone = nullptr;
    expect_rejected(pelagic_dynamic_waves_create(&options, &resources, &alone), PELAGIC_INVALID_ARGUMENT,
                    "isa is avx3, expected sse4.2, avx2, avx512 or neon");
    EXPECT_EQ(alone, nullptr);
    resources.isa = nullptr;
    ASSERT_EQ(pelagic_dynamic_waves_create(&options, &resources, &alone), PELAGIC_OK) << pelagic_last_error();
    pelagic_dynamic_waves_view view{};
    EXPECT_EQ(pelagic_dynamic_waves_get_view(alone, &view), PELAGIC_WRONG_ORDER);
    const pelagic_disturbance source = boat();
    for (int frame = 0; frame < 30; ++frame) {
        for (pelagic_dynamic_waves* waves : {alone, waves_of(ocean.get())}) {
            std::uint32_t number = 0;
            if (frame == 3) {
                ASSERT_EQ(pelagic_dynamic_waves_add_source(waves, &source, &number), PELAGIC_OK);
            }
            ASSERT_EQ(pelagic_dynamic_waves_set_center(waves, 0.02 * frame, 0), PELAGIC_OK);
        }
        ASSERT_EQ(pelagic_dynamic_waves_advance(alone, frame / 45.0), PELAGIC_OK);
        complete(ocean, frame / 45.0);
        std::uint64_t hash = 0;
        ASSERT_EQ(pelagic_dynamic_waves_hash(alone, &hash), PELAGIC_OK);
        ASSERT_EQ(hash, dynamic_waves_hash(ocean)) << frame;
    }
    ASSERT_EQ(pelagic_dynamic_waves_get_view(alone, &view), PELAGIC_OK);
    EXPECT_GT(view.height_max_m, 0);
    EXPECT_EQ(pelagic_dynamic_waves_advance(alone, std::numeric_limits<double>::quiet_NaN()),
              PELAGIC_INVALID_ARGUMENT);
    // has no effect: the ocean owns its waves
    pelagic_dynamic_waves_destroy(waves_of(ocean.get()));
    pelagic_dynamic_waves_destroy(alone);
    pelagic_executor_destroy(executor);
    complete(ocean, 1);
}

TEST_F(CInterfaceDynamicWaves, InvalidArgumentsAreRejected) {
    const COcean without = with_dynamic_waves(false), with = with_dynamic_waves();
    pelagic_dynamic_waves_view surface{};
    EXPECT_EQ(pelagic_dynamic_waves_get_view(waves_of(with.get()), &surface), PELAGIC_WRONG_ORDER);
    complete(without, 0);
    complete(with, 0);
    pelagic_dynamic_waves* none = waves_of(with.get());
    expect_rejected(pelagic_ocean_dynamic_waves(without.get(), &none), PELAGIC_INVALID_ARGUMENT,
                    "the ocean has no dynamic waves: it was created without pelagic_ocean_options.dynamic_waves");
    EXPECT_EQ(none, nullptr);
    std::uint64_t hash = 0;
    EXPECT_EQ(pelagic_dynamic_waves_hash(none, &hash), PELAGIC_INVALID_ARGUMENT);
    expect_rejected(pelagic_dynamic_waves_advance(waves_of(with.get()), 1), PELAGIC_WRONG_ORDER,
                    "an ocean advances these waves, expected waves of pelagic_dynamic_waves_create");
    EXPECT_EQ(pelagic_dynamic_waves_get_view(waves_of(without.get()), &surface), PELAGIC_INVALID_ARGUMENT);
    EXPECT_EQ(pelagic_dynamic_waves_set_center(waves_of(without.get()), 0, 0), PELAGIC_INVALID_ARGUMENT);
    EXPECT_EQ(pelagic_dynamic_waves_set_current(waves_of(without.get()), 0, 0), PELAGIC_INVALID_ARGUMENT);
    expect_rejected(pelagic_dynamic_waves_set_current(waves_of(with.get()), 11, 0), PELAGIC_INVALID_ARGUMENT,
                    "current_x_mps 11 is out of range [-10, 10]");
    pelagic_disturbance wrong = drop();
    EXPECT_EQ(pelagic_dynamic_waves_add_impulse(waves_of(without.get()), &wrong), PELAGIC_INVALID_ARGUMENT);
    wrong.radius_m = 0;
    expect_rejected(pelagic_dynamic_waves_add_impulse(waves_of(with.get()), &wrong), PELAGIC_INVALID_ARGUMENT,
                    "radius_m 0 is out of range [0.001, 1000]");
    wrong = drop();
    wrong.mode = 4;
    expect_rejected(pelagic_dynamic_waves_add_impulse(waves_of(with.get()), &wrong), PELAGIC_INVALID_ARGUMENT,
                    "mode is 4, expected one of PELAGIC_DISTURBANCE_...");
    wrong = drop();
    wrong.shape = -1;
    EXPECT_EQ(pelagic_dynamic_waves_set_source(waves_of(with.get()), 1, &wrong), PELAGIC_INVALID_ARGUMENT);
    EXPECT_EQ(pelagic_dynamic_waves_add_impulse(waves_of(with.get()), nullptr), PELAGIC_INVALID_ARGUMENT);
    EXPECT_EQ(pelagic_dynamic_waves_add_source(waves_of(with.get()), &wrong, nullptr), PELAGIC_INVALID_ARGUMENT);
    EXPECT_EQ(pelagic_dynamic_waves_set_center(waves_of(with.get()), std::numeric_limits<double>::quiet_NaN(), 0),
              PELAGIC_INVALID_ARGUMENT);

    auto dynamic_waves = pelagic_dynamic_waves_options_make();
    dynamic_waves.border_m = 20;
    auto options = pelagic_ocean_options_make();
    options.dynamic_waves = &dynamic_waves;
    const pelagic_sea sea = small_sea();
    pelagic_ocean* ocean = nullptr;
    expect_rejected(pelagic_ocean_create(&sea, &options, &ocean), PELAGIC_INVALID_ARGUMENT,
                    "dynamic_waves.border_m is 20, expected at most a quarter of side_m, 16");
    dynamic_waves.border_m = 0;
    dynamic_waves.step = 2;
    EXPECT_EQ(pelagic_ocean_create(&sea, &options, &ocean), PELAGIC_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace pelagic
