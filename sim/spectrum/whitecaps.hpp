// How much of the sea is white: the wind says how much, the Jacobian says where.
#pragma once

namespace pelagic {

/// Part of a sea that whitecaps cover: 3.84e-6 U10^3.41 (Monahan and O'Muircheartaigh 1980), at most 0.4.
double whitecap_cover(double wind_speed_mps);

/// What each of some tiles has to cover, one independent of the other, so that a part `cover` of the sea is under any of them.
double cover_of_each(double cover, int tiles);

/// Sums over the waves of a sea: how much its surface folds, in the mean over time and place. With the derivatives of
/// the sideways displacement, over texels as the tile is drawn, let
///
///   u = (Dx,x + Dz,z) / 2,  v = (Dx,x - Dz,z) / 2,  w = (Dx,z + Dz,x) / 2,  so that  J = (1 + u)^2 - v^2 - w^2
///
/// but for (Dx,z - Dz,x)^2 / 4, which is 0 without the differences. A sum of many waves is Gaussian.
struct FoldMoments {
    double uu = 0, vv = 0, ww = 0, uv = 0, uw = 0, vw = 0;  ///< covariances at choppiness 1
    double uu_rate = 0;                                     ///< mean square of du/dt, 1/s^2, at choppiness 1

    /// A wave of that mean square, m^2, that turns by `angular_frequency` radians a second. `wave_x` and `_z` are its wave vector,
    /// rad/m; the differences what a derivative makes of it: sin(k_x d) / d for central differences over texels of side d, k_x for
    /// one that is exact.
    void add_wave(double mean_square, double wave_x, double wave_z, double difference_x, double difference_z,
                  double angular_frequency);
    FoldMoments& operator+=(const FoldMoments& other);
};

/// Where water turns white: a texel of Jacobian J makes foam of clamp(1/2 + (jacobian - J) / ramp, 0, 1).
struct WhitecapThreshold {
    float jacobian;  ///< half white there
    float ramp;      ///< above 0: from none to all white
};

/// The threshold at which foam that lasts covers that part of the sea in the mean.
/// \param tick_s  between two moments at which foam is made, about 0.1
WhitecapThreshold whitecap_threshold(const FoldMoments& moments, double choppiness, double cover, double tick_s);

}  // namespace pelagic
