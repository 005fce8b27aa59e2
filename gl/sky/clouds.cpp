#include "pelagic/gl/sky/clouds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
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

float faded(float f) { return f * f * f * (f * (f * 6.f - 15.f) + 10.f); }

/// Value noise in [0, 1] with continuous second derivatives along a vertical line, periodic with
/// `period` along x and z. Keeps the lattice values of the last cell, because heights ascend.
class NoiseColumn {
   public:
    NoiseColumn(float x, float z, int period, unsigned seed) : period_(period), seed_(seed) {
        const float floor_x = std::floor(x), floor_z = std::floor(z);
        u_ = faded(x - floor_x);
        w_ = faded(z - floor_z);
        x0_ = wrapped(static_cast<std::int32_t>(floor_x));
        x1_ = wrapped(x0_ + 1);
        z0_ = wrapped(static_cast<std::int32_t>(floor_z));
        z1_ = wrapped(z0_ + 1);
        for (std::size_t end = 0; end < 2; ++end) lines_[end] = lines_at(static_cast<std::int32_t>(end));
    }

    float at(float y) {
        const float floor_y = std::floor(y), v = faded(y - floor_y);
        const auto cell = static_cast<std::int32_t>(floor_y);
        if (cell != cell_) {
            lines_[0] = cell == cell_ + 1 ? lines_[1] : lines_at(cell);
            lines_[1] = lines_at(cell + 1);
            cell_ = cell;
        }
        const glm::vec2 mixed = glm::mix(lines_[0], lines_[1], v);
        return glm::mix(mixed.x, mixed.y, w_);
    }

   private:
    std::int32_t wrapped(std::int32_t i) const { return (i % period_ + period_) % period_; }
    /// Returns the noise between the lattice points along x, at z0 and z1.
    glm::vec2 lines_at(std::int32_t y) const {
        const glm::vec2 from(random_at(x0_, y, z0_, seed_), random_at(x0_, y, z1_, seed_));
        const glm::vec2 to(random_at(x1_, y, z0_, seed_), random_at(x1_, y, z1_, seed_));
        return glm::mix(from, to, u_);
    }

    int period_;
    unsigned seed_;
    float u_, w_;
    std::int32_t x0_, x1_, z0_, z1_, cell_ = 0;
    std::array<glm::vec2, 2> lines_;  ///< at the lower and at the upper end of the cell
};

float henyey_greenstein(float cosine, float g) {
    return (1 - g * g) / (4 * std::numbers::pi_v<float> * std::pow(1 + g * g - 2 * g * cosine, 1.5f));
}

}  // namespace

void CloudShape::fill_row(int row, unsigned seed) {
    // Noise cells across the box in each octave, from 1150 m wide. Each weight is about half the
    // previous one.
    constexpr int cells[] = {4, 8, 17, 37, 75};
    constexpr float weights[] = {0.53f, 0.26f, 0.12f, 0.06f, 0.03f};
    for (int x = 0; x < side; ++x) {
        std::array<float, layers> sums{};
        for (unsigned octave = 0; octave < 5; ++octave) {
            const float scale = static_cast<float>(cells[octave]) / side;
            NoiseColumn noise(static_cast<float>(x) * scale, static_cast<float>(row) * scale, cells[octave],
                              seed + octave);
            for (int layer = 0; layer < layers; ++layer)
                sums[static_cast<std::size_t>(layer)] +=
                    weights[octave] * noise.at((static_cast<float>(layer) / layers) * height_m / width_m *
                                               static_cast<float>(cells[octave]));
        }
        std::uint8_t* to = &values_[(static_cast<std::size_t>(row) * side + static_cast<std::size_t>(x)) * layers];
        for (const float sum : sums) *to++ = static_cast<std::uint8_t>(sum * 255 + 0.5f);
    }
}

void CloudShape::measure_blocks(int row) {
    for (int block = 0; block < blocks; ++block)
        for (int layer = 0; layer < layers_of_blocks; ++layer) {
            std::uint8_t max = 0;
            const int end = std::min((layer + 1) * block_layers + 1, layers);
            for (int z = row * block_side; z <= (row + 1) * block_side; ++z)
                for (int x = block * block_side; x <= (block + 1) * block_side; ++x) {
                    const std::uint8_t* column = &values_[column_at(x & (side - 1), z & (side - 1))];
                    max = std::max(max, *std::max_element(column + layer * block_layers, column + end));
                }
            maxima_[block_at(block, row, layer)] = max;
        }
}

