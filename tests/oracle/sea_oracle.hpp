// The sea by its definition, in double and with libm: every wave vector of the full plane, no packing, no half plane.
// Only the Gaussian draws come from the library; wave_noise_test looks at those.
#pragma once

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/tests/oracle/dft.hpp"

namespace pelagic::oracle {

inline constexpr double gravity = 9.80665;

/// omega in rad/s: omega^2 = g k tanh(k d).
double frequency_of(const SeaState& sea, double k);

/// Energy over frequency in deep water, m^2 s, of pierson-moskowitz and jonswap.
double frequency_density(const SeaState& sea, double omega);

/// Energy over wave vectors, m^4, of the physical models, swell, depth and breaking included.
double density(const SeaState& sea, double kx, double kz);

/// h0 of the wave numbers (m, n).
Complex initial_amplitude(const SeaState& sea, int m, int n);

/// The three fields as complex sums, so that what should be real can be seen to be.
struct Fields {
    ComplexField height, dx, dz;  ///< dx and dz times choppiness
};

/// h~(k, t) over the full plane in FFT order.
ComplexField spectrum_at(const SeaState& sea, double time_s);

/// The sea at a time: naive sums up to N = 64, the FFT above.
Fields fields_at(const SeaState& sea, double time_s);

/// Wave number of an index in FFT order.
inline int wave_number(std::size_t p, int n) {
    return static_cast<int>(p) < n / 2 ? static_cast<int>(p) : static_cast<int>(p) - n;
}

}  // namespace pelagic::oracle
