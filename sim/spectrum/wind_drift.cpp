#include "pelagic/sim/spectrum/wind_drift.hpp"

#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

constexpr double two_pi = 6.28318530717958647693;
constexpr double wind_part = 0.02;
constexpr double usual_part = 0.033;

WindDrift part_of_wind(const SeaState& sea, double part) {
    const auto [sine, cosine] = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
    return {part * sea.wind_speed_mps * cosine, part * sea.wind_speed_mps * sine};
}

}  // namespace

WindDrift wind_drift(const SeaState& sea) { return part_of_wind(sea, wind_part); }

WindDrift usual_foam_drift(const SeaState& sea) { return part_of_wind(sea, usual_part); }

}  // namespace pelagic