float CloudShape::at(glm::vec3 point_m, float least) const {
    const float x = point_m.x * (side / width_m), z = point_m.z * (side / width_m);
    const float y = std::clamp(point_m.y * (layers / height_m), 0.f, layers - 1.001f);
    const float fx = std::floor(x), fz = std::floor(z);
    const int x0 = static_cast<int>(static_cast<std::int64_t>(fx) & (side - 1));
    const int z0 = static_cast<int>(static_cast<std::int64_t>(fz) & (side - 1));
    const int y0 = static_cast<int>(y);
    constexpr float of_byte = 1 / 255.f, rounding = 1e-5f;
    const float max = of_byte * maxima_[block_at(x0 / block_side, z0 / block_side, y0 / block_layers)];
    if (max + rounding < least) return 0;
    const int x1 = (x0 + 1) & (side - 1), z1 = (z0 + 1) & (side - 1);
    const float u = x - fx, v = y - static_cast<float>(y0), w = z - fz;
    const auto column = [&](int cx, int cz) {
        const std::uint8_t* from = &values_[column_at(cx, cz) + static_cast<std::size_t>(y0)];
        return glm::mix(static_cast<float>(from[0]), static_cast<float>(from[1]), v);
    };
    return of_byte *
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
    const float gathering = NoiseColumn(at.x * (1 / 4300.f), at.z * (1 / 4300.f), never, options_.seed + 7).at(0);
    return glm::mix(0.72f, 0.22f, options_.cover) + 0.30f * (0.5f - gathering);
}

/// Returns the relative density, [0, 1]. Clouds have flat bases and round tops, and become rarer
/// with height. From cover 0.9 to 1 the gaps between them fill with thin cloud, of optical depth
/// 4.6 along a vertical ray.
/// \param relative_height  height in the layer, 0 at the base, 1 at the top
float CloudLayer::density(glm::vec3 at, float relative_height, float threshold) const {
    const float least = threshold + 0.34f * relative_height * relative_height;
    const float shape = shape_.at(at - glm::vec3(0, options_.base_m, 0), least) - least;
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

CloudLayer::Crossing CloudLayer::crossing(glm::vec3 direction) const {
    // The layer follows the earth's curvature, so its distance at the horizon is finite.
    const auto distance_to = [&](float height_m) {
        const float b = earth_radius_m * direction.y;
        return 2 * earth_radius_m * height_m / (b + std::sqrt(b * b + 2 * earth_radius_m * height_m));
    };
    if (direction.y < 0.004f || options_.cover <= 0) return {};
    const float start = distance_to(options_.base_m);
    const float end = distance_to(options_.base_m + options_.thickness_m);
    constexpr float furthest_m = 90e3f;
    if (start > furthest_m) return {};
    // Steps are about 45 m long, and longer towards the horizon.
    const int samples = std::clamp(static_cast<int>((end - start) / 45), 20, 72);
    return {start, (end - start) / static_cast<float>(samples), samples};
}

float CloudLayer::transmittance(glm::vec2 place_m, glm::vec3 direction) const {
    if (direction.y <= 0) return 0;
    // Twice the steps of along(): a shadow needs fewer details than a cloud.
    const Crossing ray = crossing(direction);
    const int samples = ray.samples / 2;
    const float step = 2 * ray.step;
    const glm::vec2 across(direction.x, direction.z);
    float depth = 0, gathered = 0;
    for (int i = 0; i < samples && depth < 7; ++i) {
        const float h = (static_cast<float>(i) + 0.5f) / static_cast<float>(samples);
        const glm::vec2 at = place_m + across * (ray.start + (static_cast<float>(i) + 0.5f) * step);
        const glm::vec3 point(at.x, options_.base_m + h * options_.thickness_m, at.y);
        if (i % 2 == 0) gathered = threshold(point);
        depth += density(point, h, gathered) * (extinction_per_m * step);
    }
    return std::exp(-depth);
}

CloudLight CloudLayer::along(glm::vec3 direction) const {
    CloudLight light;
    const auto [start, step, samples] = crossing(direction);
    if (samples == 0) return light;
    // Each ray starts at a random offset within a step, so that no slices are visible.
    const auto bits = [](float f) { return static_cast<std::int32_t>(f * 65536); };
    const float jitter = random_at(bits(direction.x), bits(direction.y), bits(direction.z), options_.seed);
    float gathered = threshold(direction * start);
    // Multiple scattering as octaves of weaker light with lower extinction and a rounder phase
    // function (Wrenninge 2013, "Oz: The Great and Volumetric").
    struct Octave {
        float phase, reach;
    };
    std::array<Octave, 4> octaves;
    const float cosine = glm::dot(direction, key_.direction);
    float weight = 1, reach = 1, roundness = 1;
    for (Octave& octave : octaves) {
        octave = {weight * glm::mix(henyey_greenstein(cosine, forward_asymmetry * roundness),
                                    henyey_greenstein(cosine, backward_asymmetry * roundness), backward_weight),
                  reach};
        weight *= 0.6f;
        reach *= 0.35f;
        roundness *= 0.5f;
    }
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
        float sunlight = 0;
        for (const Octave& octave : octaves) sunlight += octave.phase * std::exp(-depth * octave.reach);
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
