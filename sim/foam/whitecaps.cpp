#include "pelagic/sim/foam/whitecaps.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/foam/accumulation.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

/// Lower bound of the wind speed, below which waves are invisible and the power would underflow.
constexpr double min_wind_mps = 0.01;

/// Lower bound of the Jacobian's deviation. Jacobians are floats near 1; at lower deviations their
/// rounding is as large as a step of the foam bytes.
constexpr double min_deviation = 1e-4;

/// Minimum of the ramp, as a fraction of a Gaussian's ramp, for skewed distributions of Jacobians.
constexpr double min_ramp = 0.125;

}  // namespace

double whitecap_cover(double wind_speed_mps) {
    return std::min(0.4, 3.84e-6 * det::pow(std::max(wind_speed_mps, min_wind_mps), 3.41));
}

double whitecap_cover(const SeaState& sea) {
    return sea.waves == WaveModel::spectrum ? whitecap_cover(sea.wind_speed_mps) : 0;
}

WhitecapThreshold whitecap_threshold(const FoldMoments& moments, double choppiness, double cover, double tick_s) {
    const FoldDistribution jacobians(moments, choppiness);
    if (!(jacobians.deviation >= min_deviation)) return {.jacobian = Cascade::no_whitecaps, .ramp = 1};
    constexpr double ramp = FoamAccumulation::ramp_deviations;
    const double level = FoamAccumulation(moments.frequency_radps(), tick_s).level_of(cover);
    const double none = jacobians.below_mean(level - ramp / 2), all = jacobians.below_mean(level + ramp / 2);
    return {.jacobian = static_cast<float>((none + all) / 2),
            .ramp = static_cast<float>(std::max(none - all, min_ramp * ramp * jacobians.deviation))};
}

}  // namespace pelagic
