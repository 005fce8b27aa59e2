// Physical tests of dynamic waves: dispersion, energy, borders and wakes, compared with analytic
// solutions and a slow oracle in double.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/tests/dynamic_wave_pool.hpp"
#include "pelagic/tests/kelvin_wake.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;

/// Options without border, viscosity and decay, so that only the step acts.
DynamicWavesOptions bare(DynamicWavesStep step, int resolution = 64, double side_m = 32) {
    return {.step = step,
            .resolution = resolution,
            .side_m = side_m,
            .ticks_per_s = 30,
            .border_m = 0,
            .viscosity_m2ps = 0,
            .wave_speed_mps = 6,
            .decay_per_s = 0};
}

/// Height h and companion w of a travelling wave; kx and kz are in rad/m.
struct RunningWave {
    double kx, kz, omega, texel_m, amplitude = 0.1;
    double phase(std::int64_t x, std::int64_t z, double time_s) const {
        return (kx * static_cast<double>(x) + kz * static_cast<double>(z)) * texel_m - omega * time_s;
    }
    double height(std::int64_t x, std::int64_t z, double time_s) const {
        return amplitude * std::cos(phase(x, z, time_s));
    }
    /// (dh/dt) / omega.
    double companion(std::int64_t x, std::int64_t z, double time_s) const {
        return amplitude * std::sin(phase(x, z, time_s));
    }
};

TEST(DynamicWavesWaves, TravelAtTheSpeedOfDeepAndShallowWater) {
    for (const double depth : {1e4, 2.0, 0.3}) {
        for (const auto& [i, j] : {std::pair{1, 0}, {3, 5}, {-7, 2}, {0, 13}}) {
            DynamicWavesOptions options = bare(DynamicWavesStep::spectral);
            options.depth_m = depth;
            DynamicWavePool pool(options);
            const double step = 2 * pi / options.side_m, k = step * std::hypot(i, j);
            const double omega = std::sqrt((9.80665 * k + 0.074 / 1025 * k * k * k) * std::tanh(k * depth));
            const RunningWave wave{step * i, step * j, omega, pool.grid.texel_m()};
            fill(
                pool.grid, [&](auto x, auto z) { return wave.height(x, z, 0); },
                [&](auto x, auto z) { return wave.companion(x, z, 0); });
            pool.tick(100);
            double worst = 0;
            sum_over(pool.grid, [&](auto x, auto z) {
                return worst = std::max(worst, std::fabs(pool.grid.height_m(x, z) - wave.height(x, z, 100.0 / 30)));
            });
            // Cosine and sine of a tick's phase are floats, in error by up to 6e-8 in the same
            // direction in each of 100 ticks. The transforms add rounding errors.
            EXPECT_LT(worst, 2e-5 * wave.amplitude) << i << ", " << j << " at " << depth << " m";
        }
    }
}

// The dispersion relation of the discrete step without decay:
// sin^2(omega dt / 2) = c (sin^2(kx dx / 2) + sin^2(kz dx / 2)). To lowest order omega = speed k.
TEST(DynamicWavesWaves, OfVerletFollowItsDiscreteDispersionRelation) {
    const DynamicWavesOptions options = bare(DynamicWavesStep::verlet);
    for (const auto& [i, j] : {std::pair{1, 0}, {3, 5}, {-7, 2}, {0, 13}}) {
        DynamicWavePool pool(options);
        const double step = 2 * pi / options.side_m, texel = pool.grid.texel_m(), tick = pool.grid.tick_s();
        const double courant = options.wave_speed_mps * tick / texel;
        const double omega =
            2 / tick *
            std::asin(courant * std::hypot(std::sin(step * i * texel / 2), std::sin(step * j * texel / 2)));
        if (std::abs(i) + std::abs(j) == 1) {
            EXPECT_NEAR(omega / (options.wave_speed_mps * step), 1, 1e-2);
        }
        const RunningWave wave{step * i, step * j, omega, texel};
        fill(
            pool.grid, [&](auto x, auto z) { return wave.height(x, z, 0); },
            [&](auto x, auto z) { return wave.height(x, z, -tick); });
        pool.tick(100);
        double worst = 0;
        sum_over(pool.grid, [&](auto x, auto z) {
            return worst = std::max(worst, std::fabs(pool.grid.height_m(x, z) - wave.height(x, z, 100 * tick)));
        });
        // Rounding errors of (2 h - h_before) grow with the square of the number of ticks, divided
        // by the phase per tick, at least 0.04: 1e4 / 2 x 6e-8.
        EXPECT_LT(worst, 3e-4 * wave.amplitude) << i << ", " << j;
    }
}

