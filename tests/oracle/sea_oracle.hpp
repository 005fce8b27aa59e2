// The sea by definition, in double with libm: every wave vector of the full plane, without packing.
// Only the Gaussian random numbers come from the library; wave_noise_test.cpp tests those.
#pragma once

#include <cmath>

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/tests/oracle/dft.hpp"

namespace pelagic::oracle {

inline constexpr double gravity = 9.80665;

/// Returns omega in rad/s: omega^2 = g k tanh(k d).
double frequency_of(const SeaState& sea, double k);

/// Returns k of omega^2 = g k tanh(k d), by bisection.
inline double wave_number_at(double omega, double depth_m) {
    double low = 0, high = 1e3;
    for (int i = 0; i < 200; ++i) {
        const double k = 0.5 * (low + high);
        (gravity * k * std::tanh(k * depth_m) < omega * omega ? low : high) = k;
    }
    return low;
}

/// Energy density by frequency in deep water, in m^2 s, of pierson-moskowitz and jonswap.
double frequency_density(const SeaState& sea, double omega);

/// Energy density by wave vector, in m^4, of the physical models, including swell, depth and
/// breaking.
double density(const SeaState& sea, double kx, double kz);

/// Mean of density() over the cell of the integer wave numbers (m, n), over the points that the library
/// takes.
double cell_density(const SeaState& sea, int m, int n);

/// Returns h0 of the integer wave numbers (m, n).
Complex initial_amplitude(const SeaState& sea, int m, int n);

/// Returns the height that cascades add so that the mean level at fixed places is 0, in m.
double mean_level(const SeaState& sea);

/// The three fields as complex sums, so that tests can check that the imaginary parts vanish.
struct Fields {
    ComplexField height, dx, dz;  ///< dx and dz are multiplied by choppiness
};

/// Returns h~(k, t) over the full plane in FFT order.
ComplexField spectrum_at(const SeaState& sea, double time_s);

/// Returns the fields at a time: naive sums up to N = 64, the FFT above.
Fields fields_at(const SeaState& sea, double time_s);

/// Returns the signed wave number of an index in FFT order.
inline int wave_number(std::size_t p, int n) {
    return static_cast<int>(p) < n / 2 ? static_cast<int>(p) : static_cast<int>(p) - n;
}

}  // namespace pelagic::oracle
