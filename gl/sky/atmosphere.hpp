// The clear sky seen from sea level: single scattering of sunlight by air (Rayleigh) and by haze
// (Mie), and a simple estimate of multiple scattering. Without that estimate the horizon would be
// brown.
//
// Coefficients and scale heights: Bruneton and Neyret 2008, "Precomputed Atmospheric Scattering",
// table 1 and section 2.1 (after Riley et al. 2004). Ozone, which makes the sky blue at dusk:
// Hillaire 2020, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", table 1.
// The sun's irradiance above the atmosphere is 1 in every channel, so sunlight there is white.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace pelagic::gl {

inline constexpr float earth_radius_m = 6.36e6f;
inline constexpr float atmosphere_top_m = 60e3f;
/// Scattering coefficient of air at sea level for 680, 550 and 440 nm, 1/m, and its scale height,
/// over which it falls to 1/e.
inline constexpr glm::vec3 rayleigh_per_m{5.8e-6f, 13.5e-6f, 33.1e-6f};
inline constexpr float rayleigh_height_m = 8000;
inline constexpr float mie_height_m = 1200;
inline constexpr float mie_albedo = 0.9f;      ///< ratio of scattering to extinction
inline constexpr float mie_asymmetry = 0.76f;  ///< g of mie_phase()

/// Absorption by ozone at a height of 25 km, 1/m. It falls linearly to 0 over 15 km above and below
/// that height. The red value is the mean over a display's red, 580 to 640 nm, where ozone absorbs
/// most (Gorshelev et al. 2014: 1.35 times the value at 550 nm). With the value at 680 nm, 0.65e-6,
/// dusk would be purple.
inline constexpr glm::vec3 ozone_per_m{2.5e-6f, 1.881e-6f, 0.085e-6f};
inline constexpr float ozone_height_m = 25e3f, ozone_reach_m = 15e3f;

/// Returns the extinction by haze at sea level, 1/m, at least 2e-6. It is the extinction for the
/// visibility (Koschmieder 1924) minus the scattering by air at 550 nm.
/// \param visibility_m  distance at which contrast falls to 2 %, m
float haze_per_m(float visibility_m);

/// Phase function of haze, normalised over the sphere: Cornette and Shanks 1992.
/// \param cosine  cosine of the scattering angle
float mie_phase(float cosine, float asymmetry);
/// Rayleigh phase function, normalised over the sphere.
/// \param cosine  cosine of the scattering angle
float rayleigh_phase(float cosine);

/// The clear sky for one light source. Directions are unit vectors, +y up. Radiance is relative to
/// the sun's irradiance above the atmosphere.
class Atmosphere {
   public:
    static constexpr int lines = 96;  ///< lines of the scattering table, one for each elevation

    /// Computes the whole table.
    /// \param sun  direction to the sun, which may be below the horizon
    Atmosphere(glm::vec3 sun, float visibility_m);
    struct FillLater {};
    /// Leaves the table empty. Before any query, the caller calls fill_line() for every line, then
    /// finish().
    Atmosphere(glm::vec3 sun, float visibility_m, FillLater);
    /// Computes one line of the table. Threads may fill different lines concurrently.
    /// \param line  [0, lines)
    void fill_line(int line);
    /// Adds multiple scattering. \pre all lines are filled
    void finish();

    /// Returns the radiance of the clear sky. Below the horizon it is the radiance of the horizon.
    glm::vec3 radiance(glm::vec3 direction) const;
    /// Returns the fraction of the sun's light that arrives at `height_m` above the sea.
    glm::vec3 sun_transmittance(float height_m = 0) const;
    /// Returns the transmittance of a path that starts at sea level. Ozone is ignored.
    /// \param distance_m  length of the path, m
    glm::vec3 transmittance(float sine_of_elevation, float distance_m) const;
    glm::vec3 sun() const { return sun_; }

   private:
    glm::vec3 optical_depth(float height_m, float cosine) const;

    // Single scattering by air and by haze is stored separately and without the phase functions,
    // which would need a finer table.
    struct Scattered {
        glm::vec3 rayleigh{}, mie{};
        glm::vec3 multiple{};  ///< radiance of multiply scattered light
    };
    glm::vec3 sun_;
    float haze_per_m_;
    /// Indexed by the square root of the elevation's sine, then by the azimuth from the sun.
    std::vector<Scattered> table_;
};

}  // namespace pelagic::gl
