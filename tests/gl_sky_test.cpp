// The sky as numbers: known properties of daylight, and baking beside the displayed sky. These
// tests need no GL.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <thread>

#include "pelagic/gl/sky/clear_sky.hpp"
#include "pelagic/gl/sky/cube.hpp"
#include "pelagic/gl/sky/light_presets.hpp"
#include "pelagic/gl/sky/sky_baker.hpp"
#include "pelagic/jobs/sliced_executor.hpp"

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

constexpr int sky_side = 32;

/// All tests share one baker: most of its time is the noise of the clouds, which it keeps.
class SkyBake : public testing::Test {
   protected:
    static void SetUpTestSuite() { baker_ = std::make_unique<gl::SkyBaker>(make_thread_executor(2), sky_side); }
    static void TearDownTestSuite() { baker_.reset(); }
    const gl::Sky& bake(const gl::SkyOptions& options) {
        baker_->schedule(options);
        return baker_->complete();
    }
    static inline std::unique_ptr<gl::SkyBaker> baker_;
};

// Rayleigh scattering is proportional to the fourth power of frequency.
TEST_F(SkyBake, ClearZenithIsBlueAndTheHorizonPaler) {
    const gl::Sky& sky = bake(clear_sky(50));
    const glm::vec3 zenith = texel(sky, 2, sky_side / 2, sky_side / 2);  // +y
    // -x, away from the sun, just above the horizon
    const glm::vec3 horizon = texel(sky, 1, sky_side / 2, sky_side / 2 - 1);
    EXPECT_GT(zenith.b, 1.5f * zenith.r);
    EXPECT_GT(zenith.b, zenith.g);
    EXPECT_LT(horizon.b / horizon.r, zenith.b / zenith.r);
    EXPECT_GT(horizon.g, zenith.g);  // a longer path through the air
}

TEST_F(SkyBake, LowSunIsRedAndWeak) {
    const glm::vec3 high = bake(clear_sky(60)).sun_irradiance;
    const glm::vec3 low = bake(clear_sky(2)).sun_irradiance;
    EXPECT_GT(low.r / low.b, 2 * high.r / high.b);
    EXPECT_LT(low.g, 0.5f * high.g);
    const gl::Sky& night = bake(clear_sky(-10));
    const glm::vec3 none = night.sun_irradiance * night.unit;
    EXPECT_LT(std::max({none.r, none.g, none.b}), 1e-5f);
    // Energy is conserved: the transmitted light is less than the light above the atmosphere.
    EXPECT_LT(high.g, 1.f);
    EXPECT_GT(high.g, 0.5f);
}

