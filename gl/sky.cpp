#include "pelagic/gl/sky.hpp"

#include <bit>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "pelagic/message/refusal.hpp"

namespace pelagic::gl {
namespace {

constexpr float pi = 3.14159265f;

bool in_range(float value, float least, float most) { return value >= least && value <= most; }

}  // namespace

std::string check(const SkyOptions& options) {
    if (!std::isfinite(options.sun_azimuth_rad))
        return refusal("sun_azimuth_rad", options.sun_azimuth_rad, "a finite number");
    if (!in_range(options.sun_elevation_rad, -pi / 2, pi / 2))
        return refusal("sun_elevation_rad", options.sun_elevation_rad, "[-pi/2, pi/2]");
    if (!in_range(options.cloud_cover, 0, 1)) return refusal("cloud_cover", options.cloud_cover, "[0, 1]");
    if (!in_range(options.visibility_m, 500, 300e3f))
        return refusal("visibility_m", options.visibility_m, "[500, 300e3]");
    return {};
}

glm::vec3 sun_direction(const SkyOptions& options) {
    const float across = std::cos(options.sun_elevation_rad);
    return {across * std::cos(options.sun_azimuth_rad), std::sin(options.sun_elevation_rad),
            across * std::sin(options.sun_azimuth_rad)};
}

int sky_levels(int face_size) { return std::bit_width(static_cast<unsigned>(face_size)) - 2; }

std::span<const std::uint16_t> Sky::face(int level, int face) const {
    std::size_t start = 0;
    for (int m = 0; m < level; ++m) start += std::size_t{6} * (face_size >> m) * (face_size >> m);
    const std::size_t texels_of_face = static_cast<std::size_t>(face_size >> level) * (face_size >> level);
    return std::span(texels).subspan(4 * (start + face * texels_of_face), 4 * texels_of_face);
}

}  // namespace pelagic::gl
