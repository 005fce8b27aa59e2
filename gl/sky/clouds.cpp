#include "pelagic/gl/sky/clouds.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace pelagic::gl {
namespace {

// Extinction inside a cumulus, 1/m: 100 droplets of 10 micrometres per cubic centimetre give about
// 0.06 (Hess, Koepke and Schult 1998: 0.025 to 0.07 for clean marine cumulus). The value is lower
// here, because the noise gives clouds soft, thin edges.
constexpr float extinction_per_m = 0.03f;
// Scattering by droplets: a forward Henyey-Greenstein lobe with g = 0.8 and a weak backward lobe,
// the usual fit of the Mie phase function.
constexpr float forward_asymmetry = 0.8f, backward_asymmetry = -0.2f, backward_weight = 0.35f;

float random_at(std::int32_t x, std::int32_t y, std::int32_t z, unsigned seed) {
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b1u ^ static_cast<std::uint32_t>(y) * 0x85ebca77u ^
                      static_cast<std::uint32_t>(z) * 0xc2b2ae3du ^ seed * 0x27d4eb2fu;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return static_cast<float>((h ^ h >> 15) >> 8) * (1.f / 16777216.f);
}

/// Returns value noise in [0, 1] with continuous second derivatives, periodic with `period` along x
/// and z.
float noise(glm::vec3 p, int period, unsigned seed) {
    const glm::vec3 floor = glm::floor(p), f = p - floor;
    const glm::vec3 u = f * f * f * (f * (f * 6.f - 15.f) + 10.f);
    const auto x = static_cast<std::int32_t>(floor.x), y = static_cast<std::int32_t>(floor.y),
               z = static_cast<std::int32_t>(floor.z);
    const auto wrapped = [&](std::int32_t i) { return (i % period + period) % period; };
    const std::int32_t x0 = wrapped(x), x1 = wrapped(x + 1), z0 = wrapped(z), z1 = wrapped(z + 1);
    const auto line = [&](std::int32_t at_y, std::int32_t at_z) {
        return glm::mix(random_at(x0, at_y, at_z, seed), random_at(x1, at_y, at_z, seed), u.x);
    };
    return glm::mix(glm::mix(line(y, z0), line(y + 1, z0), u.y), glm::mix(line(y, z1), line(y + 1, z1), u.y), u.z);
}

float henyey_greenstein(float cosine, float g) {
    return (1 - g * g) / (4 * std::numbers::pi_v<float> * std::pow(1 + g * g - 2 * g * cosine, 1.5f));
}

}  // namespace

void CloudShape::fill_row(int row, unsigned seed) {
    // Noise cells across the box in each octave, from 1150 m wide. Each weight is about half the
    // previous one.
    constexpr int cells[] = {4, 8, 17, 37, 75};
    constexpr float weights[] = {0.53f, 0.26f, 0.12f, 0.06f, 0.03f};
    for (int x = 0; x < side; ++x)
        for (int layer = 0; layer < layers; ++layer) {
            float sum = 0;
            for (unsigned octave = 0; octave < 5; ++octave) {
                const float scale = static_cast<float>(cells[octave]) / side;
                const float up =
                    (static_cast<float>(layer) / layers) * height_m / width_m * static_cast<float>(cells[octave]);
                const glm::vec3 p(static_cast<float>(x) * scale, up, static_cast<float>(row) * scale);
                sum += weights[octave] * noise(p, cells[octave], seed + octave);
            }
            values_[(static_cast<std::size_t>(row) * side + static_cast<std::size_t>(x)) * layers +
                    static_cast<std::size_t>(layer)] = static_cast<std::uint8_t>(sum * 255 + 0.5f);
        }
}

float CloudShape::at(glm::vec3 point_m) const {
    const float x = point_m.x * (side / width_m), z = point_m.z * (side / width_m);
    const float y = std::clamp(point_m.y * (layers / height_m), 0.f, layers - 1.001f);
    const float fx = std::floor(x), fz = std::floor(z);
    const auto x0 = static_cast<std::size_t>(static_cast<std::int64_t>(fx) & (side - 1));
    const auto z0 = static_cast<std::size_t>(static_cast<std::int64_t>(fz) & (side - 1));
    const std::size_t x1 = (x0 + 1) & (side - 1), z1 = (z0 + 1) & (side - 1), y0 = static_cast<std::size_t>(y);
    const float u = x - fx, v = y - static_cast<float>(y0), w = z - fz;
    const auto column = [&](std::size_t cx, std::size_t cz) {
        const std::uint8_t* from = &values_[(cz * side + cx) * layers + y0];
        return glm::mix(static_cast<float>(from[0]), static_cast<float>(from[1]), v);
    };
    return (1 / 255.f) *
           glm::mix(glm::mix(column(x0, z0), column(x1, z0), u), glm::mix(column(x0, z1), column(x1, z1), u), w);
}

CloudLayer::CloudLayer(const CloudOptions& options, const ClearSky& sky, const CloudShape& shape)
    : options_(options),
      sky_(sky),
      shape_(shape),
      closed_(glm::smoothstep(0.9f, 1.f, options.cover)),
      key_(sky.key_light(options.base_m + options.thickness_m)),
      sky_light_(sky.irradiance() * (1 / std::numbers::pi_v<float>)) {}

