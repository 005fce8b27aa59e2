// Axes and length units of files. Pelagic's axes are x east, y up, z south, in metres. Both
// conventions are right-handed.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace pelagic::tools {

enum class UpAxis {
    y,  ///< x east, y up, z south
    z,  ///< x east, y north, z up: (x, -z, y) in Pelagic's axes
};

/// Names in --axes and in records.
inline constexpr std::array up_axis_names = {std::pair(UpAxis::y, std::string_view("y-up")),
                                             std::pair(UpAxis::z, std::string_view("z-up"))};

enum class LengthUnit { metre, centimetre };

/// Names in --unit and in records.
inline constexpr std::array length_unit_names = {std::pair(LengthUnit::metre, std::string_view("m")),
                                                 std::pair(LengthUnit::centimetre, std::string_view("cm"))};

/// Converts a vector from Pelagic's axes to a file's.
/// \tparam Vector  a type with [0], [1] and [2], such as std::array and GLM's vectors
template <class Vector>
constexpr Vector in_axes(const Vector& vector, UpAxis up) {
    if (up == UpAxis::y) return vector;
    Vector rotated = vector;
    rotated[1] = -vector[2];
    rotated[2] = vector[1];
    return rotated;
}

/// Returns the number of units in a metre.
constexpr float units_per_metre(LengthUnit unit) { return unit == LengthUnit::centimetre ? 100.f : 1.f; }

}  // namespace pelagic::tools
