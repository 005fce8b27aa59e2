// Slope maps of cascades that are summed, compared with doubles, closed forms and the exact surface
// of a sum of waves.
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/slope_sum.hpp"
#include "pelagic/sim/spectrum/amplitudes.hpp"
#include "pelagic/sim/spectrum/mean_square_slope.hpp"
#include "pelagic/sim/surface/surface_stages.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/kernel_slopes.hpp"
#include "pelagic/tests/message_of.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;
using unfused::CascadePlanes;

/// h = Re a e^{i (kx x + kz z)}, in world axes, rad/m and metres.
struct SlopeWave {
    double kx, kz;
    std::complex<double> amplitude;

    double number() const { return std::hypot(kx, kz); }
};

/// Waves on a square grid that is rotated in the world.
struct WaveCascade {
    int resolution;
    double side_m, angle_rad;
    std::vector<SlopeWave> waves;
    double mean_square_slope;
};

/// Returns random waves of `min_steps` to N/3 grid steps of wave number, from all directions. Every
/// octave has the same mean square slope.
WaveCascade random_cascade(int resolution, double side_m, double angle_rad, double min_steps,
                           double mean_square_slope, std::mt19937& random) {
    constexpr int count = 80;
    WaveCascade cascade{resolution, side_m, angle_rad, {}, mean_square_slope};
    std::uniform_real_distribution<double> part;
    std::normal_distribution<double> draw;
    while (cascade.waves.size() < count) {
        const double steps = min_steps * std::pow(resolution / 3.0 / min_steps, part(random));
        const double direction = 2 * pi * part(random);
        const double m = std::round(steps * std::cos(direction)), n = std::round(steps * std::sin(direction));
        if (std::hypot(m, n) > resolution / 3.0 || std::hypot(m, n) < min_steps) continue;
        const double step = 2 * pi / side_m, c = std::cos(angle_rad), s = std::sin(angle_rad);
        SlopeWave wave{step * (m * c - n * s), step * (m * s + n * c), {}};
        // The mean is |a|^2/2 k^2; each of the two draws has half of it.
        const double scale = std::sqrt(mean_square_slope / count) / wave.number();
        wave.amplitude = {scale * draw(random), scale * draw(random)};
        cascade.waves.push_back(wave);
    }
    return cascade;
}

/// Returns the exact derivatives of the waves' surface at an undisplaced position.
SurfaceSlopes exact_slopes(const WaveCascade& cascade, double choppiness, double x, double z) {
    SurfaceSlopes sum;
    for (const SlopeWave& wave : cascade.waves) {
        const std::complex<double> h = wave.amplitude * std::polar(1.0, wave.kx * x + wave.kz * z);
        sum.h_x -= wave.kx * h.imag();
        sum.h_z -= wave.kz * h.imag();
        // D = lambda Re(i k/|k| h)
        const double stretch = -choppiness * h.real() / wave.number();
        sum.d_xx += wave.kx * wave.kx * stretch;
        sum.d_zz += wave.kz * wave.kz * stretch;
        sum.d_xz += wave.kx * wave.kz * stretch;
    }
    return sum;
}

/// Returns the waves' surface at the grid, by naive sums.
CascadePlanes planes_of(const WaveCascade& cascade, double choppiness) {
    const double c = std::cos(cascade.angle_rad), s = std::sin(cascade.angle_rad);
    const double texel = cascade.side_m / cascade.resolution;
    CascadePlanes planes{
        cascade.resolution, cascade.side_m, static_cast<float>(c), static_cast<float>(s), {}, {}, {}};
    for (int j = 0; j < cascade.resolution; ++j) {
        for (int i = 0; i < cascade.resolution; ++i) {
            const double x = texel * (i * c - j * s), z = texel * (i * s + j * c);
            double dx = 0, height = 0, dz = 0;
            for (const SlopeWave& wave : cascade.waves) {
                const std::complex<double> h = wave.amplitude * std::polar(1.0, wave.kx * x + wave.kz * z);
                height += h.real();
                dx -= choppiness * wave.kx / wave.number() * h.imag();
                dz -= choppiness * wave.kz / wave.number() * h.imag();
            }
            planes.dx.push_back(static_cast<float>(dx));
            planes.height.push_back(static_cast<float>(height));
            planes.dz.push_back(static_cast<float>(dz));
        }
    }
    return planes;
}

