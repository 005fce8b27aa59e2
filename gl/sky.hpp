// A sky: what is wanted, and what was baked.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "pelagic/gl/exposure.hpp"

namespace pelagic::gl {

struct SkyOptions {
    float sun_azimuth_rad = 0.6f;     ///< from +x towards +z; any
    float sun_elevation_rad = 0.45f;  ///< above the horizon; [-pi/2, pi/2]
    float cloud_cover = 0.35f;        ///< part of the sky that clouds take; [0, 1]
    float visibility_m = 40e3f;       ///< where contrast falls to 2 %; [500, 300e3]
    unsigned cloud_seed = 4;
};

/// Empty if usable, else the first bad field: "cloud_cover is 2, needs [0, 1]".
std::string check(const SkyOptions& options);

/// Towards the sun: a unit vector, +y up.
glm::vec3 sun_direction(const SkyOptions& options);

/// A baked sky. Radiances are relative to the sun's irradiance above the air, which is 1.
struct Sky {
    SkyOptions options;
    int face_size = 0;
    int levels = 0;  ///< level m holds a mirror of GGX roughness alpha = (m / (levels - 1))^2; face_size >> m texels
    /// Half floats, RGBA (A is 1): level by level, in each the faces +x, -x, +y, -y, +z, -z, rows as GL wants them.
    std::vector<std::uint16_t> texels;
    glm::vec3 sun_direction{0, 1, 0};
    glm::vec3 sun_irradiance{0};  ///< across its rays at the sea, through air, haze and the clouds before it
    glm::vec3 sky_irradiance{0};  ///< on a level plane, the sun's disc not counted
    glm::vec3 haze_per_m{0};      ///< extinction along the sea
    float unit = 1;               ///< the radiance that a value of 1 stands for: 1 by day, less at night
    float exposure = 1;           ///< makes a picture under this sky neither dark nor bright

    /// Of a radiance of 1, cd/m^2.
    float luminance_of_unit() const { return sun_illuminance_lx * unit; }
    std::span<const std::uint16_t> face(int level, int face) const;
};

/// Faces of at least 16 texels keep a level of 4, which is the roughest.
int sky_levels(int face_size);

}  // namespace pelagic::gl
