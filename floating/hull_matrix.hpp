// Vectors and matrices of the six modes of a hull, and the memory of its radiation.
#pragma once

#include <array>
#include <cstddef>

namespace pelagic {

/// Rows and columns: surge, heave, sway (translation along x, y, z of the hull), roll, yaw, pitch
/// (rotation about x, y, z through the centre of mass); kg, kg m and kg m^2.
using HullMatrix = std::array<std::array<double, 6>, 6>;

/// Velocities or forces in the order of HullMatrix.
using Vector6 = std::array<double, 6>;

/// Velocities that the resonators of given coefficients remember (radiation_states.hpp), in the hull's axes.
struct RadiationState {
    static constexpr std::size_t resonator_count = 8;
    std::array<Vector6, resonator_count> rate{};  ///< y_n driven by the motion
    std::array<Vector6, resonator_count> sum{};   ///< its integral, z_n

    /// Returns whether all values are equal.
    bool operator==(const RadiationState&) const = default;
};

}  // namespace pelagic
