// When the waves of a swell from afar arrive: each runs with its group velocity, so the long ones come first.
//
//   delay(omega) = d / cg(omega) - d / cg(omega_first)      Munk, Miller, Snodgrass and Barber 1963; Snodgrass et al. 1966
//
// In deep water cg = g / 2 omega, and frequencies come one after the other at the steady pace g / 2 d.
#pragma once

#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// s = u^2 (3 - 2u) with u = since / over: how much of a wave has come. 0 before, 1 afterwards; its slope is 0 at both ends.
constexpr double eased_part(double since_s, double over_s) {
    const double u = since_s / over_s;
    return u <= 0 ? 0 : u < 1 ? u * u * (3 - 2 * u) : 1;
}

/// A swell that was raised at one moment, `distance_m` away. The clock starts with the longest waves that count.
class SwellArrival {
   public:
    /// In periods of the swell's peak: longer waves, 1e-5 of its energy, come with these.
    static constexpr double longest_period = 1.5;
    /// Shorter ones, another 1e-5, come with these, so that there is an end.
    static constexpr double shortest_period = 1.0 / 3;

    /// \pre check(sea) is empty, and the sea has a swell
    SwellArrival(const SeaState& sea, double distance_m);

    /// Of waves of `omega` rad/s.
    double delay_s(double omega) const;
    double delay_of_peak_s() const { return delay_s(peak_); }
    double span_s() const { return delay_s(last_); }  ///< until the shortest that count
    double last_omega() const { return last_; }

   private:
    /// How long a metre takes, s/m.
    double slowness(double omega) const;

    double distance_m_, depth_m_;
    double first_, peak_, last_;  ///< rad/s
    double first_slowness_;
};

}  // namespace pelagic