SurfaceSlopes texel_of(const unfused::CascadeSlopes& maps, const SlopeRanges& ranges, std::size_t texel) {
    return slopes_of_texel(maps.slopes[texel], maps.moments[texel], ranges);
}

/// Returns the result of a GPU's bilinear filter of level 0 at a world position.
SurfaceSlopes filtered(const WaveCascade& cascade, const unfused::CascadeSlopes& maps, const SlopeRanges& ranges,
                       double x, double z) {
    const double c = std::cos(cascade.angle_rad), s = std::sin(cascade.angle_rad);
    const double texels_per_m = cascade.resolution / cascade.side_m;
    const double u = (x * c + z * s) * texels_per_m, v = (z * c - x * s) * texels_per_m;
    const double i = std::floor(u), j = std::floor(v);
    SurfaceSlopes sum;
    for (const int right : {0, 1}) {
        for (const int below : {0, 1}) {
            const int mask = cascade.resolution - 1;
            const int column = (static_cast<int>(i) + right) & mask, row = (static_cast<int>(j) + below) & mask;
            const SurfaceSlopes at =
                texel_of(maps, ranges, static_cast<std::size_t>(row * cascade.resolution + column));
            const double weight = (right ? u - i : 1 - (u - i)) * (below ? v - j : 1 - (v - j));
            sum += {at.h_x * weight, at.h_z * weight, at.d_xx * weight, at.d_zz * weight, at.d_xz * weight};
        }
    }
    return sum;
}

double angle_between(const SurfaceNormal& a, const SurfaceNormal& b) {
    const double x = a.y * b.z - a.z * b.y, y = a.z * b.x - a.x * b.z, z = a.x * b.y - a.y * b.x;
    return std::atan2(std::sqrt(x * x + y * y + z * z), a.x * b.x + a.y * b.y + a.z * b.z);
}

/// Root mean squares over random positions, and the mean square slope of the exact surface.
struct SlopeErrors {
    double normal_deg = 0, jacobian = 0, steepness = 0;
};

/// Compares the normals and Jacobians of the sum of the filtered maps with those of the waves.
SlopeErrors slope_errors(const std::vector<WaveCascade>& cascades, const std::vector<unfused::CascadeSlopes>& maps,
                         const std::vector<SlopeRanges>& ranges, double choppiness, int points,
                         std::mt19937& random) {
    SlopeErrors squares;
    std::uniform_real_distribution<double> place(-2000, 2000);
    for (int p = 0; p < points; ++p) {
        const double x = place(random), z = place(random);
        SurfaceSlopes exact, shown;
        for (std::size_t t = 0; t < cascades.size(); ++t) {
            exact += exact_slopes(cascades[t], choppiness, x, z);
            shown += filtered(cascades[t], maps[t], ranges[t], x, z);
        }
        const double degrees = angle_between(normal_of(exact), normal_of(shown)) * 180 / pi;
        const double difference = normal_of(exact).y - normal_of(shown).y;
        squares.normal_deg += degrees * degrees / points;
        squares.jacobian += difference * difference / points;
        squares.steepness += (exact.h_x * exact.h_x + exact.h_z * exact.h_z) / points;
    }
    return {std::sqrt(squares.normal_deg), std::sqrt(squares.jacobian), squares.steepness};
}

