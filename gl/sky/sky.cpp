#include "pelagic/gl/sky/sky.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>

#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic::gl {
namespace {

constexpr auto half_pi = double{std::numbers::pi_v<float> / 2},
               max_float = double{std::numeric_limits<float>::max()};

using Field = NumericField<SkyOptions>;
constexpr std::array fields = {
    Field{"sun_azimuth_rad", &SkyOptions::sun_azimuth_rad, -max_float, max_float, "a finite number"},
    Field{"sun_elevation_rad", &SkyOptions::sun_elevation_rad, -half_pi, half_pi, "[-pi/2, pi/2]"},
    Field{"cloud_cover", &SkyOptions::cloud_cover, 0, 1, "[0, 1]"},
    Field{"visibility_m", &SkyOptions::visibility_m, 500, 300e3, "[500, 300e3]"},
    Field{"cloud_seed", &SkyOptions::cloud_seed, 0, 4294967295.0, "a whole number from 0 to 4294967295"},
    Field{"moon_azimuth_rad", &SkyOptions::moon_azimuth_rad, -max_float, max_float, "a finite number"},
    Field{"moon_elevation_rad", &SkyOptions::moon_elevation_rad, -half_pi, half_pi, "[-pi/2, pi/2]"},
};

glm::vec3 direction_at(float azimuth_rad, float elevation_rad) {
    const float across = std::cos(elevation_rad);
    return {across * std::cos(azimuth_rad), std::sin(elevation_rad), across * std::sin(azimuth_rad)};
}

}  // namespace

std::span<const NumericField<SkyOptions>> sky_fields() { return fields; }

std::string check(const SkyOptions& options) { return check_fields(options, fields); }

glm::vec3 sun_direction(const SkyOptions& options) {
    return direction_at(options.sun_azimuth_rad, options.sun_elevation_rad);
}

glm::vec3 moon_direction(const SkyOptions& options) {
    return options.places_moon ? direction_at(options.moon_azimuth_rad, options.moon_elevation_rad)
                               : -sun_direction(options);
}

int sky_levels(int face_size) { return std::bit_width(static_cast<unsigned>(face_size)) - 2; }

std::span<const std::uint16_t> Sky::face(int level, int face) const {
    std::size_t start = 0;
    for (int m = 0; m < level; ++m) start += std::size_t{6} * (face_size >> m) * (face_size >> m);
    const std::size_t texels_of_face = static_cast<std::size_t>(face_size >> level) * (face_size >> level);
    return std::span(texels).subspan(4 * (start + face * texels_of_face), 4 * texels_of_face);
}

}  // namespace pelagic::gl
