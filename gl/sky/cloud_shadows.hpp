// Shadows of the clouds on the sea: a periodic map of the sunlight, or moonlight, that the clouds of
// a sky let through.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace pelagic::gl {

class CloudLayer;

/// A texel is 64 m wide. The penumbra of the sun is 8 m to 100 m wide there, and the edges of clouds
/// are about 100 m wide.
struct CloudShadows {
    static constexpr int side = 256;
    static constexpr double period_m = 16384;  ///< along x and z

    /// Rows along x, at increasing z. 255: the sunlight of the brightest place. Texel (i, j) lies at
    /// (i + 0.5, j + 0.5) period_m / side - period_m / 2. Empty: clouds cast no shadows.
    std::vector<std::uint8_t> texels;

    /// Returns the fraction of the brightest place's sunlight with bilinear interpolation, [0, 1].
    /// \param place_m  x and z at sea level, relative to the clouds (cloud_drift())
    float at(glm::dvec2 place_m) const;
};

/// Computes one row of a map: the transmittance of the clouds towards the light. Near its borders
/// the map is blended with its opposite border. Threads may fill different rows concurrently.
/// \param row  [0, CloudShadows::side)
/// \param to_light  unit vector
void fill_shadow_row(const CloudLayer& clouds, glm::vec3 to_light, int row,
                     std::span<float, CloudShadows::side> transmittances);

}  // namespace pelagic::gl