class SlopesOnEachIsa : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(Isas, SlopesOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

// The bounds are the requirements for the summed texture: normals within 2 degrees, J within 0.03,
// rms. Such a stack resolves 0.038 of Cox and Munk's mean square slope in wind of 12 m/s (0.59 of
// 0.0645), evenly over the octaves from the peak, 1/16 of the first side.
TEST(SlopeSum, OfRotatedCascadesIsNearTheExactSurface) {
    constexpr int n = 128;
    constexpr double sides[] = {1000, 150, 22, 3.3}, angles[] = {0, 0.5, -0.9, 1.8};
    constexpr double choppiness = 0.8, mean_square_slope = 0.038;
    const double octaves = std::log(n / 3.0 / 3.3 / (16.0 / 1000));
    std::mt19937 random(5);
    std::vector<WaveCascade> cascades;
    std::vector<unfused::CascadeSlopes> maps;
    std::vector<SlopeRanges> ranges;
    for (std::size_t t = 0; t < 4; ++t) {
        // The band of the cascade before ends at 6 to 7 steps of this cascade.
        const double min_steps = t == 0 ? 16 : n / 3.0 * sides[t] / sides[t - 1];
        const double part = std::log(n / 3.0 / min_steps) / octaves;
        cascades.push_back(random_cascade(n, sides[t], angles[t], min_steps, part * mean_square_slope, random));
        ranges.push_back(slope_ranges(cascades[t].mean_square_slope, cascades[t].mean_square_slope));
        maps.push_back(slopes_by(kernels_for(choose_isa()), planes_of(cascades[t], choppiness), ranges[t]));
    }
    const SlopeErrors errors = slope_errors(cascades, maps, ranges, choppiness, 4000, random);
    EXPECT_NEAR(errors.steepness, mean_square_slope, 0.2 * mean_square_slope) << "the sea that the bounds are for";
    EXPECT_LE(errors.normal_deg, 2);
    EXPECT_LE(errors.jacobian, 0.03);
}

/// Returns all waves of a cascade at t = 0: h = sum of h0 e^{ikx} and its conjugate.
WaveCascade all_waves_of(const SeaState& sea, const CascadePlan& plan) {
    const CascadeGrid& grid = plan.grid;
    WaveCascade cascade{plan.resolution, grid.side_m, std::atan2(grid.sine, grid.cosine), {}, 0};
    const CascadeWaves waves(sea, plan);
    const int half = plan.resolution / 2;
    for (int n = -half; n < half; ++n) {
        for (int m = -half; m < half; ++m) {
            const std::complex<double> h0 = waves.amplitude(m, n);
            if (h0 == 0.0) continue;
            const auto [kx, kz] = grid.in_world(m * plan.spacing(), n * plan.spacing());
            cascade.waves.push_back({kx, kz, 2.0 * h0});
        }
    }
    return cascade;
}

// As above for real seas, from the sea's spectrum to the bytes of a frame. The ranges are those of
// the sea.
TEST(SlopeSum, OfAnOceansCascadesIsNearTheExactSurface) {
    for (const int cascades : {3, 4}) {
        const SeaState sea{.cascades = cascades, .wind_direction_rad = 0.7, .lean = 0};
        Ocean ocean(sea, {.executor = make_serial_executor()});
        const Frame& frame = ocean.frame_at(0);
        const std::vector<CascadePlan> plans = plan_cascades(sea);
        ASSERT_EQ(frame.cascades.size(), static_cast<std::size_t>(cascades));
        std::vector<WaveCascade> waves;
        std::vector<unfused::CascadeSlopes> maps;
        std::vector<SlopeRanges> ranges;
        for (std::size_t t = 0; t < plans.size(); ++t) {
            const Cascade& cascade = frame.cascades[t];
            waves.push_back(all_waves_of(sea, plans[t]));
            ranges.push_back(cascade.slope_ranges);
            maps.push_back({{cascade.slopes_rgba8.begin(), cascade.slopes_rgba8.end()},
                            {cascade.moments_rgba8.begin(), cascade.moments_rgba8.end()},
                            {}});
        }
        std::mt19937 random(2);
        const SlopeErrors errors = slope_errors(waves, maps, ranges, sea.choppiness, 600, random);
        EXPECT_LE(errors.normal_deg, 2) << cascades;
        EXPECT_LE(errors.jacobian, 0.03) << cascades;
    }
}

/// sin^2(t/2) / (t/2)^2 and (2 + cos t) / 3: the mean over a texel of a bilinearly filtered wave,
/// multiplied with the exact wave and with itself.
double against_wave(double t) { return std::pow(std::sin(t / 2) / (t / 2), 2); }
double against_itself(double t) { return (2 + std::cos(t)) / 3; }

/// The integral of docs/theory.md.
double filtered_error(double far_weight) {
    const double near_weight = 0.5 - 2 * far_weight, min = 2 * pi * 6 / 128, max = 2 * pi / 3;
    double error = 0;
    constexpr int lengths = 300, directions = 40;
    for (int i = 0; i < lengths; ++i) {
        for (int j = 0; j < directions; ++j) {
            const double t = min * std::pow(max / min, (i + 0.5) / lengths);
            const double direction = pi / 2 * (j + 0.5) / directions;
            const double x = t * std::cos(direction), z = t * std::sin(direction);
            const double d = 2 * near_weight * std::sin(x) + 2 * far_weight * std::sin(2 * x);
            error += (d * d * against_itself(x) * against_itself(z) - 2 * d * x * against_wave(x) * against_wave(z) +
                      x * x) /
                     (t * t) / (lengths * directions);
        }
    }
    return error;
}

TEST(SlopeStencil, IsTheBestOfItsKind) {
    const double min = filtered_error(SlopesJob::far_weight);
    EXPECT_LT(min, filtered_error(SlopesJob::far_weight - 1e-3));
    EXPECT_LT(min, filtered_error(SlopesJob::far_weight + 1e-3));
    EXPECT_NEAR(2 * SlopesJob::near_weight + 4 * SlopesJob::far_weight, 1, 1e-15) << "a constant slope";
    // Central differences, as in the paper, have an error of a quarter.
    EXPECT_LT(min, filtered_error(0) / 6);
}

// At texels a wave along x has a known slope: the factor of the stencil. A byte is within one step
// of it.
TEST_P(SlopesOnEachIsa, OneWaveHasTheFactorOfTheStencil) {
    constexpr int n = 64;
    for (const int steps : {1, 5, 13, 21}) {
        WaveCascade cascade{n, 100, 0, {{2 * pi * steps / 100, 0, {0.2 / (2 * pi * steps / 100), 0}}}, 0.02};
        const SlopeRanges ranges{0.4f, 0.1f};
        const unfused::CascadeSlopes maps = slopes_by(kernels(), planes_of(cascade, 0.5), ranges);
        const double t = 2 * pi * steps / n;
        const double factor =
            (2 * SlopesJob::near_weight * std::sin(t) + 2 * SlopesJob::far_weight * std::sin(2 * t)) / t;
        for (std::size_t i = 0; i < n; ++i) {
            const SurfaceSlopes exact = exact_slopes(cascade, 0.5, 100.0 / n * static_cast<double>(i), 0);
            const SurfaceSlopes texel = texel_of(maps, ranges, 3 * n + i);
            const double step = ranges.slope / 127.0;
            EXPECT_NEAR(texel.h_x, exact.h_x * factor, step) << steps << " steps, " << i;
            EXPECT_NEAR(texel.d_xx, exact.d_xx * factor, step) << steps << " steps, " << i;
            EXPECT_NEAR(texel.h_z, 0, 1e-9);
            EXPECT_NEAR(texel.d_zz, 0, 1e-9);
            EXPECT_NEAR(texel.d_xz, 0, 1e-9);
        }
    }
}

/// A level of the map in double.
struct Level {
    int side;
    std::vector<SurfaceSlopes> texels;  ///< mean squares instead of variances
};

double byte_around_zero(double value, double range) { return std::clamp(value / range, -1.0, 1.0) * 127 + 128; }
double byte_from_zero(double value, double range) { return std::clamp(value / range, 0.0, 1.0) * 255; }

void expect_bytes(const Level& level, const unfused::CascadeSlopes& maps, std::size_t first,
                  const SlopeRanges& ranges) {
    for (std::size_t i = 0; i < level.texels.size(); ++i) {
        const SurfaceSlopes& s = level.texels[i];
        const bool is_base = first == 0;
        const double expected[] = {
            byte_around_zero(s.h_x, ranges.slope),
            byte_around_zero(s.h_z, ranges.slope),
            byte_around_zero(s.d_xx, ranges.slope),
            byte_around_zero(s.d_zz, ranges.slope),
            byte_around_zero(s.d_xz, ranges.slope),
            byte_from_zero(is_base ? 0 : s.var_xx - s.h_x * s.h_x, ranges.variance),
            byte_from_zero(is_base ? 0 : s.var_zz - s.h_z * s.h_z, ranges.variance),
            byte_around_zero(is_base ? 0 : s.cov_xz - s.h_x * s.h_z, ranges.variance),
        };
        for (int b = 0; b < 8; ++b) {
            const std::uint32_t word = b < 4 ? maps.slopes[first + i] : maps.moments[first + i];
            ASSERT_NEAR(word >> 8 * (b % 4) & 0xFF, std::floor(expected[b] + 0.5), 1)
                << "side " << level.side << " texel " << i << " byte " << b;
        }
    }
}

Level base_level(const CascadePlanes& planes) {
    const int n = planes.resolution;
    Level level{n, {}};
    const double texel = planes.side_m / n;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const auto derivative = [&](const std::vector<float>& plane, int right, int below) {
                const auto at = [&](int steps) {
                    const int column = (i + steps * right + n) % n, row = (j + steps * below + n) % n;
                    return double{plane[static_cast<std::size_t>(row * n + column)]};
                };
                return (SlopesJob::near_weight * (at(1) - at(-1)) + SlopesJob::far_weight * (at(2) - at(-2))) / texel;
            };
            const auto along_x = [&](const std::vector<float>& plane) {
                return planes.cosine * derivative(plane, 1, 0) - planes.sine * derivative(plane, 0, 1);
            };
            const auto along_z = [&](const std::vector<float>& plane) {
                return planes.sine * derivative(plane, 1, 0) + planes.cosine * derivative(plane, 0, 1);
            };
            SurfaceSlopes s{along_x(planes.height), along_z(planes.height), along_x(planes.dx), along_z(planes.dz),
                            (along_z(planes.dx) + along_x(planes.dz)) / 2};
            s.var_xx = s.h_x * s.h_x;
            s.var_zz = s.h_z * s.h_z;
            s.cov_xz = s.h_x * s.h_z;
            level.texels.push_back(s);
        }
    }
    return level;
}