/// Parameters of a wave along x with decay: h'' + 2 decay h' = speed^2 lap h has the solution
/// e^(-decay t) cos(k x - omega t), where omega^2 = (speed k)^2 - decay^2.
struct DecayingWave {
    double decay_per_s, side_m, speed_mps;
    int ticks_per_s, waves;
};

TEST(DynamicWavesWaves, OfVerletHaveTheSetDecayAndSpeed) {
    for (const DecayingWave& set : {DecayingWave{0.01, 40, 3, 60, 1},
                                    {0.01, 40, 3, 60, 2},
                                    {0.08, 40, 3, 60, 1},
                                    {0.5, 20, 3, 60, 4},
                                    {3, 6, 3, 120, 5},
                                    {10, 6, 6, 240, 9}}) {
        DynamicWavesOptions options = bare(DynamicWavesStep::verlet, 128, set.side_m);
        options.decay_per_s = set.decay_per_s;
        options.wave_speed_mps = set.speed_mps;
        options.ticks_per_s = set.ticks_per_s;
        DynamicWavePool pool(options);
        const double k = 2 * pi * set.waves / set.side_m, tick = pool.grid.tick_s(), texel = pool.grid.texel_m();
        const double omega = std::sqrt(std::pow(set.speed_mps * k, 2) - std::pow(set.decay_per_s, 2));
        ASSERT_GT(omega, 5 * set.decay_per_s);
        const RunningWave wave{k, 0, omega, texel};
        fill(
            pool.grid, [&](auto x, auto z) { return wave.height(x, z, 0); },
            [&](auto x, auto z) { return wave.height(x, z, -tick) * std::exp(set.decay_per_s * tick); });
        const auto moment = [&] {
            std::complex<double> sum;
            sum_over(pool.grid, [&](auto x, auto z) {
                sum += static_cast<double>(pool.grid.height_m(x, z)) * std::polar(1.0, -k * texel * double(x));
                return 0.0;
            });
            return sum;
        };
        const std::complex<double> first = moment();
        // Sampled every eighth of a period, so that the phase is unambiguous.
        const double seconds = std::min(3 / set.decay_per_s, 20 * pi / omega);
        const int ticks = static_cast<int>(seconds / tick),
                  apart = std::max(1, static_cast<int>(0.25 * pi / omega / tick));
        std::complex<double> before = first;
        double turned = 0;
        int done = 0;
        while (done < ticks) {
            const int some = std::min(apart, ticks - done);
            pool.tick(some);
            done += some;
            const std::complex<double> now = moment();
            turned -= std::arg(now / before);
            before = now;
        }
        const double amplitude = std::abs(before / first), time_s = done * tick;
        // Each tick multiplies the wave by e^(-decay tick). The initial state is a solution of the
        // continuous equation. On the grid a small fraction, half the relative error of the speed,
        // travels in the opposite direction.
        EXPECT_NEAR(amplitude / std::exp(-set.decay_per_s * time_s), 1, 5e-3) << set.decay_per_s;
        // Spatial differences slow waves down by (k texel)^2 / 24, time differences speed them up
        // by (omega tick)^2 / 24: 0.8 % at 9 waves of 128 texels.
        EXPECT_NEAR(turned / time_s / omega, 1, 1e-2) << set.decay_per_s << ", " << set.waves;
        if (omega > 20 * set.decay_per_s) {
            EXPECT_NEAR(turned / time_s / k, set.speed_mps, 1e-2 * set.speed_mps);
        }
    }
}

