#include "pelagic/sim/spectrum/folding.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pelagic {
namespace {

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

void FoldMoments::add_wave(double mean_square, double square_rate, double wave_x, double wave_z, double difference_x,
                           double difference_z, double filter) {
    const double of_square = 1 / (wave_x * wave_x + wave_z * wave_z), square_over_k2 = mean_square * of_square;
    const double xx = wave_x * difference_x, zz = wave_z * difference_z;
    const double u = (xx + zz) / 2, v = (xx - zz) / 2, w = (wave_x * difference_z + wave_z * difference_x) / 2;
    const double uu_of_wave = square_over_k2 * u * u;
    *this += {uu_of_wave,
              square_over_k2 * v * v,
              square_over_k2 * w * w,
              square_over_k2 * u * v,
              square_over_k2 * u * w,
              square_over_k2 * v * w,
              square_rate * of_square * u * u,
              uu_of_wave * uu_of_wave,
              4 * filter * uu_of_wave,
              4 * filter * square_rate * of_square * u * u};
}

FoldMoments& FoldMoments::operator+=(const FoldMoments& other) {
    uu += other.uu;
    vv += other.vv;
    ww += other.ww;
    uv += other.uv;
    uw += other.uw;
    vw += other.vw;
    uu_rate += other.uu_rate;
    uu_uu += other.uu_uu;
    trace_square += other.trace_square;
    trace_rate_square += other.trace_rate_square;
    return *this;
}

FoldMoments FoldMoments::operator*(double weight) const {
    return {uu * weight,
            vv * weight,
            ww * weight,
            uv * weight,
            uw * weight,
            vw * weight,
            uu_rate * weight,
            uu_uu * weight * weight,
            trace_square * weight,
            trace_rate_square * weight};
}

double FoldMoments::frequency_radps() const { return std::sqrt(uu_rate / uu); }

// J = 1 + 2u + x'Ax with x = (u, v, w), A = diag(1, -1, -1) and covariances S has the cumulants,
// with l = (2, 0, 0),
//   k1 = 1 + tr AS,                  k2 = l'Sl + 2 tr (AS)^2,
//   k3 = 6 l'SASl + 8 tr (AS)^3,     k4 = 48 l'SASASl + 48 tr (AS)^4
// (Mathai and Provost 1992, theorem 3.2b.2). A wave of variance s has the fourth cumulant -3/2 s^2.
// Therefore 2u contributes an additional -24 sum s^2 to k4.
FoldDistribution::FoldDistribution(const FoldMoments& m, double choppiness) {
    const double f = choppiness * choppiness;
    const Matrix s{{{f * m.uu, f * m.uv, f * m.uw}, {f * m.uv, f * m.vv, f * m.vw}, {f * m.uw, f * m.vw, f * m.ww}}};
    Matrix as = s;
    for (std::size_t row = 1; row < 3; ++row)
        for (double& value : as[row]) value = -value;
    const Matrix as2 = product(as, as), as3 = product(as2, as);
    // The first row of A is that of the unit matrix, so l'S(AS)^n l is 4 times the first element of
    // (AS)^(n + 1).
    const double k2 = std::max(4 * as[0][0] + 2 * trace(as2), 0.0);
    mean = 1 + trace(as);
    deviation = std::sqrt(k2);
    if (k2 == 0) return;
    skewness = (24 * as2[0][0] + 8 * trace(as3)) / (k2 * deviation);
    excess = (192 * as3[0][0] + 48 * trace(product(as3, as)) - 24 * f * f * m.uu_uu) / (k2 * k2);
}

double FoldDistribution::below_mean(double deviations) const {
    // With a negative excess the series is monotonic only up to the point where its slope 1 + (z^2
    // - 1) excess / 8 is 0. A sum of few waves has no larger values.
    const double z = -(excess < 0 ? std::min(deviations, std::sqrt(1 - 8 / excess)) : deviations);
    return mean + deviation * (z + (z * z - 1) * skewness / 6 + (z * z * z - 3 * z) * excess / 24 -
                               (2 * z * z * z - 5 * z) * skewness * skewness / 36);
}

}  // namespace pelagic