float luminance(glm::vec3 colour) { return glm::dot(colour, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

/// Returns the illuminance of sun or moon and sky on a level plane in clear air, lux.
double illuminance_lx(const gl::SkyOptions& options) {
    const gl::ClearSky sky(options);
    const gl::KeyLight key = sky.key_light();
    const glm::vec3 all = sky.irradiance() + key.irradiance * std::max(key.direction.y, 0.f);
    return static_cast<double>(luminance(all) * sky.unit() * gl::sun_illuminance_lx);
}

gl::SkyOptions without_moon(float elevation_deg) {
    gl::SkyOptions options = clear_sky(elevation_deg);
    options.places_moon = true;
    options.moon_elevation_rad = -1.5f;
    return options;
}

// Compares the atmosphere model, which is not fitted to illuminances, with Janiczek and DeYoung's
// table. Their air contains haze: 30 % tolerance.
TEST(ClearSky, ByDayHasThePublishedIlluminance) {
    for (const float elevation : {5.f, 10.f, 20.f, 40.f, 60.f})
        EXPECT_NEAR(
            illuminance_lx(without_moon(elevation)) / gl::published_illuminance_lx(static_cast<double>(elevation)), 1,
            0.3)
            << elevation;
}

// The same table at twilight, as almanacs print it: 3.4 lux at the end of civil twilight, 0.008 at
// that of nautical twilight, plus the night sky's 0.0006.
TEST(ClearSky, IlluminanceAtDuskFallsMonotonicallyAsPublished) {
    EXPECT_NEAR(illuminance_lx(without_moon(-6)), 3.4, 0.1);
    EXPECT_NEAR(illuminance_lx(without_moon(-12)), 0.008, 0.001);
    EXPECT_NEAR(illuminance_lx(without_moon(-40)), 2e-4 * 3.14159, 3e-5);
    double last = 1e9;
    for (float elevation = 12; elevation >= -24; elevation -= 1) {
        const double now = illuminance_lx(without_moon(elevation));
        EXPECT_LT(now, last) << elevation;
        last = now;
    }
}

// A high full moon gives 0.25 lux (Janiczek and DeYoung: 0.22 to 0.27), and a half moon a ninth of
// it. The sea's glint is the moon's.
TEST(ClearSky, MoonIsTheKeyLightAtNight) {
    const gl::SkyOptions full = clear_sky(-60);
    EXPECT_NEAR(illuminance_lx(full), 0.24, 0.05);
    const gl::KeyLight key = gl::ClearSky(full).key_light();
    EXPECT_TRUE(key.is_moon);
    EXPECT_NEAR(key.direction.y, std::sin(1.0472f), 1e-3);
    EXPECT_FALSE(gl::ClearSky(clear_sky(20)).key_light().is_moon);
    EXPECT_EQ(gl::moon_light(0), 1);
    // magnitude 2.6 below full: Krisciunas and Schaefer 1991
    EXPECT_NEAR(gl::moon_light(1.5707963), 1 / 10.9, 0.01);
    EXPECT_EQ(gl::ClearSky(clear_sky(20)).unit(), 1);
}

TEST(LightPresets, AreNamedSkies) {
    EXPECT_EQ(gl::light_presets().size(), 5u);
    for (const gl::LightPreset& preset : gl::light_presets()) {
        EXPECT_EQ(check(preset.sky), "") << preset.name;
        EXPECT_EQ(gl::light_preset_named(preset.name), &preset);
    }
    EXPECT_EQ(gl::light_preset_named("dawn"), nullptr);
    EXPECT_TRUE(gl::ClearSky(gl::light_preset_named("moonlight")->sky).key_light().is_moon);
}

/// Returns the clouds' transmittance in the direction of a texel.
float transmittance(const gl::Sky& sky, int face, int x, int y) {
    return float_of(sky.face(0, face)[4 * static_cast<std::size_t>(y * sky.face_size + x) + 3]);
}

// An overcast is closed: the optical depth of its thinnest places is 4 or more. It is no uniform
// veil either: the brightest texels above 30 degrees have 1.3 times the luminance of the darkest.
TEST_F(SkyBake, OvercastIsOpaqueAndHasStructure) {
    const gl::Cube directions(sky_side);
    for (const unsigned seed : {1u, 5u}) {
        gl::SkyOptions overcast = gl::light_preset_named("overcast")->sky;
        overcast.cloud_seed = seed;
        const gl::Sky& sky = bake(overcast);
        float min = 1e9f, max = 0;
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < sky_side; ++y)
                for (int x = 0; x < sky_side; ++x) {
                    const glm::vec3 direction = directions.direction(face, x, y);
                    if (direction.y < std::sin(0.1745f)) continue;
                    ASSERT_LE(transmittance(sky, face, x, y), 0.02f) << "seed " << seed << ", y " << direction.y;
                    if (direction.y < 0.5f) continue;
                    const float luminance =
                        glm::dot(texel(sky, face, x, y), glm::vec3(0.2126f, 0.7152f, 0.0722f));
                    min = std::min(min, luminance);
                    max = std::max(max, luminance);
                }
        EXPECT_GT(max, 1.3f * min) << "seed " << seed;
    }
}

gl::SkyOptions with_clouds(float elevation_deg, float azimuth_deg) {
    gl::SkyOptions options = clear_sky(elevation_deg);
    options.sun_azimuth_rad = azimuth_deg * 0.0174533f;
    options.cloud_cover = 0.4f;
    options.cloud_seed = 4;  // hides about half of the suns of the tests
    return options;
}

// The sea below the eye is in the shadow of the cloud that hides the sun: the map's value there is
// the clouds' transmittance in the sun's direction, in a cube that is baked from the same place. A
// texel of the cube is 2.8 degrees wide, so edges of clouds differ. Independent values would differ
// by 0.5 on average, because half of these suns shine.
TEST_F(SkyBake, MapHasTheShadowsOfTheCloudsInTheSky) {
    const gl::Cube directions(sky_side);
    double difference = 0;
    int shaded = 0, suns = 0;
    for (const float elevation_deg : {12.f, 30.f, 55.f})
        for (float azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 40) {
            const gl::Sky& sky = bake(with_clouds(elevation_deg, azimuth_deg));
            float seen = 0, nearest = -1;
            for (int face = 0; face < 6; ++face)
                for (int y = 0; y < sky_side; ++y)
                    for (int x = 0; x < sky_side; ++x)
                        if (const float cosine = glm::dot(directions.direction(face, x, y), sky.sun_direction);
                            cosine > nearest) {
                            nearest = cosine;
                            seen = transmittance(sky, face, x, y);
                        }
            const float sunlit = sky.cloud_shadows.at({0, 0}) * sky.brightest_transmittance;
            difference += std::abs(static_cast<double>(sunlit - seen));
            shaded += sunlit < 0.5f;
            ++suns;
        }
    std::printf("%d of %d suns are hidden, mean difference %.3f\n", shaded, suns, difference / suns);
    EXPECT_LT(difference / suns, 0.15);
    EXPECT_GT(shaded, suns / 5);
    EXPECT_LT(shaded, suns * 4 / 5);
}

// The map tiles: its opposite borders differ no more than neighbours inside.
TEST_F(SkyBake, MapOfShadowsIsPeriodic) {
    const std::vector<std::uint8_t>& texels = bake(with_clouds(40, 20)).cloud_shadows.texels;
    constexpr int side = gl::CloudShadows::side;
    ASSERT_EQ(texels.size(), std::size_t{side} * side);
    const auto step_at = [&](int column) {
        double sum = 0;
        for (int row = 0; row < side; ++row) {
            const auto at = [&](int i) { return static_cast<double>(texels[static_cast<std::size_t>(row * side + i % side)]); };
            sum += std::abs(at(column + 1) - at(column));
        }
        return sum / side;
    };
    double inside = 0;
    for (int column = 0; column < side - 1; ++column) inside += step_at(column) / (side - 1);
    EXPECT_GT(inside, 0.5);
    EXPECT_LT(step_at(side - 1), 2 * inside);
}

// Within 3 km ahead, where the sun is ahead, some sea has more light from the sun than from the sky.
// An overcast has none.
TEST_F(SkyBake, SunOfThePresetsShinesOnTheSeaAhead) {
    for (const gl::LightPreset& preset : gl::light_presets()) {
        const gl::Sky& sky = bake(preset.sky);
        const glm::dvec2 ahead = glm::normalize(glm::dvec2(sky.sun_direction.x, sky.sun_direction.z));
        const glm::dvec2 aside(-ahead.y, ahead.x);
        float brightest = 0;
        for (double metres = 20; metres < 3000; metres *= 1.1)
            for (const double slant : {-0.4, -0.2, 0.0, 0.2, 0.4})
                brightest = std::max(brightest, sky.cloud_shadows.at(metres * (ahead + slant * aside)));
        const float ratio = brightest * luminance(sky.sun_irradiance) / luminance(sky.sky_irradiance);
        std::printf("%s: sun over sky %.2f, on the mean %.2f\n", std::string(preset.name).c_str(),
                    static_cast<double>(ratio),
                    static_cast<double>(ratio / std::max(brightest, 1e-6f) * sky.mean_sunlight));
        if (preset.name == "overcast")
            EXPECT_LT(ratio, 0.02f);
        else
            EXPECT_GE(ratio, 1) << preset.name;
    }
}

// The water below the horizon reflects the sky above it, clouds included. Its reflectance does not
// depend on the colour, is near 1 at the horizon and falls towards the nadir.
TEST_F(SkyBake, LowerHalfReflectsTheCloudsAboveIt) {
    const gl::Sky& sky = bake({.sun_elevation_rad = 0.6f, .cloud_cover = 0.6f});
    const gl::Cube directions(sky_side);
    for (const int face : {0, 1, 4, 5}) {
        for (int x = 0; x < sky_side; ++x) {
            float nearer_horizon = 1;
            for (int y = sky_side / 2; y < sky_side; ++y) {
                const glm::vec3 below = texel(sky, face, x, y), above = texel(sky, face, x, sky_side - 1 - y);
                const float reflectance = below.g / above.g;
                // halves have steps of 1e-3
                EXPECT_NEAR(below.r / above.r, reflectance, 3e-3f);
                EXPECT_NEAR(below.b / above.b, reflectance, 3e-3f);
                EXPECT_LE(reflectance, nearer_horizon + 3e-3f);
                nearer_horizon = reflectance;
                if (y == sky_side / 2) {
                    EXPECT_GT(reflectance, 0.8f);
                }
            }
            EXPECT_LT(nearer_horizon, 0.3f);
        }
    }
}

// Half floats hold 6e-5 and more exactly: the light of a night must not underflow in them.
TEST_F(SkyBake, NightFitsIntoHalfFloats) {
    for (const auto& options : {clear_sky(-30), without_moon(-30), without_moon(-9)}) {
        const gl::Sky& sky = bake(options);
        const glm::vec3 zenith = texel(sky, 2, sky_side / 2, sky_side / 2);
        EXPECT_GT(std::min({zenith.r, zenith.g, zenith.b}), 6.1e-5f);
        EXPECT_LT(sky.unit, 1e-3f);
        EXPECT_GT(sky.exposure, 0.f);
    }
}

TEST_F(SkyBake, BakesInTheBackgroundWhileASkyIsShown) {
    const gl::Sky& shown = bake(clear_sky(40));
    const std::vector<std::uint16_t> before = shown.texels;
    baker_->schedule(clear_sky(10));
    for (int i = 0; i < 6000 && !baker_->is_done(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(baker_->is_done());
    EXPECT_EQ(shown.texels, before);  // still available for drawing
    EXPECT_NE(baker_->complete().texels, before);
}

TEST_F(SkyBake, DoesNotDependOnTheNumberOfThreads) {
    const gl::SkyOptions options{.cloud_cover = 0.4f};
    const std::vector<std::uint16_t> expected = bake(options).texels;
    const std::vector<std::uint8_t> shadows = bake(options).cloud_shadows.texels;
    for (const auto& executor : {make_serial_executor(), make_thread_executor(5)}) {
        gl::SkyBaker other(executor, sky_side);
        other.schedule(options);
        EXPECT_EQ(other.complete().texels, expected);
        EXPECT_EQ(other.complete().cloud_shadows.texels, shadows);
    }
}

// By night too, when the moon's light needs a second table of the atmosphere.
TEST_F(SkyBake, DoesNotDependOnSlices) {
    const auto executor = make_sliced_executor();
    gl::SkyBaker other(executor, sky_side);
    for (const float elevation_deg : {30.f, -15.f}) {
        const gl::SkyOptions options = clear_sky(elevation_deg);
        const gl::Sky expected = bake(options);
        other.schedule(options);
        int slices = 1;
        while (!executor->advance({})) ++slices;
        EXPECT_TRUE(other.is_done());
        EXPECT_GT(slices, 100);  // of a bake that takes one or two seconds on a web page
        const gl::Sky& sky = other.complete();
        EXPECT_EQ(sky.texels, expected.texels);
        EXPECT_EQ(sky.exposure, expected.exposure);
    }
}

TEST_F(SkyBake, RejectsValuesOutOfRange) {
    EXPECT_THROW(baker_->schedule({.cloud_cover = 2}), std::invalid_argument);
    // The message has the digits of a float: as a double the value would print as
    // 1.600000023841858.
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(check(gl::SkyOptions{.sun_azimuth_rad = infinity}), "sun_azimuth_rad is inf, expected a finite number");
    EXPECT_EQ(check(gl::SkyOptions{.sun_elevation_rad = 1.6f}),
              "sun_elevation_rad 1.6 is out of range [-pi/2, pi/2]");
    EXPECT_EQ(check(gl::SkyOptions{.cloud_cover = std::nanf("")}), "cloud_cover nan is out of range [0, 1]");
    EXPECT_EQ(check(gl::SkyOptions{.visibility_m = 499.9f}), "visibility_m 499.9 is out of range [500, 300e3]");
    EXPECT_EQ(check(gl::SkyOptions{.sun_azimuth_rad = -1e30f,
                                   .sun_elevation_rad = 3.14159265f / 2,
                                   .cloud_cover = 1,
                                   .visibility_m = 300e3f}),
              "");
    EXPECT_THROW(gl::SkyBaker(make_serial_executor(), 100), std::invalid_argument);
}

}  // namespace
}  // namespace pelagic
