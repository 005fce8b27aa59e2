#include "pelagic/gl/sky/sky_baker.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "pelagic/gl/sky/clear_sky.hpp"
#include "pelagic/gl/sky/clouds.hpp"
#include "pelagic/gl/sky/cube.hpp"
#include "pelagic/gl/sky/sky_mirrors.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"

namespace pelagic::gl {
namespace {

using std::numbers::pi_v;

constexpr float half_max = 65504;
/// Exposed radiance of a white card in the open. The filmic curve shows it as 80 % white.
constexpr float white_card = 1.35f;
/// Albedo of a mean sea, for the lower hemisphere of reflections: the Fresnel reflectance averaged
/// over a cloudy sky, 0.066 (Payne 1972, "Albedo of the sea surface"). The reflectance increases
/// towards the horizon.
constexpr float sea_albedo = 0.066f;

/// Returns the solid angle of a texel relative to that of a texel at the centre of the face.
float texel_weight(float s, float t) { return std::pow(1 + s * s + t * t, -1.5f); }

}  // namespace

// Stages in order:
//   * `sky air`: lines of the atmosphere tables;
//   * `sky light` (sum of the tables), `sky heaps` and `sky blocks` (cloud noise and its maxima,
//     once for each seed);
//   * `sky faces`: level 0 above the horizon, rows of each face;
//   * `sky shadows`: sunlight on the sea under the clouds, rows;
//   * `sky below`: level 0 below the horizon, the sea's reflection of the faces;
//   * `sky averages`: box mips, which the next stage samples;
//   * `sky mirrors`: GGX levels;
//   * `sky packing`: conversion to half floats.
//
// A job takes at most about 10 ms, a frame of a web page, so that an application with one thread
// can bake between frames (sliced_executor.hpp).
struct SkyBaker::State {
    State(std::shared_ptr<Executor> on, int face_size) : executor(std::move(on)), size(face_size) {
        for (int side = size; side >= 4; side /= 2) averages.emplace_back(side);
        for (int side = size; side >= 4; side /= 2) mirrors.emplace_back(side);
        cloud_transmittances.resize(mirrors[0].texels.size());
        for (Sky& sky : skies) {
            sky.face_size = size;
            sky.levels = sky_levels(size);
            std::size_t texels = 0;
            for (const Cube& cube : mirrors) texels += cube.texels.size();
            sky.texels.resize(4 * texels);
        }
        const StageId air = graph.add({"sky air", ClearSky::lines, 4, {}, [this](std::size_t begin, std::size_t end) {
                                           for (std::size_t line = begin; line < end; ++line)
                                               clear->fill_line(static_cast<int>(line));
                                       }});
        const StageId light = graph.add({"sky light", 1, 1, {air}, [this](auto, auto) { prepare_light(); }});
        const StageId noise =
            graph.add({"sky heaps", CloudShape::side, 4, {}, [this](std::size_t begin, std::size_t end) {
                           if (has_noise() || target().options.cloud_cover <= 0) return;
                           for (std::size_t row = begin; row < end; ++row)
                               shape.fill_row(static_cast<int>(row), target().options.cloud_seed);
                       }});
        const StageId blocks =
            graph.add({"sky blocks", CloudShape::blocks, 8, {noise}, [this](std::size_t begin, std::size_t end) {
                           if (has_noise() || target().options.cloud_cover <= 0) return;
                           for (std::size_t row = begin; row < end; ++row)
                               shape.measure_blocks(static_cast<int>(row));
                       }});
        const StageId faces = graph.add({"sky faces",
                                         6 * static_cast<std::size_t>(size),
                                         4,
                                         {light, blocks},
                                         [this](std::size_t begin, std::size_t end) {
                                             for (std::size_t row = begin; row < end; ++row)
                                                 bake_row(static_cast<int>(row) / size, static_cast<int>(row) % size);
                                         }});
        const StageId shade =
            graph.add({"sky shadows", CloudShadows::side, 2, {light, blocks}, [this](std::size_t begin, std::size_t end) {
                           if (target().options.cloud_cover <= 0) return;
                           for (std::size_t row = begin; row < end; ++row)
                               fill_shadow_row(*clouds, target().sun_direction, static_cast<int>(row), shadow_row(row));
                       }});
        const StageId below =
            graph.add({"sky below", 1, 1, {faces, shade}, [this](auto, auto) { reflect_in_sea(); }});
        const StageId box = graph.add({"sky averages", 1, 1, {below}, [this](auto, auto) { average(); }});
        std::size_t mirror_rows = 0;
        for (std::size_t level = 1; level < mirrors.size(); ++level) mirror_rows += 6 * mirrors[level].side;
        const StageId mirror =
            graph.add({"sky mirrors", mirror_rows, 8, {box}, [this](std::size_t begin, std::size_t end) {
                           for (std::size_t row = begin; row < end; ++row) filter_mirror_row(averages, mirrors, row);
                       }});
        graph.add({"sky packing", 1, 1, {mirror}, [this](auto, auto) {
                       pack();
                       if (target().options.cloud_cover > 0) noise_seed = target().options.cloud_seed;
                   }});
        run = executor->prepare(graph);
    }