Level halved(const Level& finer) {
    Level level{finer.side / 2, {}};
    for (int j = 0; j < finer.side; j += 2) {
        for (int i = 0; i < finer.side; i += 2) {
            SurfaceSlopes sum;
            for (const int texel : {0, 1, finer.side, finer.side + 1})
                sum += finer.texels[static_cast<std::size_t>(j * finer.side + i + texel)];
            level.texels.push_back({sum.h_x / 4, sum.h_z / 4, sum.d_xx / 4, sum.d_zz / 4, sum.d_xz / 4,
                                    sum.var_xx / 4, sum.var_zz / 4, sum.cov_xz / 4});
        }
    }
    return level;
}

/// A third of the variance among four texels is that of bilinear interpolation between them.
Level as_shown(Level level) {
    const auto third = [](double square, double product) { return product + (square - product) / 3; };
    for (SurfaceSlopes& s : level.texels) {
        s.var_xx = third(s.var_xx, s.h_x * s.h_x);
        s.var_zz = third(s.var_zz, s.h_z * s.h_z);
        s.cov_xz = third(s.cov_xz, s.h_x * s.h_z);
    }
    return level;
}

// Values may round to either side of a step, so one step is the best possible bound.
TEST_P(SlopesOnEachIsa, BytesOfEveryLevelAreWithinOneStepOfDoubles) {
    std::mt19937 random(11);
    for (const double angle : {0.0, 2.2}) {
        const WaveCascade cascade = random_cascade(64, 20, angle, 3, 0.02, random);
        const CascadePlanes planes = planes_of(cascade, 0.9);
        // Narrower than real ranges, so that some values are clamped.
        const SlopeRanges ranges{static_cast<float>(2 * std::sqrt(0.02)), 0.02f};
        const unfused::CascadeSlopes maps = slopes_by(kernels(), planes, ranges);
        Level level = base_level(planes);
        expect_bytes(level, maps, 0, ranges);
        level = as_shown(halved(level));
        for (int number = 1;; ++number, level = halved(level)) {
            expect_bytes(level, maps, mip_offset(64, number), ranges);
            if (level.side == 1) break;
        }
    }
}

