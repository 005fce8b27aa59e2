// Sea floors for tests, in plain arithmetic so that they are bit-identical everywhere.
#pragma once

#include <algorithm>
#include <cmath>

#include "pelagic/sim/shore.hpp"

namespace pelagic {

template <class Height>
ShoreOptions shore_of(int columns, int rows, double metres_per_sample, Height height) {
    ShoreOptions shore{.columns = columns, .rows = rows, .metres_per_sample = metres_per_sample};
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            shore.heights_m.push_back(static_cast<float>(height(i * metres_per_sample, j * metres_per_sample)));
    return shore;
}

/// A flat floor at `depth_m`, then a slope up to 2 m above the sea at the far end of x.
inline ShoreOptions beach(double long_m, double wide_m, double depth_m, double flat_m, double metres_per_sample) {
    return shore_of(static_cast<int>(long_m / metres_per_sample) + 1,
                    static_cast<int>(wide_m / metres_per_sample) + 1, metres_per_sample, [=](double x, double) {
                        return x < flat_m ? -depth_m : -depth_m + (x - flat_m) / (long_m - flat_m) * (depth_m + 2);
                    });
}

/// A beach with an island in front of it, of the golden values.
inline ShoreOptions bay() {
    ShoreOptions shore = shore_of(81, 61, 5, [](double x, double z) {
        const double from_x = x - 150, from_z = z - 120, squared = (from_x * from_x + from_z * from_z) / 1600;
        return -12 + x * 0.035 + 16 / (1 + squared * squared);
    });
    shore.corner_x_m = -170;
    shore.corner_z_m = -130;
    shore.resolution = 64;
    return shore;
}

/// A round island with steep sides in water of one depth, at the centre of a square.
inline ShoreOptions island(double side_m, double radius_m, double depth_m, double metres_per_sample) {
    const int samples = static_cast<int>(side_m / metres_per_sample) + 1;
    return shore_of(samples, samples, metres_per_sample, [=](double x, double z) {
        const double from_x = x - side_m / 2, from_z = z - side_m / 2;
        const double to_edge = std::sqrt(from_x * from_x + from_z * from_z) - radius_m;
        return std::max(-depth_m, std::min(5.0, -20 * to_edge));
    });
}

}  // namespace pelagic
