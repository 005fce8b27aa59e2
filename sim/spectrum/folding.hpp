// How much a surface folds, in the mean over time and place: which Jacobians there are, and how fast they change.
//
// With the derivatives of the horizontal displacement, over texels as the cascade is drawn, let
//
//   u = (Dx,x + Dz,z) / 2,  v = (Dx,x - Dz,z) / 2,  w = (Dx,z + Dz,x) / 2,  so that  J = (1 + u)^2 - v^2 - w^2
//
// but for (Dx,z - Dz,x)^2 / 4, which is 0 without the differences. A sum of many waves is Gaussian.
#pragma once

namespace pelagic {

/// Sums over the waves of a sea, at choppiness 1. All but the last are linear in the waves' energies.
struct FoldMoments {
    double uu = 0, vv = 0, ww = 0, uv = 0, uw = 0, vw = 0;  ///< covariances
    double uu_rate = 0;  ///< mean square of du/dt, 1/s^2, as what drifts over the sea meets it
    double uu_uu = 0;    ///< sum of the squares of what each wave adds to uu: a sum of few waves is no Gaussian

    /// A wave of that mean square of its displacement along its direction, m^2, which changes by `square_rate`, m^2/s^2, in the mean
    /// square; in deep water those of its height. `wave_x` and `_z` are its
    /// wave vector, rad/m; the differences what the texels' derivative makes of it, 1/m: sin(k_x d) / d for central differences over
    /// texels of side d.
    void add_wave(double mean_square, double square_rate, double wave_x, double wave_z, double difference_x,
                  double difference_z);
    FoldMoments& operator+=(const FoldMoments& other);
    FoldMoments operator*(double weight) const;  ///< of waves with so much of their energy

    /// How fast J changes where it is small: 2u is most of it. \pre uu is above 0
    double frequency_radps() const;
};

/// The Jacobians of a sea with those moments, by their first four cumulants.
struct FoldDistribution {
    FoldDistribution(const FoldMoments& moments, double choppiness);

    /// J lies below that as often as a Gaussian lies more than so many deviations below its mean (Cornish and Fisher 1938).
    double below_mean(double deviations) const;

    double mean, deviation;
    double skewness = 0, excess = 0;
};

}  // namespace pelagic
