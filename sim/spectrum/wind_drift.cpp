#include "pelagic/sim/spectrum/wind_drift.hpp"

#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

WindDrift fraction_of_wind(const SeaState& sea, double fraction) {
    const auto [sine, cosine] = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
    return {fraction * sea.wind_speed_mps * cosine, fraction * sea.wind_speed_mps * sine};
}

}  // namespace

WindDrift wind_drift(const SeaState& sea) { return fraction_of_wind(sea, 0.02); }

WindDrift usual_foam_drift(const SeaState& sea) { return fraction_of_wind(sea, 0.033); }

}  // namespace pelagic
