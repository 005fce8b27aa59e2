// A shred is noise of four sizes, twice as long as wide, of which less remains towards the rim.
#include "pelagic/gl/water/spray_image.hpp"

#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "pelagic/gl/water/tileable_noise.hpp"

namespace pelagic::gl {
namespace {

constexpr int spray_side = SprayImage::side;
constexpr std::size_t spray_texels = std::size_t{spray_side} * spray_side;

/// Returns the opacities of a layer, in rows.
std::vector<float> shred(std::minstd_rand& engine) {
    std::vector<GradientNoise> octaves;
    for (const int cells : {2, 4, 9, 19}) octaves.emplace_back(cells, 2 * cells, engine);
    const GradientNoise bend_x(2, 3, engine), bend_y(3, 2, engine);
    std::vector<float> texels(spray_texels);
    double sum = 0;
    for (std::size_t i = 0; i < spray_texels; ++i) {
        const glm::vec2 at =
            (glm::vec2(i % spray_side, i / spray_side) + 0.5f) / static_cast<float>(spray_side);  // [0, 1]
        const glm::vec2 bent = at + glm::vec2(0.06f * bend_x.at(at), 0.05f * bend_y.at(at));
        float noise = 0, weight = 0.85f;
        for (const GradientNoise& octave : octaves) {
            noise += weight * octave.at(bent);
            weight *= 0.62f;
        }
        const float r = glm::length(2.f * at - 1.f), rim = glm::max(0.96f - r * r, 0.f);
        const float dense = glm::smoothstep(0.f, 0.75f, 0.62f + 1.1f * noise - 0.75f * r);
        sum += texels[i] = dense * (0.25f + 0.75f * dense) * glm::min(2 * rim, 1.f);
    }
    const auto factor = static_cast<float>(std::numbers::pi / 12 * spray_texels / sum);
    for (float& texel : texels) texel = glm::min(texel * factor / SprayImage::scale, 1.f);
    return texels;
}

}  // namespace

const std::uint8_t* SprayImage::level(int level) const {
    std::size_t first = 0;
    for (int finer = 0; finer < level; ++finer) first += layers * (spray_texels >> (2 * finer));
    return texels.data() + first;
}

SprayImage make_spray_image() {
    std::minstd_rand engine(11);
    std::vector<float> level;
    for (int layer = 0; layer < SprayImage::layers; ++layer) {
        const std::vector<float> texels = shred(engine);
        level.insert(level.end(), texels.begin(), texels.end());
    }
    SprayImage image;
    for (std::size_t side = spray_side;; side /= 2) {
        for (const float texel : level) image.texels.push_back(byte_of(texel));
        if (side == 1) return image;
        // rows of all layers, one below the other
        std::vector<float> coarser(level.size() / 4);
        for (std::size_t i = 0; i < coarser.size(); ++i) {
            const float* const first = level.data() + 2 * (i / (side / 2)) * side + 2 * (i % (side / 2));
            coarser[i] = (first[0] + first[1] + first[side] + first[side + 1]) / 4;
        }
        level.swap(coarser);
    }
}

}  // namespace pelagic::gl
