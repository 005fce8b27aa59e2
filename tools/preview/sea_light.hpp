// How bright the sea is in an image: linear light, RGB, in no unit but the image's own.
#pragma once

#include <glm/vec3.hpp>

namespace pelagic::tools {

/// A place of the surface as light meets it.
struct LitWater {
    glm::vec3 normal{0, 1, 0};  ///< unit
    glm::vec3 to_eye{0, 1, 0};  ///< unit
    float slope_variance = 0;   ///< of slopes along one axis that the normal does not show
    float foam = 0;             ///< 0 none to 1 covered
    float height = 0;           ///< above rest, in parts of the significant wave height
    float distance = 0;         ///< of the eye, in parts of where haze has taken half of the contrast
};

/// Of a unit direction, below the horizon as on it. The sun's disc is not in it.
glm::vec3 sky_light(const glm::vec3& direction, const glm::vec3& to_sun);

glm::vec3 water_light(const LitWater& water, const glm::vec3& to_sun);

/// As a screen wants it (sRGB), bright light rolled off.
glm::u8vec3 screen_colour(const glm::vec3& light);

}  // namespace pelagic::tools
