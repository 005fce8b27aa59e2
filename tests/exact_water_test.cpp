// Water by the exact sum over waves: against sums in double with libm, frames, and conservation laws.
#include "pelagic/sim/exact_water.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/dispersion.hpp"
#include "pelagic/sim/water_jobs.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/spectrum/amplitudes.hpp"
#include "pelagic/tests/each_isa.hpp"

namespace pelagic::exact_water {
namespace {

using std::numbers::pi;

constexpr double gravity = 9.80665, density = 1025;

/// depth_m, pressure_pa, velocity and acceleration, in the order of WaterSamples.
constexpr std::size_t quantities = 8;
using Water8 = std::array<double, quantities>;

struct Points {
    std::vector<double> x, y, z;

    void add(double at_x, double at_y, double at_z) { x.push_back(at_x), y.push_back(at_y), z.push_back(at_z); }
    WaterPoints points() const { return {x, y, z}; }
};

struct Results {
    explicit Results(std::size_t count) : all(quantities, std::vector<float>(count, 77.f)) {}
    WaterSamples samples() { return {all[0], all[1], all[2], all[3], all[4], all[5], all[6], all[7]}; }
    double of(std::size_t quantity, std::size_t point) const { return static_cast<double>(all[quantity][point]); }

    std::vector<std::vector<float>> all;
};

Results sampled(const ExactWater& water, const Points& points) {
    Results results(points.x.size());
    water.sample(points.points(), results.samples());
    return results;
}

/// All waves of a sea by definition. Only amplitudes and the list of frequencies are the library's.
class SlowWater {
   public:
    explicit SlowWater(const SeaState& sea) {
        for (const CascadePlan& plan : plan_cascades(sea)) {
            const CascadeWaves of(sea, plan);
            depth_m_ = of.water().depth_m;
            const int half = plan.resolution / 2;
            for (int n = 1 - half; n < half; ++n) {
                for (int m = 1 - half; m < half; ++m) {
                    const std::complex<double> h0 = of.holds(m, n) ? of.amplitude(m, n) : 0;
                    if (std::norm(h0) == 0) continue;
                    const auto [kx, kz] = plan.grid.in_world(m * plan.spacing(), n * plan.spacing());
                    const double k = std::hypot(m, n) * plan.spacing();
                    const double periods = std::max(1.0, std::round(of.frequency(k) * sea.loop_period_s / (2 * pi)));
                    waves_.push_back({kx, kz, k, 2 * pi * periods / sea.loop_period_s, h0});
                }
            }
        }
    }

    double variance() const {
        double sum = 0;
        for (const Wave& wave : waves_) sum += 2 * std::norm(wave.h0);
        return sum;
    }
    double height(double x, double z, double t) const {
        double sum = 0;
        for (const Wave& wave : waves_) sum += 2 * (wave.h0 * turned(wave, x, z, t)).real();
        return sum;
    }
    Water8 at(double x, double y, double z, double t) const {
        const double surface = height(x, z, t), s = depth_m_ * (surface - y) / (depth_m_ + surface);
        double head = 0, velocity[3] = {}, slope[3] = {};
        for (const Wave& wave : waves_) {
            const std::complex<double> h = 2.0 * wave.h0 * turned(wave, x, z, t);
            const double kd = wave.k * depth_m_, up = wave.k * (depth_m_ - s);
            const bool is_deep = kd > 300;  // cosh overflows beyond 710
            const double cosh_cosh = is_deep ? std::exp(-wave.k * s) : std::cosh(up) / std::cosh(kd);
            const double sinh_cosh = is_deep ? cosh_cosh : std::sinh(up) / std::cosh(kd);
            const double cosh_sinh = is_deep ? cosh_cosh : std::cosh(up) / std::sinh(kd);
            const double sinh_sinh = is_deep ? cosh_cosh : std::sinh(up) / std::sinh(kd);
            head += cosh_cosh * h.real();
            velocity[0] += wave.omega * cosh_sinh * h.real() * wave.kx / wave.k;
            velocity[1] += wave.omega * sinh_sinh * h.imag();
            velocity[2] += wave.omega * cosh_sinh * h.real() * wave.kz / wave.k;
            slope[0] -= wave.kx * cosh_cosh * h.imag();
            slope[1] += wave.k * sinh_cosh * h.real();
            slope[2] -= wave.kz * cosh_cosh * h.imag();
        }
        return {surface - y, density * gravity * (head - y), velocity[0],          velocity[1],
                velocity[2], -gravity * slope[0],            -gravity * slope[1], -gravity * slope[2]};
    }

