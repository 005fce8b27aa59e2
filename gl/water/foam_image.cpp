#include "pelagic/gl/water/foam_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <utility>

#include "pelagic/gl/water/tileable_noise.hpp"

namespace pelagic::gl {
namespace {

constexpr int foam_side = FoamImage::side;

/// Texels of a layer: the value to rank, and two signed numbers. The fourth is unused.
using Texels = std::vector<glm::vec4>;

std::size_t at(int x, int y, int side = foam_side) {
    return static_cast<std::size_t>(y & (side - 1)) * static_cast<std::size_t>(side) +
           static_cast<std::size_t>(x & (side - 1));
}

/// Round caps of three sizes. Small bubbles fill the gaps between large ones.
class Bubbles {
   public:
    explicit Bubbles(std::minstd_rand& engine)
        : sizes_{CellNoise(19, 0.4f, engine), CellNoise(41, 0.3f, engine), CellNoise(67, 0.2f, engine)} {}

    glm::vec4 texel(glm::vec2 place) const {
        constexpr std::array heights = {1.f, 0.62f, 0.42f};
        float highest = 0;
        for (std::size_t size = 0; size < sizes_.size(); ++size) {
            const glm::vec2 d = sizes_[size].nearest(place);
            const float across = std::clamp(1 - (d.y - d.x) * 1.6f, 0.f, 1.f);  // 1 at a wall
            // The second term keeps tops of caps apart in the order of ranks.
            highest = std::max(highest, heights[size] * (std::sqrt(1 - across * across) + 0.1f * (d.y - d.x)));
        }
        return {highest, 0, 0, 0};
    }

   private:
    std::array<CellNoise, 3> sizes_;
};

/// A torn sheet. Holes of five sizes add up, and so do lumps of the same sizes, so that no size
/// prevails: the variance falls by half from each octave to the next finer one.
class Lace {
   public:
    explicit Lace(std::minstd_rand& engine)
        : holes_{CellNoise(5, 0.6f, engine), CellNoise(11, 0.55f, engine), CellNoise(23, 0.5f, engine),
                 CellNoise(47, 0.45f, engine), CellNoise(89, 0.4f, engine)},
          lumps_{GradientNoise(3, 3, engine), GradientNoise(7, 7, engine), GradientNoise(15, 15, engine),
                 GradientNoise(31, 31, engine), GradientNoise(67, 67, engine)},
          bend_{GradientNoise(4, 4, engine), GradientNoise(4, 4, engine), GradientNoise(13, 13, engine),
                GradientNoise(13, 13, engine), GradientNoise(37, 37, engine), GradientNoise(37, 37, engine)} {}

    glm::vec4 texel(glm::vec2 place) const {
        glm::vec2 bent = place;
        for (std::size_t i = 0; i < bend_.size(); i += 2)
            bent += (0.2f / static_cast<float>(bend_sizes[i / 2])) *
                    glm::vec2(bend_[i].at(place), bend_[i + 1].at(place));
        float sheet = 0, size = 1;
        for (std::size_t i = 0; i < holes_.size(); ++i) {
            sheet += size * (0.9f * holes_[i].nearest(bent).x + 0.55f * lumps_[i].at(bent));
            size *= 0.88f;
        }
        return {sheet, 0, 0, 0};
    }

   private:
    static constexpr std::array bend_sizes = {4, 13, 37};
    std::array<CellNoise, 5> holes_;
    std::array<GradientNoise, 5> lumps_;
    std::array<GradientNoise, 6> bend_;
};

/// Ridges along the wind that merge and split, with gaps.
class Streaks {
   public:
    explicit Streaks(std::minstd_rand& engine)
        : ridges_{GradientNoise(3, 7, engine), GradientNoise(5, 17, engine), GradientNoise(9, 37, engine),
                  GradientNoise(17, 73, engine)},
          bend_{GradientNoise(4, 5, engine), GradientNoise(13, 19, engine)},
          breaking_(9, 7, engine),
          warp_{GradientNoise(9, 5, engine), GradientNoise(9, 5, engine)},
          fine_warp_{GradientNoise(31, 13, engine), GradientNoise(31, 13, engine)} {}

    glm::vec4 texel(glm::vec2 place) const {
        constexpr std::array weights = {0.30f, 0.28f, 0.24f, 0.18f};
        const glm::vec2 bent = place + glm::vec2(0, 0.05f * bend_[0].at(place) + 0.012f * bend_[1].at(place));
        float ridge = 0.22f * breaking_.at(place);
        for (std::size_t size = 0; size < ridges_.size(); ++size)
            ridge += weights[size] * (1 - std::min(1.f, 3.f * std::abs(ridges_[size].at(bent))));
        const auto warp = [&](std::size_t axis) {
            return std::clamp(0.9f * warp_[axis].at(place) + 0.3f * fine_warp_[axis].at(place), -1.f, 1.f);
        };
        return {ridge, warp(0), warp(1), 0};
    }