/// Returns the noise level above which a cloud forms at its base. It varies over kilometres and is
/// low where clouds cluster.
float CloudLayer::threshold(glm::vec3 at) const {
    constexpr int never = 1 << 20;
    const float gathering = noise(at * glm::vec3(1 / 4300.f, 0, 1 / 4300.f), never, options_.seed + 7);
    return glm::mix(0.72f, 0.22f, options_.cover) + 0.30f * (0.5f - gathering);
}

/// Returns the relative density, [0, 1]. Clouds have flat bases and round tops, and become rarer
/// with height. From cover 0.9 to 1 the gaps between them fill with thin cloud, of optical depth
/// 4.6 along a vertical ray.
/// \param relative_height  height in the layer, 0 at the base, 1 at the top
float CloudLayer::density(glm::vec3 at, float relative_height, float threshold) const {
    const float shape =
        shape_.at(at - glm::vec3(0, options_.base_m, 0)) - threshold - 0.34f * relative_height * relative_height;
    const float thin = 0.25f * closed_ * (1 - glm::smoothstep(0.5f, 1.f, relative_height));
    const float density = std::max(std::min(1.f, shape * 7), thin);
    if (density <= 0) return 0;
    return glm::smoothstep(0.f, 0.12f, relative_height) * density;
}

float CloudLayer::depth_towards_sun(glm::vec3 at, float relative_height, float threshold) const {
    const glm::vec3 sun = key_.direction;
    // Slanted light leaves the layer at its top, or after at most 1200 m.
    const float length = std::min((1 - relative_height) * options_.thickness_m / std::max(sun.y, 0.08f), 1200.f);
    float depth = 0, before = 0;
    constexpr int samples = 5;
    for (int i = 1; i <= samples; ++i) {
        const float fraction = static_cast<float>(i) / samples;
        const float end = length * fraction * fraction;
        const float middle = (before + end) / 2;
        const float h = relative_height + middle * sun.y / options_.thickness_m;
        depth += density(at + sun * middle, std::min(h, 1.f), threshold) * (end - before);
        before = end;
    }
    return depth * extinction_per_m;
}

CloudLight CloudLayer::along(glm::vec3 direction) const {
    CloudLight light;
    // The layer follows the earth's curvature, so its distance at the horizon is finite.
    const auto distance_to = [&](float height_m) {
        const float b = earth_radius_m * direction.y;
        return 2 * earth_radius_m * height_m / (b + std::sqrt(b * b + 2 * earth_radius_m * height_m));
    };
    if (direction.y < 0.004f || options_.cover <= 0) return light;
    const float start = distance_to(options_.base_m);
    const float end = distance_to(options_.base_m + options_.thickness_m);
    constexpr float furthest_m = 90e3f;
    if (start > furthest_m) return light;

    // Steps are about 45 m long, and longer towards the horizon. Each ray starts at a random offset
    // within a step, so that no slices are visible.
    const int samples = std::clamp(static_cast<int>((end - start) / 45), 20, 72);
    const float step = (end - start) / static_cast<float>(samples);
    const auto bits = [](float f) { return static_cast<std::int32_t>(f * 65536); };
    const float jitter = random_at(bits(direction.x), bits(direction.y), bits(direction.z), options_.seed);
    float gathered = threshold(direction * start);
    const float cosine = glm::dot(direction, key_.direction);
    glm::vec3 sum(0);
    float transmittance = 1;
    for (int i = 0; i < samples && transmittance > 0.01f; ++i) {
        const float h = (static_cast<float>(i) + jitter) / static_cast<float>(samples);
        const float distance = start + (static_cast<float>(i) + jitter) * step;
        const glm::vec3 at(direction.x * distance, options_.base_m + h * options_.thickness_m,
                           direction.z * distance);
        if (i % 4 == 3) gathered = threshold(at);
        const float here = density(at, h, gathered);
        if (here <= 0) continue;
        const float depth = depth_towards_sun(at, h, gathered);
        // Multiple scattering as octaves of weaker light with lower extinction and a rounder phase
        // function (Wrenninge 2013, "Oz: The Great and Volumetric").
        float sunlight = 0, weight = 1, reach = 1, roundness = 1;
        for (int octave = 0; octave < 4; ++octave) {
            const float phase = glm::mix(henyey_greenstein(cosine, forward_asymmetry * roundness),
                                         henyey_greenstein(cosine, backward_asymmetry * roundness), backward_weight);
            sunlight += weight * phase * std::exp(-depth * reach);
            weight *= 0.6f;
            reach *= 0.35f;
            roundness *= 0.5f;
        }
        const glm::vec3 radiance = key_.irradiance * sunlight + sky_light_ * (0.35f + 0.65f * h) * 0.55f;
        const float opacity = 1 - std::exp(-here * extinction_per_m * step);
        sum += transmittance * opacity * radiance;
        transmittance *= 1 - opacity;
    }
    // Haze and air in front of the cloud: its colour approaches the sky's with distance.
    const glm::vec3 through = sky_.transmittance(direction.y, start);
    light.radiance = sum * through + sky_.radiance(direction) * (1 - transmittance) * (1.f - through);
    light.transmittance = transmittance;
    return light;
}

}  // namespace pelagic::gl
