#include "pelagic/sim/spectrum/wind_drift.hpp"

#include "pelagic/simd/det_math.hpp"

namespace pelagic {

WindDrift wind_drift(const SeaState& sea) {
    constexpr double two_pi = 6.28318530717958647693, part_of_wind = 0.02;
    const auto [sine, cosine] = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
    return {part_of_wind * sea.wind_speed_mps * cosine, part_of_wind * sea.wind_speed_mps * sine};
}

}  // namespace pelagic