/// The law of total variance: returns the variance of a level's means plus the mean of its
/// variances, of h_x, h_z and both.
std::array<double, 3> total_variance(const unfused::CascadeSlopes& maps, const SlopeRanges& ranges, int resolution,
                                     int level) {
    std::array<double, 3> total{};
    const auto side = static_cast<std::size_t>(resolution) >> level;
    for (std::size_t i = 0; i < side * side; ++i) {
        const SurfaceSlopes s = texel_of(maps, ranges, mip_offset(resolution, level) + i);
        const double texels = static_cast<double>(side * side);
        total[0] += (s.var_xx + s.h_x * s.h_x) / texels;
        total[1] += (s.var_zz + s.h_z * s.h_z) / texels;
        total[2] += (s.cov_xz + s.h_x * s.h_z) / texels;
    }
    return total;
}

// The single texel of the last level may be off by half a step of a byte. Rounding slopes to bytes
// adds only a twelfth of a step squared. Compared with the waves: the filtered slopes keep the
// waves' mean square to a few hundredths, which is the purpose of the stencil.
TEST(SlopeMips, KeepTheRoughnessOfEveryLevel) {
    constexpr int n = 128;
    std::mt19937 random(3);
    for (const double angle : {0.0, 1.1}) {
        const WaveCascade cascade = random_cascade(n, 22, angle, 6, 0.01, random);
        const SlopeRanges ranges = slope_ranges(cascade.mean_square_slope, cascade.mean_square_slope);
        const unfused::CascadeSlopes maps = slopes_by(kernels_for(choose_isa()), planes_of(cascade, 0.8), ranges);
        std::array<double, 3> exact{};
        for (const SlopeWave& wave : cascade.waves) {
            exact[0] += wave.kx * wave.kx * std::norm(wave.amplitude) / 2;
            exact[1] += wave.kz * wave.kz * std::norm(wave.amplitude) / 2;
            exact[2] += wave.kx * wave.kz * std::norm(wave.amplitude) / 2;
        }
        RecordProperty(
            "kept_of_mean_square_slope_" + std::to_string(angle),
            std::to_string((total_variance(maps, ranges, n, 1)[0] + total_variance(maps, ranges, n, 1)[1]) /
                           (exact[0] + exact[1])));
        const double step = ranges.variance / 127.0;
        const std::array<double, 3> first = total_variance(maps, ranges, n, 1);
        for (int level = 1; level < mip_levels(n); ++level) {
            const std::array<double, 3> total = total_variance(maps, ranges, n, level);
            for (std::size_t i = 0; i < 3; ++i) {
                EXPECT_NEAR(total[i], first[i], step / 2) << "level " << level << ", " << i;
                EXPECT_NEAR(total[i], exact[i], 0.06 * (exact[0] + exact[1])) << "level " << level << ", " << i;
            }
        }
    }
}

