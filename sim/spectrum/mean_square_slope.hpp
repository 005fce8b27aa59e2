// How steep the sea is: what was measured over a wind, what the waves of a cascade have of it, and what is left for the light.
#pragma once

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/slope_variance.hpp"

namespace pelagic {

/// Sums over the waves of a sea: mean squares and product of the slopes along two axes that a texture of it shows.
struct SlopeMoments {
    double xx = 0, zz = 0, xz = 0;

    /// A wave of that mean square, m^2. `difference_x` and `_z` are what the texture's derivative makes of the wave number, 1/m:
    /// sin(k_x d) / d for central differences over texels of side d.
    void add_wave(double mean_square, double difference_x, double difference_z);
    SlopeMoments& operator+=(const SlopeMoments& other);
    SlopeMoments operator*(double weight) const;  ///< of waves with so much of their energy

    /// Those of a cascade, along its own axes, along the world's.
    SlopeMoments in_world(const CascadeGrid& grid) const;
    /// Along a wind and across it. \pre the axes are the world's
    SlopeVariance around(double wind_direction_rad) const;
};

/// What is left of measured_slopes(), never less than 0. Waves that have too much in one direction take it from the other, so
/// that both sums together are the measured one, unless the waves alone have more.
SlopeVariance unresolved_slopes(const SlopeVariance& resolved, double wind_speed_mps);

/// What a sea's cascades leave to the light: unresolved_slopes() in its wind, but of a pond what its texels hide of its own octaves,
/// which are all that it has.
SlopeVariance slopes_left(const SeaState& sea, const SlopeVariance& resolved);

/// What the smoothness channel says: the sea's own roughness if it has one, else alpha of a GGX surface whose mean square
/// slope, alpha^2, is what the cascades leave; at most 1.
double roughness_of(const SeaState& sea, const SlopeVariance& unresolved);

}  // namespace pelagic
