#include "pelagic/sim/spectrum/swell_arrival.hpp"

#include <algorithm>

#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/system_spectrum.hpp"
#include "pelagic/simd/constants.hpp"

namespace pelagic {

double period_of_swell_s(const SeaState& sea) {
    if (sea.swell_height_m > 0) return sea.swell_period_s;
    double longest_s = 0;
    for (const WaveSystem& system : sea.systems)
        longest_s = std::max(longest_s, two_pi / SystemSpectrum(system, sea).peak_radps());
    return longest_s;
}

SwellArrival::SwellArrival(const SeaState& sea, double distance_m)
    : distance_m_(distance_m),
      depth_m_(sea.depth_m),
      first_(two_pi / (period_of_swell_s(sea) * longest_period)),
      peak_(two_pi / period_of_swell_s(sea)),
      last_(two_pi / (period_of_swell_s(sea) * shortest_period)),
      first_slowness_(slowness(first_)) {}

double SwellArrival::slowness(double omega) const {
    return 1 / group_velocity(wave_number(omega, depth_m_), depth_m_);
}

double SwellArrival::delay_s(double omega) const {
    return distance_m_ * (slowness(std::clamp(omega, first_, last_)) - first_slowness_);
}

}  // namespace pelagic
