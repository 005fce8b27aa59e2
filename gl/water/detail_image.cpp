#include "pelagic/gl/water/detail_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <random>

#include "pelagic/gl/water/tileable_noise.hpp"

namespace pelagic::gl {
namespace {

using std::numbers::pi_v;

constexpr int detail_side = DetailImage::side;

void add_ripples(std::vector<glm::vec4>& texels, std::minstd_rand& engine) {
    std::vector<glm::vec2> slopes(texels.size(), glm::vec2(0));
    for (int wave = 0; wave < 96; ++wave) {
        // Wave numbers are uniformly distributed in their logarithm. The slope spectrum per
        // logarithmic interval is constant in the saturation range. It falls where viscosity and
        // surface tension damp waves, below about 5 cm.
        const float k = DetailImage::longest_ripple *
                        std::pow(static_cast<float>(DetailImage::shortest_ripple) / DetailImage::longest_ripple,
                                 (static_cast<float>(wave) + uniform(engine)) / 96);
        const float angle = (uniform(engine) + uniform(engine) + uniform(engine) - 1.5f) * 1.6f;
        const float kx = std::round(k * std::cos(angle)), kz = std::round(k * std::sin(angle));
        const float phase = uniform(engine), length = std::max(1.f, std::hypot(kx, kz));
        const glm::vec2 along = glm::vec2(kx, kz) / length * std::min(1.f, DetailImage::damped_ripple / length);
        for (int z = 0; z < detail_side; ++z)
            for (int x = 0; x < detail_side; ++x)
                slopes[static_cast<std::size_t>(z * detail_side + x)] +=
                    along *
                    std::cos(2 * pi_v<float> *
                             ((kx * static_cast<float>(x) + kz * static_cast<float>(z)) / detail_side + phase));
    }
    double square = 0;
    for (const glm::vec2& slope : slopes) square += 0.5 * glm::dot(slope, slope);
    const float scale = 0.25f / static_cast<float>(std::sqrt(square / static_cast<double>(slopes.size())));
    for (std::size_t i = 0; i < texels.size(); ++i) {
        texels[i].x = std::clamp(slopes[i].x * scale, -1.f, 1.f);
        texels[i].y = std::clamp(slopes[i].y * scale, -1.f, 1.f);
    }
}

/// Cellular noise: distances to the nearest and second nearest of cells^2 points, one in each cell,
/// in cells.
class Cells {
   public:
    Cells(int cells, std::minstd_rand& engine) : cells_(cells) {
        for (int i = 0; i < cells * cells; ++i) {
            const float x = uniform(engine);
            points_.emplace_back(x, uniform(engine));
        }
    }
    glm::vec2 nearest(float x, float z) const {
        const int cx = static_cast<int>(x), cz = static_cast<int>(z);
        glm::vec2 found(9);
        for (int dz = -1; dz <= 1; ++dz)
            for (int dx = -1; dx <= 1; ++dx) {
                const int px = (cx + dx + cells_) % cells_, pz = (cz + dz + cells_) % cells_;
                const glm::vec2 point = points_[static_cast<std::size_t>(pz * cells_ + px)];
                const float d =
                    std::hypot(static_cast<float>(cx + dx) + point.x - x, static_cast<float>(cz + dz) + point.y - z);
                if (d < found.x)
                    found = {d, found.x};
                else
                    found.y = std::min(found.y, d);
            }
        return found;
    }

   private:
    int cells_;
    std::vector<glm::vec2> points_;
};

void add_lace(std::vector<glm::vec4>& texels, std::minstd_rand& engine) {
    const std::array layers = {Cells(6, engine), Cells(13, engine), Cells(29, engine), Cells(61, engine)};
    const std::array counts = {6, 13, 29, 61};
    const std::array weights = {0.34f, 0.30f, 0.22f, 0.14f};
    std::vector<float> values(texels.size());
    for (int z = 0; z < detail_side; ++z)
        for (int x = 0; x < detail_side; ++x) {
            float lace = 0, bend_x = 0, bend_z = 0;
            for (std::size_t layer = 0; layer < layers.size(); ++layer) {
                // Each layer is distorted by the previous one, which turns polygons into threads.
                const float scale = static_cast<float>(counts[layer]) / detail_side;
                const float cells = static_cast<float>(counts[layer]);
                const float u = std::fmod((static_cast<float>(x) + bend_x + detail_side) * scale, cells);
                const float v = std::fmod((static_cast<float>(z) + bend_z + detail_side) * scale, cells);
                const glm::vec2 d = layers[layer].nearest(u, v);
                const float thread = 1 - std::min(1.f, (d.y - d.x) * 2.2f);
                lace += weights[layer] * (0.65f * thread + 0.35f * (1 - std::min(1.f, d.x)));
                bend_x = (d.x - 0.5f) * 9.f / static_cast<float>(layer + 1);
                bend_z = (d.y - 0.8f) * 9.f / static_cast<float>(layer + 1);
            }
            values[static_cast<std::size_t>(z * detail_side + x)] = lace;
        }
    // Ranks replace the values, so that exactly the fraction 1 - a of the plane exceeds a threshold
    // a.
    std::vector<std::uint32_t> order(values.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return values[a] < values[b]; });
    for (std::size_t rank = 0; rank < order.size(); ++rank)
        texels[order[rank]].z = static_cast<float>(rank) / static_cast<float>(order.size() - 1);
}

}  // namespace

const std::uint8_t* DetailImage::level(int level) const {
    std::size_t start = 0;
    for (int m = 0; m < level; ++m) start += static_cast<std::size_t>(side >> m) * (side >> m);
    return texels.data() + 4 * start;
}

DetailImage make_detail_image() {
    std::minstd_rand engine(7);
    std::vector<glm::vec4> texels(std::size_t{detail_side} * detail_side);
    add_ripples(texels, engine);
    add_lace(texels, engine);

    DetailImage image;
    double all = 0;
    for (int level = 0, size = detail_side; level < DetailImage::levels; ++level, size /= 2) {
        double square = 0;
        for (const glm::vec4& texel : texels) square += texel.x * texel.x + texel.y * texel.y;
        square /= static_cast<double>(texels.size());
        if (level == 0) all = square;
        for (const glm::vec4& texel : texels) {
            image.texels.push_back(byte_of(texel.x * 0.5f + 0.5f));
            image.texels.push_back(byte_of(texel.y * 0.5f + 0.5f));
            image.texels.push_back(byte_of(texel.z));
            image.texels.push_back(byte_of(static_cast<float>(square / all)));
        }
        std::vector<glm::vec4> coarser(texels.size() / 4);
        const auto width = static_cast<std::size_t>(size);
        for (std::size_t z = 0; z < width / 2; ++z)
            for (std::size_t x = 0; x < width / 2; ++x) {
                const glm::vec4* from = &texels[2 * z * width + 2 * x];
                coarser[z * (width / 2) + x] = 0.25f * (from[0] + from[1] + from[width] + from[width + 1]);
            }
        texels = std::move(coarser);
    }
    return image;
}

}  // namespace pelagic::gl
