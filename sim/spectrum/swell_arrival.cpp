#include "pelagic/sim/spectrum/swell_arrival.hpp"

#include <algorithm>

#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/simd/constants.hpp"

namespace pelagic {
namespace {}

SwellArrival::SwellArrival(const SeaState& sea, double distance_m)
    : distance_m_(distance_m),
      depth_m_(sea.depth_m),
      first_(two_pi / (sea.swell_period_s * longest_period)),
      peak_(two_pi / sea.swell_period_s),
      last_(two_pi / (sea.swell_period_s * shortest_period)),
      first_slowness_(slowness(first_)) {}

double SwellArrival::slowness(double omega) const {
    return 1 / group_velocity(wave_number(omega, depth_m_), depth_m_);
}

double SwellArrival::delay_s(double omega) const {
    return distance_m_ * (slowness(std::clamp(omega, first_, last_)) - first_slowness_);
}

}  // namespace pelagic
