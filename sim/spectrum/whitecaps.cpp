#include "pelagic/sim/spectrum/whitecaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
    return c;
}

double trace(const Matrix& m) { return m[0][0] + m[1][1] + m[2][2]; }

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

void FoldMoments::add_wave(double mean_square, double wave_x, double wave_z, double difference_x, double difference_z,
                           double angular_frequency) {
    const double part = mean_square / (wave_x * wave_x + wave_z * wave_z);
    const double xx = wave_x * difference_x, zz = wave_z * difference_z;
    const double u = (xx + zz) / 2, v = (xx - zz) / 2, w = (wave_x * difference_z + wave_z * difference_x) / 2;
    *this += {part * u * u,
              part * v * v,
              part * w * w,
              part * u * v,
              part * u * w,
              part * v * w,
              part * u * u * angular_frequency * angular_frequency};
}

FoldMoments& FoldMoments::operator+=(const FoldMoments& other) {
    uu += other.uu;
    vv += other.vv;
    ww += other.ww;
    uv += other.uv;
    uw += other.uw;
    vw += other.vw;
    uu_rate += other.uu_rate;
    return *this;
}

// J = 1 + 2u + x'Ax with x = (u, v, w), A = diag(1, -1, -1) and covariances S has the cumulants, with l = (2, 0, 0),
//   k1 = 1 + tr AS,  k2 = l'Sl + 2 tr (AS)^2,  k3 = 6 l'SASl + 8 tr (AS)^3,  k4 = 48 l'SASASl + 48 tr (AS)^4
// (Mathai and Provost 1992, theorem 3.2b.2).
float whitecap_jacobian(const FoldMoments& m, double choppiness, double cover) {
    const double f = choppiness * choppiness;
    const Matrix s{{{f * m.uu, f * m.uv, f * m.uw}, {f * m.uv, f * m.vv, f * m.vw}, {f * m.uw, f * m.vw, f * m.ww}}};
    Matrix as = s;
    for (std::size_t row = 1; row < 3; ++row)
        for (double& value : as[row]) value = -value;
    const Matrix as2 = product(as, as), as3 = product(as2, as);
    const double k1 = 1 + trace(as);
    // The first row of A is that of the unit matrix, so l'S(AS)^n l is 4 times the first element of (AS)^(n + 1).
    const double k2 = 4 * as[0][0] + 2 * trace(as2);
    const double k3 = 24 * as2[0][0] + 8 * trace(as3);
    const double k4 = 192 * as3[0][0] + 48 * trace(product(as3, as));
    if (k2 <= 0) return static_cast<float>(k1);

    const double deviation = std::sqrt(k2);
    const double skewness = k3 / (k2 * deviation), excess = k4 / (k2 * k2);
    const double z = normal_quantile(cover);
    const double quantile = z + (z * z - 1) * skewness / 6 + (z * z * z - 3 * z) * excess / 24 -
                            (2 * z * z * z - 5 * z) * skewness * skewness / 36;
    return static_cast<float>(k1 + deviation * quantile);
}

WhitecapThreshold whitecap_threshold(const FoldMoments& moments, double choppiness, double cover, double tick_s) {
    static_cast<void>(tick_s);
    return {whitecap_jacobian(moments, choppiness, cover), 0.1f};
}

}  // namespace pelagic
