#include "pelagic/sim/shore/sea_bed.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/simd/bilinear.hpp"

namespace pelagic {
namespace {

constexpr int size_multiple = 16;  // columns and rows are multiples of it

int rounded_up(double texels) {
    return std::max(1, static_cast<int>(std::ceil(texels / size_multiple))) * size_multiple;
}

}  // namespace

SeaBed::SeaBed(const ShoreOptions& options) : x_m(options.corner_x_m), z_m(options.corner_z_m) {
    const double wide_m = (options.columns - 1) * options.metres_per_sample;
    const double deep_m = (options.rows - 1) * options.metres_per_sample;
    texel_m = std::max(wide_m, deep_m) / (options.resolution - 1);
    columns = wide_m >= deep_m ? options.resolution : rounded_up(wide_m / texel_m + 1);
    rows = deep_m >= wide_m ? options.resolution : rounded_up(deep_m / texel_m + 1);
    const double samples_per_texel = texel_m / options.metres_per_sample;
    depth_m.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            depth_m[at(i, j)] = 0 - bilinear_sample(options.heights_m, options.columns, options.rows,
                                                    i * samples_per_texel, j * samples_per_texel);

    // On a full grid, the least-squares slopes along x and z are independent.
    double along_x = 0, along_z = 0, squares_x = 0, squares_z = 0;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const double x = (i - 0.5 * (columns - 1)) * texel_m, z = (j - 0.5 * (rows - 1)) * texel_m;
            const double water_m = std::max(depth_m[at(i, j)], 0.0);
            along_x += x * water_m, along_z += z * water_m;
            squares_x += x * x, squares_z += z * z;
        }
    slope_x = along_x / squares_x;
    slope_z = along_z / squares_z;
}

}  // namespace pelagic
