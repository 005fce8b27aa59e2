#include "pelagic/sim/spectrum/whitecaps.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/spectrum/lasting_foam.hpp"
#include "pelagic/sim/tile.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

/// Less wind than this makes no waves that anybody sees, and its power would leave the range of numbers.
constexpr double least_wind_mps = 0.01;

/// x of the standard normal distribution with P(X < x) = part. Abramowitz and Stegun 1964, 26.2.23: within 4.5e-4.
/// \pre part is in (0, 1/2]
double normal_quantile(double part) {
    const double t = std::sqrt(-2 * det::log(part));
    return (2.515517 + t * (0.802853 + t * 0.010328)) / (1 + t * (1.432788 + t * (0.189269 + t * 0.001308))) - t;
}

/// Jacobians are floats near 1: where they vary less than this, their rounding is a step of foam's bytes.
constexpr double least_deviation = 1e-4;

/// Part of a Gaussian's ramp that is left at least, however bent the distribution of Jacobians is.
constexpr double least_ramp = 0.125;

}  // namespace

double whitecap_cover(double wind_speed_mps) {
    return std::min(0.4, 3.84e-6 * det::pow(std::max(wind_speed_mps, least_wind_mps), 3.41));
}

double whitecap_cover(const SeaState& sea) {
    return sea.waves == WaveModel::spectrum ? whitecap_cover(sea.wind_speed_mps) : 0;
}

double cover_of_each(double cover, int tiles) { return tiles == 1 ? cover : 1 - det::pow(1 - cover, 1.0 / tiles); }

double quantile_of_sum(double cover, int tiles) {
    const double part = std::clamp(cover, 1e-12, 0.4);
    return normal_quantile(part) / normal_quantile(cover_of_each(part, tiles));
}

WhitecapThreshold whitecap_threshold(const FoldMoments& moments, double choppiness, double cover, double tick_s) {
    const FoldDistribution jacobians(moments, choppiness);
    if (!(jacobians.deviation >= least_deviation)) return {.jacobian = Tile::no_whitecaps, .ramp = 1};
    constexpr double ramp = LastingFoam::ramp_deviations;
    const double level = LastingFoam(moments.frequency_radps(), tick_s).level_of(cover);
    const double none = jacobians.below_mean(level - ramp / 2), all = jacobians.below_mean(level + ramp / 2);
    return {.jacobian = static_cast<float>((none + all) / 2),
            .ramp = static_cast<float>(std::max(none - all, least_ramp * ramp * jacobians.deviation))};
}

}  // namespace pelagic
