// A layer of cumulus above the sea, marched along a ray: noise for its shape, Beer-Lambert for its light.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "pelagic/gl/sky/clear_sky.hpp"

namespace pelagic::gl {

struct CloudOptions {
    float cover = 0.4f;       ///< part of the sky that clouds take, about; [0, 1]
    float base_m = 900;       ///< height of the flat bases: the usual one of fair-weather cumulus
    float thickness_m = 900;  ///< up to the highest tops
    unsigned seed = 1;
};

/// Noise that heaps clouds up, in a box that repeats: five octaves, kept as bytes so that a ray's samples hit the cache.
class CloudShape {
   public:
    static constexpr int side = 256, layers = 48;
    static constexpr float width_m = 4600, height_m = 900;

    CloudShape() : values_(std::size_t{side} * side * layers) {}
    /// One row of all layers; rows are independent.
    void fill_row(int row, unsigned seed);
    /// In [0, 1], trilinear; repeats along x and z.
    float at(glm::vec3 point_m) const;

   private:
    std::vector<std::uint8_t> values_;  ///< layer fastest: a ray climbs
};

/// What a ray from sea level meets.
struct CloudLight {
    glm::vec3 radiance{0};    ///< towards the eye, haze in front of it included
    float transmittance = 1;  ///< of the sky behind
};

class CloudLayer {
   public:
    /// In the units of `sky`.
    CloudLayer(const CloudOptions& options, const ClearSky& sky, const CloudShape& shape);

    /// \param direction  unit vector
    /// \pre `shape` is filled
    CloudLight along(glm::vec3 direction) const;
    /// Part of the light from above that comes through to the eye at sea level.
    float visibility(glm::vec3 direction) const { return direction.y > 0 ? along(direction).transmittance : 0; }

   private:
    float threshold(glm::vec3 at) const;
    float density(glm::vec3 at, float height_part, float threshold) const;
    float depth_towards_sun(glm::vec3 at, float height_part, float threshold) const;

    CloudOptions options_;
    const ClearSky& sky_;
    const CloudShape& shape_;
    KeyLight key_;         ///< at the tops: the sun reaches them longer than the sea
    glm::vec3 sky_light_;  ///< what they get from everywhere
};

}  // namespace pelagic::gl
