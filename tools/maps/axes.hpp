// The axes and the unit that files have. Pelagic's own are x east, y up, z south, in metres; both kinds are right-handed.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace pelagic::tools {

enum class UpAxis {
    y,  ///< x east, y up, z south
    z,  ///< x east, y north, z up: (x, -z, y) of Pelagic's
};

/// As --axes and records have them.
inline constexpr std::array up_axis_names = {std::pair(UpAxis::y, std::string_view("y-up")),
                                             std::pair(UpAxis::z, std::string_view("z-up"))};

enum class LengthUnit { metre, centimetre };

/// As --unit and records have them.
inline constexpr std::array length_unit_names = {std::pair(LengthUnit::metre, std::string_view("m")),
                                                 std::pair(LengthUnit::centimetre, std::string_view("cm"))};

/// A vector of Pelagic's along the axes of a file. \tparam Vector  has [0], [1] and [2], as std::array and GLM's have
template <class Vector>
constexpr Vector in_axes(const Vector& vector, UpAxis up) {
    if (up == UpAxis::y) return vector;
    Vector turned = vector;
    turned[1] = -vector[2];
    turned[2] = vector[1];
    return turned;
}

/// How many of the unit a metre has.
constexpr float units_per_metre(LengthUnit unit) { return unit == LengthUnit::centimetre ? 100.f : 1.f; }

}  // namespace pelagic::tools