// Decay acts on waves only: a constant level of the grid does not decay, with or without waves on
// it.
TEST(DynamicWavesWaves, OfVerletKeepTheMeanLevel) {
    DynamicWavesOptions options = bare(DynamicWavesStep::verlet);
    options.decay_per_s = 0.5;
    DynamicWavePool pool(options);
    const double step = 2 * pi / options.side_m;
    const auto height = [&](auto x, auto z) {
        return 0.3 + 0.1 * std::cos(step * pool.grid.texel_m() * (2 * double(x) - 3 * double(z)));
    };
    fill(pool.grid, height, height);
    for (int second = 1; second <= 20; ++second) {
        pool.tick(options.ticks_per_s);
        const double mean = sum_over(pool.grid, [&](auto x, auto z) { return pool.grid.height_m(x, z); }) / 4096;
        // Floats near 0.3 m are spaced by 3e-8, and 64 of them are distinct, so rounding changes
        // the mean by 2e-9 per tick at random. Decay removes such a change after about 30 ticks:
        // 600 changes give 2e-9 x 30 sqrt(600) = 1.5e-6 rms. The bound is six times that.
        EXPECT_NEAR(mean, 0.3, 1e-5) << "after " << second << " s";
    }
}

struct Shown {
    /// rows and columns, wrapped periodically
    std::vector<double> height_m, vertical_velocity_mps;
};

/// What a frame shows at `fraction` in [0, 1] of the time between the last two ticks.
Shown shown(const DynamicWaveGrid& grid, double fraction) {
    const auto n = static_cast<std::size_t>(grid.options().resolution);
    AlignedBuffer<float> height(n * n), rise(n * n), edge(n);
    std::vector<std::uint8_t> foam(n * n);
    for (std::size_t item = 0; item < n / DynamicWaveGrid::rows_per_item; ++item)
        grid.interpolate(static_cast<float>(fraction), item,
                         {height.data(), rise.data(), foam.data(), edge.data(), edge.data()});
    return {{height.data(), height.data() + n * n}, {rise.data(), rise.data() + n * n}};
}

// At omega = 4.4 rad/s, a difference between ticks is half a tick (3.7 %) early or late. The
// derivative of a parabola through three ticks has a relative error of (3 fraction^2 - 1) / 6
// (omega tick)^2, at most 0.18 %. Terms of (omega tick)^3 = 4e-4 add less than a quarter of that
// value.
TEST(DynamicWavesWaves, VerticalVelocityMatchesTheShownTime) {
    for (const DynamicWavesStep step : {DynamicWavesStep::spectral, DynamicWavesStep::verlet}) {
        DynamicWavesOptions options = bare(step);
        options.ticks_per_s = 60;
        DynamicWavePool pool(options);
        const bool is_verlet = step == DynamicWavesStep::verlet;
        const double tick = pool.grid.tick_s(), texel = pool.grid.texel_m();
        const double k = 2 * pi / options.side_m * (is_verlet ? 4 : 10);
        const double omega =
            is_verlet ? 2 / tick * std::asin(options.wave_speed_mps * tick / texel * std::sin(k * texel / 2))
                      : std::sqrt(9.80665 * k + 0.074 / 1025 * k * k * k);
        ASSERT_NEAR(omega, is_verlet ? 4.7 : 4.4, 0.05);
        const RunningWave wave{k, 0, omega, texel};
        fill(
            pool.grid, [&](auto x, auto z) { return wave.height(x, z, 0); },
            [&](auto x, auto z) { return is_verlet ? wave.height(x, z, -tick) : wave.companion(x, z, 0); });
        pool.tick(8);
        for (const double fraction : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            const Shown water = shown(pool.grid, fraction);
            const double time_s = (7 + fraction) * tick;
            double worst = 0;
            for (std::int64_t x = 0; x < options.resolution; ++x) {
                const double rise = wave.amplitude * omega * std::sin(wave.phase(x, 0, time_s));
                worst = std::max(worst, std::fabs(water.vertical_velocity_mps[static_cast<std::size_t>(x)] - rise));
            }
            const double turned = omega * tick,
                         bound = std::fabs(3 * fraction * fraction - 1) / 6 * turned * turned + 1e-4;
            EXPECT_LT(worst / (wave.amplitude * omega), bound) << fraction << (is_verlet ? " Verlet" : " spectral");
        }
    }
}

