// A layer of cumulus clouds above the sea, computed by ray marching: noise for the shape,
// Beer-Lambert for the light.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "pelagic/gl/sky/clear_sky.hpp"

namespace pelagic::gl {

struct CloudOptions {
    float cover = 0.4f;       ///< approximate fraction of the sky under clouds; [0, 1], 1: overcast
    float base_m = 900;       ///< height of the flat bases; typical of fair-weather cumulus
    float thickness_m = 900;  ///< from the bases to the highest tops
    unsigned seed = 1;
};

/// Periodic 3D noise that shapes the clouds: five octaves, stored as bytes for cache locality along
/// a ray.
class CloudShape {
   public:
    static constexpr int side = 256, layers = 48;
    static constexpr float width_m = 4600, height_m = 900;

    static constexpr int block_side = 4, block_layers = 8;
    static constexpr int blocks = side / block_side, layers_of_blocks = layers / block_layers;

    CloudShape()
        : values_(std::size_t{side} * side * layers), maxima_(std::size_t{blocks} * blocks * layers_of_blocks) {}
    /// Computes one row of all layers. Threads may fill different rows concurrently.
    /// \param row  [0, side)
    void fill_row(int row, unsigned seed);
    /// Computes the maxima of a row of blocks. Threads may measure different rows concurrently.
    /// \pre all rows are filled
    /// \param row  [0, blocks)
    void measure_blocks(int row);
    /// Returns the noise at a point with trilinear interpolation, [0, 1]. Periodic along x and z.
    /// Noise below `least` may be returned as 0.
    /// \pre all blocks are measured
    float at(glm::vec3 point_m, float least) const;

   private:
    static std::size_t column_at(int x, int z) {
        return (static_cast<std::size_t>(z) * side + static_cast<std::size_t>(x)) * layers;
    }
    static std::size_t block_at(int x, int z, int layer) {
        return (static_cast<std::size_t>(z) * blocks + static_cast<std::size_t>(x)) * layers_of_blocks +
               static_cast<std::size_t>(layer);
    }

    std::vector<std::uint8_t> values_;  ///< the layer is the fastest index, because rays ascend
    std::vector<std::uint8_t> maxima_;  ///< of each block and of the next values along each axis
};

/// Cloud light along a ray from sea level.
struct CloudLight {
    glm::vec3 radiance{0};    ///< towards the eye, including haze in front of the cloud
    float transmittance = 1;  ///< for the light of the sky behind the clouds
};

class CloudLayer {
   public:
    /// \param sky  must outlive this object; radiances are in its unit
    /// \param shape  must outlive this object; may be filled later
    CloudLayer(const CloudOptions& options, const ClearSky& sky, const CloudShape& shape);

    /// Computes the cloud light along a ray from sea level.
    /// \pre the CloudShape is filled and measured
    /// \param direction  unit vector
    CloudLight along(glm::vec3 direction) const;
    /// Returns the transmittance of the clouds along a ray from a place at sea level; 0 below the
    /// horizon.
    /// \pre the CloudShape is filled and measured
    /// \param place_m  x and z; along() looks from (0, 0)
    /// \param direction  unit vector
    float transmittance(glm::vec2 place_m, glm::vec3 direction) const;

   private:
    /// Part of a ray from sea level that is in the layer, and its samples.
    struct Crossing {
        float start = 0, step = 0;  ///< metres
        int samples = 0;            ///< 0: the ray meets no cloud
    };
    Crossing crossing(glm::vec3 direction) const;
    float threshold(glm::vec3 at) const;
    float density(glm::vec3 at, float relative_height, float threshold) const;
    float depth_towards_sun(glm::vec3 at, float relative_height, float threshold) const;

    CloudOptions options_;
    const ClearSky& sky_;
    const CloudShape& shape_;
    float closed_;         ///< 0: gaps between clouds are clear; 1: thin cloud fills them
    KeyLight key_;         ///< light at the cloud tops, where the sun sets later
    glm::vec3 sky_light_;  ///< mean radiance of the sky that lights the clouds
};

}  // namespace pelagic::gl
