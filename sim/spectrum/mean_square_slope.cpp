#include "pelagic/sim/spectrum/mean_square_slope.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/spectrum/wave_list.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
SlopeVariance measured_slopes(double wind_speed_mps) {
    const DefaultFloatEnvironment environment(wind_speed_mps);
    return environment.result(SlopeVariance{0.00316 * wind_speed_mps, 0.003 + 0.00192 * wind_speed_mps});
}

void SlopeMoments::add_wave(double mean_square, double difference_x, double difference_z) {
    *this += {mean_square * difference_x * difference_x, mean_square * difference_z * difference_z,
              mean_square * difference_x * difference_z};
}

SlopeMoments& SlopeMoments::operator+=(const SlopeMoments& other) {
    xx += other.xx;
    zz += other.zz;
    xz += other.xz;
    return *this;
}

SlopeMoments SlopeMoments::operator*(double weight) const { return {xx * weight, zz * weight, xz * weight}; }

SlopeMoments SlopeMoments::in_world(const CascadeGrid& grid) const {
    const double c = grid.cosine, s = grid.sine, both = 2 * c * s * xz;
    return {c * c * xx - both + s * s * zz, s * s * xx + both + c * c * zz, c * s * (xx - zz) + (c * c - s * s) * xz};
}

SlopeVariance SlopeMoments::around(double wind_direction_rad) const {
    const auto [s, c] = det::sine_cosine_of_turns(wind_direction_rad / two_pi);
    const double both = 2 * s * c * xz;
    return {c * c * xx + both + s * s * zz, s * s * xx - both + c * c * zz};
}

SlopeVariance unresolved_slopes(const SlopeVariance& resolved, double wind_speed_mps) {
    const SlopeVariance all = measured_slopes(wind_speed_mps);
    const double unresolved = all.total() - resolved.total();
    if (!(unresolved > 0)) return {};
    const double upwind = std::max(0.0, all.upwind - resolved.upwind);
    const double crosswind = std::max(0.0, all.crosswind - resolved.crosswind);
    const double scale = unresolved / (upwind + crosswind);
    return {upwind * scale, crosswind * scale};
}

SlopeVariance unresolved_slopes(const SeaState& sea, const SlopeVariance& resolved) {
    if (sea.waves != WaveModel::pond) return unresolved_slopes(resolved, sea.wind_speed_mps);
    return hidden_slopes(sea, grid_octaves(sea, plan_cascades(sea).front()));
}

double roughness_of(const SeaState& sea, const SlopeVariance& unresolved) {
    return sea.roughness < 0 ? std::min(1.0, std::sqrt(unresolved.total())) : sea.roughness;
}

SlopeRanges slope_ranges(double mean_square_slope, double mean_square_convergence) {
    // Smaller than the resolution of a byte of a normal.
    constexpr double min_mean_square_slope = 1e-12;
    const double square = std::max(mean_square_slope, min_mean_square_slope);
    return {static_cast<float>(4 * std::sqrt(std::max(square, mean_square_convergence))),
            static_cast<float>(3 * square)};
}

}  // namespace pelagic
