#include "pelagic/sim/spectrum/whitecaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pelagic/sim/tile.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

/// Less wind than this makes no waves that anybody sees, and its power would leave the range of numbers.
constexpr double least_wind_mps = 0.01;

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
    return c;
}

double trace(const Matrix& m) { return m[0][0] + m[1][1] + m[2][2]; }

/// The Jacobian of a sea at one place, of the mean over time.
struct FoldDistribution {
    FoldDistribution(const FoldMoments& moments, double choppiness);

    /// The Jacobian below which it lies as often as a Gaussian lies more than so many deviations below its mean (Cornish and Fisher
    /// 1938, up to the fourth cumulant).
    double below_mean(double deviations) const;

    double mean, deviation, skewness = 0, excess = 0;
};

/// Density of the standard normal distribution.
double density(double x) { return 0.39894228040143267794 * det::exp(-x * x / 2); }

/// What lies above x of it. Abramowitz and Stegun 1964, 26.2.17: within 7.5e-8.
double part_above(double x) {
    if (x < 0) return 1 - part_above(-x);
    const double t = 1 / (1 + 0.2316419 * x);
    return density(x) * t *
           (0.319381530 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
}

/// Foam fades from all to none in so many ticks.
constexpr double fading_ticks = 255.0 / 9;

/// From no foam to all of it, in deviations of the Gaussian that stands for the Jacobian.
constexpr double ramp_deviations = 0.3;

/// The ramp is at least this part of a Gaussian's.
constexpr double least_slope = 0.125;

/// Jacobians are floats near 1: if they vary less, they are all noise.
constexpr double least_deviation = 1e-5;

/// How much of the sea is under foam.
class LastingFoam {
   public:
    /// \param frequency  root of the mean square of the Gaussian's rate of change over its own, rad/s
    LastingFoam(double frequency, double tick_s);

    /// Of water that is half white where the Gaussian is so many deviations below its mean.
    double cover(double deviations) const;
    /// The other way round, within 1e-6.
    double deviations_of(double cover) const;

   private:
    struct Node {
        double foam, weight;
    };
    /// Gauss and Legendre's, of 3 points in [0, 1].
    static constexpr Node foam_nodes[] = {
        {0.11270166537925831, 5.0 / 18}, {0.5, 8.0 / 18}, {0.88729833462074169, 5.0 / 18}};

    double half_turn_of_tick_;
    double crossings_;
};

}  // namespace

double whitecap_cover(double wind_speed_mps) {
    return std::min(0.4, 3.84e-6 * det::pow(std::max(wind_speed_mps, least_wind_mps), 3.41));
}

double cover_of_each(double cover, int tiles) { return tiles == 1 ? cover : 1 - det::pow(1 - cover, 1.0 / tiles); }

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
FoldDistribution::FoldDistribution(const FoldMoments& m, double choppiness) {
    const double f = choppiness * choppiness;
    const Matrix s{{{f * m.uu, f * m.uv, f * m.uw}, {f * m.uv, f * m.vv, f * m.vw}, {f * m.uw, f * m.vw, f * m.ww}}};
    Matrix as = s;
    for (std::size_t row = 1; row < 3; ++row)
        for (double& value : as[row]) value = -value;
    const Matrix as2 = product(as, as), as3 = product(as2, as);
    // The first row of A is that of the unit matrix, so l'S(AS)^n l is 4 times the first element of (AS)^(n + 1).
    const double k2 = std::max(4 * as[0][0] + 2 * trace(as2), 0.0);
    mean = 1 + trace(as);
    deviation = std::sqrt(k2);
    if (k2 == 0) return;
    skewness = (24 * as2[0][0] + 8 * trace(as3)) / (k2 * deviation);
    excess = (192 * as3[0][0] + 48 * trace(product(as3, as))) / (k2 * k2);
}

double FoldDistribution::below_mean(double deviations) const {
    const double z = -deviations;
    return mean + deviation * (z + (z * z - 1) * skewness / 6 + (z * z * z - 3 * z) * excess / 24 -
                               (2 * z * z * z - 5 * z) * skewness * skewness / 36);
}

LastingFoam::LastingFoam(double frequency, double tick_s) : half_turn_of_tick_(frequency * tick_s / 2) {
    const double fall = ramp_deviations / (fading_ticks * tick_s) / frequency;
    crossings_ = (density(fall) + fall * (1 - part_above(fall))) / fall;
}

double LastingFoam::cover(double deviations) const {
    const double r = deviations * half_turn_of_tick_;
    const double seen = r < 1e-3 ? 1 : 2.50662827463100050242 * (0.5 - part_above(r)) / r;
    const double whole = part_above(deviations + ramp_deviations / 2);
    double cover = 0;
    for (const auto& [foam, weight] : foam_nodes) {
        const double part = part_above(deviations + ramp_deviations * (foam - 0.5));
        const double entries = seen * crossings_ * (part - whole);
        cover += weight * (1 - (1 - whole) * det::exp(-entries / (1 - whole)));
    }
    return cover;
}

double LastingFoam::deviations_of(double wanted) const {
    double low = 0, high = 8;
    for (int step = 0; step < 24; ++step) {
        const double middle = (low + high) / 2;
        (cover(middle) > wanted ? low : high) = middle;
    }
    return (low + high) / 2;
}

WhitecapThreshold whitecap_threshold(const FoldMoments& moments, double choppiness, double cover, double tick_s) {
    const FoldDistribution jacobian(moments, choppiness);
    if (!(jacobian.deviation >= least_deviation)) return {.jacobian = Tile::no_whitecaps, .ramp = 1};
    const double level = LastingFoam(std::sqrt(moments.uu_rate / moments.uu), tick_s).deviations_of(cover);
    const double first = jacobian.below_mean(level - ramp_deviations / 2);
    const double all = jacobian.below_mean(level + ramp_deviations / 2);
    return {.jacobian = static_cast<float>((first + all) / 2),
            .ramp = static_cast<float>(std::max(first - all, least_slope * ramp_deviations * jacobian.deviation))};
}

}  // namespace pelagic
