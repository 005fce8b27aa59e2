// Structs of newer applications, as capi/pelagic.h specifies: the library never reads or writes
// beyond struct_size, and unknown non-zero fields are rejected. Structs that it writes have one
// size, and it writes each field.
#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "pelagic/tests/capi_sea.hpp"

namespace pelagic {
namespace {

constexpr unsigned char untouched_byte = 0xAB;

/// A struct of `bytes` bytes; the memory around it must be neither read nor written.
template <class T>
class CallerStruct {
   public:
    explicit CallerStruct(std::size_t bytes, const T& value = {}) : bytes_(bytes), memory_(8192, untouched_byte) {
        std::memset(memory_.data(), 0, bytes);
        std::memcpy(memory_.data(), &value, std::min(bytes, sizeof value));
        get()->struct_size = static_cast<std::uint32_t>(bytes);
    }
    T* get() { return reinterpret_cast<T*>(memory_.data()); }
    unsigned char& byte(std::size_t place) { return memory_[place]; }

    /// Returns whether all bytes of [begin, end) are `value`.
    bool holds(unsigned char value, std::size_t begin, std::size_t end) const {
        return std::all_of(memory_.begin() + static_cast<std::ptrdiff_t>(begin),
                           memory_.begin() + static_cast<std::ptrdiff_t>(end),
                           [value](unsigned char byte) { return byte == value; });
    }
    bool is_untouched_behind() const { return holds(untouched_byte, bytes_, memory_.size()); }

   private:
    std::size_t bytes_;
    std::vector<unsigned char> memory_;
};

class StructSizes : public testing::Test {
   protected:
    COcean ocean = ocean_of(small_sea(), executor_of(PELAGIC_EXECUTOR_SERIAL).get());