// An impulse adds its height at once, with zero velocity. The water then falls with at most
// -h'' = height g sqrt(pi) / radius (deep water; the integral of e^(-k^2 radius^2 / 4) k^2 dk,
// times height radius^2 g / 2). A parabola overestimates that by a factor of up to 1.5 within a
// tick.
TEST(DynamicWavesWaves, OfImpulsesStartWithZeroVelocity) {
    DynamicWavePool pool({.resolution = 64, .side_m = 16, .border_m = 3});
    const double drop_m = 0.4;
    pool.tick(2);
    pool.grid.sources().add_impulse({.mode = Disturbance::Mode::impulse, .radius_m = 1, .height_m = drop_m});
    pool.tick();
    EXPECT_NEAR(shown(pool.grid, 0).height_m[0], drop_m, 1e-6);
    const double fastest = 1.5 * drop_m * 9.80665 * std::sqrt(pi) * pool.grid.tick_s();
    for (int tick = 0; tick < 2; ++tick, pool.tick())
        for (const double fraction : {0.0, 0.5, 1.0}) {
            const double rise = shown(pool.grid, fraction).vertical_velocity_mps[0];
            EXPECT_LE(rise, 0) << tick << ' ' << fraction;
            EXPECT_GT(rise, -(tick + 1) * fastest) << tick << ' ' << fraction;
        }
}

/// One step by definition: z_k exp(-i omega dt - (2 nu k^2 + decay) dt), as sums in double.
std::vector<std::complex<double>> stepped(const std::vector<std::complex<double>>& z, const DynamicWavesOptions& o) {
    const int n = o.resolution;
    const auto size = static_cast<std::size_t>(n);
    std::vector<std::complex<double>> roots(size);
    for (std::size_t i = 0; i < size; ++i) roots[i] = std::polar(1.0, 2 * pi * static_cast<double>(i) / n);
    const auto along = [&](const std::vector<std::complex<double>>& in, bool forward, bool rows) {
        std::vector<std::complex<double>> out(in.size());
        for (std::size_t line = 0; line < size; ++line)
            for (std::size_t k = 0; k < size; ++k) {
                std::complex<double> sum = 0;
                for (std::size_t i = 0; i < size; ++i) {
                    const auto root = roots[k * i % size];
                    sum += in[rows ? line * size + i : i * size + line] * (forward ? std::conj(root) : root);
                }
                out[rows ? line * size + k : k * size + line] = sum;
            }
        return out;
    };
    auto waves = along(along(z, true, true), true, false);
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column) {
            const double step = 2 * pi / o.side_m;
            const double k = step * std::hypot(std::min(row, n - row), std::min(column, n - column));
            const double omega = std::sqrt((9.80665 * k + 0.074 / 1025 * k * k * k) * std::tanh(k * o.depth_m));
            const double dt = 1.0 / o.ticks_per_s;
            waves[static_cast<std::size_t>(row * n + column)] *=
                std::polar(std::exp(-(2 * o.viscosity_m2ps * k * k + o.decay_per_s) * dt) / (n * n), -omega * dt);
        }
    return along(along(waves, false, true), false, false);
}

