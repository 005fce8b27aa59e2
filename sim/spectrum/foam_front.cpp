#include "pelagic/sim/spectrum/foam_front.hpp"

#include <algorithm>

#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {

FoamFront foam_front(const SeaState& sea) {
    constexpr double tangent = 0.17632698070846498;  // of 10 degrees
    constexpr double full_lean = 0.4;
    const auto [sine, cosine] = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
    const double front = tangent * std::min(lean_of(sea) / full_lean, 1.0);
    return {front * cosine, front * sine};
}

}  // namespace pelagic