// At level 0 the filtered surface has that variance too, so the roughness does not change where
// mips begin.
TEST(SlopeMips, BeginWithTheFilteredVarianceOfLevel0) {
    constexpr int n = 128;
    std::mt19937 random(4);
    const WaveCascade cascade = random_cascade(n, 22, 0.4, 6, 0.01, random);
    const SlopeRanges ranges = slope_ranges(cascade.mean_square_slope, cascade.mean_square_slope);
    const unfused::CascadeSlopes maps = slopes_by(kernels_for(choose_isa()), planes_of(cascade, 0.8), ranges);
    std::uniform_real_distribution<double> place(0, 22);
    double shown = 0;
    constexpr int points = 20000;
    for (int p = 0; p < points; ++p) {
        const SurfaceSlopes at = filtered(cascade, maps, ranges, place(random), place(random));
        shown += (at.h_x * at.h_x + at.h_z * at.h_z) / points;
    }
    const std::array<double, 3> first = total_variance(maps, ranges, n, 1);
    // The mean of 20000 squares of a Gaussian has a standard deviation of a hundredth. These values
    // are not independent.
    EXPECT_NEAR(first[0] + first[1], shown, 0.05 * shown);
}

// Flat water is exactly flat: a byte represents zero.
TEST_P(SlopesOnEachIsa, StillWaterIsFlatAndSmooth) {
    const std::vector<float> zero(32 * 32);
    const unfused::CascadeSlopes maps = slopes_by(kernels(), {32, 10, 1, 0, zero, zero, zero}, slope_ranges(0, 0));
    for (std::size_t i = 0; i < maps.slopes.size(); ++i) {
        const SurfaceSlopes s = texel_of(maps, {1, 1}, i);
        for (const double value : {s.h_x, s.h_z, s.d_xx, s.d_zz, s.d_xz, s.var_xx, s.var_zz, s.cov_xz})
            ASSERT_EQ(value, 0) << i;
    }
    const SurfaceNormal up = normal_of(SurfaceSlopes{});
    EXPECT_EQ(up.x, 0);
    EXPECT_EQ(up.y, 1);
    EXPECT_EQ(up.z, 0);
}