TEST(DynamicWavesWaves, StepMatchesAnOracleInDouble) {
    DynamicWavesOptions options = bare(DynamicWavesStep::spectral);
    options.viscosity_m2ps = 0.01;
    options.decay_per_s = 0.5;
    options.depth_m = 3;
    DynamicWavePool pool(options);
    pool.grid.sources().add_impulse(
        {.mode = Disturbance::Mode::impulse, .x_m = 1.3, .z_m = -2, .radius_m = 1.5, .height_m = 0.7});
    pool.tick(3);
    const std::size_t n = 64;
    std::vector<std::complex<double>> z(n * n);
    const auto place = [&](std::int64_t x, std::int64_t row) {
        return static_cast<std::size_t>(row & 63) * n + static_cast<std::size_t>(x & 63);
    };
    double largest = 0;
    sum_over(pool.grid, [&](auto x, auto row) {
        z[place(x, row)] = {pool.grid.height_m(x, row), pool.grid.companion_m(x, row)};
        return largest = std::max(largest, std::abs(z[place(x, row)]));
    });
    const auto after = stepped(z, options);
    pool.tick();
    double worst = 0;
    sum_over(pool.grid, [&](auto x, auto row) {
        const std::complex<double> texel(pool.grid.height_m(x, row), pool.grid.companion_m(x, row));
        return worst = std::max(worst, std::abs(texel - after[place(x, row)]));
    });
    // Two float transforms, forward and backward; a frame's transforms are specified within 2e-6 of
    // the largest value.
    EXPECT_LT(worst, 2e-6 * largest);
}

double spectral_energy(const DynamicWaveGrid& grid) {
    return sum_over(grid, [&](auto x, auto z) {
        return std::norm(std::complex<double>(grid.height_m(x, z), grid.companion_m(x, z)));
    });
}

/// The energy that Verlet's step conserves without decay:
/// |(h - h_before) / dt|^2 + speed^2 grad h . grad h_before.
double verlet_energy(const DynamicWaveGrid& grid) {
    const double over_tick = 1 / grid.tick_s(), over_texel = grid.options().wave_speed_mps / grid.texel_m();
    return sum_over(grid, [&](auto x, auto z) {
        const double moved = (static_cast<double>(grid.height_m(x, z)) - grid.companion_m(x, z)) * over_tick;
        const auto slopes = [&](auto nx, auto nz) {
            return (static_cast<double>(grid.height_m(nx, nz)) - grid.height_m(x, z)) *
                   (static_cast<double>(grid.companion_m(nx, nz)) - grid.companion_m(x, z)) * over_texel * over_texel;
        };
        return moved * moved + slopes(x + 1, z) + slopes(x, z + 1);
    });
}

/// Applies pressure at many positions for 30 ticks.
void stir(DynamicWavePool& pool) {
    for (int i = 0; i < 30; ++i) {
        pool.grid.sources().add_impulse(
            {.x_m = 5.0 * std::cos(i), .z_m = 6.0 * std::sin(2 * i), .radius_m = 0.8, .height_m = 1});
        pool.tick();
    }
}

TEST(DynamicWavesWaves, NeverGrowWithoutASource) {
    // Rounding may add 1e-7 of the energy per tick.
    DynamicWavesOptions options = {
        .resolution = 64, .side_m = 32, .border_m = 4, .viscosity_m2ps = 0, .decay_per_s = 1e-4};
    DynamicWavePool pool(options);
    stir(pool);
    double before = spectral_energy(pool.grid);
    ASSERT_GT(before, 0.1);
    for (int i = 0; i < 400; ++i) {
        pool.tick();
        const double after = spectral_energy(pool.grid);
        ASSERT_LE(after, before) << "tick " << i;
        before = after;
    }
}

// Decay acts on the velocity only, and a border acts on both terms, so that energy oscillates
// within a wave's period: the test compares the maximum of each second.
TEST(DynamicWavesWaves, OfVerletNeverGrowWithoutASource) {
    for (const double border_m : {0.0, 4.0}) {
        DynamicWavePool pool(
            {.step = DynamicWavesStep::verlet, .resolution = 64, .side_m = 32, .border_m = border_m});
        stir(pool);
        double before = verlet_energy(pool.grid);
        ASSERT_GT(before, 0.1);
        for (int second = 0; second < 10; ++second) {
            double max = 0;
            for (int i = 0; i < 60; ++i) {
                pool.tick();
                max = std::max(max, verlet_energy(pool.grid));
            }
            if (second > 0) {
                ASSERT_LE(max, before) << "second " << second << " with a border of " << border_m;
            }
            before = max;
        }
    }
}

