#include "pelagic/tools/preview/sea_light.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace pelagic::tools {
namespace {

// Colours of a clear afternoon, chosen by eye. Upwelling light is that of the open ocean,
// blue-green where the sun shines through crests.
constexpr glm::vec3 horizon(0.62f, 0.74f, 0.86f), zenith(0.10f, 0.24f, 0.55f), around_sun(0.50f, 0.42f, 0.30f);
constexpr glm::vec3 sun(2.6f, 2.35f, 2.0f), deep_water(0.006f, 0.038f, 0.060f), lit_crest(0.010f, 0.120f, 0.115f);
constexpr float foam_albedo = 0.75f;
/// Reflectance of water at normal incidence, ((1.34 - 1) / (1.34 + 1))^2.
constexpr float normal_reflectance = 0.021f;
/// Slope variance of ripples shorter than a texel; avoids division by zero.
constexpr float min_slope_variance = 2e-4f;

float square(float x) { return x * x; }

float schlick(float cosine) {
    const float complement = 1 - cosine;
    return normal_reflectance + (1 - normal_reflectance) * square(square(complement)) * complement;
}

/// Returns GGX with Smith shadowing, times the cosine to the sun. alpha^2 is twice the slope
/// variance.
float sun_glint(const LitWater& water, const glm::vec3& to_sun, float to_eye_cosine) {
    const float to_sun_cosine = glm::dot(water.normal, to_sun);
    if (to_sun_cosine <= 0) return 0;
    const glm::vec3 half = glm::normalize(water.to_eye + to_sun);
    const float alpha2 = 2 * (water.slope_variance + min_slope_variance);
    const float facing = std::max(glm::dot(water.normal, half), 0.f);
    constexpr float pi = std::numbers::pi_v<float>;
    const float density = alpha2 / (pi * square(square(facing) * (alpha2 - 1) + 1));
    const auto smith = [&](float cosine) { return cosine + std::sqrt(alpha2 + (1 - alpha2) * square(cosine)); };
    return density * schlick(glm::dot(half, to_sun)) * to_sun_cosine / (smith(to_eye_cosine) * smith(to_sun_cosine));
}

/// Approximates the sRGB curve by square roots, with an error below one step of 8 bits.
float encoded(float linear) {
    const float half = std::sqrt(linear), quarter = std::sqrt(half), eighth = std::sqrt(quarter);
    return 0.662002687f * half + 0.684122060f * quarter - 0.323583601f * eighth - 0.0225411470f * linear;
}

}  // namespace

glm::vec3 sky_light(const glm::vec3& direction, const glm::vec3& to_sun) {
    const float up = std::max(direction.y, 0.f);
    const glm::vec3 clear = glm::mix(horizon, zenith, 1 - square(square(1 - up)));
    const float near_sun = std::max(glm::dot(direction, to_sun), 0.f);
    return clear + around_sun * square(square(square(near_sun)));
}

glm::vec3 water_light(const LitWater& water, const glm::vec3& to_sun) {
    const float spread = std::sqrt(water.slope_variance);
    // At grazing angles, facets of a rough surface that face the eye dominate.
    const float to_eye_cosine = std::max(glm::dot(water.normal, water.to_eye), 0.02f);
    const float reflectance = schlick(std::min(1.f, to_eye_cosine + 0.6f * spread));
    glm::vec3 mirrored = 2 * glm::dot(water.normal, water.to_eye) * water.normal - water.to_eye;
    mirrored.y = std::max(mirrored.y, 0.f) + spread;
    const glm::vec3 reflected = sky_light(glm::normalize(mirrored), to_sun);

    // Light that enters behind a crest leaves it towards the eye.
    const float against_sun = std::max(-glm::dot(glm::vec3(water.to_eye.x, 0, water.to_eye.z), to_sun), 0.f);
    const float through = glm::clamp(0.25f + 0.6f * water.height, 0.f, 1.f) * (0.35f + 0.65f * against_sun);
    const glm::vec3 upwelling = deep_water + lit_crest * through * (1 - 0.5f * water.normal.y);

    const glm::vec3 bare =
        glm::mix(upwelling, reflected, reflectance) + sun * sun_glint(water, to_sun, to_eye_cosine);
    const float to_sun_cosine = std::max(glm::dot(water.normal, to_sun), 0.f);
    const glm::vec3 white = foam_albedo * (0.3f * to_sun_cosine * sun + 0.45f * (horizon + zenith));
    const glm::vec3 seen = glm::mix(bare, white, glm::clamp(water.foam, 0.f, 1.f));
    return glm::mix(horizon, seen, 1 / (1 + square(water.distance)));
}

glm::u8vec3 screen_colour(const glm::vec3& light) {
    glm::u8vec3 colour;
    for (int channel = 0; channel < 3; ++channel) {
        const float x = 0.85f * std::max(light[channel], 0.f);
        // Narkowicz 2016, a fit to the ACES film curve.
        const float shown = std::min(1.f, x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f));
        colour[channel] = static_cast<std::uint8_t>(std::clamp(255 * encoded(shown) + 0.5f, 0.f, 255.f));
    }
    return colour;
}

}  // namespace pelagic::tools
