// The clear sky of any hour: daylight, dusk, moonlight, and what is left without either.
//
// By day and until the sun has set it is the scattered light of the atmosphere (atmosphere.hpp). Below that its colours and
// directions stay the model's, whose single scattering loses its way in the earth's shadow, and its amount is what is published:
//
//   * twilight: illuminance by the sun's elevation, Janiczek and DeYoung 1987, "Computer Programs for Sun and Moon Illuminance",
//     USNO Circular 171 (also Seidelmann 1992, eq. 9.341-1): 760 lx at sunset, 3.4 at -6 degrees, 0.008 at -12, 0.00065 at -18;
//   * the moon: 1/400 000 of the sun's light when full (14.0 magnitudes), less by its phase (Krisciunas and Schaefer 1991, eq.
//     9), scattered by the same air;
//   * the night sky's own light, 2e-4 cd/m^2 (21.9 magnitudes a square second of arc: airglow, zodiacal light, stars too faint
//     to be seen; Leinert et al. 1998).
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "pelagic/gl/sky/atmosphere.hpp"
#include "pelagic/gl/sky/sky.hpp"

namespace pelagic::gl {

/// Light that comes from one direction: the sun's or the moon's.
struct KeyLight {
    glm::vec3 direction{0, 1, 0};  ///< towards it
    glm::vec3 irradiance{0};       ///< across its rays
    bool is_moon = false;
};

/// On a level plane under the sun at that elevation, clear sky and sun together, lux.
double published_illuminance_lx(double elevation_deg);

/// The moon's light over that of the full moon. \param phase_angle_rad  between sun and earth, seen from the moon; 0: full
double moon_light(double phase_angle_rad);

class ClearSky {
   public:
    explicit ClearSky(const SkyOptions& options);
    /// Lines of the tables of air under the sun and under the moon; without a moon the second half is none.
    static constexpr int lines = 2 * Atmosphere::lines;
    /// As Atmosphere's.
    ClearSky(const SkyOptions& options, Atmosphere::FillLater);
    void fill_line(int line);
    void finish();

    /// What a radiance or irradiance of 1 in the answers below stands for, where the sun's irradiance above the air is 1: 1 by
    /// day, a power of two by night, so that half floats hold its light.
    float unit() const { return unit_; }
    /// As Atmosphere::radiance().
    glm::vec3 radiance(glm::vec3 direction) const;
    /// On a level plane, without the key light.
    glm::vec3 irradiance() const { return irradiance_ / unit_; }
    /// The brighter one of sun and moon there.
    KeyLight key_light(float height_m = 0) const;
    glm::vec3 transmittance(float sine_of_elevation, float distance_m) const {
        return sun_air_.transmittance(sine_of_elevation, distance_m);
    }

   private:
    float sun_elevation_rad_;
    Atmosphere sun_air_;  ///< with the sun no lower than where the model still knows colours
    std::optional<Atmosphere> moon_air_;
    glm::vec3 moon_irradiance_{0};  ///< above the air
    float twilight_scale_ = 1, unit_ = 1;
    bool sun_is_up_;
    glm::vec3 irradiance_{0};
};

}  // namespace pelagic::gl
