// Noise on a square that repeats, for textures that are made at start-up: cells around points, and smooth gradients. Places run
// from 0 to 1 along both sides. Numbers come from an engine's own bits: standard distributions differ between libraries.
#pragma once

#include <glm/vec2.hpp>
#include <random>
#include <vector>

namespace pelagic::gl {

/// Uniform in [0, 1).
float uniform(std::minstd_rand& engine);

/// Bubbles side by side: cells^2 of them, one in each square of a grid, of different sizes. The wall between two is where both
/// are as far away, less their radii, so walls bow around the smaller one as those of foam do (Worley 1996, "A Cellular Texture
/// Basis Function", with additive weights).
class CellNoise {
   public:
    /// \param cells  a side, 3 or more
    /// \param max_radius  of the largest bubble, in squares of the grid, below 1; 0: straight walls
    CellNoise(int cells, float max_radius, std::minstd_rand& engine);

    /// Distances to the nearest bubble's middle and to the next, less their radii, in squares of the grid.
    glm::vec2 nearest(glm::vec2 at) const;
    int cells() const { return cells_; }

   private:
    struct Bubble {
        glm::vec2 middle;  ///< in its square
        float radius;
    };
    int cells_;
    std::vector<Bubble> bubbles_;
};

/// Perlin's gradient noise (2002, "Improving Noise"), within [-1, 1], with a grid of its own along each side. It is 0 on the
/// grid, so each noise stands elsewhere, or their sums would show where all grids meet.
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