    Sky& target() { return skies[writing]; }
    bool has_noise() { return noise_seed == target().options.cloud_seed; }

    void prepare_light() {
        Sky& sky = target();
        clear->finish();
        clouds.emplace(CloudOptions{.cover = sky.options.cloud_cover, .seed = sky.options.cloud_seed}, *clear, shape);
        const KeyLight key = clear->key_light();
        sky.unit = clear->unit();
        sky.sun_direction = key.direction;
        sky.key_is_moon = key.is_moon;
        sky.haze_per_m = rayleigh_per_m + haze_per_m(sky.options.visibility_m);
    }

    std::size_t texel_number(int face, int x, int y) const {
        return (static_cast<std::size_t>(face) * static_cast<std::size_t>(size) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(size) +
               static_cast<std::size_t>(x);
    }

    void bake_row(int face, int y) {
        Cube& cube = mirrors[0];
        for (int x = 0; x < size; ++x) {
            const glm::vec3 d = cube.direction(face, x, y);
            if (d.y < 0) continue;
            const CloudLight cloud = clouds->along(d);
            const glm::vec3 radiance = clear->radiance(d) * cloud.transmittance + cloud.radiance;
            cube.at(face, x, y) = glm::clamp(radiance, 0.f, half_max);
            cloud_transmittances[texel_number(face, x, y)] = cloud.transmittance;
        }
    }

    /// Below the horizon, a mirror reflects other waves, which reflect the sky and its clouds. The
    /// reflectance falls towards the nadir.
    void reflect_in_sea() {
        Cube& cube = mirrors[0];
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) {
                    const glm::vec3 d = cube.direction(face, x, y);
                    if (d.y >= 0) continue;
                    const float grazing = std::pow(1 + std::max(d.y, -1.f), 5.f);
                    cube.at(face, x, y) = cube.mirrored(face, x, y) * glm::mix(sea_albedo, 1.f, grazing);
                    cloud_transmittances[texel_number(face, x, y)] = 0;
                }
    }

    void average() {
        averages[0].texels = mirrors[0].texels;
        for (std::size_t level = 1; level < averages.size(); ++level) {
            const Cube& finer = averages[level - 1];
            Cube& cube = averages[level];
            for (int face = 0; face < 6; ++face)
                for (int y = 0; y < cube.side; ++y)
                    for (int x = 0; x < cube.side; ++x)
                        cube.at(face, x, y) =
                            0.25f * (finer.at(face, 2 * x, 2 * y) + finer.at(face, 2 * x + 1, 2 * y) +
                                     finer.at(face, 2 * x, 2 * y + 1) + finer.at(face, 2 * x + 1, 2 * y + 1));
        }
        measure_irradiance();
    }

    std::span<float, CloudShadows::side> shadow_row(std::size_t row) {
        return std::span<float, CloudShadows::side>(&shadows[row * CloudShadows::side], CloudShadows::side);
    }

    /// \param key  irradiance of the key light without clouds
    void store_shadows(const glm::vec3& key) {
        Sky& sky = target();
        sky.cloud_shadows.texels.clear();
        sky.sun_irradiance = sky.sun_direction.y > 0 ? key : glm::vec3(0);
        sky.brightest_transmittance = 0;
        sky.mean_sunlight = 1;
        if (sky.options.cloud_cover <= 0) return;
        constexpr float least = 1e-4f;
        const float brightest = std::max(*std::max_element(shadows.begin(), shadows.end()), least);
        sky.sun_irradiance *= brightest;
        sky.brightest_transmittance = brightest;
        double sum = 0;
        for (const float transmittance : shadows) {
            sky.cloud_shadows.texels.push_back(static_cast<std::uint8_t>(transmittance / brightest * 255 + 0.5f));
            sum += static_cast<double>(transmittance / brightest);
        }
        sky.mean_sunlight = static_cast<float>(sum / static_cast<double>(shadows.size()));
    }

