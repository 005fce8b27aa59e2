// Units, a sea, and a comparison of states, for tests of hulls.
#pragma once

#include <numbers>

#include "pelagic/floating/hull.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

inline constexpr double water_kgpm3 = 1025, degree_rad = std::numbers::pi / 180;

inline const SeaState rough_sea{
    .resolution = 64, .patch_size_m = 400, .wind_speed_mps = 17, .fetch_m = 400e3, .choppiness = 1};

inline bool equal(const HullState& a, const HullState& b) {
    return a.position_m == b.position_m && a.orientation == b.orientation && a.velocity_mps == b.velocity_mps &&
           a.angular_velocity_radps == b.angular_velocity_radps && a.wake_velocity_y_mps == b.wake_velocity_y_mps &&
           a.wake_rotation_radps == b.wake_rotation_radps &&
           a.submersion == b.submersion &&
           a.has_previous_step == b.has_previous_step && a.radiation == b.radiation;
}

}  // namespace pelagic
