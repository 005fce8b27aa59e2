#include "pelagic/gl/sky/sky_mirrors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace pelagic::gl {
namespace {

using std::numbers::pi_v;

}  // namespace

glm::vec2 hammersley(std::uint32_t i, std::uint32_t count) {
    std::uint32_t bits = i;
    bits = bits << 16 | bits >> 16;
    bits = (bits & 0x55555555u) << 1 | (bits & 0xaaaaaaaau) >> 1;
    bits = (bits & 0x33333333u) << 2 | (bits & 0xccccccccu) >> 2;
    bits = (bits & 0x0f0f0f0fu) << 4 | (bits & 0xf0f0f0f0u) >> 4;
    bits = (bits & 0x00ff00ffu) << 8 | (bits & 0xff00ff00u) >> 8;
    return {(static_cast<float>(i) + 0.5f) / static_cast<float>(count), static_cast<float>(bits) * 0x1p-32f};
}

void filter_mirror_row(const std::vector<Cube>& averages, std::vector<Cube>& mirrors, std::size_t row) {
    std::size_t level = 1;
    while (row >= 6 * static_cast<std::size_t>(mirrors[level].side))
        row -= 6 * static_cast<std::size_t>(mirrors[level++].side);
    Cube& cube = mirrors[level];
    const int face = static_cast<int>(row) / cube.side, y = static_cast<int>(row) % cube.side;
    const float perceptual = static_cast<float>(level) / static_cast<float>(mirrors.size() - 1);
    const float alpha = perceptual * perceptual;
    constexpr std::uint32_t most_samples = 64;
    const std::uint32_t samples = level == 1 ? 24 : most_samples;
    const auto size = static_cast<float>(mirrors[0].side);
    const float texel_angle = 4 * pi_v<float> / (6 * size * size);
    /// Facets of a GGX distribution, in coordinates along tangent, across, normal.
    struct Facet {
        float tangent, across, normal;
        std::size_t average;  ///< level of `averages` whose texels are as wide as the sample
    };
    std::array<Facet, most_samples> facets;
    for (std::uint32_t i = 0; i < samples; ++i) {
        const glm::vec2 u = hammersley(i, samples);
        const float cosine = std::sqrt((1 - u.x) / (1 + (alpha * alpha - 1) * u.x));
        const float sine = std::sqrt(1 - cosine * cosine), angle = 2 * pi_v<float> * u.y;
        const float denominator = cosine * cosine * (alpha * alpha - 1) + 1;
        const float density = alpha * alpha / (pi_v<float> * denominator * denominator) / 4;
        const float sample_angle = 1 / (static_cast<float>(samples) * density);
        const float from = std::clamp(0.5f * std::log2(sample_angle / texel_angle) + 0.5f, 0.f,
                                      static_cast<float>(averages.size() - 1));
        facets[i] = {sine * std::cos(angle), sine * std::sin(angle), cosine, static_cast<std::size_t>(from + 0.5f)};
    }
    for (int x = 0; x < cube.side; ++x) {
        const glm::vec3 n = cube.direction(face, x, y);
        const glm::vec3 helper = std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
        const glm::vec3 tangent = glm::normalize(glm::cross(helper, n)), across = glm::cross(n, tangent);
        glm::vec3 sum(0);
        float weights = 0;
        for (std::uint32_t i = 0; i < samples; ++i) {
            const Facet& facet = facets[i];
            const glm::vec3 h = tangent * facet.tangent + across * facet.across + n * facet.normal;
            const glm::vec3 light = 2 * facet.normal * h - n;
            const float to_light = glm::dot(light, n);
            if (to_light <= 0) continue;
            sum += averages[facet.average].sample(light) * to_light;
            weights += to_light;
        }
        cube.at(face, x, y) = sum / std::max(weights, 1e-6f);
    }
}

}  // namespace pelagic::gl
