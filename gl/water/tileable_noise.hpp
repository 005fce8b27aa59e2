// Periodic noise for textures that are generated at start-up: cellular noise and gradient noise.
// Coordinates run from 0 to 1 along both axes. Random numbers are computed from the engine's bits,
// because standard distributions differ between libraries.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec2.hpp>
#include <random>
#include <vector>

namespace pelagic::gl {

/// Returns a uniform number in [0, 1).
float uniform(std::minstd_rand& engine);

/// Returns a number of [0, 1] as a byte. Others are clamped.
inline std::uint8_t byte_of(float value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0.f, 1.f) * 255 + 0.5f);
}

/// Cellular noise: cells^2 adjacent bubbles of different sizes, one in each square of a grid. On
/// the wall between two bubbles the distances to both centres, each less the bubble's radius, are
/// equal. Walls therefore curve around the smaller bubble, as in foam (Worley 1996, "A Cellular
/// Texture Basis Function", with additive weights).
class CellNoise {
   public:
    /// \param cells  number of cells along each axis, at least 3
    /// \param max_radius  maximum bubble radius in grid squares, below 1; 0 gives straight walls
    CellNoise(int cells, float max_radius, std::minstd_rand& engine);

    /// Returns the two smallest values of distance to centre less radius, in grid squares.
    glm::vec2 nearest(glm::vec2 at) const;
    int cells() const { return cells_; }

   private:
    struct Bubble {
        glm::vec2 middle;  ///< centre within its square, [0, 1)
        float radius;
    };
    int cells_;
    std::vector<Bubble> bubbles_;
};

/// Gradient noise (Perlin 2002, "Improving Noise") in [-1, 1], with its own number of cells along
/// each axis. It is 0 at the grid points. Each instance has a random offset, so that a sum of
/// several does not show the points that their grids share.
class GradientNoise {
   public:
    GradientNoise(int cells_x, int cells_y, std::minstd_rand& engine);
    float at(glm::vec2 at) const;

   private:
    int cells_x_, cells_y_;
    glm::vec2 moved_;
    std::vector<glm::vec2> gradients_;
};

}  // namespace pelagic::gl
