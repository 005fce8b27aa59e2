// Position of a grid of texels that follows a point. Texel i of the world's grid has the position i
// texel_m and is kept in column i mod N of a torus. So texels that stay in a moving grid stay in
// memory where they are.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace pelagic {

/// Largest coordinate in the water: of a Disturbance, the world's origin and a current of some years.
inline constexpr double farthest_position_m = 1e9;

class GridPlacement {
   public:
    GridPlacement(int resolution, double texel_m) : resolution_(resolution), texel_m_(texel_m) {}

    /// Returns the first texels along x and z of the grid whose centre is nearest to a point.
    std::array<std::int64_t, 2> first_around(double x_m, double z_m) const {
        const auto first = [this](double middle_m) {
            return static_cast<std::int64_t>(std::floor(middle_m / texel_m_ + 0.5)) - resolution_ / 2;
        };
        return {first(x_m), first(z_m)};
    }
    void move_to(const std::array<std::int64_t, 2>& first) { first_ = first; }

    std::size_t in_torus(std::int64_t texel) const {
        return static_cast<std::size_t>(texel & (static_cast<std::int64_t>(resolution_) - 1));
    }

    int resolution() const { return resolution_; }
    double texel_m() const { return texel_m_; }
    const std::array<std::int64_t, 2>& first() const { return first_; }

   private:
    int resolution_;  ///< a power of two
    double texel_m_;
    std::array<std::int64_t, 2> first_{};
};

}  // namespace pelagic