   private:
    struct Wave {
        double kx, kz, k, omega;
        std::complex<double> h0;
    };
    static std::complex<double> turned(const Wave& wave, double x, double z, double t) {
        const long double phase = static_cast<long double>(wave.kx) * x + static_cast<long double>(wave.kz) * z -
                                  static_cast<long double>(wave.omega) * t;
        const auto within = static_cast<double>(std::fmod(phase, 2 * std::numbers::pi_v<long double>));
        return {std::cos(within), std::sin(within)};
    }

    double depth_m_ = 0;
    std::vector<Wave> waves_;
};

/// A quarter of the loop and a later one, which fractions of 32 bits hold exactly.
constexpr std::array<double, 2> times_of_loops = {0.25, 7.6875};

void expect_equals_the_slow_sum(const SeaState& sea, double reach_m, int columns, const char* name) {
    ASSERT_EQ(check(sea), "");
    ExactWater water(sea);
    const SlowWater truth(sea);
    // Further down, floats have larger steps of depth and pressure.
    const double sigma = std::sqrt(truth.variance()), deepest_m = std::min(water.depth_m(), 60.0);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> anywhere(-reach_m, reach_m);
    std::array<double, quantities> error{}, square{};
    for (const double loops : times_of_loops) {
        const double time_s = loops * sea.loop_period_s;
        water.set_time(time_s);
        Points points;
        for (int i = 0; i < columns; ++i) {
            const double x = anywhere(random), z = anywhere(random), height = truth.height(x, z, time_s);
            for (const double y : {-deepest_m, -4 * sigma, -sigma, 0.25 * height, 0.999 * height, height - 1e-3})
                if (y >= -deepest_m && y < height) points.add(x, y, z);
        }
        const Results results = sampled(water, points);
        for (std::size_t i = 0; i < points.x.size(); ++i) {
            const Water8 exact = truth.at(points.x[i], points.y[i], points.z[i], time_s);
            for (std::size_t quantity = 0; quantity < quantities; ++quantity) {
                // The hydrostatic pressure is no part of the waves.
                const double still = quantity == 1 ? -density * gravity * points.y[i] : 0;
                const double at = quantity == 0 ? sigma : exact[quantity] - still;
                const double difference = results.of(quantity, i) - exact[quantity];
                error[quantity] += difference * difference;
                square[quantity] += at * at;
            }
        }
    }
    for (std::size_t quantity = 0; quantity < quantities; ++quantity) {
        if (square[quantity] == 0) continue;
        EXPECT_LT(error[quantity], 1e-10 * square[quantity])
            << name << " quantity " << quantity << ": " << std::sqrt(error[quantity] / square[quantity]);
    }
}

// The error of a float is 3e-8, and phases are within 2e-6 turns (N = 512).
TEST(ExactWater, EqualsASlowSumAtAnyDepth) {
    for (const double depth_m : {5.0, 20.0, 4000.0}) {
        const SeaState sea{.cascades = 2, .resolution = 64, .wind_speed_mps = 9, .depth_m = depth_m};
        expect_equals_the_slow_sum(sea, 3000, 12, ("depth" + std::to_string(depth_m)).c_str());
    }
}

TEST(ExactWater, EqualsASlowSumOfManyWavesFarAway) {
    SeaState sea{.resolution = 512, .patch_size_m = 700, .depth_m = 20, .swell_height_m = 1, .seed = 5};
    expect_equals_the_slow_sum(sea, 1e6, 2, "far");
}

TEST(ExactWater, EqualsASlowSumOfListedWaves) {
    SeaState sea{.waves = WaveModel::analytic};
    expect_equals_the_slow_sum(sea, 3000, 12, "analytic");
    sea = {.waves = WaveModel::regular, .wind_direction_rad = 0.7, .depth_m = 12, .choppiness = 0};
    for (const int order : {1, 2}) {
        sea.order = order;
        expect_equals_the_slow_sum(sea, 3000, 12, "regular");
    }
}

/// Returns the undisplaced position of a texel.
CascadeGrid::Vector place_of(const Cascade& cascade, int i, int j) {
    return cascade.grid.in_world(i * cascade.texel_m(), j * cascade.texel_m());
}

// Heights of frames have errors of 1e-6 of their maximum.
TEST(ExactWater, HasTheHeightsAndVelocitiesOfFrames) {
    const SeaState spectrum{.resolution = 64, .patch_size_m = 250};
    const SeaState shallow{.resolution = 32, .patch_size_m = 90, .depth_m = 4};
    const SeaState analytic{.waves = WaveModel::analytic, .cascades = 1, .resolution = 128};
    SeaState regular{.waves = WaveModel::regular, .wind_direction_rad = 0.5, .depth_m = 9, .order = 2};
    for (SeaState sea : {spectrum, shallow, analytic, regular}) {
        sea.choppiness = 0;
        ASSERT_EQ(check(sea), "");
        Ocean ocean(sea, {.executor = make_serial_executor(), .velocities = Velocities::drawn});
        ExactWater water(sea);
        for (const double time_s : {0.0, 12.375, -98765.4321}) {
            const Cascade& cascade = ocean.frame_at(time_s).cascades[0];
            water.set_time(time_s);
            Points points;
            for (int i = 0; i < 30; ++i) {
                const auto [x, z] = place_of(cascade, i * 7 % cascade.resolution(), i * 5 % cascade.resolution());
                points.add(x, 0, z);
            }
            std::vector<float> height(30), rise(30);
            water.sample_surface({points.x, points.z}, {.height_m = height, .velocity_y_mps = rise});
            const double bound = 3e-6 * static_cast<double>(cascade.bounds.height_max_m);
            for (int i = 0; i < 30; ++i) {
                const int column = i * 7 % cascade.resolution(), row = i * 5 % cascade.resolution();
                const auto at = static_cast<std::size_t>(i);
                EXPECT_NEAR(static_cast<double>(height[at]), static_cast<double>(cascade.height.at(column, row)), bound)
                    << name_of(sea.waves) << ' ' << time_s;
                EXPECT_NEAR(static_cast<double>(rise[at]), static_cast<double>(cascade.velocity_y.at(column, row)),
                            10 * bound)
                    << name_of(sea.waves) << ' ' << time_s;
            }
        }
    }
}

TEST(ExactWater, AddsAllCascadesOfAFrame) {
    SeaState sea{.resolution = 64};
    sea.choppiness = 0;
    Ocean ocean(sea, {.executor = make_serial_executor()});
    for (const double time_s : {1.0, 250.5, 3333.25}) {
        double sum = 0;
        for (const Cascade& cascade : ocean.frame_at(time_s).cascades)
            sum += static_cast<double>(cascade.height.at(0, 0));
        std::vector<double> origin = {0};
        std::vector<float> height(1);
        ExactWater(sea).at(time_s).sample_surface({origin, origin}, {.height_m = height});
        EXPECT_NEAR(static_cast<double>(height[0]), sum, 1e-5);
    }
}

TEST(ExactWater, HasNoPressureAtTheSurfaceAndAboveIt) {
    const ExactWater water = ExactWater({.resolution = 64}).at(20.5);
    Points points;
    for (int i = 0; i < 200; ++i) points.add(13.7 * i, 0, -3.1 * i);
    std::vector<float> height(points.x.size());
    water.sample_surface({points.x, points.z}, {.height_m = height});
    for (std::size_t i = 0; i < height.size(); ++i) points.y[i] = static_cast<double>(height[i]);
    const Results surface = sampled(water, points);
    for (double& y : points.y) y += 0.01;
    const Results air = sampled(water, points);
    for (std::size_t i = 0; i < height.size(); ++i) {
        EXPECT_NEAR(surface.of(0, i), 0, 4e-7);  // heights are floats
        EXPECT_NEAR(surface.of(1, i), 0, 4e-3);
        EXPECT_NEAR(air.of(0, i), -0.01, 4e-7);
        EXPECT_NEAR(air.of(1, i), -0.01 * 1025 * gravity_mps2, 0.05);
        // the motion is that of the surface
        for (std::size_t quantity = 2; quantity < quantities; ++quantity)
            EXPECT_NEAR(air.of(quantity, i), surface.of(quantity, i), 1e-5) << quantity;
    }
}

/// A swell of a centimetre, so that Wheeler's stretching, whose share is k a, has none. Long loops keep
/// frequencies within 7e-5.
SeaState low_swell() {
    return {.spectrum = SpectrumModel::none,
            .resolution = 32,
            .patch_size_m = 900,
            .depth_m = 20,
            .swell_height_m = 0.01,
            .swell_spread_rad = 0.5,
            .loop_period_s = 86400};
}

TEST(ExactWater, ConservesVolumeAndMomentum) {
    const SeaState sea = low_swell();
    ExactWater water(sea);
    const double tick_s = sea.loop_period_s / 0x1p32, dt = 512 * tick_s, t = 0x1p24 * tick_s, step = 0.5;
    std::array<double, 4> error{}, square{};
    for (int i = 0; i < 40; ++i) {
        const double x = 77.3 * i, y = -1 - 0.4 * i, z = -41.9 * i;
        Points around;
        for (const double sign : {1.0, -1.0}) {
            around.add(x + sign * step, y, z), around.add(x, y + sign * step, z), around.add(x, y, z + sign * step);
        }
        Points here;
        here.add(x, y, z);
        water.set_time(t);
        const Results sides = sampled(water, around), now = sampled(water, here);
        water.set_time(t - dt);
        const Results before = sampled(water, here);
        water.set_time(t + dt);
        const Results after = sampled(water, here);
        double divergence = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double derivative = (sides.of(2 + axis, axis) - sides.of(2 + axis, axis + 3)) / (2 * step);
            divergence += derivative;
            square[3] += derivative * derivative;
            const double rate = (after.of(2 + axis, 0) - before.of(2 + axis, 0)) / (2 * dt);
            error[axis] += std::pow(rate - now.of(5 + axis, 0), 2);
            square[axis] += std::pow(now.of(5 + axis, 0), 2);
        }
        error[3] += divergence * divergence;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_LT(std::sqrt(error[axis] / square[axis]), 1e-3) << axis;
    EXPECT_LT(std::sqrt(error[3] / square[3]), 1e-3);
}

// Airy: both energies are rho g / 2 times the variance of the height. Waves that run against each other
// exchange some of them.
TEST(ExactWater, HasEqualKineticAndPotentialEnergy) {
    const SeaState sea = low_swell();
    const ExactWater water(sea);
    const SlowWater truth(sea);
    constexpr int side = 32, levels = 40;
    double kinetic = 0, squares = 0;
    for (int level = 0; level <= levels; ++level) {
        Points points;
        for (int i = 0; i < side * side; ++i)
            points.add(900.0 / side * (i % side), -0.02 - (20 - 0.02) * level / levels, 900.0 / side * (i / side));
        const Results results = sampled(water, points);
        double sum = 0;
        for (std::size_t i = 0; i < points.x.size(); ++i)
            for (const std::size_t axis : {2u, 3u, 4u}) sum += std::pow(results.of(axis, i), 2);
        const double simpson = level == 0 || level == levels ? 1 : level % 2 == 1 ? 4 : 2;
        kinetic += 0.5 * sum / (side * side) * simpson * 20.0 / levels / 3;
        if (level > 0) continue;
        for (std::size_t i = 0; i < points.x.size(); ++i) squares += std::pow(results.of(0, i) + points.y[i], 2);
    }
    const double potential = 0.5 * gravity * squares / (side * side), mean = 0.5 * gravity * truth.variance();
    EXPECT_NEAR(potential / mean, 1, 3e-3);
    EXPECT_NEAR(kinetic / mean, 1, 3e-3);
    EXPECT_NEAR((potential + kinetic) / mean, 2, 1e-3);
}

TEST(ExactWater, MovesWithTheSeaLevelAndTheCurrent) {
    const SeaState sea{.cascades = 2, .resolution = 32, .depth_m = 8};
    const WaterFrame frame{.sea_level_m = 3, .current_x_mps = 1.5, .current_z_mps = -0.5};
    const ExactWater still = ExactWater(sea).at(10), moved = ExactWater(sea, {.water_frame = frame}).at(10);
    Points points, world;
    points.add(4, -2, 7), points.add(-40, -8, 3);
    for (std::size_t i = 0; i < 2; ++i) world.add(points.x[i] + 15, points.y[i] + 3, points.z[i] - 5);
    const Results results = sampled(still, points), lifted = sampled(moved, world);
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t quantity = 0; quantity < quantities; ++quantity)
            EXPECT_NEAR(lifted.of(quantity, i),
                        results.of(quantity, i) + (quantity == 2 ? 1.5 : quantity == 4 ? -0.5 : 0), 1e-6);
}

class ExactWaterOnEachIsa : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(On, ExactWaterOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

TEST_P(ExactWaterOnEachIsa, HasTheBitsOfEveryOtherAndOfAnyThreads) {
    const auto executor = make_thread_executor(3);
    Points points;
    for (int i = 0; i < 300; ++i) points.add(31.7 * i, 2.0 - 0.05 * i, 1e4 - 77.7 * i);
    for (const double depth_m : {20.0, 4000.0}) {
        const SeaState sea{.resolution = 64, .depth_m = depth_m};
        const ExactWater first = ExactWater(sea, {.isa = isas_here().front()}).at(34.5);
        const ExactWater water = ExactWater(sea, {.executor = executor, .isa = GetParam()}).at(34.5);
        const Results expected = sampled(first, points);
        Results results(points.x.size());
        WaterJobs(executor).sample(water, points.points(), results.samples());
        for (std::size_t quantity = 0; quantity < quantities; ++quantity)
            EXPECT_EQ(std::memcmp(results.all[quantity].data(), expected.all[quantity].data(), 4 * points.x.size()), 0)
                << quantity;
    }
}

// The error of the polynomial, and that of the exponent, a float.
TEST_P(ExactWaterOnEachIsa, DecaysExponentiallyWithDepth) {
    constexpr std::size_t waves = WaveBlock::partial_sums;
    alignas(64) std::array<std::uint32_t, waves> none{};
    alignas(64) std::array<float, waves> steps, zeros{}, one{};
    steps.fill(1);
    one[0] = 1;
    const WaveBlock block{none.data(), none.data(),  steps.data(), nullptr, one.data(),
                          zeros.data(), zeros.data(), zeros.data(), waves};
    for (int i = 0; i <= 20000; ++i) {
        const float x = static_cast<float>(i) * 1e-3f;
        std::array<double, SumWaterJob::sums> sums{};
        kernels().sum_water(
            {.waves = block, .x = none.data(), .z = none.data(), .decay = &x, .points = 1, .all = sums.data()});
        const double exact = std::exp(-static_cast<double>(x));
        ASSERT_NEAR(sums[SumWaterJob::head] / exact, 1, 2e-7 + 1e-7 * static_cast<double>(x)) << x;
        if (i == 0) {
            EXPECT_EQ(sums[SumWaterJob::head], 1);
        }
    }
}

TEST(ExactWater, HasNoSampleAtPositionsThatAreNotFinite) {
    const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    const ExactWater water({.cascades = 1, .resolution = 32});
    Points points;
    points.add(nan, 0, 0), points.add(0, inf, 0), points.add(0, -inf, 0), points.add(0, 0, 1e300), points.add(0, -1, 0);
    const Results results = sampled(water, points);
    for (const auto& values : results.all) {
        for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(std::bit_cast<std::uint32_t>(values[i]), 0x7fc00000u) << i;
        EXPECT_TRUE(std::isfinite(values[4]));
    }
    std::vector<float> height(5), error(5);
    std::vector<std::uint8_t> converged(5);
    water.sample_surface({points.x, points.z}, {.height_m = height, .error_m = error, .converged = converged});
    EXPECT_TRUE(std::isnan(height[0]) && std::isinf(error[3]) && converged[3] == 0);
    EXPECT_TRUE(converged[4] == 1 && error[4] == 0);
}

std::string error_of(const auto& run) {
    try {
        run();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "none";
}

TEST(ExactWater, RejectsInvalidInputOnOneLine) {
    const SeaState sea{.cascades = 1, .resolution = 32, .depth_m = 50};
    const ExactWater water(sea, {.water_frame = {.sea_level_m = 10}});
    std::vector<double> x(2), y = {0, -40.5}, z(2);
    std::vector<float> out(2, 7.f), shorter(1);
    EXPECT_EQ(error_of([&] { water.sample({x, y, z}, {.pressure_pa = out}); }),
              "y[1] is -40.5, expected at least -40, the sea floor");
    EXPECT_EQ(out[0], 7.f);
    y[1] = -40;
    EXPECT_EQ(error_of([&] { water.sample({x, y, z}, {.pressure_pa = out}); }), "none");
    EXPECT_EQ(error_of([&] { water.sample({x, y, z}, {.depth_m = shorter}); }),
              "depth_m has 1 elements, expected 2 or none");
    EXPECT_EQ(error_of([&] { water.sample({x, {}, z}, {.depth_m = out}); }),
              "y has 0 elements, expected 2, as x has");
    EXPECT_EQ(error_of([&] { water.sample_surface({x, z}, {.foam = out}); }), "exact water has no foam");
    EXPECT_EQ(error_of([&] { ExactWater({.waves = WaveModel::pond}); }),
              "waves is pond, expected spectrum, analytic or regular");
    EXPECT_EQ(error_of([&] { ExactWater(sea, {.water_density_kgpm3 = 0}); }),
              "water_density_kgpm3 0 is out of range [500, 2000]");
    EXPECT_EQ(error_of([&] { (void)water.at(std::nan("")); }), "time_s is nan, expected a finite number");
    EXPECT_EQ(error_of([&] { ExactWater({.wind_speed_mps = -3}); }), "wind_speed_mps -3 is out of range (0, 60]");
}

}  // namespace
}  // namespace pelagic::exact_water
