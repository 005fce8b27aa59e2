// Optical properties of water: absorption and scattering, from Jerlov's water types or from the
// concentration of chlorophyll.
//
// The channels red, green and blue represent 612, 549 and 465 nm, the dominant wavelengths of the
// Rec. 709 display primaries.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>

namespace pelagic::gl {

/// Inherent optical properties of homogeneous water, 1/m each.
///
/// Nearly all scattering deflects light by a few degrees only. Light along a path is therefore
/// treated as unscattered, except for the backscattered fraction (Gordon 1973, "Simple calculation
/// of the diffuse reflectance of the ocean"). An isotropic scattering coefficient of twice
/// backscattering_per_m represents that fraction.
struct WaterOptics {
    glm::vec3 absorption_per_m{};
    glm::vec3 scattering_per_m{};      ///< scattering in all directions
    glm::vec3 backscattering_per_m{};  ///< part of scattering_per_m beyond 90 degrees

    /// Returns the attenuation of light from above per metre of path, 1/m.
    glm::vec3 attenuation_per_m() const { return absorption_per_m + backscattering_per_m; }
};

/// Returns the optical properties of a Jerlov water type.
///
/// Sources:
/// * Diffuse attenuation K: Jerlov 1976, "Marine Optics", table XXVII, for coasts; Austin and
///   Petzold 1986, "Spectral dependence of the diffuse attenuation coefficient of light in ocean
///   waters", for the ocean.
/// * Scattering in the ocean: from the chlorophyll that Morel 1988 ("Optical modeling of the upper
///   ocean") gives for each type.
/// * Scattering at coasts, where mineral particles scatter: Solonenko and Mobley 2015 ("Inherent
///   optical properties of Jerlov water types") at 550 nm.
/// * Absorption, solved to give K: Morel and Maritorena 2001 ("Bio-optical properties of oceanic
///   waters"), a = K 0.9 (1 - R) / (1 + 2.25 R), R = 0.33 bb / a.
/// \param jerlov_type  "I", "IA", "IB", "II", "III" (ocean, from the clearest to the most turbid)
///     or "1C", "3C", "5C", "7C", "9C" (coast)
/// \throws std::invalid_argument  for another name
WaterOptics water_optics(std::string_view jerlov_type);

/// Jerlov type of most seas in middle latitudes.
inline constexpr std::string_view default_jerlov_type = "II";

/// Returns the names, from the clearest to the most turbid.
std::span<const std::string_view> jerlov_types();

/// Returns the optical properties of case 1 water, whose colour depends on phytoplankton.
///
/// Absorption: a = (a_w + 0.06 A C^0.65) (1 + 0.2 exp(-0.014 (wavelength - 440 nm)))
/// (Morel 1991, "Light and marine photosynthesis"). Scattering follows Morel and Maritorena 2001.
/// \param mg_per_m3  chlorophyll concentration C, [0.01, 30]
/// \throws std::invalid_argument  if mg_per_m3 is out of range
WaterOptics water_optics_of_chlorophyll(float mg_per_m3);

}  // namespace pelagic::gl