// The strongest decay at the coarsest tick and the largest c. The waves of two texels along both
// axes, whose heights alternate in sign, are the first to grow if a step is unstable.
TEST(DynamicWavesWaves, OfVerletAreStableAtAnyDecay) {
    for (const double decay : {0.0, 1.0, 3.0, 10.0}) {
        DynamicWavesOptions options = bare(DynamicWavesStep::verlet);
        options.ticks_per_s = 10;
        options.wave_speed_mps = 3.16;  // c = (3.16 / (10 x 0.5))^2 = 0.399
        options.decay_per_s = decay;
        DynamicWavePool pool(options);
        const auto height = [](auto x, auto z) { return (x + z) % 2 == 0 ? 0.1 : -0.1; };
        fill(pool.grid, height, height);
        double highest = 0;
        for (int tick = 0; tick < 200; ++tick) {
            pool.tick();
            sum_over(pool.grid, [&](auto x, auto z) {
                highest = std::max(highest, std::fabs(static_cast<double>(pool.grid.height_m(x, z))));
                return 0.0;
            });
        }
        // A wave with equal heights at two successive ticks has its extremum between them. The
        // amplitude is at most 1 / cos(omega dt / 2) <= sqrt(5) of the height.
        EXPECT_LT(highest, 0.1 * std::sqrt(5) * 1.01) << decay;
    }
}

/// Returns the fraction of a wave packet's energy that remains after the time to cross the border
/// twice.
double remaining_energy(DynamicWavesStep step, double wave_m, double degrees) {
    DynamicWavesOptions options = {.step = step, .resolution = 256, .side_m = 64, .ticks_per_s = 30};
    options.viscosity_m2ps = 0;
    options.decay_per_s = 0;
    DynamicWavePool pool(options);
    const double k = 2 * pi / wave_m, angle = degrees * pi / 180, texel = pool.grid.texel_m();
    const double speed = step == DynamicWavesStep::verlet ? options.wave_speed_mps : std::sqrt(9.80665 / k) / 2;
    const double omega = step == DynamicWavesStep::verlet ? speed * k : std::sqrt(9.80665 * k);
    const double width = 6;  // of the packet, in metres; well within the 40 m without border
    const RunningWave wave{k * std::cos(angle), k * std::sin(angle), omega, texel};
    const auto envelope = [&](double x, double z) { return std::exp(-(x * x + z * z) / (width * width)); };
    fill(
        pool.grid,
        [&](auto x, auto z) { return wave.height(x, z, 0) * envelope(double(x) * texel, double(z) * texel); },
        [&](auto x, auto z) {
            if (step == DynamicWavesStep::spectral)
                return wave.companion(x, z, 0) * envelope(double(x) * texel, double(z) * texel);
            const double back = speed * pool.grid.tick_s();
            return wave.height(x, z, -pool.grid.tick_s()) *
                   envelope(double(x) * texel + back * std::cos(angle), double(z) * texel + back * std::sin(angle));
        });
    const auto energy = [&] {
        return step == DynamicWavesStep::spectral ? spectral_energy(pool.grid) : verlet_energy(pool.grid);
    };
    const double before = energy();
    // From the centre to the edge and back to the undamped water, along the longer of both axes.
    const double path = (32 + 32 - 12) / std::cos(angle > pi / 4 ? pi / 2 - angle : angle);
    pool.tick(static_cast<int>(path / speed / pool.grid.tick_s()));
    return energy() / before;
}

TEST(BorderDamping, ReflectsLessThanOnePercentOfEnergy) {
    for (const DynamicWavesStep step : {DynamicWavesStep::spectral, DynamicWavesStep::verlet})
        for (const double wave_m : {12.0, 6.0, 3.0})
            for (const double degrees : {0.0, 20.0, 45.0})
                EXPECT_LT(remaining_energy(step, wave_m, degrees), 0.01)
                    << wave_m << " m at " << degrees
                    << (step == DynamicWavesStep::verlet ? " degrees, Verlet" : " degrees");
}

double highest_in(const DynamicWaveGrid& grid) {
    double highest = 0;
    sum_over(grid, [&](auto x, auto z) {
        return highest = std::max(highest, std::fabs(static_cast<double>(grid.height_m(x, z))));
    });
    return highest;
}

