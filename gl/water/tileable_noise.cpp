#include "pelagic/gl/water/tileable_noise.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace pelagic::gl {
namespace {

/// \pre -period <= i < 2 period
int wrapped(int i, int period) { return i < 0 ? i + period : i >= period ? i - period : i; }

/// Wraps coordinates into [0, 1).
glm::vec2 wrapped(glm::vec2 at) { return at - glm::floor(at); }

}  // namespace

float uniform(std::minstd_rand& engine) { return static_cast<float>(engine()) * 0x1p-31f; }

CellNoise::CellNoise(int cells, float max_radius, std::minstd_rand& engine) : cells_(cells) {
    for (int i = 0; i < cells * cells; ++i) {
        const float x = uniform(engine), y = uniform(engine), size = uniform(engine);
        // Squaring makes large bubbles rare, as in froth, where small bubbles fill the gaps.
        bubbles_.push_back({{x, y}, max_radius * size * size});
    }
}

glm::vec2 CellNoise::nearest(glm::vec2 at) const {
    const glm::vec2 p = wrapped(at) * static_cast<float>(cells_);
    const int cx = static_cast<int>(p.x), cy = static_cast<int>(p.y);
    glm::vec2 found(9);
    for (int dy = -1; dy <= 1; ++dy) {
        const int row = wrapped(cy + dy, cells_) * cells_;
        for (int dx = -1; dx <= 1; ++dx) {
            const Bubble& bubble = bubbles_[static_cast<std::size_t>(row + wrapped(cx + dx, cells_))];
            const float x = static_cast<float>(cx + dx) + bubble.middle.x - p.x;
            const float y = static_cast<float>(cy + dy) + bubble.middle.y - p.y;
            const float distance = std::sqrt(x * x + y * y) - bubble.radius;
            if (distance < found.x)
                found = {distance, found.x};
            else
                found.y = std::min(found.y, distance);
        }
    }
    return found;
}

GradientNoise::GradientNoise(int cells_x, int cells_y, std::minstd_rand& engine)
    : cells_x_(cells_x), cells_y_(cells_y) {
    const float x = uniform(engine);
    moved_ = {x, uniform(engine)};
    for (int i = 0; i < cells_x * cells_y; ++i) {
        const float angle = 2 * std::numbers::pi_v<float> * uniform(engine);
        gradients_.emplace_back(std::cos(angle), std::sin(angle));
    }
}

float GradientNoise::at(glm::vec2 at) const {
    const glm::vec2 p = wrapped(at + moved_) * glm::vec2(cells_x_, cells_y_), floor = glm::floor(p), f = p - floor;
    const auto corner = [&](int dx, int dy) {
        const int x = wrapped(static_cast<int>(floor.x) + dx, cells_x_);
        const int y = wrapped(static_cast<int>(floor.y) + dy, cells_y_);
        return glm::dot(gradients_[static_cast<std::size_t>(y * cells_x_ + x)], f - glm::vec2(dx, dy));
    };
    const glm::vec2 w = f * f * f * (f * (f * 6.f - 15.f) + 10.f);
    // 1.414 normalises the maximum, which occurs where four gradients point at the centre of the
    // cell.
    return 1.414f *
           glm::mix(glm::mix(corner(0, 0), corner(1, 0), w.x), glm::mix(corner(0, 1), corner(1, 1), w.x), w.y);
}

}  // namespace pelagic::gl
