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

constexpr auto half_pi = double{std::numbers::pi_v<float> / 2};

using Field = NumericField<SkyOptions>;
constexpr Field fields[] = {
    // generated from schema/sky.toml: table
    {"sun_azimuth_rad", &SkyOptions::sun_azimuth_rad, -std::numeric_limits<float>::max(), std::numeric_limits<float>::max(),
     "a finite number"},
    {"sun_elevation_rad", &SkyOptions::sun_elevation_rad, -half_pi, half_pi, "[-pi/2, pi/2]"},
    {"cloud_cover", &SkyOptions::cloud_cover, 0, 1, "[0, 1]"},
    {"visibility_m", &SkyOptions::visibility_m, 500, 300e3, "[500, 300e3]"},
    {"cloud_seed", &SkyOptions::cloud_seed, 0, 4294967295.0, "a whole number from 0 to 4294967295"},
    {"moon_azimuth_rad", &SkyOptions::moon_azimuth_rad, -std::numeric_limits<float>::max(), std::numeric_limits<float>::max(),
     "a finite number"},
    {"moon_elevation_rad", &SkyOptions::moon_elevation_rad, -half_pi, half_pi, "[-pi/2, pi/2]"},
    // end of generated
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
