// Axes and length units of files. Pelagic's axes are x east, y up, z south, in metres. Both
// conventions are right-handed.
#pragma once

#include <array>
#include <string_view>

#include "pelagic/message/enum_names.hpp"

namespace pelagic::tools {

enum class UpAxis {
    y,  ///< x east, y up, z south
    z,  ///< x east, y north, z up: (x, -z, y) in Pelagic's axes
};

enum class LengthUnit { metre, centimetre };

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

// Names in options and in records.
namespace pelagic {

template <>
struct EnumNames<tools::UpAxis> {
    static constexpr std::array<std::string_view, 2> all = {"y-up", "z-up"};
};

template <>
struct EnumNames<tools::LengthUnit> {
    static constexpr std::array<std::string_view, 2> all = {"m", "cm"};
};

}  // namespace pelagic
