#include "pelagic/gl/water/sea_floor.hpp"

#include <algorithm>
#include <bit>
#include <glm/gtc/packing.hpp>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/simd/bilinear.hpp"

namespace pelagic::gl {

double SeaFloor::height_at(double x_m, double z_m) const {
    return bilinear_sample(heights_m, columns, rows, (x_m - corner_m.x) / metres_per_texel,
                           (z_m - corner_m.y) / metres_per_texel);
}

std::string check(const SeaFloor& floor) {
    for (const float channel : {floor.albedo.x, floor.albedo.y, floor.albedo.z})
        if (!(channel >= 0 && channel <= 1)) return invalid_value_message("albedo", channel, "[0, 1]");
    if (floor.is_even() && floor.rows == 0) return {};
    const std::string sides = "2 to " + std::to_string(SeaFloor::max_samples_per_side) + ", or 0 for an even floor";
    if (floor.columns < 2 || floor.columns > SeaFloor::max_samples_per_side)
        return invalid_value_message("columns", floor.columns, sides);
    if (floor.rows < 2 || floor.rows > SeaFloor::max_samples_per_side)
        return invalid_value_message("rows", floor.rows, sides);
    if (!(floor.metres_per_texel >= 0.001 && floor.metres_per_texel <= 1e4))
        return invalid_value_message("metres_per_texel", floor.metres_per_texel, "[0.001, 10000]");
    if (floor.heights_m.size() != static_cast<std::size_t>(floor.columns) * floor.rows)
        return invalid_value_message("heights_m.size()", floor.heights_m.size(), "columns * rows");
    for (const float height : floor.heights_m)
        if (!(height >= -11000 && height <= 9000))
            return invalid_value_message("heights_m", height, "[-11000, 9000]");
    return {};
}

SeaFloor floor_of(const ShoreOptions& shore) {
    return {.columns = shore.columns,
            .rows = shore.rows,
            .heights_m = shore.heights_m,
            .corner_m = {shore.corner_x_m, shore.corner_z_m},
            .metres_per_texel = shore.metres_per_sample};
}

FloorTexels texels_of(const SeaFloor& floor) {
    FloorTexels texels;
    int columns = floor.columns, rows = floor.rows;
    texels.levels = std::bit_width(static_cast<unsigned>(std::max(columns, rows)));
    std::vector<float> heights = floor.heights_m;
    for (int level = 0;; ++level) {
        for (const float height : heights) texels.halves.push_back(glm::packHalf1x16(height));
        if (level + 1 == texels.levels) return texels;
        // GL's sizes of mip levels: half, rounded down, at least one.
        const int fewer_columns = std::max(columns / 2, 1), fewer_rows = std::max(rows / 2, 1);
        std::vector<float> coarser;
        for (int j = 0; j < fewer_rows; ++j)
            for (int i = 0; i < fewer_columns; ++i) {
                const auto at = [&](int column, int row) {
                    return heights[static_cast<std::size_t>(std::min(row, rows - 1)) * columns +
                                   std::min(column, columns - 1)];
                };
                coarser.push_back(0.25f * (at(2 * i, 2 * j) + at(2 * i + 1, 2 * j) + at(2 * i, 2 * j + 1) +
                                           at(2 * i + 1, 2 * j + 1)));
            }
        heights = std::move(coarser);
        columns = fewer_columns;
        rows = fewer_rows;
    }
}

}  // namespace pelagic::gl
