#include "pelagic/gl/sky/cloud_shadows.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "pelagic/gl/sky/clouds.hpp"

namespace pelagic::gl {
namespace {

constexpr auto map_m = static_cast<float>(CloudShadows::period_m);
constexpr float shadow_texel_m = map_m / CloudShadows::side;
constexpr float blend_m = map_m / 16;

/// Returns the weight of a place against the place a period away: 1/2 at a border, 1 inside.
float own_weight(float at_m) { return 0.5f + 0.5f * glm::smoothstep(0.f, blend_m, map_m / 2 - std::abs(at_m)); }

float place_of(int i) { return (static_cast<float>(i) + 0.5f) * shadow_texel_m - map_m / 2; }

}  // namespace

float CloudShadows::at(glm::dvec2 place_m) const {
    if (texels.empty()) return 1;
    const glm::dvec2 at = (place_m / period_m + 0.5) * double{side} - 0.5, cell = glm::floor(at);
    const glm::vec2 f(at - cell);
    const auto wrapped = [](double i) { return static_cast<std::size_t>(i - std::floor(i / side) * side); };
    const std::size_t x0 = wrapped(cell.x), x1 = wrapped(cell.x + 1);
    const auto line = [&](std::size_t row) {
        return glm::mix(static_cast<float>(texels[row * side + x0]), static_cast<float>(texels[row * side + x1]), f.x);
    };
    return glm::mix(line(wrapped(cell.y)), line(wrapped(cell.y + 1)), f.y) / 255;
}

void fill_shadow_row(const CloudLayer& clouds, glm::vec3 to_light, int row,
                     std::span<float, CloudShadows::side> transmittances) {
    const auto opposite = [](float at) { return at < 0 ? at + map_m : at - map_m; };
    const float z = place_of(row), z_weight = own_weight(z);
    const auto column = [&](float x) {
        const float own = clouds.transmittance({x, z}, to_light);
        return z_weight == 1 ? own : glm::mix(clouds.transmittance({x, opposite(z)}, to_light), own, z_weight);
    };
    for (int i = 0; i < CloudShadows::side; ++i) {
        const float x = place_of(i), x_weight = own_weight(x);
        const float own = column(x);
        transmittances[static_cast<std::size_t>(i)] =
            x_weight == 1 ? own : glm::mix(column(opposite(x)), own, x_weight);
    }
}

}  // namespace pelagic::gl
