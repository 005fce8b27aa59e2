// A layer of cumulus above the sea, marched along a ray: noise for its shape, Beer-Lambert for its light.
#pragma once

#include <glm/vec3.hpp>

#include "gl/atmosphere.hpp"

namespace pelagic::gl {

struct CloudOptions {
    float cover = 0.4f;        ///< part of the sky that clouds take, about; [0, 1]
    float base_m = 900;        ///< height of the flat bases: the usual one of fair-weather cumulus
    float thickness_m = 900;   ///< up to the highest tops
    unsigned seed = 1;
};

/// What a ray from sea level meets.
struct CloudLight {
    glm::vec3 radiance{0};    ///< towards the eye, haze in front of it included
    float transmittance = 1;  ///< of the sky behind
};

class CloudLayer {
   public:
    /// \param sky_irradiance  of the clear sky on a level plane, for the light that clouds get from everywhere
    CloudLayer(const CloudOptions& options, const Atmosphere& atmosphere, glm::vec3 sky_irradiance);

    /// \param direction  unit vector
    CloudLight along(glm::vec3 direction) const;
    /// Part of the sun's light that comes through to the eye at sea level.
    float sun_visibility() const;

   private:
    float density(glm::vec3 at, float height_part, bool with_detail) const;
    float depth_towards_sun(glm::vec3 at, float height_part) const;

    CloudOptions options_;
    const Atmosphere& atmosphere_;
    glm::vec3 sun_light_, sky_light_;
};

}  // namespace pelagic::gl
