// The clear sky at any hour: daylight, dusk, moonlight and airglow.
//
// By day and until sunset, the radiance is the scattered light of the atmosphere (atmosphere.hpp).
// After sunset, single scattering is inaccurate in the earth's shadow. The model then provides only
// colours and directions, and published measurements provide the amount of light:
//
//   * twilight: illuminance by the sun's elevation, Janiczek and DeYoung 1987, "Computer Programs
//     for Sun and Moon Illuminance", USNO Circular 171 (also Seidelmann 1992, eq. 9.341-1): 760 lx
//     at sunset, 3.4 at -6 degrees, 0.008 at -12, 0.00065 at -18;
//   * moon: 1/400 000 of the sun's light at full moon (14.0 magnitudes), reduced by its phase
//     (Krisciunas and Schaefer 1991, eq. 9), and scattered by the same atmosphere model;
//   * night sky: 2e-4 cd/m^2 (21.9 magnitudes per square arcsecond: airglow, zodiacal light, and
//     stars too faint to be seen; Leinert et al. 1998).
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "pelagic/gl/sky/atmosphere.hpp"
#include "pelagic/gl/sky/sky.hpp"

namespace pelagic::gl {

/// Directional light: sunlight or moonlight.
struct KeyLight {
    glm::vec3 direction{0, 1, 0};  ///< towards the light source
    glm::vec3 irradiance{0};       ///< on a plane perpendicular to the rays
    bool is_moon = false;
};

/// Returns the illuminance of a horizontal plane by the sun and the clear sky together, lux.
/// \param elevation_deg  the sun's elevation, degrees
double published_illuminance_lx(double elevation_deg);

/// Returns the ratio of the moon's light to that of the full moon.
/// \param phase_angle_rad  angle between sun and earth, seen from the moon; 0: full moon
double moon_light(double phase_angle_rad);

class ClearSky {
   public:
    explicit ClearSky(const SkyOptions& options);
    /// Lines of the atmosphere tables for the sun and for the moon. Without a moon, fill_line()
    /// does nothing for the second half.
    static constexpr int lines = 2 * Atmosphere::lines;
    /// Leaves the tables empty. Before any query, the caller calls fill_line() for every line, then
    /// finish().
    ClearSky(const SkyOptions& options, Atmosphere::FillLater);
    /// Computes one line of the tables. Threads may fill different lines concurrently.
    /// \param line  [0, lines)
    void fill_line(int line);
    /// Completes the tables and computes irradiance and unit. \pre all lines are filled
    void finish();

    /// Returns the scale of the radiances and irradiances below, relative to the sun's irradiance
    /// above the atmosphere. It is 1 by day and a power of two at night, so that half floats can
    /// represent the light.
    float unit() const { return unit_; }
    /// Returns the radiance of the clear sky. Below the horizon it is the radiance of the horizon.
    glm::vec3 radiance(glm::vec3 direction) const;
    /// Returns the irradiance of a horizontal plane by the sky, without the key light.
    glm::vec3 irradiance() const { return irradiance_ / unit_; }
    /// Returns the brighter of sunlight and moonlight at that height above the sea.
    KeyLight key_light(float height_m = 0) const;
    /// Returns the transmittance of a path that starts at sea level (Atmosphere::transmittance()).
    glm::vec3 transmittance(float sine_of_elevation, float distance_m) const {
        return sun_air_.transmittance(sine_of_elevation, distance_m);
    }

   private:
    float sun_elevation_rad_;
    Atmosphere sun_air_;  ///< the sun's elevation is limited to the range of the model
    std::optional<Atmosphere> moon_air_;
    glm::vec3 moon_irradiance_{0};  ///< above the atmosphere
    float twilight_scale_ = 1, unit_ = 1;
    bool sun_is_up_;
    glm::vec3 irradiance_{0};
};

}  // namespace pelagic::gl
