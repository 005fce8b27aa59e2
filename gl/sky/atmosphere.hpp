// The clear sky: sunlight scattered once by air (Rayleigh) and by haze (Mie), seen from sea level, and a plain estimate
// of what is scattered again, without which the horizon would be brown.
//
// Coefficients and scale heights: Bruneton and Neyret 2008, "Precomputed Atmospheric Scattering", table 1 and section 2.1
// (after Riley et al. 2004). Ozone, which makes the sky of dusk blue: Hillaire 2020, "A Scalable and Production Ready Sky and
// Atmosphere Rendering Technique", table 1. The sun's irradiance above the air is 1 in every channel: the image's white.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace pelagic::gl {

inline constexpr float earth_radius_m = 6.36e6f;
inline constexpr float atmosphere_top_m = 60e3f;
/// Scattering by air at sea level for 680, 550 and 440 nm, 1/m, and the height in which it falls to 1/e.
inline constexpr glm::vec3 rayleigh_per_m{5.8e-6f, 13.5e-6f, 33.1e-6f};
inline constexpr float rayleigh_height_m = 8000;
inline constexpr float mie_height_m = 1200;
inline constexpr float mie_albedo = 0.9f;      ///< scattering over extinction
inline constexpr float mie_asymmetry = 0.76f;  ///< g

/// Absorption by ozone 25 km high; none is 15 km above or below. Red is not that of 680 nm, 0.65e-6, but the mean of what a screen's
/// red stands for, 580 to 640 nm, where ozone absorbs most (Gorshelev et al. 2014: 1.35 times as much as at 550 nm): dusk would be
/// purple.
inline constexpr glm::vec3 ozone_per_m{2.5e-6f, 1.881e-6f, 0.085e-6f};
inline constexpr float ozone_height_m = 25e3f, ozone_reach_m = 15e3f;

/// Extinction by haze at sea level, 1/m, for a visibility: the distance at which contrast falls to 2 % (Koschmieder
/// 1924), less what air itself takes at 550 nm.
float haze_per_m(float visibility_m);

/// Cornette and Shanks 1992, normalised over the sphere.
float mie_phase(float cosine, float asymmetry);
float rayleigh_phase(float cosine);

/// The sky for one sun. Directions are unit vectors, +y up; radiance is relative to the sun's irradiance.
class Atmosphere {
   public:
    static constexpr int lines = 96;  ///< of its table, one an elevation

    /// \param sun  towards the sun; it may stand below the horizon
    Atmosphere(glm::vec3 sun, float visibility_m);
    struct FillLater {};
    /// Its table is to be filled by fill_line(), whose lines are independent, and then finish(), before anything is asked.
    Atmosphere(glm::vec3 sun, float visibility_m, FillLater);
    void fill_line(int line);
    void finish();

    /// Radiance of the clear sky; below the horizon that of the horizon.
    glm::vec3 radiance(glm::vec3 direction) const;
    /// Part of the sun's light that arrives at `height_m` above the sea.
    glm::vec3 sun_transmittance(float height_m = 0) const;
    /// Part of light that is left after a path from sea level, `distance_m` towards an elevation.
    glm::vec3 transmittance(float sine_of_elevation, float distance_m) const;
    glm::vec3 sun() const { return sun_; }

   private:
    glm::vec3 optical_depth(float height_m, float cosine) const;

    // Light scattered by air and by haze apart, without the phase functions, which would need a finer table.
    struct Scattered {
        glm::vec3 rayleigh{}, mie{};
        glm::vec3 again{};  ///< radiance of light scattered more than once
    };
    glm::vec3 sun_;
    float haze_per_m_;
    std::vector<Scattered> table_;  ///< by the root of the elevation's sine and the azimuth from the sun
};

}  // namespace pelagic::gl
