// Flight of a droplet: gravity and linear drag towards the wind, in closed form.
//
//   dv/dt = -g + (w - v) / T
//   v(a) = w' + (v_0 - w') e,  x(a) = x_0 + w' a + (v_0 - w') T (1 - e),  e = exp(-a / T)
//
// where a is the age, w the wind, w' = w - g T and T the relaxation time.
#pragma once

#include <array>

#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {

using SprayVector = std::array<double, 3>;

struct Flight {
    SprayVector start_m, start_mps, wind_mps;
    double relaxation_s;  ///< above 0
};

struct FlightPoint {
    SprayVector place_m, velocity_mps;
};

inline FlightPoint flown(const Flight& flight, double age_s) {
    const double e = det::exp(-age_s / flight.relaxation_s);
    FlightPoint point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double fall = axis == 1 ? gravity_mps2 * flight.relaxation_s : 0;
        const double end = flight.wind_mps[axis] - fall, change = flight.start_mps[axis] - end;
        point.velocity_mps[axis] = end + change * e;
        point.place_m[axis] = flight.start_m[axis] + end * age_s + change * flight.relaxation_s * (1 - e);
    }
    return point;
}

/// Returns the terminal velocity of a drop of water in still air, m/s: linear between values of
/// Gunn and Kinzer 1949, "The terminal velocity of fall for water droplets in stagnant air".
/// \param diameter_mm  [0.1, 5]
inline double terminal_velocity(double diameter_mm) {
    struct Measured {
        double diameter_mm, velocity_mps;
    };
    constexpr std::array measured = {Measured{0.1, 0.27}, Measured{0.2, 0.72}, Measured{0.4, 1.62},
                                     Measured{0.6, 2.47}, Measured{1.0, 4.03}, Measured{1.4, 5.17},
                                     Measured{2.0, 6.49}, Measured{3.0, 8.06}, Measured{5.0, 9.09}};
    std::size_t next = 1;
    while (next + 1 < measured.size() && diameter_mm > measured[next].diameter_mm) ++next;
    const Measured &a = measured[next - 1], &b = measured[next];
    return a.velocity_mps +
           (diameter_mm - a.diameter_mm) / (b.diameter_mm - a.diameter_mm) * (b.velocity_mps - a.velocity_mps);
}

/// Returns the relaxation time of a drop, s: that of the linear drag with its terminal velocity.
inline double relaxation_of(double diameter_mm) { return terminal_velocity(diameter_mm) / gravity_mps2; }

}  // namespace pelagic
