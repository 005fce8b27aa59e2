#include "gl/clouds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace pelagic::gl {
namespace {

// Extinction inside a cumulus, 1/m: 100 droplets of 10 micrometres a cubic centimetre give about 0.06 (Hess, Koepke and
// Schult 1998, clean marine cumulus 0.025 to 0.07); thinner here, for the noise leaves soft edges no thickness.
constexpr float extinction_per_m = 0.03f;
// Droplets scatter forwards: Henyey-Greenstein with g = 0.8, and a weak lobe back, the usual fit of Mie's curve.
constexpr float forward_asymmetry = 0.8f, backward_asymmetry = -0.2f, backward_part = 0.35f;

float random_at(std::int32_t x, std::int32_t y, std::int32_t z, unsigned seed) {
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b1u ^ static_cast<std::uint32_t>(y) * 0x85ebca77u ^
                      static_cast<std::uint32_t>(z) * 0xc2b2ae3du ^ seed * 0x27d4eb2fu;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return static_cast<float>((h ^ h >> 15) >> 8) * (1.f / 16777216.f);
}

/// Value noise in [0, 1] with continuous second derivatives.
float noise(glm::vec3 p, unsigned seed) {
    const glm::vec3 floor = glm::floor(p), f = p - floor;
    const glm::vec3 u = f * f * f * (f * (f * 6.f - 15.f) + 10.f);
    const auto x = static_cast<std::int32_t>(floor.x), y = static_cast<std::int32_t>(floor.y),
               z = static_cast<std::int32_t>(floor.z);
    const auto line = [&](std::int32_t dy, std::int32_t dz) {
        return glm::mix(random_at(x, y + dy, z + dz, seed), random_at(x + 1, y + dy, z + dz, seed), u.x);
    };
    return glm::mix(glm::mix(line(0, 0), line(1, 0), u.y), glm::mix(line(0, 1), line(1, 1), u.y), u.z);
}

/// Each octave turned, so that their lattices do not line up.
glm::vec3 turned(glm::vec3 p) {
    return {0.8f * p.x - 0.6f * p.z + 17.3f, p.y + 5.7f, 0.6f * p.x + 0.8f * p.z - 31.1f};
}

float henyey_greenstein(float cosine, float g) {
    return (1 - g * g) / (4 * 3.14159265f * std::pow(1 + g * g - 2 * g * cosine, 1.5f));
}

}  // namespace

CloudLayer::CloudLayer(const CloudOptions& options, const Atmosphere& atmosphere, glm::vec3 sky_irradiance)
    : options_(options),
      atmosphere_(atmosphere),
      sun_light_(atmosphere.sun_transmittance(options.base_m + options.thickness_m)),
      sky_light_(sky_irradiance * (1 / 3.14159265f)) {}

float CloudLayer::density(glm::vec3 at, float height_part, bool with_detail) const {
    const unsigned seed = options_.seed;
    // Where clouds gather (kilometres), then the heaps (hundreds of metres), then their curls.
    const float gathering = noise(at * glm::vec3(1 / 4300.f, 0, 1 / 4300.f), seed + 7);
    glm::vec3 p = at * (1 / 1150.f);
    float shape = 0.55f * noise(p, seed);
    p = turned(p) * 2.03f;
    shape += 0.28f * noise(p, seed + 1);
    p = turned(p) * 2.11f;
    // Flat bases, round tops: the higher, the rarer.
    const float threshold =
        glm::mix(0.72f, 0.18f, options_.cover) + 0.30f * (0.5f - gathering) + 0.34f * height_part * height_part;
    const float most_detail = 0.17f;
    if (shape + most_detail < threshold) return 0;
    const float base = glm::smoothstep(0.f, 0.12f, height_part);
    if (!with_detail) return base * glm::clamp((shape + 0.085f - threshold) * 7.f, 0.f, 1.f);
    shape += 0.10f * noise(p, seed + 2);
    p = turned(p) * 2.17f;
    shape += 0.045f * noise(p, seed + 3);
    p = turned(p) * 2.09f;
    shape += 0.025f * noise(p, seed + 4);
    return base * glm::clamp((shape - threshold) * 7.f, 0.f, 1.f);
}

float CloudLayer::depth_towards_sun(glm::vec3 at, float height_part) const {
    const glm::vec3 sun = atmosphere_.sun();
    // Slanted light leaves the layer at its top, or far away.
    const float length = std::min((1 - height_part) * options_.thickness_m / std::max(sun.y, 0.08f), 1200.f);
    float depth = 0, before = 0;
    constexpr int samples = 4;
    for (int i = 1; i <= samples; ++i) {
        const float part = static_cast<float>(i) / samples;
        const float end = length * part * part;
        const float middle = (before + end) / 2;
        const float h = height_part + middle * sun.y / options_.thickness_m;
        depth += density(at + sun * middle, std::min(h, 1.f), i == 1) * (end - before);
        before = end;
    }
    return depth * extinction_per_m;
}

CloudLight CloudLayer::along(glm::vec3 direction) const {
    CloudLight light;
    // Bent down with the earth: the layer's distance at the horizon is finite.
    const auto distance_to = [&](float height_m) {
        const float b = earth_radius_m * direction.y;
        return 2 * earth_radius_m * height_m / (b + std::sqrt(b * b + 2 * earth_radius_m * height_m));
    };
    if (direction.y < 0.004f || options_.cover <= 0) return light;
    const float start = distance_to(options_.base_m);
    const float end = distance_to(options_.base_m + options_.thickness_m);
    constexpr float furthest_m = 90e3f;
    if (start > furthest_m) return light;

    constexpr int samples = 28;
    const float step = (end - start) / samples;
    const float cosine = glm::dot(direction, atmosphere_.sun());
    glm::vec3 sum(0);
    float left = 1;
    for (int i = 0; i < samples && left > 0.01f; ++i) {
        const float h = (static_cast<float>(i) + 0.5f) / samples;
        const float distance = start + (static_cast<float>(i) + 0.5f) * step;
        const glm::vec3 at(direction.x * distance, options_.base_m + h * options_.thickness_m,
                           direction.z * distance);
        const float here = density(at, h, true);
        if (here <= 0) continue;
        const float depth = depth_towards_sun(at, h);
        // Light scattered more than once, as octaves of weaker, rounder and further-reaching light (Wrenninge 2013,
        // "Oz: The Great and Volumetric").
        float sunlight = 0, weight = 1, reach = 1, roundness = 1;
        for (int octave = 0; octave < 4; ++octave) {
            const float phase = glm::mix(henyey_greenstein(cosine, forward_asymmetry * roundness),
                                         henyey_greenstein(cosine, backward_asymmetry * roundness), backward_part);
            sunlight += weight * phase * std::exp(-depth * reach);
            weight *= 0.6f;
            reach *= 0.35f;
            roundness *= 0.5f;
        }
        const glm::vec3 radiance = sun_light_ * sunlight + sky_light_ * (0.35f + 0.65f * h) * 0.55f;
        const float taken = 1 - std::exp(-here * extinction_per_m * step);
        sum += left * taken * radiance;
        left *= 1 - taken;
    }
    // Haze and air in front of the cloud: it takes the sky's colour with distance.
    const glm::vec3 through = atmosphere_.transmittance(direction.y, start);
    light.radiance = sum * through + atmosphere_.radiance(direction) * (1 - left) * (1.f - through);
    light.transmittance = left;
    return light;
}

float CloudLayer::sun_visibility() const {
    const glm::vec3 sun = atmosphere_.sun();
    return sun.y > 0 ? along(sun).transmittance : 0;
}

}  // namespace pelagic::gl
