// The drops of rain (rain.hpp) on a dynamic-wave grid. Random numbers are functions of (seed, tick,
// cell of the world), as those of the cascades are functions of the wave numbers. So no state is
// stored, and equal drops fall wherever the grid is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/dynamic_waves/grid_placement.hpp"
#include "pelagic/sim/rain.hpp"

namespace pelagic {

/// Texels (0, 0) of the planes that a tick changes, in rows as in dynamic_wave_jobs.hpp.
struct HeightPlanes {
    float* now;
    float* before;  ///< Verlet's other height; null for the spectral step
    /// The heights from which frames interpolate. They receive impulses too, which so have no
    /// velocity.
    float* tick_before;
};

class RainDrops {
   public:
    /// Makes no rain.
    RainDrops() = default;
    /// \pre check(water) and check(rain, water) are empty
    RainDrops(const Rain& rain, const DynamicWavesOptions& water);

    /// Adds the drops of a tick to rows of the torus. Drops that the grid's edge would cut are left
    /// out, so that the volume of the water is constant.
    void push_rows(const GridPlacement& placement, std::int64_t tick, std::size_t first_row, std::size_t rows,
                   HeightPlanes heights) const;

    /// Returns the rain of the constructor; Rain{} if there is none.
    const Rain& rain() const { return rain_; }
    std::size_t bytes() const { return shapes_.capacity() * sizeof(Shape); }

   private:
    /// A drop's shape is a sum of products of factors along x and along z:
    /// (q - 1) e^-q = rim_x e_z + e_x rim_z, where e = e^-s^2, rim = (s^2 - 1/2) e^-s^2 and s is
    /// the distance from its centre over its radius.
    struct Shape {
        float e, rim;
    };
    struct Drop;

    template <class OfDrop>
    void for_drops(std::uint64_t state, std::int64_t cell_x, std::int64_t cell_z, OfDrop of_drop) const;
    const Shape* shape_at(std::size_t subtexel) const { return shapes_.data() + subtexel * width(); }
    std::size_t width() const { return static_cast<std::size_t>(2 * reach_ + 2); }

    Rain rain_;
    double none_ = 1;            ///< probability that a cell has no drop in a tick
    double mean_ = 0;            ///< mean number of drops of a cell and tick
    float height_ = 0;           ///< on the grid
    std::int64_t reach_ = 0;     ///< texels below a drop's texel; one more above it
    std::vector<Shape> shapes_;  ///< width() texels for each subtexel position of a drop's centre
};

}  // namespace pelagic
