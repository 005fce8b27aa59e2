// The sky as numbers: what daylight is known to look like, and baking beside what is shown. Needs no GL.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "pelagic/gl/sky_baker.hpp"

namespace pelagic {
namespace {

float float_of(std::uint16_t half) {
    const int exponent = half >> 10 & 31;
    const float fraction = static_cast<float>(half & 1023) / 1024;
    const float size = exponent == 0 ? std::ldexp(fraction, -14) : std::ldexp(1 + fraction, exponent - 15);
    return (half & 0x8000) != 0 ? -size : size;
}

glm::vec3 texel(const gl::Sky& sky, int face, int x, int y) {
    const std::size_t at = 4 * static_cast<std::size_t>(y * sky.face_size + x);
    const auto values = sky.face(0, face);
    return {float_of(values[at]), float_of(values[at + 1]), float_of(values[at + 2])};
}

gl::SkyOptions clear_sky(float elevation_deg) {
    return {.sun_azimuth_rad = 0, .sun_elevation_rad = elevation_deg * 0.0174533f, .cloud_cover = 0};
}

constexpr int side = 32;

class SkyBake : public testing::Test {
   protected:
    const gl::Sky& bake(const gl::SkyOptions& options) {
        baker_.schedule(options);
        return baker_.complete();
    }
    gl::SkyBaker baker_{make_thread_executor(2), side};
};

// Rayleigh scattering goes with the fourth power of frequency.
TEST_F(SkyBake, AClearZenithIsBlueAndTheHorizonPaler) {
    const gl::Sky& sky = bake(clear_sky(50));
    const glm::vec3 zenith = texel(sky, 2, side / 2, side / 2);       // +y
    const glm::vec3 horizon = texel(sky, 1, side / 2, side / 2 - 1);  // -x, away from the sun, just above
    EXPECT_GT(zenith.b, 1.5f * zenith.r);
    EXPECT_GT(zenith.b, zenith.g);
    EXPECT_LT(horizon.b / horizon.r, zenith.b / zenith.r);
    EXPECT_GT(horizon.g, zenith.g);  // more air on the way
}

TEST_F(SkyBake, TheLowSunIsRedAndWeak) {
    const glm::vec3 high = bake(clear_sky(60)).sun_irradiance;
    const glm::vec3 low = bake(clear_sky(2)).sun_irradiance;
    EXPECT_GT(low.r / low.b, 2 * high.r / high.b);
    EXPECT_LT(low.g, 0.5f * high.g);
    const glm::vec3 none = bake(clear_sky(-10)).sun_irradiance;
    EXPECT_LT(std::max({none.r, none.g, none.b}), 0.01f);
    // Nobody adds light: what comes down is less than what came to the air.
    EXPECT_LT(high.g, 1.f);
    EXPECT_GT(high.g, 0.5f);
}

TEST_F(SkyBake, BakesInTheBackgroundBesideTheSkyThatIsShown) {
    const gl::Sky& shown = bake(clear_sky(40));
    const std::vector<std::uint16_t> before = shown.texels;
    baker_.schedule(clear_sky(10));
    for (int i = 0; i < 6000 && !baker_.is_done(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(baker_.is_done());
    EXPECT_EQ(shown.texels, before);  // still there to be drawn
    EXPECT_NE(baker_.complete().texels, before);
}

TEST_F(SkyBake, IsTheSameForAnyNumberOfThreads) {
    const gl::SkyOptions options{.cloud_cover = 0.4f};
    const std::vector<std::uint16_t> expected = bake(options).texels;
    for (const auto& executor : {make_serial_executor(), make_thread_executor(5)}) {
        gl::SkyBaker other(executor, side);
        other.schedule(options);
        EXPECT_EQ(other.complete().texels, expected);
    }
}

TEST_F(SkyBake, RefusesWhatIsOutOfRange) {
    EXPECT_THROW(baker_.schedule({.cloud_cover = 2}), std::invalid_argument);
    // In the digits of a float: as doubles they would read 1.600000023841858.
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(check(gl::SkyOptions{.sun_azimuth_rad = infinity}), "sun_azimuth_rad is inf, needs a finite number");
    EXPECT_EQ(check(gl::SkyOptions{.sun_elevation_rad = 1.6f}), "sun_elevation_rad is 1.6, needs [-pi/2, pi/2]");
    EXPECT_EQ(check(gl::SkyOptions{.cloud_cover = std::nanf("")}), "cloud_cover is nan, needs [0, 1]");
    EXPECT_EQ(check(gl::SkyOptions{.visibility_m = 499.9f}), "visibility_m is 499.9, needs [500, 300e3]");
    EXPECT_EQ(check(gl::SkyOptions{.sun_azimuth_rad = -1e30f,
                                   .sun_elevation_rad = 3.14159265f / 2,
                                   .cloud_cover = 1,
                                   .visibility_m = 300e3f}),
              "");
    EXPECT_THROW(gl::SkyBaker(make_serial_executor(), 100), std::invalid_argument);
}

}  // namespace
}  // namespace pelagic
