// Statistics of folding: the distribution of the Jacobian over time and space, and its rate of
// change.
//
// The derivatives of the horizontal displacement are those of the cascade's texels. Let
//
//   u = (Dx,x + Dz,z) / 2,  v = (Dx,x - Dz,z) / 2,  w = (Dx,z + Dz,x) / 2,
//   so that  J = (1 + u)^2 - v^2 - w^2
//
// except for the term (Dx,z - Dz,x)^2 / 4, which is 0 for exact derivatives. A sum of many waves is
// Gaussian.
#pragma once

namespace pelagic {

/// Sums over the waves of a sea, at choppiness 1. All members except uu_uu are linear in the waves'
/// energies.
struct FoldMoments {
    double uu = 0, vv = 0, ww = 0, uv = 0, uw = 0, vw = 0;  ///< covariances
    double uu_rate = 0;  ///< mean square of du/dt, 1/s^2, in the frame of drifting foam
    double uu_uu = 0;    ///< sum of squares of each wave's uu: a sum of few waves is not Gaussian
    /// Mean squares of 2u and of 2 du/dt as bilinear filtering between texels shows them, in the
    /// mean over all positions.
    double trace_square = 0, trace_rate_square = 0;

    /// Adds a wave.
    /// \param mean_square  mean square of its displacement along its direction, m^2; that of its
    /// height in deep water
    /// \param square_rate  mean square of the time derivative of this displacement, m^2/s^2
    /// \param wave_x, wave_z  wave vector, rad/m
    /// \param difference_x, difference_z  factors of the texels' derivative, 1/m: sin(k_x d) / d
    /// for central differences over
    ///     texels of side d
    /// \param filter  factor on mean squares from bilinear filtering between texels
    void add_wave(double mean_square, double square_rate, double wave_x, double wave_z, double difference_x,
                  double difference_z, double filter);
    FoldMoments& operator+=(const FoldMoments& other);
    /// Moments if all energies are multiplied by `weight`.
    FoldMoments operator*(double weight) const;

    /// Returns the frequency of J where J is small, rad/s; 2u is its largest term. \pre uu is above
    /// 0
    double frequency_radps() const;
};

/// The distribution of the Jacobian of a sea, by its first four cumulants.
struct FoldDistribution {
    FoldDistribution(const FoldMoments& moments, double choppiness);

    /// Returns the quantile of J with the probability that a Gaussian is more than `deviations`
    /// standard deviations below its mean (Cornish and Fisher 1938).
    double below_mean(double deviations) const;

    double mean, deviation;
    double skewness = 0, excess = 0;
};

}  // namespace pelagic
