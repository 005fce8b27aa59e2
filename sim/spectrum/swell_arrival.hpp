// Arrival times of a distant swell. Waves travel at their group velocity, so long waves arrive
// first.
//
//   delay(omega) = d / cg(omega) - d / cg(omega_first)
//
// (Munk, Miller, Snodgrass and Barber 1963; Snodgrass et al. 1966). In deep water cg = g / 2 omega,
// so the arriving frequency grows at the constant rate g / 2 d.
#pragma once

#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// Returns the fraction of a wave's energy that has arrived: s = u^2 (3 - 2u) with u = since /
/// over. It is 0 before and 1 after the transition; its derivative is 0 at both ends.
constexpr double eased_fraction(double since_s, double over_s) {
    const double u = since_s / over_s;
    return u <= 0 ? 0 : u < 1 ? u * u * (3 - 2 * u) : 1;
}

/// Returns the peak period of a sea's swell in seconds: of the swell of its options, or else the
/// longest of its systems. 0 if the sea has neither.
double period_of_swell_s(const SeaState& sea);

/// A swell that was generated at one moment, `distance_m` away. Delays are relative to the arrival
/// of the waves of longest_period.
class SwellArrival {
   public:
    /// Longest period with its own delay, in periods of the swell's peak. Longer waves, a fraction
    /// of 1e-5 of the energy, arrive with it.
    static constexpr double longest_period = 1.5;
    /// Shortest period with its own delay. Shorter waves, another 1e-5 of the energy, arrive with
    /// it, so the arrival is finite.
    static constexpr double shortest_period = 1.0 / 3;

    /// \pre check(sea) is empty, and the sea has a swell or a system
    SwellArrival(const SeaState& sea, double distance_m);

    /// Returns the delay of waves of `omega` rad/s.
    double delay_s(double omega) const;
    double delay_of_peak_s() const { return delay_s(peak_); }
    double span_s() const { return delay_s(last_); }  ///< delay of the waves of shortest_period
    double last_omega() const { return last_; }

   private:
    /// Returns the inverse of the group velocity, s/m.
    double slowness(double omega) const;

    double distance_m_, depth_m_;
    double first_, peak_, last_;  ///< rad/s
    double first_slowness_;
};

}  // namespace pelagic
