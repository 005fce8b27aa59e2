// The drops of rain (rain.hpp) that fall on a grid of water. They are drawn by (seed, tick, cell of the world), as the waves of the
// wind are by their numbers: there is nothing to remember, and wherever the grid is, the same drops fall.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/dynamic_waves/grid_placement.hpp"
#include "pelagic/sim/rain.hpp"

namespace pelagic {

/// Texels (0, 0) of the planes of a grid that a tick moves, in rows as dynamic_wave_jobs.hpp has them.
struct HeightPlanes {
    float* now;
    float* before;       ///< Verlet's other height; null where there is none
    float* tick_before;  ///< as frames show it: what is there at once was there before the tick, too
};

class RainDrops {
   public:
    /// None.
    RainDrops() = default;
    /// \pre check(water) and check(rain, water) are empty
    RainDrops(const Rain& rain, const DynamicWavesOptions& water);

    /// Adds the drops of the tick to rows of the torus. One that the grid's edge would cut does not fall: no water comes in, and none
    /// goes.
    void push_rows(const GridPlacement& placement, std::int64_t tick, std::size_t first_row, std::size_t rows,
                   HeightPlanes heights) const;

    /// What it was made of; all as in Rain{} where it is none.
    const Rain& rain() const { return rain_; }
    std::size_t bytes() const { return shapes_.capacity() * sizeof(Shape); }

   private:
    /// A drop's shape is the product of one along x and one along z: (q - 1) e^-q = rim_x e_z + e_x rim_z, where
    /// e = e^-s^2, rim = (s^2 - 1/2) e^-s^2 and s is the way from its middle over its radius.
    struct Shape {
        float e, rim;
    };
    struct Drop;

    template <class OfDrop>
    void for_drops(std::uint64_t state, std::int64_t cell_x, std::int64_t cell_z, OfDrop of_drop) const;
    const Shape* shape_at(std::size_t part) const { return shapes_.data() + part * width(); }
    std::size_t width() const { return static_cast<std::size_t>(2 * reach_ + 2); }

    Rain rain_;
    double none_ = 1;            ///< how likely a cell has no drop in a tick
    double mean_ = 0;            ///< drops of a cell and tick
    float height_ = 0;           ///< as it is drawn
    std::int64_t reach_ = 0;     ///< texels to either side of a drop's own, and one more above
    std::vector<Shape> shapes_;  ///< for each part of a texel where a drop's middle may be, width() texels
};

}  // namespace pelagic
