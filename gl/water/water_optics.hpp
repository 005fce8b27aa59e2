// What the water does to light: absorption and scattering, by Jerlov's types of sea water or by how much chlorophyll it holds.
//
// The channels red, green and blue stand for 612, 549 and 465 nm, the dominant wavelengths of the primaries of a screen (Rec. 709).
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <string_view>

namespace pelagic::gl {

/// Inherent optical properties of homogeneous water, 1/m each. Nearly all scattering leads on within some degrees, so a path through
/// the water is seen as if its light went straight on but for the part that is scattered backwards (Gordon 1973, "Simple calculation
/// of the diffuse reflectance of the ocean"): twice backscattering_per_m, the same in all directions, stands for it.
struct WaterOptics {
    glm::vec3 absorption_per_m{};
    glm::vec3 scattering_per_m{};      ///< in all directions
    glm::vec3 backscattering_per_m{};  ///< by more than 90 degrees; part of the above

    /// How fast light from above dwindles with depth, 1/m, along a way of a metre.
    glm::vec3 attenuation_per_m() const { return absorption_per_m + backscattering_per_m; }
};

/// Of a type of water: "I", "IA", "IB", "II", "III" (the ocean, from its clearest to the most turbid) or "1C", "3C", "5C", "7C", "9C"
/// (coasts). Their diffuse attenuation K: Jerlov 1976, "Marine Optics", table XXVII; of the ocean's, Austin and Petzold 1986, "Spectral
/// dependence of the diffuse attenuation coefficient of light in ocean waters". Scattering in the ocean follows the chlorophyll that
/// Morel 1988 ("Optical modeling of the upper ocean") gives for each type; at coasts, where mineral particles scatter, it is that
/// of Solonenko and Mobley 2015 ("Inherent optical properties of Jerlov water types") at 550 nm. Absorption is what then makes K, by Morel
/// and Maritorena 2001 ("Bio-optical properties of oceanic waters"): a = K 0.9 (1 - R) / (1 + 2.25 R), R = 0.33 bb / a.
/// Throws std::invalid_argument for another name.
WaterOptics water_optics(std::string_view jerlov_type);

/// Of most seas in middle latitudes.
inline constexpr std::string_view default_jerlov_type = "II";

/// The names, from the clearest to the most turbid.
std::span<const std::string_view> jerlov_types();

/// Of water whose colour comes from what lives in it (case 1), by its chlorophyll, mg/m^3 in [0.01, 30]: a = (a_w + 0.06 A C^0.65) (1 +
/// 0.2 exp(-0.014 (wavelength - 440 nm))) (Morel 1991, "Light and marine photosynthesis"), scattering as in Morel and Maritorena 2001.
/// Throws std::invalid_argument for a value out of range.
WaterOptics water_optics_of_chlorophyll(float mg_per_m3);

}  // namespace pelagic::gl