    void measure_irradiance() {
        Sky& sky = target();
        const Cube& cube = averages[std::min<std::size_t>(averages.size() - 1, 2)];
        glm::vec3 irradiance(0);
        float weights = 0;
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < cube.side; ++y)
                for (int x = 0; x < cube.side; ++x) {
                    const float scale = 2.f / static_cast<float>(cube.side);
                    const float weight = texel_weight((static_cast<float>(x) + 0.5f) * scale - 1,
                                                      (static_cast<float>(y) + 0.5f) * scale - 1);
                    const glm::vec3 d = cube.direction(face, x, y);
                    weights += weight;
                    if (d.y > 0) irradiance += cube.at(face, x, y) * (d.y * weight);
                }
        const glm::vec3 key = clear->key_light().irradiance;
        store_shadows(key);
        sky.sky_irradiance = irradiance * (4 * pi_v<float> / weights);
        // Rec. 709 luminance of a white card in the open, tilted halfway from horizontal towards
        // the sun. A horizontal card would underestimate the light of an evening.
        const float tilted = sky.sun_direction.y > 0 ? 0.5f + 0.5f * sky.sun_direction.y : 0;
        // A cloud in front of the sun darkens this position, not the whole view.
        const glm::vec3 sunlight = key * std::max(clouds->transmittance({0, 0}, sky.sun_direction), 0.5f);
        const glm::vec3 card = (sky.sky_irradiance + sunlight * tilted) / pi_v<float>;
        // An overcast sky is as bright as the card. The sky's luminance is added, so that the sky
        // is not overexposed.
        const glm::vec3 scene = card + 0.6f / pi_v<float> * sky.sky_irradiance;
        const float luminance = glm::dot(scene, glm::vec3(0.2126f, 0.7152f, 0.0722f));
        // Luminance of a middle-grey card, as a light meter measures it.
        const float grey = 0.18f * luminance * sky.luminance_of_unit();
        sky.exposure = white_card / std::max(luminance, 1e-6f) * night_darkening(grey);
    }

    void pack() {
        std::uint16_t* to = target().texels.data();
        for (std::size_t level = 0; level < mirrors.size(); ++level)
            for (std::size_t i = 0; i < mirrors[level].texels.size(); ++i) {
                const float alpha = level == 0 ? cloud_transmittances[i] : 1;
                const std::uint64_t halves = glm::packHalf4x16(glm::vec4(mirrors[level].texels[i], alpha));
                for (int c = 0; c < 4; ++c) *to++ = static_cast<std::uint16_t>(halves >> 16 * c);
            }
    }

    std::shared_ptr<Executor> executor;
    int size;
    CloudShape shape;
    std::optional<unsigned> noise_seed;  ///< seed of the noise in `shape`
    std::optional<ClearSky> clear;
    std::optional<CloudLayer> clouds;
    std::vector<Cube> averages, mirrors;
    std::vector<float> shadows = std::vector<float>(std::size_t{CloudShadows::side} * CloudShadows::side);
    std::vector<float> cloud_transmittances;  ///< cloud transmittance of level 0's texels
    std::array<Sky, 2> skies;
    std::size_t writing = 0;
    bool in_flight = false;
    JobGraph graph;
    std::unique_ptr<GraphRun> run;  // last member: its destructor waits for jobs in flight
};

SkyBaker::SkyBaker(std::shared_ptr<Executor> executor, int face_size) {
    if (face_size < 16 || face_size > 2048 || !std::has_single_bit(static_cast<unsigned>(face_size)))
        throw std::invalid_argument(invalid_value_message("face_size", face_size, "a power of two from 16 to 2048"));
    state_ = std::make_unique<State>(std::move(executor), face_size);
}
SkyBaker::~SkyBaker() = default;

void SkyBaker::schedule(const SkyOptions& options) {
    assert(!state_->in_flight && "complete() the sky in flight first");
    require(check(options));
    state_->writing = 1 - state_->writing;
    state_->target().options = options;
    state_->clear.emplace(options, Atmosphere::FillLater{});
    state_->in_flight = true;
    state_->run->schedule();
}

bool SkyBaker::is_done() const { return state_->run->is_done(); }

const Sky& SkyBaker::complete() {
    if (state_->in_flight) state_->run->complete();
    state_->in_flight = false;
    return state_->target();
}

}  // namespace pelagic::gl
