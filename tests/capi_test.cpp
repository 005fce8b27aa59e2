// The C interface: results equal those of C++, and every misuse returns a status and a message of
// one line. Linked against the shared library only.
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <thread>

#include "pelagic/tests/capi_sea.hpp"
#include "pelagic/tests/platform/platform.hpp"
#include "pelagic/tests/test_paths.hpp"

namespace pelagic {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

/// Checks that the call fails with status `expected` and a message that contains `words`.
void expect_failure(pelagic_status status, pelagic_status expected, const std::string& words) {
    EXPECT_EQ(status, expected) << pelagic_last_error();
    const std::string message = pelagic_last_error();
    EXPECT_NE(message.find(words), std::string::npos) << message << "\nlacks " << words;
    EXPECT_EQ(message.find('\n'), std::string::npos);
}
void expect_invalid(pelagic_status status, const std::string& words) {
    expect_failure(status, PELAGIC_INVALID_ARGUMENT, words);
}
void expect_wrong_order(pelagic_status status, const std::string& words) {
    expect_failure(status, PELAGIC_WRONG_ORDER, words);
}

COcean make_ocean(std::int32_t resolution = 16) {
    return ocean_of(small_sea(resolution), executor_of(PELAGIC_EXECUTOR_SERIAL).get());
}

TEST(CInterface, HasTheVersionOfTheProject) {
    EXPECT_STREQ(PELAGIC_PROJECT_VERSION,
                 (std::to_string(pelagic_version() / 10000) + "." + std::to_string(pelagic_version() / 100 % 100) +
                  "." + std::to_string(pelagic_version() % 100))
                     .c_str());
}

// Bit-identical to the transitions of the C++ interface, which have their own tests.
TEST(CInterface, TransitionsAreGivenTogetherOrOneByOne) {
    const pelagic_sea before = small_sea();
    pelagic_sea after = before, other = before;
    after.wind_speed_mps = 5;
    other.seed = 99;
    auto change = pelagic_change_make();
    change.sea = &after;
    change.from_s = 1;
    change.over_s = 10;
    pelagic_change changes[2] = {change, change};
    changes[1].sea = &before;
    changes[1].from_s = 20;
    auto forecast = pelagic_forecast_make();
    forecast.first = &before;
    forecast.changes = changes;
    forecast.change_count = 2;

    pelagic_ocean* created = nullptr;
    ASSERT_EQ(pelagic_ocean_create_forecast(&forecast, nullptr, &created), PELAGIC_OK) << pelagic_last_error();
    const COcean at_once(created);
    const COcean live = make_ocean();
    for (const pelagic_change& each : changes)
        ASSERT_EQ(pelagic_ocean_schedule_change(live.get(), &each), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(hash_at(at_once, 0), hash_at(make_ocean(), 0));
    EXPECT_NE(hash_at(at_once, 5), hash_at(make_ocean(), 5));
    for (const double time_s : {5.0, 15.0, 24.0}) EXPECT_EQ(hash_at(at_once, time_s), hash_at(live, time_s));

    expect_invalid(pelagic_ocean_schedule_change(live.get(), &change), "change 2: from_s is 1, expected at least 30");
    change.swell_from_m = 1;
    expect_invalid(pelagic_ocean_schedule_change(live.get(), &change),
                   "change 2: swell_from_m 1 is out of range [1e3, 2e7]");
    change.swell_from_m = 0;
    change.from_s = 40;
    change.sea = &other;
    expect_invalid(pelagic_ocean_schedule_change(live.get(), &change), "change 2: seed is 99");
    change.sea = nullptr;
    expect_invalid(pelagic_ocean_schedule_change(live.get(), &change), "sea is NULL");
    changes[1].struct_size = 24;
    expect_invalid(pelagic_ocean_create_forecast(&forecast, nullptr, &created), "changes[1].struct_size");
    EXPECT_EQ(created, nullptr);
    ASSERT_EQ(pelagic_ocean_schedule_sea(live.get(), &after), PELAGIC_OK);
    expect_wrong_order(pelagic_ocean_schedule_change(live.get(), &changes[0]), "a sea is being baked");
}

// The hash of `wanted` in tests/golden, 0 if there is no such name.
std::uint64_t golden_hash(const std::string& wanted) {
    std::ifstream file(in_sources("tests/golden/hashes.txt"));
    for (std::string name, hash; file >> name >> hash;)
        if (name == wanted) return std::stoull(hash, nullptr, 16);
    return 0;
}

TEST(CInterface, FramesHaveTheGoldenHash) {
    auto sea = pelagic_sea_make();
    pelagic_ocean* ocean = nullptr;
    ASSERT_EQ(pelagic_ocean_create(&sea, nullptr, &ocean), PELAGIC_OK);
    complete(ocean, 12.34);
    EXPECT_EQ(hash_of(ocean), golden_hash("default@12.34"));
    pelagic_ocean_destroy(ocean);
}

TEST(CInterface, AnUnknownPresetIsNamed) {
    auto sea = pelagic_sea_make();
    expect_invalid(pelagic_sea_preset("choppy", &sea),
                   "preset is choppy, expected one of pond, calm, lake, analytic-calm, analytic-moderate, swell, "
                   "moderate, rough, "
                   "analytic-intense, storm, beaufort-0 to beaufort-12");
    expect_invalid(pelagic_sea_preset(std::string(5000, 'x').c_str(), &sea), "preset is xxx");
}

// Messages equal those of check(SeaState).
TEST(CInterface, InvalidFieldsOfASeaAreNamed) {
    const std::map<std::string, std::function<void(pelagic_sea&)>> mistakes = {
        {"system_count is 9, expected 0 to 8", [](pelagic_sea& sea) { sea.system_count = 9; }},
        {"system_count is -1, expected 0 to 8", [](pelagic_sea& sea) { sea.system_count = -1; }},
        {"systems[0].spreading is 9, expected one of PELAGIC_SPREADING_...",
         [](pelagic_sea& sea) {
             sea.systems[0] = pelagic_wave_system_make();
             sea.systems[0].spreading = 9;
             sea.system_count = 1;
         }},
        {"systems[1].height_m -1 is out of range (0, 30], or 0: by the wind",
         [](pelagic_sea& sea) {
             sea.systems[0] = sea.systems[1] = pelagic_wave_system_make();
             sea.systems[1].height_m = -1;
             sea.system_count = 2;
         }},
        {"spectrum is -1, expected one of PELAGIC_SPECTRUM_...", [](pelagic_sea& sea) { sea.spectrum = -1; }},
        {"resolution is 17, expected a power of two from 16 to 2048", [](pelagic_sea& sea) { sea.resolution = 17; }},
        {"resolution is -2147483648", [](pelagic_sea& sea) { sea.resolution = INT32_MIN; }},
        {"wind_speed_mps -3 is out of range (0, 60]", [](pelagic_sea& sea) { sea.wind_speed_mps = -3; }},
        {"fetch_m 0 is out of range (0, 2e6]", [](pelagic_sea& sea) { sea.fetch_m = 0; }},
        {"spreading is 4, expected one of PELAGIC_SPREADING_...", [](pelagic_sea& sea) { sea.spreading = 4; }},
        {"wave_height_m 31 is out of range (0, 30], or 0: chosen", [](pelagic_sea& sea) { sea.wave_height_m = 31; }},
        {"swell_spread_rad 2 is out of range [pi/180, 4 pi/9]", [](pelagic_sea& sea) { sea.swell_spread_rad = 2; }},
        {"cascades is 5, expected 1, 2, 3 or 4", [](pelagic_sea& sea) { sea.cascades = 5; }},
        {"cascades is 2, expected 1 where the side of the cascade is given",
         [](pelagic_sea& sea) { sea.cascades = 2; }},
        {"cascades is 3, expected 1 where the resolution is 16",
         [](pelagic_sea& sea) { sea.cascades = 3, sea.patch_size_m = 0; }},
        {"spreading is hasselmann, expected paper where the spectrum is phillips-paper",
         [](pelagic_sea& sea) {
             sea.spectrum = PELAGIC_SPECTRUM_PHILLIPS_PAPER;
             sea.spreading = PELAGIC_SPREADING_HASSELMANN;
         }},
        {"swell_height_m is 2, expected 0 where the spectrum is phillips-paper",
         [](pelagic_sea& sea) {
             sea.spectrum = PELAGIC_SPECTRUM_PHILLIPS_PAPER;
             sea.swell_height_m = 2;
         }},
    };
    const COcean ocean = make_ocean();
    for (const auto& [line, make] : mistakes) {
        pelagic_sea sea = small_sea();
        make(sea);
        auto* made = reinterpret_cast<pelagic_ocean*>(1);
        expect_invalid(pelagic_sea_check(&sea), line);
        expect_invalid(pelagic_ocean_create(&sea, nullptr, &made), line);
        EXPECT_EQ(made, nullptr);
        expect_invalid(pelagic_ocean_schedule_sea(ocean.get(), &sea), line);
    }
}

TEST(CInterface, NullPointersAreNamed) {
    const COcean ocean = make_ocean();
    auto sea = small_sea();
    pelagic_frame frame{};
    pelagic_ocean_info info{};
    auto options = pelagic_executor_options_make();
    auto points = pelagic_points_make();
    auto samples = pelagic_samples_make();
    auto ray = pelagic_ray_make();
    pelagic_hit hit{};
    auto buffers = pelagic_frame_buffers_make();
    pelagic_cascade cascade{};
    const auto water = pelagic_water_frame_make();
    pelagic_executor* executor = nullptr;
    pelagic_ocean* made = nullptr;
    std::int32_t flag = 0;
    std::uint64_t hash = 0;

    expect_invalid(pelagic_sea_preset(nullptr, &sea), "name is NULL");
    expect_invalid(pelagic_sea_preset("calm", nullptr), "sea is NULL");
    expect_invalid(pelagic_sea_check(nullptr), "sea is NULL");
    expect_invalid(pelagic_executor_create(nullptr, &executor), "options is NULL");
    expect_invalid(pelagic_executor_create(&options, nullptr), "executor is NULL");
    expect_invalid(pelagic_executor_set_spin_us(nullptr, 0), "executor is NULL");
    expect_invalid(pelagic_ocean_create(nullptr, nullptr, &made), "sea is NULL");
    expect_invalid(pelagic_ocean_create(&sea, nullptr, nullptr), "ocean is NULL");
    expect_invalid(pelagic_ocean_describe(nullptr, &info), "ocean is NULL");
    expect_invalid(pelagic_ocean_describe(ocean.get(), nullptr), "info is NULL");
    expect_invalid(pelagic_ocean_schedule(nullptr, 0), "ocean is NULL");
    expect_invalid(pelagic_ocean_poll(nullptr, &flag), "ocean is NULL");
    expect_invalid(pelagic_ocean_complete(nullptr, &frame), "ocean is NULL");
    expect_invalid(pelagic_ocean_frame_at(nullptr, 0, &buffers, nullptr), "ocean is NULL");
    expect_invalid(pelagic_ocean_frame_at(ocean.get(), 0, nullptr, nullptr), "buffers is NULL");
    expect_invalid(pelagic_ocean_copy(nullptr, &buffers), "ocean is NULL");
    expect_invalid(pelagic_ocean_cascade(nullptr, 0, &cascade), "ocean is NULL");
    expect_invalid(pelagic_ocean_frame_hash(nullptr, 0, PELAGIC_HASH_FRAME, &hash), "ocean is NULL");
    expect_invalid(pelagic_ocean_schedule_sea(nullptr, &sea), "ocean is NULL");
    expect_invalid(pelagic_ocean_schedule_sea(ocean.get(), nullptr), "sea is NULL");
    expect_invalid(pelagic_ocean_set_water_frame(nullptr, &water), "ocean is NULL");
    expect_invalid(pelagic_ocean_set_water_frame(ocean.get(), nullptr), "water is NULL");
    expect_invalid(pelagic_ocean_poll_sea(nullptr, &flag), "ocean is NULL");
    expect_invalid(pelagic_ocean_complete_sea(nullptr), "ocean is NULL");
    expect_invalid(pelagic_ocean_query(nullptr, &points, &samples), "ocean is NULL");
    expect_invalid(pelagic_ocean_query_series(nullptr, nullptr, 0, nullptr, &points, &samples, nullptr), "ocean is NULL");
    expect_invalid(pelagic_ocean_query_series(ocean.get(), nullptr, 1, nullptr, &points, &samples, nullptr),
                   "times_s is NULL");
    expect_invalid(pelagic_ocean_first_hit(nullptr, &ray, &hit), "ocean is NULL");
    pelagic_executor_destroy(nullptr);
    pelagic_ocean_destroy(nullptr);

    EXPECT_EQ(pelagic_ocean_schedule(ocean.get(), 0), PELAGIC_OK);
    expect_invalid(pelagic_ocean_poll(ocean.get(), nullptr), "is_ready is NULL");
    expect_invalid(pelagic_ocean_complete(ocean.get(), nullptr), "frame is NULL");
    EXPECT_EQ(pelagic_ocean_complete(ocean.get(), &frame), PELAGIC_OK) << "a failed complete leaves it in flight";
    expect_invalid(pelagic_ocean_copy(ocean.get(), nullptr), "buffers is NULL");
    expect_invalid(pelagic_ocean_cascade(ocean.get(), 0, nullptr), "cascade is NULL");
    expect_invalid(pelagic_ocean_frame_hash(ocean.get(), 0, PELAGIC_HASH_FRAME, nullptr), "hash is NULL");
    expect_invalid(pelagic_ocean_query(ocean.get(), nullptr, &samples), "points is NULL");
    expect_invalid(pelagic_ocean_query(ocean.get(), &points, nullptr), "samples is NULL");
    expect_invalid(pelagic_ocean_first_hit(ocean.get(), nullptr, &hit), "ray is NULL");
    ray.direction[1] = -1;
    expect_invalid(pelagic_ocean_first_hit(ocean.get(), &ray, nullptr), "hit is NULL");
    points.count = 1;
    expect_invalid(pelagic_ocean_query(ocean.get(), &points, &samples), "points.x is NULL");
    EXPECT_EQ(pelagic_ocean_schedule_sea(ocean.get(), &sea), PELAGIC_OK);
    expect_invalid(pelagic_ocean_poll_sea(ocean.get(), nullptr), "is_ready is NULL");
}

TEST(CInterface, WrongStructSizesAreNamed) {
    const COcean ocean = make_ocean();
    complete(ocean, 0);
    for (const std::uint32_t size : {0u, 1u, 4u, 7u, 100000u, 0xffffffffu}) {
        const auto with_size = [size]<class T>(T value) {
            value.struct_size = size;
            return value;
        };
        auto sea = with_size(small_sea());
        auto good_sea = small_sea();
        auto executor_options = with_size(pelagic_executor_options{});
        auto ocean_options = with_size(pelagic_ocean_options{});
        auto buffers = with_size(pelagic_frame_buffers{});
        auto points = with_size(pelagic_points{});
        auto samples = with_size(pelagic_samples{});
        auto good_points = pelagic_points_make();
        auto good_samples = pelagic_samples_make();
        auto ray = with_size(pelagic_ray{});
        pelagic_hit hit{};
        pelagic_executor* executor = nullptr;
        pelagic_ocean* made = nullptr;

        expect_invalid(pelagic_sea_check(&sea), "sea.struct_size is " + std::to_string(size) + ", expected ");
        expect_invalid(pelagic_sea_preset("calm", &sea), "sea.struct_size");
        expect_invalid(pelagic_executor_create(&executor_options, &executor), "options.struct_size");
        expect_invalid(pelagic_ocean_create(&sea, nullptr, &made), "sea.struct_size");
        expect_invalid(pelagic_ocean_create(&good_sea, &ocean_options, &made), "options.struct_size");
        expect_invalid(pelagic_ocean_frame_at(ocean.get(), 0, &buffers, nullptr), "buffers.struct_size");
        expect_invalid(pelagic_ocean_schedule_sea(ocean.get(), &sea), "sea.struct_size");
        expect_invalid(pelagic_ocean_query(ocean.get(), &points, &good_samples), "points.struct_size");
        expect_invalid(pelagic_ocean_query(ocean.get(), &good_points, &samples), "samples.struct_size");
        expect_invalid(pelagic_ocean_first_hit(ocean.get(), &ray, &hit), "ray.struct_size");
    }
}

TEST(CInterface, AWrongNumberOfCascadesIsNamed) {
    const COcean ocean = make_ocean();
    auto buffers = pelagic_frame_buffers_make();
    buffers.cascade_count = 2;
    expect_invalid(pelagic_ocean_frame_at(ocean.get(), 0, &buffers, nullptr),
                   "buffers.cascade_count is 2, expected 1");
}

TEST(CInterface, OptionsOutOfRangeAreNamed) {
    const auto create_with = [](const std::function<void(pelagic_executor_options&)>& change) {
        auto options = pelagic_executor_options_make();
        change(options);
        pelagic_executor* executor = nullptr;
        const pelagic_status status = pelagic_executor_create(&options, &executor);
        EXPECT_EQ(executor, nullptr);
        return status;
    };
    expect_invalid(create_with([](auto& o) { o.kind = 5; }), "kind is 5, expected 0 to 4");
    expect_invalid(create_with([](auto& o) { o.kind = -1; }), "kind is -1");
    expect_invalid(create_with([](auto& o) { o.threads = -1; }), "threads is -1, expected 0 to 1024");
    expect_invalid(create_with([](auto& o) { o.kind = PELAGIC_EXECUTOR_THREADS, o.threads = 1025; }),
                   "threads is 1025, expected 0 to 1024");
    expect_invalid(create_with([](auto& o) { o.kind = PELAGIC_EXECUTOR_APPLICATION; }), "parallel_for is null");
    expect_invalid(create_with([](auto& o) { o.cpu_mask = 1; }),
                   "cpu_mask is set, expected PELAGIC_EXECUTOR_THREADS");

    const auto threads = executor_of(PELAGIC_EXECUTOR_THREADS, 2);
    EXPECT_EQ(pelagic_executor_set_spin_us(threads.get(), 0), PELAGIC_OK);
    expect_invalid(pelagic_executor_set_spin_us(threads.get(), 1001), "spin_us is 1001, expected 0 to 1000");

    const pelagic_sea sea = small_sea();
    const auto ocean_with = [&](const std::function<void(pelagic_ocean_options&)>& change) {
        auto options = pelagic_ocean_options_make();
        change(options);
        pelagic_ocean* ocean = nullptr;
        const pelagic_status status = pelagic_ocean_create(&sea, &options, &ocean);
        EXPECT_EQ(ocean, nullptr);
        return status;
    };
    expect_invalid(ocean_with([](auto& o) { o.isa = "mmx"; }), "isa is mmx");
    expect_invalid(ocean_with([](auto& o) { o.query_tolerance_m = nan; }), "query_tolerance_m is nan");
    expect_invalid(ocean_with([](auto& o) { o.query_tolerance_m = -1; }), "query_tolerance_m is -1");
}

TEST(CInterface, CallsInTheWrongOrderFailAndChangeNothing) {
    const COcean ocean = make_ocean();
    pelagic_frame frame{};
    auto buffers = pelagic_frame_buffers_make();
    auto points = pelagic_points_make();
    auto samples = pelagic_samples_make();
    const pelagic_sea sea = small_sea();
    std::uint64_t hash = 0;
    expect_wrong_order(pelagic_ocean_complete(ocean.get(), &frame), "no frame is in flight");
    expect_wrong_order(pelagic_ocean_frame_hash(ocean.get(), 0, PELAGIC_HASH_FRAME, &hash), "no frame yet");
    expect_wrong_order(pelagic_ocean_query(ocean.get(), &points, &samples), "no frame yet");
    expect_wrong_order(pelagic_ocean_complete_sea(ocean.get()), "no sea is being baked");
    expect_wrong_order(pelagic_ocean_copy(ocean.get(), &buffers), "no frame yet");
    pelagic_cascade cascade{};
    expect_wrong_order(pelagic_ocean_cascade(ocean.get(), 0, &cascade), "no frame yet");

    EXPECT_EQ(pelagic_ocean_schedule(ocean.get(), 3), PELAGIC_OK);
    expect_wrong_order(pelagic_ocean_schedule(ocean.get(), 4), "a frame is in flight");
    expect_wrong_order(pelagic_ocean_frame_at(ocean.get(), 4, &buffers, nullptr), "a frame is in flight");
    EXPECT_EQ(pelagic_ocean_schedule_sea(ocean.get(), &sea), PELAGIC_OK);
    expect_wrong_order(pelagic_ocean_schedule_sea(ocean.get(), &sea), "a sea is being baked");
    expect_wrong_order(pelagic_ocean_complete_sea(ocean.get()), "a frame is in flight");
    EXPECT_EQ(pelagic_ocean_complete(ocean.get(), &frame), PELAGIC_OK);
    EXPECT_EQ(frame.time_s, 3);
    expect_wrong_order(pelagic_ocean_complete(ocean.get(), &frame), "no frame is in flight");
    EXPECT_EQ(pelagic_ocean_complete_sea(ocean.get()), PELAGIC_OK);

    pelagic_sea other = small_sea(32);
    expect_invalid(pelagic_ocean_schedule_sea(ocean.get(), &other), "resolution is 32, expected 16");
}

TEST(CInterface, InvalidTimesAreNamed) {
    const COcean ocean = make_ocean();
    auto buffers = pelagic_frame_buffers_make();
    expect_invalid(pelagic_ocean_schedule(ocean.get(), nan), "time_s is nan, expected a finite number");
    expect_invalid(pelagic_ocean_schedule(ocean.get(), -infinity), "time_s is -inf");
    expect_invalid(pelagic_ocean_frame_at(ocean.get(), infinity, &buffers, nullptr), "time_s is inf");
    for (const double time_s : {1e300, -1e300, -0.0, 5e-324}) complete(ocean, time_s);
}

TEST(CInterface, HugeCountsAndInvalidPositionsDoNotCrash) {
    const COcean ocean = make_ocean();
    complete(ocean, 1);
    auto points = pelagic_points_make();
    auto samples = pelagic_samples_make();
    const double x[4] = {nan, infinity, 1e300, 1}, z[4] = {0, -infinity, 1, -1e15};
    float height[4], error[4];
    std::uint8_t converged[4];
    points.x = x, points.z = z;
    samples.height_m = height, samples.error_m = error, samples.converged = converged;
    for (const std::size_t count : {SIZE_MAX, SIZE_MAX / 2, SIZE_MAX / 8}) {
        points.count = count;
        expect_invalid(pelagic_ocean_query(ocean.get(), &points, &samples), "points.count is ");
    }
    points.count = 4;
    EXPECT_EQ(pelagic_ocean_query(ocean.get(), &points, &samples), PELAGIC_OK);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(error[i], std::numeric_limits<float>::infinity());
        EXPECT_EQ(converged[i], 0);
        EXPECT_EQ(std::bit_cast<std::uint32_t>(height[i]), 0x7fc00000u);
    }
    points.interpolation = 2;
    expect_invalid(pelagic_ocean_query(ocean.get(), &points, &samples), "points.interpolation is 2, expected");
    points.interpolation = PELAGIC_INTERPOLATION_LINEAR;
    points.count = 0, points.x = points.z = nullptr;
    EXPECT_EQ(pelagic_ocean_query(ocean.get(), &points, &samples), PELAGIC_OK);

    FrameArrays arrays(16);
    pelagic_frame_buffers buffers = arrays.view();
    for (const std::size_t count : {std::size_t{0}, std::size_t{255}, SIZE_MAX}) {
        buffers.plane_count = count;
        expect_invalid(pelagic_ocean_frame_at(ocean.get(), 0, &buffers, nullptr), "dx has ");
    }

    auto ray = pelagic_ray_make();
    pelagic_hit hit{};
    expect_invalid(pelagic_ocean_first_hit(ocean.get(), &ray, &hit), "ray.direction's length 0 is out of range");
    ray.direction[0] = nan;
    expect_invalid(pelagic_ocean_first_hit(ocean.get(), &ray, &hit), "ray.direction's length nan");
    ray.direction[0] = 1;
    for (const double reach_m : {nan, -1.0, infinity, 1e300}) {
        ray.reach_m = reach_m;
        expect_invalid(pelagic_ocean_first_hit(ocean.get(), &ray, &hit), "ray.reach_m is ");
    }
    ray.reach_m = 10, ray.origin_m[2] = nan;
    expect_invalid(pelagic_ocean_first_hit(ocean.get(), &ray, &hit), "ray.origin_m nan");
}

TEST(CInterface, MissingOceanOptionsAreNamed) {
    const pelagic_sea sea = small_sea();
    pelagic_ocean* plain = nullptr;
    ASSERT_EQ(pelagic_ocean_create(&sea, nullptr, &plain), PELAGIC_OK);
    const COcean ocean(plain);
    EXPECT_EQ(complete(plain, 0).velocity_x.data, nullptr);
    auto points = pelagic_points_make();
    auto samples = pelagic_samples_make();
    expect_invalid(pelagic_ocean_query(plain, &points, &samples),
                   "it was created without pelagic_ocean_options.queries");
    FrameArrays arrays(16);
    const pelagic_frame_buffers buffers = arrays.view();
    expect_invalid(pelagic_ocean_frame_at(plain, 0, &buffers, nullptr), "velocity_x is requested");
}

TEST(CInterface, EachThreadHasItsOwnMessage) {
    expect_invalid(pelagic_sea_check(nullptr), "sea is NULL");
    std::thread([] { EXPECT_STREQ(pelagic_last_error(), ""); }).join();
    const pelagic_sea sea = small_sea();
    EXPECT_EQ(pelagic_sea_check(&sea), PELAGIC_OK);
    EXPECT_NE(std::string(pelagic_last_error()), "") << "success leaves the last message";
}

TEST(CInterface, MessagesHaveTheGivenValue) {
    const pelagic_sea sea = small_sea(16);
    for (const double wanted : {1e-300, -2.5e-7, 1000.0000000000001}) {
        auto options = pelagic_ocean_options_make();
        options.query_tolerance_m = wanted;
        pelagic_ocean* ocean = nullptr;
        expect_invalid(pelagic_ocean_create(&sea, &options, &ocean), ", expected 0 or [1e-6, 1000]");
        const std::string message = pelagic_last_error();
        EXPECT_EQ(std::strtod(message.c_str() + message.find(" is ") + 4, nullptr), wanted) << message;
    }
}

TEST(CInterface, FrameAtDoesNotChangeOtherFrames) {
    const COcean ocean = ocean_of(small_sea(128), executor_of(PELAGIC_EXECUTOR_THREADS, 3).get());
    const pelagic_frame shown = complete(ocean, 1);
    const std::uint64_t before = hash_of(ocean.get());
    FrameArrays arrays(128), again(128);
    const pelagic_frame_buffers buffers = arrays.view(), other = again.view();
    pelagic_bounds bounds{};
    EXPECT_EQ(pelagic_ocean_frame_at(ocean.get(), 2, &buffers, &bounds), PELAGIC_OK);
    EXPECT_EQ(pelagic_ocean_frame_at(ocean.get(), 9, &other, nullptr), PELAGIC_OK);
    EXPECT_NE(arrays, again);
    EXPECT_EQ(before, hash_of(ocean.get()));
    EXPECT_EQ(pelagic_ocean_schedule(ocean.get(), 2), PELAGIC_OK);
    EXPECT_EQ(before, hash_of(ocean.get())) << "also while the next frame is computed";
    EXPECT_NE(shown.height.data, nullptr);

    pelagic_frame frame{};
    EXPECT_EQ(pelagic_ocean_complete(ocean.get(), &frame), PELAGIC_OK);
    const pelagic_plane* planes[6] = {&frame.dx,         &frame.height,     &frame.dz,
                                      &frame.velocity_x, &frame.velocity_y, &frame.velocity_z};
    for (int p = 0; p < 6; ++p)
        for (int texel = 0; texel < 128 * 128; ++texel)
            ASSERT_EQ(texel_of(*planes[p], texel % 128, texel / 128),
                      arrays.planes[static_cast<std::size_t>(p)][static_cast<std::size_t>(texel)]);
    EXPECT_EQ(std::memcmp(frame.displacement_rgba16f, arrays.halves.data(), 2 * arrays.halves.size()), 0);
    EXPECT_EQ(std::memcmp(frame.gradient_rgba8, arrays.bytes.data(), 4 * arrays.bytes.size()), 0);
    EXPECT_EQ(frame.gradient_levels, 8);
    EXPECT_EQ(frame.gradient_offset[7] + 1, arrays.bytes.size());
    EXPECT_EQ(std::memcmp(&frame.bounds, &bounds, sizeof bounds), 0);
}

// If complete() computes the frame itself, poll() must not report "not ready" forever.
TEST(CInterface, PollReportsReadyEventually) {
    for (const std::int32_t kind : {PELAGIC_EXECUTOR_SERIAL, PELAGIC_EXECUTOR_THREADS}) {
        for (const std::int32_t resolution : {16, 256}) {
            const COcean ocean = ocean_of(small_sea(resolution), executor_of(kind, 2).get());
            pelagic_frame frame{};
            const pelagic_sea sea = small_sea(resolution);
            for (int n = 0; n < 5; ++n) {
                std::int32_t is_ready = 0, sea_is_ready = 0;
                ASSERT_EQ(pelagic_ocean_schedule_sea(ocean.get(), &sea), PELAGIC_OK);
                ASSERT_EQ(pelagic_ocean_schedule(ocean.get(), n), PELAGIC_OK);
                while (!is_ready || !sea_is_ready) {
                    ASSERT_EQ(pelagic_ocean_poll(ocean.get(), &is_ready), PELAGIC_OK);
                    ASSERT_EQ(pelagic_ocean_poll_sea(ocean.get(), &sea_is_ready), PELAGIC_OK);
                    std::this_thread::yield();
                }
                ASSERT_EQ(pelagic_ocean_complete(ocean.get(), &frame), PELAGIC_OK);
                ASSERT_EQ(pelagic_ocean_complete_sea(ocean.get()), PELAGIC_OK);
            }
        }
    }
}

// Equal to Ocean::is_ready(): no work is pending.
TEST(CInterface, PollReportsReadyIfNothingIsInFlight) {
    const COcean ocean = make_ocean();
    const pelagic_sea sea = small_sea();
    const auto expect_ready = [&] {
        std::int32_t is_ready = -1;
        EXPECT_EQ(pelagic_ocean_poll(ocean.get(), &is_ready), PELAGIC_OK);
        EXPECT_EQ(is_ready, 1);
        is_ready = -1;
        EXPECT_EQ(pelagic_ocean_poll_sea(ocean.get(), &is_ready), PELAGIC_OK);
        EXPECT_EQ(is_ready, 1);
    };
    expect_ready();
    complete(ocean, 1);
    ASSERT_EQ(pelagic_ocean_schedule_sea(ocean.get(), &sea), PELAGIC_OK);
    ASSERT_EQ(pelagic_ocean_complete_sea(ocean.get()), PELAGIC_OK);
    expect_ready();
}

TEST(CInterface, ACopyIsThatOfTheFrameCompletedLast) {
    const COcean ocean = ocean_of(small_sea(64), executor_of(PELAGIC_EXECUTOR_THREADS, 3).get());
    complete(ocean, 2);
    FrameArrays arrays(64), later(64);
    const pelagic_frame_buffers buffers = arrays.view(), later_buffers = later.view();
    ASSERT_EQ(pelagic_ocean_copy(ocean.get(), &buffers), PELAGIC_OK) << pelagic_last_error();
    ASSERT_EQ(pelagic_ocean_schedule(ocean.get(), 3), PELAGIC_OK);
    ASSERT_EQ(pelagic_ocean_copy(ocean.get(), &later_buffers), PELAGIC_OK);
    EXPECT_EQ(arrays, later) << "also while the next frame is computed";

    FrameArrays one(64);
    auto height_alone = pelagic_frame_buffers_make();
    height_alone.plane_count = 64 * 64;
    height_alone.height = one.planes[1].data();
    EXPECT_EQ(pelagic_ocean_copy(ocean.get(), &height_alone), PELAGIC_OK);
    EXPECT_EQ(one.planes[1], arrays.planes[1]);
    height_alone.plane_count = 5;
    expect_invalid(pelagic_ocean_copy(ocean.get(), &height_alone), "height has 5 elements, expected 4096");
}

// Equal to a C++ application that queries the frame of frame_at().
TEST(CInterface, AFrameOfFrameAtCanBeQueriedBeforeTheFirstComplete) {
    const COcean ocean = make_ocean(64);
    auto points = pelagic_points_make();
    auto samples = pelagic_samples_make();
    const double place = 0;
    float height = 0;
    points.count = 1, points.x = points.z = &place;
    samples.height_m = &height;
    const auto height_by_query = [&] {
        height = -1000;
        EXPECT_EQ(pelagic_ocean_query(ocean.get(), &points, &samples), PELAGIC_OK) << pelagic_last_error();
        return height;
    };
    for (const double time_s : {1.0, 2.0, 3.0}) {
        FrameArrays arrays(64), copied(64);
        const pelagic_frame_buffers buffers = arrays.view(), copied_buffers = copied.view();
        ASSERT_EQ(pelagic_ocean_frame_at(ocean.get(), time_s, &buffers, nullptr), PELAGIC_OK);
        const float queried = height_by_query();
        ASSERT_EQ(pelagic_ocean_copy(ocean.get(), &copied_buffers), PELAGIC_OK);
        EXPECT_EQ(copied, arrays) << "copy() returns that frame too";
        const COcean other = make_ocean(64);
        EXPECT_EQ(hash_of(ocean.get()), hash_at(other, time_s));
        float other_height = 0;
        samples.height_m = &other_height;
        EXPECT_EQ(pelagic_ocean_query(other.get(), &points, &samples), PELAGIC_OK);
        samples.height_m = &height;
        EXPECT_EQ(queried, other_height);
    }
    // After the first complete(), queries read the completed frame; later calls of frame_at() do
    // not change it.
    complete(ocean, 9);
    const float shown = height_by_query();
    FrameArrays arrays(64);
    const pelagic_frame_buffers buffers = arrays.view();
    ASSERT_EQ(pelagic_ocean_frame_at(ocean.get(), 1, &buffers, nullptr), PELAGIC_OK);
    EXPECT_EQ(height_by_query(), shown);
}

std::uint64_t hash_of_frames(pelagic_ocean* ocean, int frames) {
    std::uint64_t all = 0;
    for (int n = 0; n < frames; ++n) {
        complete(ocean, n * 0.1);
        all = all * 31 + hash_of(ocean);
    }
    return all;
}

TEST(CInterface, ACpuMaskIsAccepted) {
    if (!threads_have_cpu_masks()) GTEST_SKIP() << "this system has no CPU masks";
    auto options = pelagic_executor_options_make();
    options.kind = PELAGIC_EXECUTOR_THREADS;
    options.cpu_mask = ~std::uint64_t{0};
    pelagic_executor* executor = nullptr;
    ASSERT_EQ(pelagic_executor_create(&options, &executor), PELAGIC_OK) << pelagic_last_error();
    const COceanExecutor held(executor);
    EXPECT_EQ(hash_of_frames(ocean_of(small_sea(128), executor).get(), 3), hash_of_frames(make_ocean(128).get(), 3));
}

}  // namespace
}  // namespace pelagic
