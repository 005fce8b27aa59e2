// Normals, Jacobians, bytes and mipmaps in double, from three displacement planes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pelagic/sim/frame.hpp"

namespace pelagic::oracle {

using Plane = std::vector<double>;  ///< element (i, j) at j N + i

/// The planes of a frame of the library, converted to double.
struct Displacement {
    int n;
    Plane dx, height, dz;
};
Displacement displacement_of(const Frame& frame);

/// One level of the mip chain: averages of the scaled normal (its length encodes roughness) and of
/// the clamped Jacobian.
struct Level {
    int side;
    std::vector<std::array<double, 3>> normal;
    Plane jacobian;
    Plane smoothness;
};

/// Returns J before clamping, equation 48.
Plane jacobian_of(const Displacement& surface, double patch_size_m);

/// Returns all levels from the base (equations 45 to 49) up to one texel (52, 53).
std::vector<Level> levels_of(const Displacement& surface, double patch_size_m, double roughness);

/// Evaluates equation 50 before the floor: bytes as real numbers, R G B A.
std::array<double, 4> bytes_of(const Level& level, std::size_t texel);

}  // namespace pelagic::oracle