// The surface takes the shape of the pressure: h = shape is the equilibrium, and the initial waves
// leave the grid.
TEST(DynamicWaveSources, OfConstantPressureShapeTheSurface) {
    for (const DynamicWavesStep step : {DynamicWavesStep::spectral, DynamicWavesStep::verlet}) {
        DynamicWavePool pool({.step = step, .resolution = 64, .side_m = 32, .border_m = 8});
        const Disturbance press{.radius_m = 2, .height_m = -0.5};
        for (int i = 0; i < 3000; ++i) {
            pool.grid.sources().add_impulse(press);
            pool.tick();
        }
        double worst = 0;
        sum_over(pool.grid, [&](auto x, auto z) {
            const double away = std::hypot(double(x), double(z)) * pool.grid.texel_m() / press.radius_m;
            const double shape = away < 3 ? press.height_m * std::exp(-away * away) : 0;
            return worst = std::max(worst, std::fabs(pool.grid.height_m(x, z) - shape));
        });
        EXPECT_LT(worst, 0.02 * 0.5) << (step == DynamicWavesStep::verlet ? "Verlet" : "spectral");
    }
}

/// J0(x) = integral of cos(x sin a) over half a turn, divided by pi. Sums of periodic functions are
/// exact for x < 2 points.
double bessel_0(double x) {
    constexpr int points = 128;
    double sum = 0;
    for (int i = 0; i < points; ++i) sum += std::cos(x * std::sin((i + 0.5) * pi / points));
    return sum / points;
}

/// The height of a Gaussian initially at rest, where all waves have one speed and decay:
/// height radius^2 / 2 times the integral of
/// e^(-k^2 radius^2 / 4) J0(k r) cos(speed k t) e^(-decay t) k dk.
double ring(double height_m, double radius_m, double speed_mps, double decay_per_s, double r, double t) {
    constexpr int steps = 300;
    const double step = 12 / radius_m / steps;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double k = (i + 0.5) * step;
        sum += std::exp(-k * k * radius_m * radius_m / 4) * bessel_0(k * r) * std::cos(speed_mps * k * t) * k * step;
    }
    return height_m * radius_m * radius_m / 2 * std::exp(-decay_per_s * t) * sum;
}

// In linear theory the rings are a tenth as high as the drop, because added water has zero initial
// velocity. A relaxation that completes in one tick adds its shape times the shape over its height:
// a Gaussian whose radius is smaller by sqrt 2.
TEST(DynamicWaveSources, OfImpulseAndRelaxationMakeTheRingsOfLinearTheory) {
    for (const Disturbance::Mode mode : {Disturbance::Mode::impulse, Disturbance::Mode::relaxation}) {
        const bool is_relaxation = mode == Disturbance::Mode::relaxation;
        DynamicWavePool pool({.step = DynamicWavesStep::verlet, .resolution = 512, .side_m = 64});
        const double drop_m = 0.2, radius_m = 1;
        pool.grid.sources().add_impulse({.mode = mode,
                                         .radius_m = is_relaxation ? std::sqrt(2) * radius_m : radius_m,
                                         .height_m = drop_m,
                                         .rate_per_s = 1000});
        for (const int second : {1, 2, 3}) {
            pool.tick(60);
            double worst = 0, highest = 0;
            // up to 12 m, which the border's influence has not reached
            for (int i = 0; i <= 96; ++i) {
                const double wanted = ring(drop_m, radius_m, 3, 0.01, i * 0.125, second);
                worst = std::max(worst, std::fabs(pool.grid.height_m(i, 0) - wanted));
                worst = std::max(worst, std::fabs(pool.grid.height_m(0, -i) - wanted));
                highest = std::max(highest, std::fabs(wanted));
            }
            // Waves of k = 2 / radius are slower by (k texel)^2 / 24 (1 - c) = 0.2 %: at most 0.04
            // rad of a ring of 18 rad.
            EXPECT_LT(worst, 0.05 * highest) << second << (is_relaxation ? " s, pulled" : " s, added");
        }
    }
}

