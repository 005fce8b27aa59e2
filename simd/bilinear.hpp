// Bilinear samples of a field of floats.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace pelagic {

/// Returns the value at a position in units of samples, clamped to the edges of the field.
/// \param values  columns * rows; sample (i, j) is values[j * columns + i]
/// \pre columns and rows are at least 2
inline double bilinear_sample(std::span<const float> values, int columns, int rows, double column, double row) {
    const double u = std::clamp(column, 0.0, static_cast<double>(columns - 1));
    const double v = std::clamp(row, 0.0, static_cast<double>(rows - 1));
    const int i = std::min(static_cast<int>(u), columns - 2), j = std::min(static_cast<int>(v), rows - 2);
    const float* const above = values.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) + i;
    const float* const below = above + columns;
    const auto along_row = [&](const float* pair) {
        return static_cast<double>(pair[0]) + (u - i) * (static_cast<double>(pair[1]) - static_cast<double>(pair[0]));
    };
    const double first = along_row(above);
    return first + (v - j) * (along_row(below) - first);
}

}  // namespace pelagic
