// Shading of the sea for preview images: linear RGB light in arbitrary units.
#pragma once

#include <glm/vec3.hpp>

namespace pelagic::tools {

/// Inputs of the shading at a point of the surface.
struct LitWater {
    glm::vec3 normal{0, 1, 0};  ///< unit vector
    glm::vec3 to_eye{0, 1, 0};  ///< unit vector
    float slope_variance = 0;   ///< variance of unresolved slopes along one axis
    float foam = 0;             ///< 0 none to 1 covered
    float height = 0;           ///< over the undisplaced surface / significant wave height
    float distance = 0;         ///< from the eye / distance at which haze halves the contrast
};

/// Returns the light of the sky without the sun's disc. Directions below the horizon have the
/// horizon's light.
/// \param direction  unit vector
glm::vec3 sky_light(const glm::vec3& direction, const glm::vec3& to_sun);

/// Returns the light from a point of the surface.
glm::vec3 water_light(const LitWater& water, const glm::vec3& to_sun);

/// Converts light to sRGB with tone mapping.
glm::u8vec3 screen_colour(const glm::vec3& light);

}  // namespace pelagic::tools
