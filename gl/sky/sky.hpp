// The options of a sky, and a baked sky.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "pelagic/gl/exposure.hpp"
#include "pelagic/gl/sky/cloud_shadows.hpp"
#include "pelagic/message/numeric_field.hpp"

namespace pelagic::gl {

struct SkyOptions {
    // generated from schema/sky.toml: members
    float sun_azimuth_rad = 0.6f;     ///< from +x towards +z; a finite number
    float sun_elevation_rad = 0.45f;  ///< above the horizon; [-pi/2, pi/2]
    float cloud_cover = 0.35f;        ///< fraction of the sky that clouds cover; [0, 1]
    float visibility_m = 40e3f;       ///< distance at which contrast falls to 2 %; [500, 300e3]
    std::uint32_t cloud_seed = 108;   ///< seed of the clouds
    bool places_moon = false;         ///< if false, the moon is full and opposite the sun
    float moon_azimuth_rad = 0;       ///< from +x towards +z; a finite number
    /// Above the horizon; the phase follows from the sun's position; [-pi/2, pi/2].
    float moon_elevation_rad = 0;
    // end of generated

    bool operator==(const SkyOptions&) const = default;
};

/// Returns the numeric options with their ranges, in the order of the struct.
std::span<const NumericField<SkyOptions>> sky_fields();

/// Returns an empty text if the options are valid, else a message about the first invalid field:
/// "cloud_cover 2 is out of range [0, 1]".
std::string check(const SkyOptions& options);

/// Returns the direction to the sun: a unit vector, +y up.
glm::vec3 sun_direction(const SkyOptions& options);
/// Returns the direction to the moon: a unit vector, +y up.
glm::vec3 moon_direction(const SkyOptions& options);

/// The light of a baked sky. Radiances are relative to `unit` times the sun's irradiance above the
/// atmosphere. The key light is the light source that has a disc and a glint: the sun, or the moon if
/// it is brighter at sea level.
struct SkyLight {
    SkyOptions options;
    /// Number of levels. Level m holds the sky reflected by a GGX mirror of roughness alpha = (m /
    /// (levels - 1))^2. Its faces have face_size >> m texels on a side.
    int levels = 0;
    glm::vec3 sun_direction{0, 1, 0};  ///< direction to the key light
    /// Irradiance of the key light at sea level on a plane perpendicular to its rays, after air and
    /// haze, and after the clouds where they let through most. Sky::cloud_shadows is relative to it.
    glm::vec3 sun_irradiance{0};
    /// Transmittance of the clouds there; 0 if the sky has no cloud_shadows.
    float brightest_transmittance = 0;
    float mean_sunlight = 1;  ///< mean of cloud_shadows
    bool key_is_moon = false;
    glm::vec3 sky_irradiance{0};  ///< on a horizontal plane, without the key light's disc
    glm::vec3 haze_per_m{0};      ///< extinction along the sea surface, 1/m
    float unit = 1;               ///< radiance of a stored value of 1: 1 by day, less at night
    float exposure = 1;           ///< suggested exposure of an image under this sky

    /// Returns the luminance of a stored radiance of 1, cd/m^2.
    float luminance_of_unit() const { return sun_illuminance_lx * unit; }
};

/// A baked sky.
struct Sky : SkyLight {
    int face_size = 0;
    /// RGBA half floats. A: in level 0 the clouds' transmittance for stars, sun and moon, else 1. Order:
    /// levels, then the faces +x, -x, +y, -y, +z, -z, then rows in GL's order.
    std::vector<std::uint16_t> texels;
    CloudShadows cloud_shadows;

    /// Returns the texels of one face of one level.
    std::span<const std::uint16_t> face(int level, int face) const;
};

/// Returns the number of levels. The roughest level has faces of 4 x 4 texels.
/// \param face_size  texels on a side, a power of two, at least 16
int sky_levels(int face_size);

}  // namespace pelagic::gl
