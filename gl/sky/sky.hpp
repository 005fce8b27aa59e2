// A sky: what is wanted, and what was baked.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "pelagic/gl/exposure.hpp"
#include "pelagic/message/numeric_field.hpp"

namespace pelagic::gl {

struct SkyOptions {
    float sun_azimuth_rad = 0.6f;     ///< from +x towards +z; any
    float sun_elevation_rad = 0.45f;  ///< above the horizon; [-pi/2, pi/2]
    float cloud_cover = 0.35f;        ///< part of the sky that clouds take; [0, 1]
    float visibility_m = 40e3f;       ///< where contrast falls to 2 %; [500, 300e3]
    unsigned cloud_seed = 4;
    bool places_moon = false;      ///< else it stands opposite the sun: full, and up when the sun is down
    float moon_azimuth_rad = 0;    ///< any
    float moon_elevation_rad = 0;  ///< [-pi/2, pi/2]; its phase follows from where the sun is

    bool operator==(const SkyOptions&) const = default;
};

/// The numeric options with ranges, in the order of the struct.
std::span<const NumericField<SkyOptions>> sky_fields();

/// Empty if usable, else the first bad field: "cloud_cover is 2, needs [0, 1]".
std::string check(const SkyOptions& options);

/// Towards the sun: a unit vector, +y up.
glm::vec3 sun_direction(const SkyOptions& options);
glm::vec3 moon_direction(const SkyOptions& options);

/// A baked sky. Radiances are relative to the sun's irradiance above the air, which is 1, and at night to a part of it, `unit`. The
/// key light is what has a disc and a glint: the sun, or the moon where that is the brighter one at the sea.
struct Sky {
    SkyOptions options;
    int face_size = 0;
    int levels = 0;  ///< level m holds a mirror of GGX roughness alpha = (m / (levels - 1))^2; face_size >> m texels
    /// Half floats, RGBA (A: in level 0 how much of the stars' light clouds let through, else 1): level by level, in each the faces +x, -x, +y, -y, +z, -z, rows as GL wants them.
    std::vector<std::uint16_t> texels;
    glm::vec3 sun_direction{0, 1, 0};  ///< towards the key light
    glm::vec3 sun_irradiance{
        0};  ///< the key light's, across its rays at the sea, through air, haze and the clouds before it
    bool key_is_moon = false;
    glm::vec3 sky_irradiance{0};  ///< on a level plane, the key light's disc not counted
    glm::vec3 haze_per_m{0};      ///< extinction along the sea
    float unit = 1;               ///< the radiance that a value of 1 stands for: 1 by day, less at night
    float exposure = 1;           ///< makes an image under this sky neither dark nor bright

    /// Of a radiance of 1, cd/m^2.
    float luminance_of_unit() const { return sun_illuminance_lx * unit; }
    std::span<const std::uint16_t> face(int level, int face) const;
};

/// Faces of at least 16 texels keep a level of 4, which is the roughest.
int sky_levels(int face_size);

}  // namespace pelagic::gl