    void complete_one() {
        pelagic_frame frame{};
        ASSERT_EQ(pelagic_ocean_schedule(ocean.get(), 1), PELAGIC_OK);
        ASSERT_EQ(pelagic_ocean_complete(ocean.get(), &frame), PELAGIC_OK);
    }
};

/// Checks that `call` accepts the size of this header and a newer size whose new fields are 0, and
/// rejects one byte less and new fields that are not 0.
template <class T, class Call>
void expect_read_in_every_size(const T& value, Call call) {
    EXPECT_EQ(call(CallerStruct<T>(sizeof(T), value).get()), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(call(CallerStruct<T>(sizeof(T) - 1, value).get()), PELAGIC_INVALID_ARGUMENT);
    for (const std::size_t bytes : {sizeof(T) + 8, std::size_t{4096}}) {
        CallerStruct<T> newer(bytes, value);
        EXPECT_EQ(call(newer.get()), PELAGIC_OK) << bytes << ": " << pelagic_last_error();
        newer.byte(bytes - 1) = 1;
        EXPECT_EQ(call(newer.get()), PELAGIC_INVALID_ARGUMENT);
        EXPECT_NE(std::string(pelagic_last_error()).find("sets fields of a later version"), std::string::npos)
            << pelagic_last_error();
    }
    EXPECT_EQ(call(CallerStruct<T>(4097, value).get()), PELAGIC_INVALID_ARGUMENT);
}

TEST_F(StructSizes, InputStructsMayBeOlderOrNewer) {
    complete_one();
    expect_read_in_every_size(small_sea(), [](pelagic_sea* sea) { return pelagic_sea_check(sea); });
    auto serial = pelagic_executor_options_make();
    serial.kind = PELAGIC_EXECUTOR_SERIAL;
    expect_read_in_every_size(serial, [](pelagic_executor_options* options) {
        pelagic_executor* executor = nullptr;
        const pelagic_status status = pelagic_executor_create(options, &executor);
        pelagic_executor_destroy(executor);
        return status;
    });
    expect_read_in_every_size(pelagic_ocean_options{}, [](pelagic_ocean_options* options) {
        const pelagic_sea sea = small_sea();
        pelagic_ocean* made = nullptr;
        const pelagic_status status = pelagic_ocean_create(&sea, options, &made);
        pelagic_ocean_destroy(made);
        return status;
    });
    expect_read_in_every_size(pelagic_frame_buffers{},
                              [&](pelagic_frame_buffers* to) { return pelagic_ocean_copy(ocean.get(), to); });
    const auto points = pelagic_points_make();
    const auto samples = pelagic_samples_make();
    expect_read_in_every_size(
        points, [&](pelagic_points* asked) { return pelagic_ocean_query(ocean.get(), asked, &samples); });
    expect_read_in_every_size(
        samples, [&](pelagic_samples* wanted) { return pelagic_ocean_query(ocean.get(), &points, wanted); });
    auto dynamic_waves = pelagic_dynamic_waves_options_make();
    expect_read_in_every_size(dynamic_waves, [](pelagic_dynamic_waves_options* wanted) {
        const pelagic_sea sea = small_sea();
        auto options = pelagic_ocean_options_make();
        options.dynamic_waves = wanted;
        pelagic_ocean* made = nullptr;
        const pelagic_status status = pelagic_ocean_create(&sea, &options, &made);
        pelagic_ocean_destroy(made);
        return status;
    });
    auto shore = pelagic_shore_options_make();
    const float floor[] = {-9, 1, -8, 2};
    shore.columns = shore.rows = 2;
    shore.metres_per_sample = 100;
    shore.resolution = 64;
    shore.heights_m = floor;
    expect_read_in_every_size(shore, [](pelagic_shore_options* wanted) {
        const pelagic_sea sea = stack_sea(2, 32);
        auto options = pelagic_ocean_options_make();
        options.shore = wanted;
        pelagic_ocean* made = nullptr;
        const pelagic_status status = pelagic_ocean_create(&sea, &options, &made);
        pelagic_ocean_destroy(made);
        return status;
    });
    auto spray = pelagic_spray_options_make();
    expect_read_in_every_size(spray, [](pelagic_spray_options* wanted) {
        const pelagic_sea sea = small_sea();
        auto options = pelagic_ocean_options_make();
        options.spray = wanted;
        pelagic_ocean* made = nullptr;
        const pelagic_status status = pelagic_ocean_create(&sea, &options, &made);
        pelagic_ocean_destroy(made);
        return status;
    });
    auto answering = pelagic_ocean_options_make();
    answering.dynamic_waves = &dynamic_waves;
    answering.spray = &spray;
    const COcean water = ocean_of(small_sea(), answering);
    auto disturbance = pelagic_disturbance_make();
    expect_read_in_every_size(disturbance, [&](pelagic_disturbance* push) {
        return pelagic_dynamic_waves_add_impulse(waves_of(water.get()), push);
    });
    const auto status_of_input = [](auto create, const auto* from) {
        pelagic_input* made = nullptr;
        const pelagic_status status = create(from, &made);
        pelagic_input_destroy(made);
        return status;
    };
    expect_read_in_every_size(pelagic_waves_make(), [&](pelagic_waves* waves) {
        return status_of_input(pelagic_input_create_waves, waves);
    });
    expect_read_in_every_size(pelagic_ripple_make(), [&](pelagic_ripple* rings) {
        return status_of_input(pelagic_input_create_ripple, rings);
    });
    auto callback = pelagic_input_callback_make();
    callback.add = [](void*, const pelagic_input_rows*) {};
    expect_read_in_every_size(callback, [&](pelagic_input_callback* wanted) {
        return status_of_input(pelagic_input_create_callback, wanted);
    });
    auto rain = pelagic_rain_make();
    rain.drops_per_m2_s = 1;
    expect_read_in_every_size(
        rain, [&](pelagic_rain* falls) { return pelagic_dynamic_waves_set_rain(waves_of(water.get()), falls); });
    auto emitter = pelagic_spray_emitter_make();
    expect_read_in_every_size(
        emitter, [&](pelagic_spray_emitter* bow) { return pelagic_ocean_emit(water.get(), bow, 1); });
    complete(water, 0);
    auto water_frame = pelagic_water_frame_make();
    water_frame.sea_level_m = 2;
    expect_read_in_every_size(
        water_frame, [&](pelagic_water_frame* wanted) { return pelagic_ocean_set_water_frame(ocean.get(), wanted); });
    const pelagic_sea small = small_sea();
    pelagic_exact_water* exact = nullptr;
    expect_read_in_every_size(pelagic_exact_water_options_make(), [&](pelagic_exact_water_options* wanted) {
        pelagic_exact_water_destroy(exact);
        return pelagic_exact_water_create(&small, wanted, &exact);
    });
    pelagic_exact_water_destroy(exact);
    ASSERT_EQ(pelagic_exact_water_create(&small, nullptr, &exact), PELAGIC_OK);
    auto water_samples = pelagic_water_samples_make();
    auto water_points = pelagic_water_points_make();
    expect_read_in_every_size(water_points, [&](pelagic_water_points* wanted) {
        return pelagic_exact_water_sample(exact, wanted, &water_samples);
    });
    expect_read_in_every_size(water_samples, [&](pelagic_water_samples* wanted) {
        return pelagic_exact_water_sample(exact, &water_points, wanted);
    });
    pelagic_exact_water_destroy(exact);
    expect_read_in_every_size(water_points, [&](pelagic_water_points* wanted) {
        return pelagic_ocean_sample_water(ocean.get(), wanted, &water_samples);
    });
    auto ray = pelagic_ray_make();
    ray.direction[1] = -1;
    expect_read_in_every_size(ray, [&](pelagic_ray* asked) {
        pelagic_hit hit{};
        return pelagic_ocean_first_hit(ocean.get(), asked, &hit);
    });
}

/// Checks that `call` fills structs of this header's size and of a newer size with equal bytes.
/// Unknown fields are set to 0; the size field and the memory after the struct are unchanged.
template <class T, class Call>
void expect_written_in_every_size(Call call) {
    CallerStruct<T> today(sizeof(T));
    ASSERT_EQ(call(today.get()), PELAGIC_OK) << pelagic_last_error();
    for (const std::size_t bytes : {sizeof(T), sizeof(T) + 8, std::size_t{4096}}) {
        CallerStruct<T> application(bytes);
        if (bytes > sizeof(T)) application.byte(bytes - 1) = untouched_byte;
        ASSERT_EQ(call(application.get()), PELAGIC_OK) << pelagic_last_error();
        EXPECT_EQ(application.get()->struct_size, bytes);
        EXPECT_EQ(std::memcmp(&application.byte(4), &today.byte(4), sizeof(T) - 4), 0) << bytes;
        EXPECT_TRUE(application.is_untouched_behind()) << bytes;
        EXPECT_TRUE(application.holds(0, sizeof(T), bytes)) << bytes;
    }
    CallerStruct<T> smaller(sizeof(T) - 1);
    EXPECT_EQ(call(smaller.get()), PELAGIC_INVALID_ARGUMENT);
    EXPECT_TRUE(smaller.is_untouched_behind());
}

TEST_F(StructSizes, WrittenInputStructsMayBeOlderOrNewer) {
    expect_written_in_every_size<pelagic_sea>([](pelagic_sea* sea) { return pelagic_sea_preset("storm", sea); });
}

/// Checks that `call` writes all fields of a struct, and no memory after it. The last four bytes may
/// be padding.
template <class T, class Call>
void expect_all_written(Call call) {
    std::vector<unsigned char> zeros(sizeof(T) + 8), ones(sizeof(T) + 8, 0xFF);
    ASSERT_EQ(call(reinterpret_cast<T*>(zeros.data())), PELAGIC_OK) << pelagic_last_error();
    ASSERT_EQ(call(reinterpret_cast<T*>(ones.data())), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(std::memcmp(zeros.data(), ones.data(), sizeof(T) - 4), 0);
    EXPECT_TRUE(std::all_of(ones.end() - 8, ones.end(), [](unsigned char byte) { return byte == 0xFF; }));
}

TEST_F(StructSizes, OutputStructsAreWrittenWholly) {
    const pelagic_sea asked = small_sea();
    expect_all_written<pelagic_statistics>(
        [&](pelagic_statistics* statistics) { return pelagic_sea_statistics(&asked, statistics); });
    expect_all_written<pelagic_ocean_info>(
        [&](pelagic_ocean_info* info) { return pelagic_ocean_describe(ocean.get(), info); });
    const COcean serial = ocean_of(small_sea(), executor_of(PELAGIC_EXECUTOR_SERIAL).get());
    expect_all_written<pelagic_frame>([&](pelagic_frame* frame) {
        // Frames alternate between two buffers, so two further frames restore the pointers.
        pelagic_frame other{};
        pelagic_ocean_schedule(serial.get(), 2);
        pelagic_ocean_complete(serial.get(), &other);
        pelagic_ocean_schedule(serial.get(), 1);
        const pelagic_status status = pelagic_ocean_complete(serial.get(), frame);
        if (status != PELAGIC_OK) pelagic_ocean_complete(serial.get(), &other);
        if (status == PELAGIC_OK) frame->number = 0;  // it counts frames
        return status;
    });
    auto dynamic_waves = pelagic_dynamic_waves_options_make();
    auto options = pelagic_ocean_options_make();
    options.dynamic_waves = &dynamic_waves;
    const COcean water = ocean_of(small_sea(), options);
    pelagic_frame first{};
    ASSERT_EQ(pelagic_ocean_schedule(water.get(), 1), PELAGIC_OK);
    ASSERT_EQ(pelagic_ocean_complete(water.get(), &first), PELAGIC_OK);
    expect_all_written<pelagic_dynamic_waves_view>([&](pelagic_dynamic_waves_view* surface) {
        return pelagic_dynamic_waves_get_view(waves_of(water.get()), surface);
    });
    auto shore = pelagic_shore_options_make();
    const float floor[] = {-9, 1, -8, 2};
    shore.columns = shore.rows = 2;
    shore.metres_per_sample = 100;
    shore.resolution = 64;
    shore.heights_m = floor;
    auto ashore = pelagic_ocean_options_make();
    ashore.shore = &shore;
    const COcean coast = ocean_of(stack_sea(2, 32), ashore);
    ASSERT_EQ(pelagic_ocean_schedule(coast.get(), 1), PELAGIC_OK);
    ASSERT_EQ(pelagic_ocean_complete(coast.get(), &first), PELAGIC_OK);
    expect_all_written<pelagic_shore_surface>(
        [&](pelagic_shore_surface* surface) { return pelagic_ocean_shore(coast.get(), surface); });
    complete_one();
    expect_all_written<pelagic_cascade>(
        [&](pelagic_cascade* cascade) { return pelagic_ocean_cascade(ocean.get(), 0, cascade); });
    auto ray = pelagic_ray_make();
    ray.origin_m[1] = 50, ray.direction[1] = -1, ray.reach_m = 100;
    expect_all_written<pelagic_hit>(
        [&](pelagic_hit* hit) { return pelagic_ocean_first_hit(ocean.get(), &ray, hit); });
}

TEST_F(StructSizes, StructsOfHullsMayBeOlderOrNewer) {
    auto options = pelagic_hull_options_make();
    if (!has_hulls()) GTEST_SKIP() << pelagic_last_error();
    options.mass_kg = 10;
    const double vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const std::uint32_t triangles[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    auto mesh = pelagic_hull_mesh_make();
    mesh.vertex_count = mesh.triangle_count = 4;
    mesh.vertices_m = vertices;
    mesh.triangles = triangles;
    const auto status_of_hull = [](const pelagic_hull_mesh* of, const pelagic_hull_options* with) {
        pelagic_hull* made = nullptr;
        const pelagic_status status = pelagic_hull_create(of, with, &made);
        pelagic_hull_destroy(made);
        return status;
    };
    expect_read_in_every_size(mesh, [&](pelagic_hull_mesh* of) { return status_of_hull(of, &options); });
    expect_read_in_every_size(options, [&](pelagic_hull_options* with) { return status_of_hull(&mesh, with); });

    pelagic_hull* hull = nullptr;
    pelagic_bodies* bodies = nullptr;
    std::uint32_t number = 0;
    ASSERT_EQ(pelagic_hull_create(&mesh, &options, &hull), PELAGIC_OK) << pelagic_last_error();
    ASSERT_EQ(pelagic_bodies_create(ocean.get(), nullptr, &bodies), PELAGIC_OK) << pelagic_last_error();
    expect_read_in_every_size(pelagic_bodies_options_make(), [&](pelagic_bodies_options* with) {
        pelagic_bodies* made = nullptr;
        const pelagic_status status = pelagic_bodies_create(ocean.get(), with, &made);
        pelagic_bodies_destroy(made);
        return status;
    });
    pelagic_hull_state state{};
    ASSERT_EQ(pelagic_hull_at_rest(hull, 0, 0, 0, &state), PELAGIC_OK);
    ASSERT_EQ(pelagic_bodies_add(bodies, hull, &state, &number), PELAGIC_OK);
    complete_one();
    ASSERT_EQ(pelagic_bodies_step(bodies, 0.01, nullptr), PELAGIC_OK) << pelagic_last_error();
    expect_read_in_every_size(pelagic_hull_inputs_make(), [&](pelagic_hull_inputs* inputs) {
        return pelagic_bodies_set_inputs(bodies, number, inputs);
    });
    expect_all_written<pelagic_hull_state>(
        [&](pelagic_hull_state* to) { return pelagic_hull_at_rest(hull, 1, 2, 3, to); });
    expect_all_written<pelagic_hull_state>(
        [&](pelagic_hull_state* to) { return pelagic_bodies_get_state(bodies, number, to); });
    expect_all_written<pelagic_hull_info>(
        [&](pelagic_hull_info* info) { return pelagic_hull_describe(hull, info); });
    expect_all_written<pelagic_hull_loads>(
        [&](pelagic_hull_loads* loads) { return pelagic_bodies_get_loads(bodies, number, loads); });
    pelagic_bodies_destroy(bodies);
    pelagic_hull_destroy(hull);
}

}  // namespace
}  // namespace pelagic
