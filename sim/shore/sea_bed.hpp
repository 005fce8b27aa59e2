// Floor of a shore, resampled to the grid of ShoreSurface.
#pragma once

#include <cstddef>
#include <vector>

#include "pelagic/sim/shore.hpp"

namespace pelagic {

struct SeaBed {
    /// Samples the heights of the options bilinearly. \pre check(options) is empty
    explicit SeaBed(const ShoreOptions& options);

    int columns, rows;  ///< multiples of 16
    double texel_m, x_m, z_m;
    std::vector<double> depth_m;  ///< depth of still water by texel; below 0 on land
    /// Slope of the depth along x and z, of the least-squares plane; land counts as depth 0.
    double slope_x = 0, slope_z = 0;

    /// Shallower water counts as land.
    static constexpr double min_depth_m = 0.02;

    std::size_t at(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(i);
    }
    bool is_water(std::size_t texel) const { return depth_m[texel] > min_depth_m; }
    std::size_t texels() const { return depth_m.size(); }
};

}  // namespace pelagic
