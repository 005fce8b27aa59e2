// Mean square slopes of the sea: measured values by wind speed, the slopes of a cascade's waves,
// the unresolved slopes, which become roughness, and the ranges of slope maps.
#pragma once

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/slope_sum.hpp"
#include "pelagic/sim/slope_variance.hpp"

namespace pelagic {

/// Sums over the waves of a sea: mean squares and mean product of the slopes along two axes, as a
/// texture shows them.
struct SlopeMoments {
    double xx = 0, zz = 0, xz = 0;

    /// Adds a wave.
    /// \param mean_square  mean square of its height, m^2
    /// \param difference_x, difference_z  factors of the texture's derivative, 1/m: sin(k_x d) / d
    /// for central differences
    ///     over texels of side d
    void add_wave(double mean_square, double difference_x, double difference_z);
    SlopeMoments& operator+=(const SlopeMoments& other);
    /// Moments if all energies are multiplied by `weight`.
    SlopeMoments operator*(double weight) const;

    /// Converts moments along a cascade's axes to moments along the world's axes.
    SlopeMoments in_world(const CascadeGrid& grid) const;
    /// Returns the slope variances along the wind and across it. \pre the axes are the world's
    SlopeVariance around(double wind_direction_rad) const;
};

/// Returns measured_slopes() minus the resolved slopes, at least 0. A resolved excess in one
/// direction is subtracted from the other. Resolved and unresolved slopes together then equal the
/// measured total, unless the resolved slopes exceed it.
SlopeVariance unresolved_slopes(const SlopeVariance& resolved, double wind_speed_mps);

/// Returns the slope variance that a sea's cascades do not resolve: unresolved_slopes() for the
/// sea's wind. For a pond it is the variance of its octaves that its texels cannot show, because a
/// pond has no other waves.
SlopeVariance unresolved_slopes(const SeaState& sea, const SlopeVariance& resolved);

/// Returns the roughness for the smoothness channel: the sea's own roughness if it is set.
/// Otherwise it is alpha of a GGX surface with the mean square slope alpha^2 of the unresolved
/// slopes, at most 1.
double roughness_of(const SeaState& sea, const SlopeVariance& unresolved);

/// Returns the value ranges of a cascade's slope maps. The slope range is four times the root of
/// the larger mean square. This is at least four standard deviations along any axis, and five if
/// waves run in opposite directions. The variance range is three times the mean square slope. A sea
/// without waves has positive ranges, too.
/// \param mean_square_slope  mean of h_x^2 + h_z^2
/// \param mean_square_convergence  mean of (D_xx + D_zz)^2 at choppiness 1; the larger of both in
/// shallow water
SlopeRanges slope_ranges(double mean_square_slope, double mean_square_convergence);

}  // namespace pelagic
