// Wave inputs through the C interface: analytic waves, a C callback next to a wave list, and
// invalid values.
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "pelagic/tests/capi_sea.hpp"

namespace pelagic {
namespace {

struct DestroyInput {
    void operator()(pelagic_input* input) const { pelagic_input_destroy(input); }
};
using CInput = std::unique_ptr<pelagic_input, DestroyInput>;

constexpr double flat_side_m = 250, loop_s = 64;

pelagic_sea flat_sea(std::int32_t resolution = 64) {
    pelagic_sea sea = small_sea(resolution);
    sea.wind_speed_mps = 0.1;
    sea.loop_period_s = loop_s;
    return sea;
}

/// One wave with five periods along x and three along z.
struct OneWave {
    double amplitude = 1.5, wavelength = flat_side_m / std::sqrt(34.0), direction = std::atan2(3.0, 5.0), phase = 0.5;
    pelagic_waves as_waves() const {
        auto waves = pelagic_waves_make();
        waves.count = 1;
        waves.amplitude_m = &amplitude, waves.wavelength_m = &wavelength;
        waves.direction_rad = &direction, waves.phase_rad = &phase;
        waves.choppiness = 1;
        return waves;
    }
    double angle(int i, int j, int n, double t) const {
        const double omega = std::sqrt(9.80665 * 2 * std::numbers::pi / wavelength);
        const double periods = std::round(omega * loop_s / (2 * std::numbers::pi));
        return 2 * std::numbers::pi * ((5.0 * i + 3.0 * j) / n - periods * t / loop_s) + phase;
    }
};

CInput waves_input(const pelagic_waves& waves) {
    pelagic_input* made = nullptr;
    EXPECT_EQ(pelagic_input_create_waves(&waves, &made), PELAGIC_OK) << pelagic_last_error();
    return CInput(made);
}

CInput ripple_input(double amplitude_m) {
    auto ripple = pelagic_ripple_make();
    ripple.wavelength_m = 20;
    ripple.amplitude_m = amplitude_m;
    pelagic_input* made = nullptr;
    EXPECT_EQ(pelagic_input_create_ripple(&ripple, &made), PELAGIC_OK) << pelagic_last_error();
    return CInput(made);
}

CInput callback_input(pelagic_add_rows add, void* user = nullptr) {
    auto callback = pelagic_input_callback_make();
    callback.add = add;
    callback.user = user;
    callback.largest_slope = 1;
    pelagic_input* made = nullptr;
    EXPECT_EQ(pelagic_input_create_callback(&callback, &made), PELAGIC_OK) << pelagic_last_error();
    return CInput(made);
}

/// An ocean with velocities; the input handles are destroyed before the first frame.
COcean ocean_with(const pelagic_sea& sea, std::vector<CInput> inputs) {
    std::vector<pelagic_input*> pointers;
    for (const CInput& input : inputs) pointers.push_back(input.get());
    auto options = pelagic_ocean_options_make();
    options.velocities = 1;
    options.input_count = pointers.size();
    options.inputs = pointers.data();
    return ocean_of(sea, options);
}

TEST(CInterfaceInputs, ACallbackMatchesAWaveList) {
    const OneWave wave;
    // The height of the wave, and a vertical velocity with another amplitude, from a C callback.
    const auto add = [](void* user, const pelagic_input_rows* rows) {
        const auto& given = *static_cast<const OneWave*>(user);
        const int n = rows->resolution;
        for (int j = 0; j < rows->row_count; ++j)
            for (int i = 0; i < n; ++i) {
                const double angle = given.angle(i, rows->first_row + j, n, rows->time_s);
                rows->height[j * n + i] = static_cast<float>(1.5 * std::cos(angle));
                rows->velocity_y[j * n + i] = static_cast<float>(rows->side_m * std::sin(angle));
            }
    };
    std::vector<CInput> batch, callback;
    batch.push_back(waves_input(wave.as_waves()));
    callback.push_back(callback_input(add, const_cast<OneWave*>(&wave)));
    const COcean a = ocean_with(flat_sea(), std::move(batch)), b = ocean_with(flat_sea(), std::move(callback));
    const pelagic_frame one = complete(a, 7), other = complete(b, 7);
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 64; ++i) {
            EXPECT_NEAR(texel_of(one.height, i, j), texel_of(other.height, i, j), 1e-5);
            EXPECT_NEAR(texel_of(other.velocity_y, i, j), flat_side_m * std::sin(wave.angle(i, j, 64, 7)), 1e-2);
        }
}

TEST(CInterfaceInputs, InputsCanBeChangedBetweenFrames) {
    const OneWave wave;
    CInput waves = waves_input(wave.as_waves()), rings = ripple_input(0.5);
    pelagic_input* const all[] = {waves.get(), rings.get()};
    auto options = pelagic_ocean_options_make();
    options.velocities = 1;
    options.input_count = 2;
    options.inputs = all;
    const COcean ocean = ocean_of(flat_sea(), options);
    std::vector<CInput> none;
    const COcean pure = ocean_with(flat_sea(), std::move(none));
    EXPECT_NE(hash_at(ocean, 3), hash_at(pure, 3));
    const auto nothing = pelagic_waves_make();
    ASSERT_EQ(pelagic_input_set_waves(waves.get(), &nothing), PELAGIC_OK) << pelagic_last_error();
    const auto still = pelagic_ripple_make();
    ASSERT_EQ(pelagic_input_set_ripple(rings.get(), &still), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(hash_at(ocean, 3), hash_at(pure, 3));
    expect_rejected(pelagic_input_set_ripple(waves.get(), &still), PELAGIC_INVALID_ARGUMENT,
                    "input is not a ripple; expected one of pelagic_input_create_ripple");
    expect_rejected(pelagic_input_set_waves(rings.get(), &nothing), PELAGIC_INVALID_ARGUMENT,
                    "input is not a batch of waves; expected one of pelagic_input_create_waves");
    pelagic_ocean* second = nullptr;
    const pelagic_sea sea = flat_sea();
    expect_rejected(pelagic_ocean_create(&sea, &options, &second), PELAGIC_INVALID_ARGUMENT,
                    "inputs[0] belongs to another ocean, expected one that is new");
}

TEST(CInterfaceInputs, InvalidValuesAreRejectedWithOneLine) {
    pelagic_input* made = nullptr;
    OneWave wave;
    wave.wavelength = std::numeric_limits<double>::quiet_NaN();
    pelagic_waves waves = wave.as_waves();
    expect_rejected(pelagic_input_create_waves(&waves, &made), PELAGIC_INVALID_ARGUMENT,
                    "waves[0].wavelength_m nan is out of range [0.01, 1000]");
    waves.count = 65;
    expect_rejected(pelagic_input_create_waves(&waves, &made), PELAGIC_INVALID_ARGUMENT,
                    "waves.count is 65, expected at most 64");
    waves.count = 1, waves.amplitude_m = nullptr;
    expect_rejected(pelagic_input_create_waves(&waves, &made), PELAGIC_INVALID_ARGUMENT,
                    "waves.amplitude_m is NULL, expected a pointer");
    auto ripple = pelagic_ripple_make();
    ripple.wavelength_m = 0;
    expect_rejected(pelagic_input_create_ripple(&ripple, &made), PELAGIC_INVALID_ARGUMENT,
                    "wavelength_m 0 is out of range [0.01, 1000]");
    auto callback = pelagic_input_callback_make();
    expect_rejected(pelagic_input_create_callback(&callback, &made), PELAGIC_INVALID_ARGUMENT,
                    "callback.add is NULL, expected a pointer");
    callback.add = [](void*, const pelagic_input_rows*) {};
    callback.largest_slope = -1;
    expect_rejected(pelagic_input_create_callback(&callback, &made), PELAGIC_INVALID_ARGUMENT,
                    "callback.largest_slope -1 is out of range [0, 100]");
    EXPECT_EQ(made, nullptr);
    const pelagic_sea sea = flat_sea(16);
    auto options = pelagic_ocean_options_make();
    options.input_count = 1;
    pelagic_ocean* ocean = nullptr;
    expect_rejected(pelagic_ocean_create(&sea, &options, &ocean), PELAGIC_INVALID_ARGUMENT,
                    "inputs is NULL, expected a pointer");
    options.inputs = &made;
    expect_rejected(pelagic_ocean_create(&sea, &options, &ocean), PELAGIC_INVALID_ARGUMENT,
                    "inputs[0] is NULL, expected a pointer");
}

TEST(CInterfaceInputs, AFailingCallbackLosesOnlyItsFrame) {
    int fails = 0;
    const auto add = [](void* user, const pelagic_input_rows* rows) {
        const int how = *static_cast<const int*>(user);
        if (how == 1) throw std::runtime_error("lost");
        if (how == 2) rows->height[3] = std::numeric_limits<float>::infinity();
        rows->height[5] = 0.25f;
    };
    std::vector<CInput> inputs;
    inputs.push_back(callback_input(add, &fails));
    const COcean ocean = ocean_with(flat_sea(), std::move(inputs));
    const std::uint64_t before = hash_at(ocean, 1);
    pelagic_frame frame{};
    fails = 1;
    ASSERT_EQ(pelagic_ocean_schedule(ocean.get(), 2), PELAGIC_OK);
    expect_rejected(pelagic_ocean_complete(ocean.get(), &frame), PELAGIC_APPLICATION_ERROR,
                    "an input's callback threw");
    fails = 2;
    ASSERT_EQ(pelagic_ocean_schedule(ocean.get(), 2), PELAGIC_OK);
    expect_rejected(pelagic_ocean_complete(ocean.get(), &frame), PELAGIC_INVALID_ARGUMENT,
                    "inputs[0]'s height inf is out of range [-1000, 1000], metres or metres a second");
    fails = 0;
    EXPECT_EQ(hash_at(ocean, 1), before);
}

}  // namespace
}  // namespace pelagic
