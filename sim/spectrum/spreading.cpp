#include "pelagic/sim/spectrum/spreading.hpp"

#include <cmath>

#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

// Integral of |cos|^s over half a circle by the trapezoidal rule; its error is largest for s = 1, 1e-7.
double half_circle_integral(double exponent) {
    constexpr int steps = 4096;
    double sum = 0;
    for (int i = 1; i < steps; ++i)
        sum += det::pow(det::sine_cosine_of_turns(static_cast<double>(i) / (2 * steps)).sine, exponent);
    return sum * (3.14159265358979323846 / steps);
}

}  // namespace

DirectionalSpreading::DirectionalSpreading(double alignment)
    : exponent_(1 + 5 * alignment * alignment),
      opposing_(0.01 + 0.49 * (1 - alignment) * (1 - alignment)),
      integral_(half_circle_integral(exponent_) * (1 + opposing_)) {}

double DirectionalSpreading::weight(double cosine) const { return weights(cosine).along; }

DirectionalSpreading::Opposites DirectionalSpreading::weights(double cosine) const {
    const double size = std::fabs(cosine);
    if (size < 1e-12) return {0, 0};
    const double with_wind = det::pow(size, exponent_), against_wind = with_wind * opposing_;
    return cosine < 0 ? Opposites{against_wind, with_wind} : Opposites{with_wind, against_wind};
}

}  // namespace pelagic