   private:
    std::array<GradientNoise, 4> ridges_;
    std::array<GradientNoise, 2> bend_;
    GradientNoise breaking_;
    std::array<GradientNoise, 2> warp_, fine_warp_;
};

/// Computes slopes of the value to rank by central differences, scaled so that few exceed [-1, 1]
/// before clamping.
void add_slopes(Texels& texels) {
    double square = 0;
    for (int y = 0; y < foam_side; ++y)
        for (int x = 0; x < foam_side; ++x) {
            glm::vec4& texel = texels[at(x, y)];
            texel.y = texels[at(x + 1, y)].x - texels[at(x - 1, y)].x;
            texel.z = texels[at(x, y + 1)].x - texels[at(x, y - 1)].x;
            square += texel.y * texel.y + texel.z * texel.z;
        }
    const float scale = 0.3f / static_cast<float>(std::sqrt(0.5 * square / static_cast<double>(texels.size())));
    for (glm::vec4& texel : texels) {
        texel.y = glm::clamp(texel.y * scale, -1.f, 1.f);
        texel.z = glm::clamp(texel.z * scale, -1.f, 1.f);
    }
}

/// Replaces the values by their ranks in (0, 1). For any distribution of values, the fraction 1 - a
/// of the texels then exceeds a threshold a.
void rank(Texels& texels) {
    std::vector<std::pair<float, std::uint32_t>> order(texels.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = {texels[i].x, i};
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < order.size(); ++i)
        texels[order[i].second].x = (static_cast<float>(i) + 0.5f) / static_cast<float>(order.size());
}

/// Returns the value that a standard normal variable exceeds with probability 1 - rank, within
/// 0.007 (Winitzki 2008, "A handy approximation for the error function and its inverse").
float normal_score(float rank) {
    constexpr float a = 0.147f;
    const float log = std::log(4 * rank * (1 - rank)), t = 2 / (std::numbers::pi_v<float> * a) + 0.5f * log;
    return std::copysign(std::sqrt(2 * (std::sqrt(t * t - log / a) - t)), rank - 0.5f);
}

Texels halved(const Texels& texels, int side) {
    Texels coarser(texels.size() / 4);
    for (int y = 0; y < side / 2; ++y)
        for (int x = 0; x < side / 2; ++x)
            coarser[at(x, y, side / 2)] =
                0.25f * (texels[at(2 * x, 2 * y, side)] + texels[at(2 * x + 1, 2 * y, side)] +
                         texels[at(2 * x, 2 * y + 1, side)] + texels[at(2 * x + 1, 2 * y + 1, side)]);
    return coarser;
}

std::uint8_t signed_byte_of(float value) {
    return static_cast<std::uint8_t>(128 + std::lround(std::clamp(value, -1.f, 1.f) * 127));
}

/// Returns the offset of a layer in a level. Level `levels` and layer 0 give the total number of
/// bytes.
std::size_t start_of(int level, int layer) {
    std::size_t texels = 0;
    for (int m = 0; m < level; ++m) texels += std::size_t{FoamImage::layers} << 2 * (FoamImage::levels - 1 - m);
    for (int l = 0; l < layer; ++l) texels += std::size_t{1} << 2 * (FoamImage::levels - 1 - level);
    return 4 * texels;
}

/// Stages: `foam rows` computes values for rows of all layers; `foam levels` computes slopes, ranks
/// and mips, with one job per layer.
class FoamBake {
   public:
    FoamBake() {
        for (Texels& layer : layers_) layer.resize(std::size_t{foam_side} * foam_side);
        image_.texels.resize(start_of(FoamImage::levels, 0));
        const StageId rows = graph_.add({"foam rows",
                                         std::size_t{FoamImage::layers} * foam_side,
                                         16,
                                         {},
                                         [this](std::size_t begin, std::size_t end) {
                                             for (std::size_t row = begin; row < end; ++row)
                                                 fill_row(static_cast<int>(row) / foam_side,
                                                          static_cast<int>(row) % foam_side);
                                         }});
        graph_.add({"foam levels", FoamImage::layers, 1, {rows}, [this](std::size_t begin, std::size_t end) {
                        for (std::size_t layer = begin; layer < end; ++layer) make_levels(static_cast<int>(layer));
                    }});
    }

    FoamImage run(Executor& executor) {
        const std::unique_ptr<GraphRun> run = executor.prepare(graph_);
        run->schedule();
        run->complete();
        return std::move(image_);
    }

   private:
    void fill_row(int layer, int y) {
        for (int x = 0; x < foam_side; ++x) {
            const glm::vec2 place = (glm::vec2(x, y) + 0.5f) / static_cast<float>(foam_side);
            layers_[static_cast<std::size_t>(layer)][at(x, y)] = layer == FoamImage::bubbles ? bubbles_.texel(place)
                                                                 : layer == FoamImage::lace  ? lace_.texel(place)
                                                                                             : streaks_.texel(place);
        }
    }

    void make_levels(int layer) {
        Texels& texels = layers_[static_cast<std::size_t>(layer)];
        if (layer != FoamImage::streaks) add_slopes(texels);
        rank(texels);
        for (int level = 0; level < FoamImage::levels; ++level) {
            Texels shown = texels;
            // Averages concentrate around 0.5, where a threshold would cover all or nothing, so
            // they are ranked again.
            if (level > 0) rank(shown);
            std::uint8_t* to = &image_.texels[start_of(level, layer)];
            for (const glm::vec4& texel : shown) {
                *to++ = byte_of(texel.x);
                *to++ = signed_byte_of(texel.y);
                *to++ = signed_byte_of(texel.z);
                *to++ = signed_byte_of(normal_score(texel.x) / FoamImage::largest_score);
            }
            texels = halved(texels, foam_side >> level);
        }
    }

    std::minstd_rand engine_{11};
    Bubbles bubbles_{engine_};
    Lace lace_{engine_};
    Streaks streaks_{engine_};
    std::array<Texels, FoamImage::layers> layers_;
    FoamImage image_;
    JobGraph graph_;
};

}  // namespace

const std::uint8_t* FoamImage::level(int level) const { return &texels[start_of(level, 0)]; }

const std::uint8_t* FoamImage::texel(int level, Layer layer, int x, int y) const {
    return &texels[start_of(level, layer) + 4 * at(x, y, side >> level)];
}

FoamImage make_foam_image(Executor& executor) { return FoamBake().run(executor); }

}  // namespace pelagic::gl