// The same water on a rotated cascade, with its displacement rotated: normals rotate, J and
// smoothness stay. Floats round differently, so a byte may differ by one step and a normal of two
// bytes by a corresponding angle.
TEST_P(SlopesOnEachIsa, GradientsOfARotatedCascadeRotateWithIt) {
    std::mt19937 random(9);
    const CascadePlanes planes = planes_of(random_cascade(64, 20, 0, 3, 0.03, random), 0.8);
    CascadePlanes turned = planes;
    turned.cosine = 0.6f;
    turned.sine = 0.8f;
    for (std::size_t i = 0; i < planes.dx.size(); ++i) {
        turned.dx[i] = 0.6f * planes.dx[i] - 0.8f * planes.dz[i];
        turned.dz[i] = 0.8f * planes.dx[i] + 0.6f * planes.dz[i];
    }
    const Gradients straight = gradients_by(kernels(), planes, true), askew = gradients_by(kernels(), turned, true);
    for (std::size_t i = 0; i < straight.texels.size(); ++i) {
        const auto byte = [&](const Gradients& from, int number) {
            return static_cast<double>(from.texels[i] >> 8 * number & 0xFF);
        };
        const double x = byte(straight, 0) - 127.5, z = byte(straight, 1) - 127.5;
        ASSERT_NEAR(byte(askew, 0) - 127.5, 0.6 * x - 0.8 * z, 2) << i;
        ASSERT_NEAR(byte(askew, 1) - 127.5, 0.8 * x + 0.6 * z, 2) << i;
        ASSERT_NEAR(byte(askew, 2), byte(straight, 2), 1) << i;
        ASSERT_NEAR(byte(askew, 3), byte(straight, 3), 1) << i;
    }
}

TEST_P(SlopesOnEachIsa, GradientsDoNotDependOnTheHalves) {
    std::mt19937 random(10);
    const CascadePlanes planes = planes_of(random_cascade(64, 20, 0, 3, 0.03, random), 0.8);
    const Gradients with = gradients_by(kernels(), planes, true), without = gradients_by(kernels(), planes, false);
    EXPECT_EQ(with.texels, without.texels);
    EXPECT_EQ(std::count(without.halves.begin(), without.halves.end(), 0),
              static_cast<std::ptrdiff_t>(without.halves.size()));
}

CascadePlanes planes_of(const Cascade& cascade) {
    CascadePlanes planes{cascade.resolution(),
                         cascade.grid.side_m,
                         static_cast<float>(cascade.grid.cosine),
                         static_cast<float>(cascade.grid.sine),
                         {},
                         {},
                         {}};
    for (int j = 0; j < cascade.resolution(); ++j) {
        for (int i = 0; i < cascade.resolution(); ++i) {
            planes.dx.push_back(cascade.dx.at(i, j));
            planes.height.push_back(cascade.height.at(i, j));
            planes.dz.push_back(cascade.dz.at(i, j));
        }
    }
    return planes;
}

void expect_slopes(const Cascade& cascade, const unfused::CascadeSlopes& expected) {
    EXPECT_TRUE(std::equal(cascade.slopes_rgba8.begin(), cascade.slopes_rgba8.end(), expected.slopes.begin(),
                           expected.slopes.end()));
    EXPECT_TRUE(std::equal(cascade.moments_rgba8.begin(), cascade.moments_rgba8.end(), expected.moments.begin(),
                           expected.moments.end()));
}

