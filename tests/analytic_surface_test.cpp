// The analytic surface, compared with sums in long double by libm and with Gerstner's exact wave,
// and checked for independence of the order of evaluation.
#include "pelagic/analytic/analytic_surface.hpp"

#include <cfenv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "pelagic/analytic/wave_phase.hpp"
#include "pelagic/tests/analytic_points.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/message_of.hpp"

namespace pelagic {
namespace {

constexpr Long gravity = 9.80665L;

struct Truth {
    Long height = 0, x = 0, z = 0;  // displacement
    Long slope_x = 0, slope_z = 0;  // of the height, by reference position
    Long xx = 0, xz = 0, zz = 0;    // derivatives of the displacement
    Long velocity[3] = {};
    Long jacobian() const { return (1 + xx) * (1 + zz) - xz * xz; }
};

/// The sums as the header defines them, written plainly, without optimisation.
Truth truth(const AnalyticSea& sea, Long time_s, Long x, Long z) {
    Truth sum;
    for (const AnalyticWave& wave : sea.waves) {
        const Long k = 2 * long_pi / wave.wavelength_m, w = std::sqrt(gravity * k), a = wave.amplitude_m,
                   moved = sea.choppiness * a;
        const Long direction_x = std::cos(Long{wave.direction_rad}), direction_z = std::sin(Long{wave.direction_rad});
        const Long phase = k * (direction_x * x + direction_z * z) - w * time_s + wave.phase_rad;
        const Long s = std::sin(phase), c = std::cos(phase);
        sum.height += a * c;
        sum.x -= moved * direction_x * s;
        sum.z -= moved * direction_z * s;
        sum.slope_x -= a * k * direction_x * s;
        sum.slope_z -= a * k * direction_z * s;
        sum.xx -= moved * k * direction_x * direction_x * c;
        sum.xz -= moved * k * direction_x * direction_z * c;
        sum.zz -= moved * k * direction_z * direction_z * c;
        sum.velocity[0] += moved * direction_x * w * c;
        sum.velocity[1] += a * w * s;
        sum.velocity[2] += moved * direction_z * w * c;
    }
    return sum;
}

struct Sampled {
    enum Kind {
        height,
        horizontal_x,
        horizontal_z,
        normal_x,
        normal_y,
        normal_z,
        jacobian,
        velocity_x,
        velocity_y,
        velocity_z,
        kinds
    };
    explicit Sampled(std::size_t count) : of(kinds, std::vector<float>(count)) {}
    AnalyticSamples view() { return {of[0], of[1], of[2], of[3], of[4], of[5], of[6], of[7], of[8], of[9]}; }
    std::uint64_t hash() const { return hash_of(of); }
    std::vector<std::vector<float>> of;
};

Sampled sample_undisplaced(const AnalyticSurface& water, double time_s, const AnalyticPositions& positions) {
    Sampled answers(positions.x.size());
    water.sample_undisplaced(time_s, positions.view(), answers.view());
    return answers;
}

Sampled in_world(const AnalyticSurface& water, double time_s, const AnalyticPositions& positions) {
    Sampled answers(positions.x.size());
    water.sample(time_s, positions.view(), answers.view());
    return answers;
}

const AnalyticSea& intense() { return analytic_preset_named("analytic-intense")->sea; }

/// The steepest sea that is accepted, with a short steep wave on a high long one: Newton's method
/// alone would diverge far from the solution.
AnalyticSea short_on_long() {
    return {.waves = {{.amplitude_m = 12, .wavelength_m = 500, .direction_rad = 0.3},
                      {.amplitude_m = 0.0124, .wavelength_m = 0.316, .direction_rad = -1, .phase_rad = 2}}};
}

AnalyticSea sixty_four_waves() {
    std::mt19937 random(5);
    const auto one = [&] { return static_cast<double>(random()) * 0x1p-32; };
    AnalyticSea sea{.waves = {}, .choppiness = 0.9};
    for (int i = 0; i < 64; ++i) {
        const double part = one(), wavelength_m = 1 + 199 * part * part * part;
        sea.waves.push_back(
            {.006 * wavelength_m / (2 * std::numbers::pi), wavelength_m, 6 * one() - 3, 6 * one() - 3});
    }
    return sea;
}

class AnalyticOnEachIsa : public testing::TestWithParam<Isa> {};
INSTANTIATE_TEST_SUITE_P(Isas, AnalyticOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

// The bound of the header. Normals and Jacobians depend on slopes below 1; their bound is 1e-6 of
// their largest value.
TEST_P(AnalyticOnEachIsa, IsTheSumOfItsWaves) {
    for (const AnalyticSea& sea : {intense(), sixty_four_waves()}) {
        const AnalyticSurface water(sea, GetParam());
        Long amplitude = 0, speed = 0, shortest = 1e9;
        for (const AnalyticWave& wave : sea.waves) {
            amplitude += wave.amplitude_m;
            speed += wave.amplitude_m * std::sqrt(gravity * 2 * long_pi / wave.wavelength_m);
            shortest = std::min(shortest, Long{wave.wavelength_m});
        }
        for (const auto& [reach_m, time_s] :
             {std::pair(100.0, 0.0), {100.0, -7654.3}, {1e6 * double(shortest), 1e6}}) {
            const AnalyticPositions positions = random_positions(150, reach_m);
            const Sampled sampled = sample_undisplaced(water, time_s, positions);
            for (std::size_t i = 0; i < positions.x.size(); ++i) {
                const Truth t = truth(sea, time_s, positions.x[i], positions.z[i]);
                const Long n[3] = {t.slope_z * t.xz - t.slope_x * (1 + t.zz), t.jacobian(),
                                   t.slope_x * t.xz - t.slope_z * (1 + t.xx)};
                const Long length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
                const Long right[] = {t.height,      t.x,          t.z,           n[0] / length, n[1] / length,
                                      n[2] / length, t.jacobian(), t.velocity[0], t.velocity[1], t.velocity[2]};
                const Long scale[] = {amplitude, amplitude, amplitude, 1, 1, 1, 1, speed, speed, speed};
                for (int kind = 0; kind < Sampled::kinds; ++kind)
                    ASSERT_NEAR(sampled.of[kind][i], rounded(right[kind]), rounded(1e-6L * scale[kind]))
                        << "kind " << kind << " at " << reach_m;
            }
        }
    }
}

TEST_P(AnalyticOnEachIsa, SurfaceFoundForAWorldPointIsDisplacedThere) {
    for (const AnalyticSea& sea : {intense(), short_on_long(), sixty_four_waves()}) {
        const AnalyticSurface water(sea, GetParam());
        const AnalyticPositions positions = random_positions(600, 3000);
        const Sampled sampled = in_world(water, 55, positions);
        AnalyticPositions rest;
        for (std::size_t i = 0; i < positions.x.size(); ++i) {
            rest.x.push_back(positions.x[i] - double{sampled.of[Sampled::horizontal_x][i]});
            rest.z.push_back(positions.z[i] - double{sampled.of[Sampled::horizontal_z][i]});
        }
        for (std::size_t i = 0; i < positions.x.size(); ++i) {
            const Truth t = truth(sea, 55, rest.x[i], rest.z[i]);
            ASSERT_LE(std::hypot(rest.x[i] + t.x - positions.x[i], rest.z[i] + t.z - positions.z[i]),
                      AnalyticSurface::tolerance_m);
            // The search stops within half of the tolerance, on faces of slope 0.4; and floats lose
            // 1.2e-5 at wave heights of 12 m.
            ASSERT_NEAR(sampled.of[Sampled::height][i], rounded(t.height), 4e-5);
        }
    }
}

// r' <= r min(s, c r), with c from choppiness and sum A. For this sea s = 0.4 and c = 6: the
// fixed-point iteration reduces the error to 7 cm, then Newton's method takes over.
TEST(AnalyticSearch, NumberOfStepsIsTheProvenBound) {
    EXPECT_EQ(AnalyticSurface(analytic_preset_named("analytic-calm")->sea).max_search_steps(), 3);
    EXPECT_EQ(AnalyticSurface(intense()).max_search_steps(), 6);
    const int max = AnalyticSurface(short_on_long()).max_search_steps();
    const int all_by_fixed_point = 1 + int(std::ceil(std::log(12.0124 / 5e-5) / std::log(1 / 0.4)));
    EXPECT_GT(max, 6);
    EXPECT_LE(max, all_by_fixed_point);
}

// The FNV-1a hash of all samples is equal on every instruction set, compiler and processor.
TEST_P(AnalyticOnEachIsa, SamplesHaveTheGoldenHash) {
    const AnalyticSurface water(sixty_four_waves(), GetParam());
    EXPECT_EQ(sample_undisplaced(water, 1234.5, random_positions(1003, 5000)).hash(), 13589754078015390544u);
    EXPECT_EQ(in_world(water, 1234.5, random_positions(1003, 5000)).hash(), 7045321192955639590u);
}

TEST_P(AnalyticOnEachIsa, PointsDoNotDependOnTheirBatch) {
    const AnalyticSurface water(intense(), GetParam());
    const AnalyticPositions positions = random_positions(200, 300);
    const Sampled all = in_world(water, 9, positions);
    for (const std::size_t i : {0u, 15u, 16u, 127u, 128u, 199u}) {
        const Sampled alone = in_world(water, 9, {{positions.x[i]}, {positions.z[i]}});
        for (int kind = 0; kind < Sampled::kinds; ++kind) EXPECT_EQ(alone.of[kind][0], all.of[kind][i]);
        float height_alone = 0;
        water.sample(9, {{&positions.x[i], 1}, {&positions.z[i], 1}}, {.height_m = {&height_alone, 1}});
        EXPECT_EQ(height_alone, all.of[Sampled::height][i]);
    }
}

TEST_P(AnalyticOnEachIsa, ApplicationsRoundingModeDoesNotMatter) {
    const std::uint64_t hash = in_world(AnalyticSurface(intense(), GetParam()), 9, random_positions(100, 300)).hash();
    std::fesetround(FE_UPWARD);
    const std::uint64_t upwards =
        in_world(AnalyticSurface(intense(), GetParam()), 9, random_positions(100, 300)).hash();
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(upwards, hash);
}

TEST(AnalyticTime, SamplesDoNotDependOnTheOrderOfTimes) {
    const AnalyticSurface water(intense());
    const AnalyticPositions positions = random_positions(64, 300);
    std::vector<std::uint64_t> forwards;
    for (int frame = 0; frame < 50; ++frame) forwards.push_back(in_world(water, frame / 72.0, positions).hash());
    for (int frame = 49; frame >= 0; --frame)
        EXPECT_EQ(in_world(water, frame / 72.0, positions).hash(), forwards[static_cast<std::size_t>(frame)]);
    std::mt19937 random(3);
    for (int i = 0; i < 50; ++i) {
        const int frame = static_cast<int>(random() % 50);
        EXPECT_EQ(in_world(AnalyticSurface(intense()), frame / 72.0, positions).hash(),
                  forwards[static_cast<std::size_t>(frame)]);
    }
    EXPECT_NE(forwards[0], forwards[1]);
}

// 0.1 is stored as 3602879701896397 / 2^55, so ten of them exceed a turn by 2 / 2^55.
TEST(AnalyticTime, TurnsAreExactProducts) {
    EXPECT_EQ(turned(0.1, 10), 1024u);
    EXPECT_EQ(turned(0.1, -10), std::uint64_t{0} - 1024);
    EXPECT_EQ(turned(0.25, 3), 0xC000000000000000u);
    EXPECT_EQ(turned(0.25, 3e300), 0u);
    EXPECT_EQ(turned(0.3, 0), 0u);
    std::mt19937_64 random(2);
    for (int i = 0; i < 1000; ++i) {
        const auto one = [&] { return static_cast<double>(random()) * 0x1p-64; };
        const double f = 8 * one(), long_s = std::floor(one() * 0x1p50), short_s = std::floor(one() * 4096);
        // Each of the three products is truncated to 2^-64 of a turn.
        EXPECT_LE(turned(f, long_s + short_s) - turned(f, long_s) - turned(f, short_s), 1u);
    }
    for (const double time_s : {5e-324, 1e-300, 1e18, 1.7976931348623157e308})
        EXPECT_EQ(turned(0.123, time_s) + turned(0.123, -time_s), 0u) << time_s;
}

TEST(AnalyticTime, AnyFiniteTimeGivesFiniteSamples) {
    const AnalyticSurface water(intense());
    for (const double time_s : {-1e308, -1e20, 5e-324, 1e12, 1e308}) {
        const Sampled sampled = in_world(water, time_s, random_positions(20, 10));
        for (const float at : sampled.of[Sampled::height]) EXPECT_LE(std::fabs(at), 3.f);
    }
}

// Lamb 1932, article 229: waves 100 m long have a period of 8.004 s and a phase speed of 12.49 m/s.
TEST(AnalyticPhysics, WavesTravelAtTheDeepWaterPhaseSpeed) {
    for (const auto& [wavelength_m, period_s] : {std::pair(100.0, 8.0044), {25.0, 4.0022}, {1.0, 0.80044}}) {
        const AnalyticSea sea{.waves = {{.amplitude_m = wavelength_m / 100, .wavelength_m = wavelength_m}}};
        const AnalyticSurface water(sea);
        const AnalyticPositions positions = random_positions(100, wavelength_m);
        AnalyticPositions ahead = positions;
        for (double& x : ahead.x) x += wavelength_m / period_s * 3;
        const Sampled before = sample_undisplaced(water, 0, positions), after = sample_undisplaced(water, 3, ahead);
        // The period is given to five digits: after 3 s the crest is within 1e-5 of 3 s / period of
        // its exact position.
        for (std::size_t i = 0; i < positions.x.size(); ++i)
            EXPECT_NEAR(after.of[Sampled::height][i], before.of[Sampled::height][i],
                        wavelength_m / 100 * 2 * std::numbers::pi * 3 / period_s * 2e-5);
    }
}

// Gerstner 1802 (Lamb 1932, article 251): x = a - A e^kb sin(k a - w t), y = b + A e^kb cos(k a - w
// t) solves Euler's equations.
class Trochoid : public testing::Test {
   protected:
    static constexpr double wavelength_m = 20, k = 2 * std::numbers::pi / wavelength_m, amplitude_m = 0.38 / k;
    /// The surface of particles that are `depth_m` below the mean surface in still water.
    static AnalyticSurface at_depth(double depth_m) {
        return AnalyticSurface(
            {.waves = {{.amplitude_m = amplitude_m * std::exp(-k * depth_m), .wavelength_m = wavelength_m}}});
    }
};

TEST_F(Trochoid, ParticlesMoveOnCircles) {
    const AnalyticSurface water = at_depth(0);
    const double w = std::sqrt(9.80665 * k);
    const AnalyticPositions positions{{3.3}, {-8}};
    for (int i = 0; i < 40; ++i) {
        const double t = 0.13 * i, phase = k * 3.3 - w * t;
        const Sampled at = sample_undisplaced(water, t, positions);
        EXPECT_NEAR(at.of[Sampled::horizontal_x][0], -amplitude_m * std::sin(phase), 1e-6 * amplitude_m);
        EXPECT_NEAR(at.of[Sampled::height][0], amplitude_m * std::cos(phase), 1e-6 * amplitude_m);
        EXPECT_NEAR(std::hypot(at.of[Sampled::horizontal_x][0], at.of[Sampled::height][0]), amplitude_m,
                    1e-6 * amplitude_m);
        EXPECT_NEAR(std::hypot(at.of[Sampled::velocity_x][0], at.of[Sampled::velocity_y][0]), amplitude_m * w,
                    1e-6 * amplitude_m * w);
        EXPECT_EQ(at.of[Sampled::horizontal_z][0], 0);
    }
}

// Water is incompressible: d(x, y)/d(a, b) = 1 - (k A)^2 e^2kb for all a and t. Derivatives are
// differences over 1 cm of floats of about half a metre.
TEST_F(Trochoid, JacobianIsConstantOnALayer) {
    const double b = 0.4, step = 0.01;
    const AnalyticSurface above = at_depth(b - step), below = at_depth(b + step);
    const double right = 1 - 0.38 * 0.38 * std::exp(-2 * k * b);
    for (int i = 0; i < 50; ++i) {
        const double a = 0.77 * i, t = 0.31 * i;
        const Sampled up = sample_undisplaced(above, t, {{a - step, a, a + step}, {0, 0, 0}}),
                      down = sample_undisplaced(below, t, {{a - step, a, a + step}, {0, 0, 0}});
        const auto d_a = [&](Sampled::Kind kind) {
            return double(up.of[kind][2] - up.of[kind][0] + down.of[kind][2] - down.of[kind][0]) / (4 * step);
        };
        const auto d_b = [&](Sampled::Kind kind) { return double(up.of[kind][1] - down.of[kind][1]) / (2 * step); };
        const double found = (1 + d_a(Sampled::horizontal_x)) * (1 + d_b(Sampled::height)) -
                             d_b(Sampled::horizontal_x) * d_a(Sampled::height);
        EXPECT_NEAR(found, right, 3e-5);
    }
}

// The pressure is constant along the surface: acceleration minus gravity is normal to it.
TEST_F(Trochoid, SurfacePressureIsConstant) {
    const AnalyticSurface water = at_depth(0);
    const double step = 1.0 / 64;
    for (int i = 0; i < 50; ++i) {
        const AnalyticPositions positions{{0.9 * i}, {0}};
        const double t = 0.17 * i;
        const Sampled before = sample_undisplaced(water, t - step, positions),
                      at = sample_undisplaced(water, t, positions),
                      after = sample_undisplaced(water, t + step, positions);
        const double a_x = (after.of[Sampled::velocity_x][0] - before.of[Sampled::velocity_x][0]) / (2 * step);
        const double a_y = (after.of[Sampled::velocity_y][0] - before.of[Sampled::velocity_y][0]) / (2 * step);
        // The component along the tangent. Central differences over 1/64 s lose
        // (w / 64)^2 / 6 = 1.2e-4 of the acceleration, k A g.
        EXPECT_NEAR(a_x * at.of[Sampled::normal_y][0] - (a_y + 9.80665) * at.of[Sampled::normal_x][0], 0,
                    2e-4 * 0.38 * 9.80665);
    }
}

TEST(AnalyticDerivatives, NormalsAndVelocitiesMatchFiniteDifferences) {
    const AnalyticSea sea = intense();
    const AnalyticPositions positions = random_positions(60, 500);
    const Sampled sampled = sample_undisplaced(AnalyticSurface(sea), 12, positions);
    const Long step = 1e-5L;
    const auto drawn = [&](Long t, Long x, Long z) {
        const Truth at = truth(sea, t, x, z);
        return std::array<Long, 3>{x + at.x, at.height, z + at.z};
    };
    const auto slope = [&](const std::array<Long, 3>& a, const std::array<Long, 3>& b) {
        return std::array<Long, 3>{(b[0] - a[0]) / (2 * step), (b[1] - a[1]) / (2 * step),
                                   (b[2] - a[2]) / (2 * step)};
    };
    for (std::size_t i = 0; i < positions.x.size(); ++i) {
        const Long x = positions.x[i], z = positions.z[i];
        const auto u = slope(drawn(12, x - step, z), drawn(12, x + step, z)),
                   v = slope(drawn(12, x, z - step), drawn(12, x, z + step));
        const Long n[3] = {v[1] * u[2] - v[2] * u[1], v[2] * u[0] - v[0] * u[2], v[0] * u[1] - v[1] * u[0]};
        const Long length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(sampled.of[Sampled::normal_x + axis][i], rounded(n[axis] / length), 2e-6);
        EXPECT_NEAR(sampled.of[Sampled::jacobian][i], rounded(n[1]), 2e-6);
        const auto moves = slope(drawn(12 - step, x, z), drawn(12 + step, x, z));
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(sampled.of[Sampled::velocity_x + axis][i], rounded(moves[axis]), 1e-5);
    }
}

TEST(AnalyticSurface, RejectsASeaThatIsTooSteep) {
    AnalyticSea sea{.waves = {{.amplitude_m = 1, .wavelength_m = 12}}};
    EXPECT_EQ(message_of([&] { AnalyticSurface water(sea); }),
              "steepness is 0.523599, expected at most 0.4, the sum of 2 pi amplitude_m / wavelength_m");
    sea.waves[0].amplitude_m = 0.4 * 12 / (2 * std::numbers::pi);
    EXPECT_NO_THROW(AnalyticSurface{sea});
}

TEST(AnalyticSurface, RejectsPointsAndArraysItCannotTake) {
    const AnalyticSurface water(intense());
    const AnalyticPositions positions = random_positions(3, 10);
    std::vector<float> two(2);
    EXPECT_EQ(message_of([&] { in_world(water, std::nan(""), positions); }), "time_s is nan, expected a finite number");
    EXPECT_EQ(message_of([&] { in_world(water, 0, {{std::nan("")}, {0}}); }),
              "a coordinate nan is out of range [-1e9, 1e9]");
    EXPECT_EQ(message_of([&] { in_world(water, 0, {{0}, {1.1e9}}); }),
              "a coordinate 1100000000 is out of range [-1e9, 1e9]");
    EXPECT_EQ(message_of([&] { water.sample(0, positions.view(), {.height_m = two}); }),
              "an array differs in length from the points, expected as many or none");
}

// The example of docs/sea-state.md.
TEST(AnalyticExample, SamplesFollowATransition) {
    std::vector<float> seen;
    for (const double time_s : {0.0, 30.0, 60.0}) {
        const AnalyticSea& calm = analytic_preset_named("analytic-calm")->sea;
        const AnalyticSea& rough = analytic_preset_named("analytic-intense")->sea;
        // the transition takes a minute
        const AnalyticSurface water(morphed(calm, rough, time_s / 60));
        const std::vector<double> xs{12, 30}, zs{-3, 5};
        std::vector<float> heights(2), velocities(2);
        water.sample(time_s, {.x = xs, .z = zs}, {.height_m = heights});
        water.sample(time_s, {.x = xs, .z = zs}, {.velocity_y_mps = velocities});
        seen.push_back(heights[0]);
        for (const float velocity : velocities) EXPECT_LE(std::fabs(velocity), 5);
    }
    EXPECT_EQ(seen.size(), 3u);
    EXPECT_NE(seen[0], seen[2]);
}

}  // namespace
}  // namespace pelagic
