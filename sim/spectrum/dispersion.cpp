#include "pelagic/sim/spectrum/dispersion.hpp"

#include <cmath>

#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {
constexpr double two_pi = 6.28318530717958647693;
}

double angular_frequency(double k, double depth_m) { return std::sqrt(gravity_mps2 * k * det::tanh(k * depth_m)); }

// d/dk of omega^2 = g k tanh(k d): 2 omega omega' = g (tanh(k d) + k d (1 - tanh^2(k d))).
double group_velocity(double k, double depth_m) {
    const double kd = k * depth_m;
    const double tanh_kd = det::tanh(kd);
    return gravity_mps2 * (tanh_kd + kd * (1 - tanh_kd * tanh_kd)) / (2 * angular_frequency(k, depth_m));
}

std::uint32_t loop_harmonic(double omega, double loop_period_s) {
    const double periods = std::floor(omega * loop_period_s / two_pi + 0.5);
    return periods < 1 ? 1 : static_cast<std::uint32_t>(periods);
}

// fmod is exact by IEEE 754, unlike the rest of libm; a result that rounds up to a whole turn wraps to 0.
LoopFraction loop_fraction(double time_s, double loop_period_s) {
    double within = std::fmod(time_s, loop_period_s);
    if (within < 0) within += loop_period_s;
    const double turns = std::floor(within / loop_period_s * 0x1p32 + 0.5);
    return {static_cast<std::uint32_t>(static_cast<std::uint64_t>(turns))};
}

}  // namespace pelagic