TEST(SlopesOfFrames, AreOptionalForOneCascadeAndChangeNoHash) {
    const SeaState sea{.resolution = 64, .patch_size_m = 60};
    Ocean plain(sea, {.executor = make_serial_executor()});
    Ocean asked(sea, {.executor = make_serial_executor(), .slopes = true});
    const Frame& without = plain.frame_at(3);
    const Frame& with = asked.frame_at(3);
    EXPECT_TRUE(without.cascades[0].slopes_rgba8.empty());
    EXPECT_TRUE(without.cascades[0].moments_rgba8.empty());
    EXPECT_EQ(hash_of(with), hash_of(without));
    EXPECT_GT(asked.memory_bytes(), plain.memory_bytes());
    const Cascade& cascade = with.cascades[0];
    expect_slopes(cascade, unfused::slopes_of(planes_of(cascade), cascade.slope_ranges));

    // The ranges follow from the waves: their mean square slope by the definition.
    const CascadePlan plan = plan_cascades(sea)[0];
    const CascadeWaves waves(sea, plan);
    double mean_square_slope = 0;
    for (int n = 0; n < 32; ++n) {
        for (int m = -31; m < 32; ++m) {
            if (n == 0 && m <= 0) continue;
            const auto [along, against] = waves.variances(m, n).plus;
            const double k = plan.spacing() * std::hypot(m, n);
            mean_square_slope += 2 * k * k * (along + against);
        }
    }
    EXPECT_NEAR(cascade.slope_ranges.slope, 4 * std::sqrt(mean_square_slope), 1e-6);
    EXPECT_NEAR(cascade.slope_ranges.variance, 3 * mean_square_slope, 1e-6);

    std::vector<std::uint32_t> slopes(cascade.slopes_rgba8.size()), moments(slopes.size());
    FrameBuffers buffers{.slopes_rgba8 = slopes, .moments_rgba8 = moments};
    asked.frame_at(3, buffers);
    EXPECT_TRUE(std::equal(slopes.begin(), slopes.end(), cascade.slopes_rgba8.begin(), cascade.slopes_rgba8.end()));
    EXPECT_TRUE(
        std::equal(moments.begin(), moments.end(), cascade.moments_rgba8.begin(), cascade.moments_rgba8.end()));
    EXPECT_EQ(message_of([&] { plain.frame_at(3, buffers); }),
              "slopes_rgba8 is requested, but the ocean was created without slopes");
}

// A frame of two cascades whose displacement the test writes.
TEST(SlopesOfFrames, ProduceTheHalvesAndTheHashOfSeveralCascades) {
    std::mt19937 random(12);
    const Kernels& kernels = kernels_for(choose_isa());
    FrameSlots slots(2, 32, kernels.lanes, {.gradients = false, .slopes = true});
    SurfaceStages first(slots, 0, kernels), second(slots, 1, kernels);
    JobGraph graph;
    const StageId surface_done = graph.add({.name = "surface", .count = 1, .body = [](std::size_t, std::size_t) {}});
    first.add_to(graph, surface_done);
    second.add_to(graph, surface_done);
    const WaveCascade waves[] = {random_cascade(32, 100, 0, 2, 0.02, random),
                                 random_cascade(32, 13, 0.7, 3, 0.02, random)};
    for (std::size_t t = 0; t < 2; ++t) {
        const CascadePlanes planes = planes_of(waves[t], 0.8);
        slots.buffers(t).surface = surface_of(planes, kernels.lanes);
        // The views of the buffer that was there before.
        slots.cascade(t).dx.data = slots.buffers(t).surface.data();
        slots.cascade(t).height.data = slots.buffers(t).surface.data() + surface_height * kernels.lanes;
        slots.cascade(t).dz.data = slots.buffers(t).surface.data() + surface_dz * kernels.lanes;
        slots.cascade(t).grid = {waves[t].side_m, std::cos(waves[t].angle_rad), std::sin(waves[t].angle_rad)};
        slots.cascade(t).slope_ranges = slope_ranges(waves[t].mean_square_slope, waves[t].mean_square_slope);
    }
    const auto executor = make_serial_executor();
    const auto run = executor->prepare(graph);
    run->schedule();
    run->complete();
    for (std::size_t t = 0; t < 2; ++t) {
        const Cascade& cascade = slots.cascade(t);
        const CascadePlanes planes = planes_of(waves[t], 0.8);
        const unfused::CascadeSlopes expected = unfused::slopes_of(planes, cascade.slope_ranges);
        expect_slopes(cascade, expected);
        EXPECT_TRUE(std::equal(cascade.displacement_rgba16f.begin(), cascade.displacement_rgba16f.end(),
                               expected.halves.begin(), expected.halves.end()));
        EXPECT_TRUE(cascade.gradient_rgba8.empty());
    }
    const std::uint64_t hash = hash_of(slots.frame());
    slots.buffers(1).moments[5] ^= 1;
    EXPECT_NE(hash_of(slots.frame()), hash);
    slots.buffers(1).moments[5] ^= 1;
    EXPECT_EQ(hash_of(slots.frame()), hash);
    const std::vector<std::uint32_t> gradients(mip_offset(32, mip_levels(32)));
    slots.cascade(0).gradient_rgba8 = gradients;
    EXPECT_EQ(hash_of(slots.frame()), hash) << "gradients beside slopes are an option";
}

}  // namespace
}  // namespace pelagic
