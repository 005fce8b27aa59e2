// The floor of a shore on the grid of what frames show of it.
#pragma once

#include <cstddef>
#include <vector>

#include "pelagic/sim/shore.hpp"

namespace pelagic {

struct SeaBed {
    /// Columns and rows are sampled bilinearly from the options' field. \pre check(options) is empty
    explicit SeaBed(const ShoreOptions& options);

    int columns, rows;  ///< multiples of 16
    double texel_m, x_m, z_m;
    std::vector<double> depth_m;  ///< of still water, by texel; below 0 on land
    /// How the depth grows along x and z, of the plane that fits it best, land counting as 0.
    double slope_x = 0, slope_z = 0;

    /// Water that is shallower is land to waves.
    static constexpr double min_depth_m = 0.02;

    std::size_t at(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i);
    }
    bool is_water(std::size_t texel) const { return depth_m[texel] > min_depth_m; }
    std::size_t texels() const { return depth_m.size(); }
};

}  // namespace pelagic
