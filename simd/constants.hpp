// Constants of mathematics and physics that several modules share.
#pragma once

#include <numbers>

namespace pelagic {

inline constexpr double two_pi = 2 * std::numbers::pi;
/// Standard gravity (3rd CGPM, 1901).
inline constexpr double gravity_mps2 = 9.80665;

}  // namespace pelagic