TEST(DynamicWaveSources, OfConstantRelaxationMakeABoundedBulge) {
    for (const DynamicWavesStep step : {DynamicWavesStep::spectral, DynamicWavesStep::verlet}) {
        DynamicWavePool pool({.step = step, .resolution = 64, .side_m = 32, .border_m = 4});
        double highest = 0;
        for (int i = 0; i < 2000; ++i) {
            pool.grid.sources().add_impulse({.mode = Disturbance::Mode::relaxation, .radius_m = 2, .height_m = 0.5});
            pool.tick();
            highest = std::max(highest, highest_in(pool.grid));
        }
        // Water that rises towards a height may overshoot it, like a spring, by at most the initial
        // distance.
        EXPECT_LE(highest, 2 * 0.5);
        EXPECT_GT(highest, 0.1);
    }
}

// The two grids have different wave numbers, so results differ in bits but agree within the
// tolerance.
TEST(DynamicWaveWake, IsEqualInASmallAndALargeGrid) {
    DynamicWavesOptions narrow = {.step = DynamicWavesStep::spectral, .resolution = 128, .side_m = 64}, wide = narrow;
    wide.resolution = 512;
    wide.side_m = 256;
    DynamicWavePool a(narrow), b(wide);
    for (int i = 0; i < 300; ++i) {
        const double x = -10 + 4.0 * i / 60;
        for (DynamicWavePool* pool : {&a, &b}) {
            if (pool == &a) pool->grid.set_center(x, 0);
            pool->grid.sources().add_impulse(
                {.shape = Disturbance::Shape::hull, .x_m = x, .radius_m = 0.8, .length_m = 2, .height_m = -0.4});
            pool->tick();
        }
    }
    // 16 texels inside the border of 24.
    const std::int64_t inset = 24 + 16, n = narrow.resolution;
    double off = 0, all = 0;
    for (std::int64_t z = a.grid.first_z() + inset; z < a.grid.first_z() + n - inset; ++z)
        for (std::int64_t x = a.grid.first_x() + inset; x < a.grid.first_x() + n - inset; ++x) {
            const double here = a.grid.height_m(x, z), there = b.grid.height_m(x, z);
            off += (here - there) * (here - there);
            all += there * there;
        }
    RecordProperty("rms_off", std::to_string(std::sqrt(off / all)));
    EXPECT_LT(std::sqrt(off / all), 0.01);
}

// A boat of 10 m at 5 m/s, followed by the grid, over six wavelengths of its wake.
TEST(DynamicWaveWake, HasKelvinsAngleAndLength) {
    DynamicWavePool pool({.resolution = 512, .side_m = 256, .ticks_per_s = 20, .border_m = 24}, choose_isa(),
                         make_thread_executor(2));
    const DynamicWaveGrid& grid = pool.grid;
    const double speed = 5, k = 9.80665 / (speed * speed), length = 2 * pi / k;
    double boat = 0;
    for (int i = 0; i < 55 * 20; ++i) {
        boat = speed * i * grid.tick_s();
        pool.grid.set_center(boat, 0);
        // The draught grows over three seconds.
        pool.grid.sources().add_impulse({.shape = Disturbance::Shape::hull,
                                         .x_m = boat,
                                         .radius_m = 1.5,
                                         .length_m = 5,
                                         .height_m = -0.6 * std::min(1.0, i / 60.0)});
        pool.tick();
    }
    const auto height = [&](double behind, double aside) {
        return static_cast<double>(
            grid.height_m(std::llround((boat - behind) / grid.texel_m()), std::llround(aside / grid.texel_m())));
    };
    const KelvinWake wake = measure_wake(height, length, grid.texel_m(), 1.5, 6);
    EXPECT_NEAR(wake.length_m, length, 0.05 * length);
    // 19.47 degrees: asin(1/3).
    for (const double angle : wake.angle_rad) EXPECT_NEAR(angle * 180 / pi, std::asin(1.0 / 3) * 180 / pi, 1);
}

}  // namespace
}  // namespace pelagic
