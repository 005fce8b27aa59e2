// Bit-exact tests of dynamic waves: equal on every instruction set and executor, after moves of the
// grid, and after save and restore.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "pelagic/tests/dynamic_wave_pool.hpp"
#include "pelagic/tests/each_executor.hpp"
#include "pelagic/tests/emulated.hpp"
#include "pelagic/tests/golden.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/sanitized.hpp"
#include "pelagic/tests/sweep.hpp"

namespace pelagic {
namespace {

DynamicWavesOptions small(DynamicWavesStep step) {
    return {.step = step, .resolution = 64, .side_m = 32, .border_m = 6, .foam_height_m = 0.05};
}

/// A sawtooth from -1 to 1, without libm, whose results differ between systems.
double sawtooth(int tick, int period) { return 2.0 * (tick % period) / period - 1; }

/// Applies the inputs of tick n: a moved centre, a hull at the centre, a relaxation source, and
/// drops.
void apply_inputs(DynamicWaveGrid& grid, int tick) {
    const double x = 0.05 * tick, z = 5 * sawtooth(tick, 70);
    grid.set_center(x, z);
    grid.sources().add_impulse({.shape = Disturbance::Shape::hull,
                                .x_m = x,
                                .z_m = z,
                                .radius_m = 0.9,
                                .length_m = 2.4,
                                .heading_rad = 0.3 * sawtooth(tick, 90),
                                .height_m = -0.4});
    grid.sources().add_impulse(
        {.mode = Disturbance::Mode::relaxation, .x_m = x - 4, .z_m = z + 3, .radius_m = 0.8, .height_m = 0.2});
    if (tick % 7 == 0)
        grid.sources().add_impulse({.mode = Disturbance::Mode::impulse,
                                    .x_m = x + 9 * sawtooth(tick, 23),
                                    .z_m = z + 9 * sawtooth(tick, 31),
                                    .radius_m = 1.1,
                                    .height_m = 0.3});
}

std::uint64_t replayed(const DynamicWavesOptions& options, Isa isa, std::shared_ptr<Executor> executor,
                       int ticks = 90) {
    DynamicWavePool pool(options, isa, std::move(executor));
    for (int i = 0; i < ticks; ++i) {
        apply_inputs(pool.grid, i);
        pool.tick();
    }
    return pool.grid.hash();
}

TEST(DynamicWaveReplay, HasTheGoldenHashOnEveryInstructionSetAndExecutor) {
    for (const Computing& on : computings()) {
        SCOPED_TRACE(on.name);
        GoldenRows rows("dynamic-waves");
        for (const DynamicWavesStep step : {DynamicWavesStep::spectral, DynamicWavesStep::verlet})
            rows.row(std::string(name_of(step)), {replayed(small(step), on.isa, on.executor())});
        rows.expect();
    }
}

TEST(DynamicWaveReplay, OfALargerGridIsBitIdenticalOnEveryInstructionSetAndExecutor) {
    for (const DynamicWavesStep step : {DynamicWavesStep::spectral, DynamicWavesStep::verlet}) {
        DynamicWavesOptions larger = small(step);
        larger.resolution = 128, larger.side_m = 64;
        const std::uint64_t expected = replayed(larger, isas_here().front(), make_serial_executor());
        for (const Computing& on : computings())
            EXPECT_EQ(replayed(larger, on.isa, on.executor()), expected) << on.name;
    }
}

TEST(GridPlacementMoves, KeepTexelsThatStayInsideTheGrid) {
    for (const DynamicWavesStep step : {DynamicWavesStep::spectral, DynamicWavesStep::verlet}) {
        DynamicWavePool pool(small(step));
        DynamicWaveGrid& grid = pool.grid;
        for (int i = 0; i < 40; ++i) {
            apply_inputs(grid, i);
            pool.tick();
        }
        std::mt19937 random(5);
        for (int move = 0; move < 60; ++move) {
            struct Texel {
                float height, companion;
                std::uint8_t foam;
                bool operator==(const Texel&) const = default;
            };
            const auto read = [&](std::int64_t x, std::int64_t z) {
                return Texel{grid.height_m(x, z), grid.companion_m(x, z), grid.foam(x, z)};
            };
            const std::int64_t x0 = grid.first_x(), z0 = grid.first_z(), n = grid.options().resolution;
            std::vector<Texel> before;
            for (std::int64_t z = z0; z < z0 + n; ++z)
                for (std::int64_t x = x0; x < x0 + n; ++x) before.push_back(read(x, z));
            // Moves in texels, not metres. The last moves are large enough to leave no overlap.
            std::uniform_int_distribution<int> step_of(move < 50 ? -9 : -80, move < 50 ? 9 : 80);
            const double texel = grid.texel_m(), half = static_cast<double>(n / 2);
            grid.set_center((static_cast<double>(x0) + half + step_of(random) + 0.4) * texel,
                            (static_cast<double>(z0) + half + step_of(random) - 0.4) * texel);
            for (std::int64_t z = grid.first_z(); z < grid.first_z() + n; ++z)
                for (std::int64_t x = grid.first_x(); x < grid.first_x() + n; ++x) {
                    const bool was_there = x >= x0 && x < x0 + n && z >= z0 && z < z0 + n;
                    const Texel expected =
                        was_there ? before[static_cast<std::size_t>((z - z0) * n + x - x0)] : Texel{};
                    ASSERT_TRUE(read(x, z) == expected) << x << ", " << z << " after move " << move;
                }
            apply_inputs(grid, 40 + move);
            pool.tick();
        }
    }
}

TEST(GridPlacementMoves, VerletInteriorIsBitIdenticalToALargerGrid) {
    DynamicWavesOptions narrow = small(DynamicWavesStep::verlet), wide = narrow;
    narrow.border_m = wide.border_m = 4;
    wide.resolution = 256;
    wide.side_m = 128;
    DynamicWavePool a(narrow), b(wide);
    const int ticks = 20;
    for (int i = 0; i < ticks; ++i) {
        for (DynamicWavePool* pool : {&a, &b}) {
            pool->grid.sources().add_impulse({.x_m = 1, .z_m = -2, .radius_m = 0.7, .height_m = 0.4});
            pool->tick();
        }
    }
    // The border is 8 texels wide, and its influence spreads by one texel per tick.
    double largest = 0;
    for (std::int64_t z = -32 + 8 + ticks; z < 32 - 8 - ticks; ++z)
        for (std::int64_t x = -32 + 8 + ticks; x < 32 - 8 - ticks; ++x) {
            ASSERT_EQ(a.grid.height_m(x, z), b.grid.height_m(x, z)) << x << ", " << z;
            largest = std::max(largest, std::fabs(static_cast<double>(a.grid.height_m(x, z))));
        }
    EXPECT_GT(largest, 0.05);
}

TEST(DynamicWaveState, RestoredGridContinuesBitIdentically) {
    for (const DynamicWavesStep step : {DynamicWavesStep::spectral, DynamicWavesStep::verlet}) {
        DynamicWavePool continuous(small(step)), rolled_back(small(step)), restored(small(step));
        const auto run = [](DynamicWavePool& pool, int from, int to) {
            for (int i = from; i < to; ++i) {
                apply_inputs(pool.grid, i);
                pool.tick();
            }
        };
        run(continuous, 0, 80);
        run(rolled_back, 0, 37);
        const std::vector<std::uint8_t> saved = rolled_back.grid.saved();
        run(rolled_back, 37, 60);  // a prediction that is rolled back
        rolled_back.grid.restore(saved);
        restored.grid.restore(saved);
        run(rolled_back, 37, 80);
        run(restored, 37, 80);
        EXPECT_EQ(rolled_back.grid.hash(), continuous.grid.hash());
        EXPECT_EQ(restored.grid.hash(), continuous.grid.hash());
        EXPECT_EQ(rolled_back.grid.ticks(), 80);
    }
}

TEST(DynamicWaveState, InvalidStateIsRejectedWithoutAChange) {
    DynamicWavePool pool(small(DynamicWavesStep::spectral));
    for (int i = 0; i < 5; ++i) {
        apply_inputs(pool.grid, i);
        pool.tick();
    }
    const std::uint64_t before = pool.grid.hash();
    const std::vector<std::uint8_t> saved = pool.grid.saved();
    const auto refuses = [&](std::vector<std::uint8_t> bytes, const std::string& reason) {
        const std::string message = message_of([&] { pool.grid.restore(bytes); });
        EXPECT_NE(message.find(reason), std::string::npos) << message << " lacks " << reason;
        EXPECT_EQ(pool.grid.hash(), before);
    };
    std::vector<std::uint8_t> shorter = saved;
    shorter.pop_back();
    refuses(shorter, "bytes");
    const auto with = [&](std::size_t at, auto value) {
        std::vector<std::uint8_t> bytes = saved;
        std::memcpy(bytes.data() + at, &value, sizeof value);
        return bytes;
    };
    refuses(with(0, std::numeric_limits<std::int64_t>::max()), "first texel");
    refuses(with(16, std::int64_t{-1}), "ticks");
    refuses(with(24, std::numeric_limits<float>::quiet_NaN()), "texel of the water nan is out of range");
    refuses(with(saved.size() / 2, 1e30f), "texel of the water 1e+30 is out of range [-1e6, 1e6]");
}

TEST(DynamicWavesGridRefuses, InvalidOptions) {
    const auto reason = [](auto change) {
        DynamicWavesOptions options;
        change(options);
        return check(options);
    };
    EXPECT_EQ(check(DynamicWavesOptions{}), "");
    EXPECT_EQ(reason([](auto& o) { o.resolution = 100; }), "resolution is 100, expected 64, 128, 256, 512 or 1024");
    EXPECT_EQ(reason([](auto& o) { o.border_m = 17; }), "border_m is 17, expected at most a quarter of side_m, 16");
    EXPECT_EQ(reason([](auto& o) { o.side_m = std::numeric_limits<double>::quiet_NaN(); }),
              "side_m nan is out of range [1, 10000]");
    // c = (9.5 / (60 x 0.25))^2 = 0.401
    EXPECT_EQ(
        reason([](auto& o) { o.step = DynamicWavesStep::verlet, o.wave_speed_mps = 9.5; }),
        "wave_speed_mps is 9.5, expected c = (wave_speed_mps / (ticks_per_s texel))^2 to be 0.4 at most, which is "
        "0.401");
    EXPECT_EQ(reason([](auto& o) { o.step = DynamicWavesStep::verlet, o.wave_speed_mps = 9.48; }), "");
    EXPECT_EQ(reason([](auto& o) { o.wave_speed_mps = 9.5; }), "") << "only Verlet's waves have that speed";
    DynamicWavesOptions wrong;
    wrong.ticks_per_s = 1;
    EXPECT_THROW(DynamicWaves{wrong}, std::invalid_argument);
}

TEST(DynamicWaveGrid, AcceptsTheFarthestPositions) {
    DynamicWavePool pool(small(DynamicWavesStep::spectral));
    apply_inputs(pool.grid, 0);
    pool.tick();
    // The farthest valid positions, where coordinates still resolve single texels.
    pool.grid.set_center(1e8, -1e8);
    pool.grid.sources().add_impulse({.mode = Disturbance::Mode::impulse, .x_m = 1e8, .z_m = -1e8, .height_m = 0.5});
    pool.tick();
    EXPECT_GT(sum_over(pool.grid, [&](auto x, auto z) { return std::fabs(pool.grid.height_m(x, z)); }), 1);
}

/// omega dt of Verlet waves of two texels along an axis: sin(omega dt / 2) = courant.
double rotated_by_shortest(const DynamicWavesOptions& options) {
    return 2 * std::asin(DynamicWaveGrid::courant_number(options));
}

/// An upper bound of the heights that Verlet's step keeps indefinitely, in metres.
/// Where one of a texel's two heights is below s = BorderDamping::smallest, it is set to 0. If the
/// other one is not, their difference v (the velocity per tick) changes by less than s. The sign is
/// random, because equally many heights lie on both sides of zero.
/// So v^2 grows by s^2 / 3 on average, in 2 s / (pi A) of all ticks, with amplitude A. Decay
/// removes 2 decay dt v^2, with v = A omega dt. Both are equal at
/// A^3 = s^3 / (3 pi decay dt (omega dt)^2), which is 16 s for waves of two texels. Those waves
/// have no group velocity, so the border does not absorb them.
/// The bound is six times the rms, A / sqrt 2.
double max_residual_m(const DynamicWavesOptions& options) {
    const double tick = 1.0 / options.ticks_per_s, turned = rotated_by_shortest(options);
    const double in_smallest = std::cbrt(1 / (3 * std::numbers::pi * options.decay_per_s * tick * turned * turned));
    return 6 / std::sqrt(2.0) * in_smallest * static_cast<double>(BorderDamping::smallest);
}

TEST(DynamicWavesGridLasts, WithoutDriftOrDenormals) {
    for (const DynamicWavesStep step : {DynamicWavesStep::spectral, DynamicWavesStep::verlet}) {
        DynamicWavesOptions options = small(step);
        options.side_m = 16;
        options.border_m = 4;
        DynamicWavePool pool(options);
        for (int i = 0; i < 20; ++i) {
            pool.grid.sources().add_impulse({.mode = Disturbance::Mode::relaxation, .radius_m = 1, .height_m = 0.5});
            pool.tick();
        }
        const auto largest = [&] {
            double all = 0;
            sum_over(pool.grid, [&](auto x, auto z) {
                for (const float value : {pool.grid.height_m(x, z), pool.grid.companion_m(x, z)}) {
                    EXPECT_NE(std::fpclassify(value), FP_SUBNORMAL);
                    all = std::max(all, std::fabs(static_cast<double>(value)));
                }
                return 0;
            });
            return all;
        };
        const double before = largest();
        const int ticks = is_sanitized || is_emulated ? 300 : of_sweep(20'000, 1'000'000);
        const double pushed = step == DynamicWavesStep::verlet ? max_residual_m(options) : 0;
        for (int tenth = 1; tenth <= 10; ++tenth) {
            pool.tick(ticks / 10);
            const double decayed = before * std::exp(-options.decay_per_s * tenth * ticks / 10 * pool.grid.tick_s());
            EXPECT_LT(largest(), decayed + pushed) << "after " << tenth << " tenths";
        }
    }
}

constexpr int busy_ticks = 6000, quiet_ticks = 4000;  // ticks of a round

/// Applies the inputs of tick n of a round: hulls and pressure sources that are added and removed,
/// an intermittent relaxation source, and positive and negative impulses. The grid's centre moves
/// away by up to 6 m and returns.
void apply_round_inputs(DynamicWaveGrid& grid, int tick) {
    constexpr int change_ticks = 400, numbers = 6, last_change = busy_ticks / change_ticks;
    if (tick % change_ticks == 0 && tick <= busy_ticks) {
        const int change = tick / change_ticks;
        grid.sources().remove(static_cast<std::uint32_t>((change + 3) % numbers + 1));
        if (change + numbers <= last_change)
            grid.set_source(static_cast<std::uint32_t>(change % numbers + 1),
                            {.shape = change % 2 ? Disturbance::Shape::hull : Disturbance::Shape::gauss,
                             .mode = change % 5 == 3 ? Disturbance::Mode::relaxation : Disturbance::Mode::pressure,
                             .x_m = 4 * sawtooth(change, 7),
                             .z_m = 4 * sawtooth(change, 5),
                             .radius_m = 0.9,
                             .length_m = 1.7,
                             .heading_rad = sawtooth(change, 11),
                             .height_m = change % 3 ? -0.3 : 0.2,
                             .velocity_x_mps = 0.5 * sawtooth(change, 4),
                             .velocity_z_mps = 0.4 * sawtooth(change, 9)});
        else
            for (std::uint32_t number = 1; number <= numbers; ++number) grid.sources().remove(number);
    }
    if (tick >= busy_ticks) return;
    grid.set_center(6 * (1 - std::fabs(sawtooth(tick, busy_ticks))), 0);
    if (tick % 29 == 0)
        grid.sources().add_impulse({.mode = Disturbance::Mode::impulse,
                                    .x_m = 5 * sawtooth(tick, 310),
                                    .z_m = 5 * sawtooth(tick, 170),
                                    .radius_m = 0.7,
                                    .height_m = tick % 2 ? 0.25 : -0.25});
    if (tick % 1000 < 200)
        grid.sources().add_impulse(
            {.mode = Disturbance::Mode::relaxation, .x_m = 1, .radius_m = 0.8, .height_m = 0.3});
}

struct Texels {
    double squares = 0, highest = 0;  ///< of heights and companions
    int denormal = 0;
};

Texels texels_of(const DynamicWaveGrid& grid) {
    const std::vector<std::uint8_t> saved = grid.saved();
    const std::size_t count = static_cast<std::size_t>(grid.options().resolution) * grid.options().resolution;
    std::vector<float> texels(3 * count);  // includes the heights of the previous tick
    std::memcpy(texels.data(), saved.data() + 3 * sizeof(std::int64_t), texels.size() * sizeof(float));
    Texels all;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const double value = texels[i];
        all.denormal += std::fpclassify(texels[i]) == FP_SUBNORMAL;
        if (i < 2 * count) all.squares += value * value;
        all.highest = std::max(all.highest, std::fabs(value));
    }
    return all;
}

/// Verlet's step and border damping by definition, in double, without sources. Only the initial
/// state is taken from the grid.
class VerletInDouble {
   public:
    explicit VerletInDouble(const DynamicWaveGrid& grid)
        : n_(grid.options().resolution), first_{grid.first_x(), grid.first_z()}, now_(size()), before_(size()) {
        const DynamicWavesOptions& options = grid.options();
        const double tick = grid.tick_s();
        for (std::int64_t z = 0; z < n_; ++z)
            for (std::int64_t x = 0; x < n_; ++x) {
                now_[at(x, z)] = static_cast<double>(grid.height_m(first_[0] + x, first_[1] + z));
                before_[at(x, z)] = static_cast<double>(grid.companion_m(first_[0] + x, first_[1] + z));
            }
        for (std::int64_t i = 0; i < n_; ++i) {
            const double from_edge = (static_cast<double>(std::min(i, n_ - 1 - i)) + 0.5) * grid.texel_m();
            const double within = std::max(0.0, 1 - from_edge / options.border_m);
            damping_.push_back(std::exp(-12 * options.wave_speed_mps / options.border_m * within * within * tick));
        }
        decay_ = std::exp(-options.decay_per_s * tick);
        coupling_ = std::pow(options.wave_speed_mps * tick / grid.texel_m(), 2);
    }

    void tick() {
        for (std::int64_t z = 0; z < n_; ++z)
            for (std::int64_t x = 0; x < n_; ++x)
                for (std::vector<double>* plane : {&now_, &before_})
                    (*plane)[at(x, z)] *=
                        damping_[static_cast<std::size_t>(x)] * damping_[static_cast<std::size_t>(z)];
        for (std::int64_t z = 0; z < n_; ++z)
            for (std::int64_t x = 0; x < n_; ++x) {
                const double here = now_[at(x, z)];
                const double lap =
                    now_[at(x - 1, z)] + now_[at(x + 1, z)] + now_[at(x, z - 1)] + now_[at(x, z + 1)] - 4 * here;
                double& to = before_[at(x, z)];
                to = here + decay_ * decay_ * (here - to) + decay_ * coupling_ * lap;
            }
        now_.swap(before_);
    }

    double highest_m() const {
        double highest = 0;
        for (const double height : now_) highest = std::max(highest, std::fabs(height));
        return highest;
    }
    double farthest_from(const DynamicWaveGrid& grid) const {
        double farthest = 0;
        for (std::int64_t z = 0; z < n_; ++z)
            for (std::int64_t x = 0; x < n_; ++x)
                farthest = std::max(
                    farthest,
                    std::fabs(now_[at(x, z)] - static_cast<double>(grid.height_m(first_[0] + x, first_[1] + z))));
        return farthest;
    }

   private:
    std::size_t size() const { return static_cast<std::size_t>(n_ * n_); }
    std::size_t at(std::int64_t x, std::int64_t z) const {
        return static_cast<std::size_t>((z & (n_ - 1)) * n_ + (x & (n_ - 1)));
    }

    std::int64_t n_;
    std::array<std::int64_t, 2> first_;
    std::vector<double> now_, before_, damping_;
    double decay_ = 1, coupling_ = 0;
};

// A hundred rounds in the nightly sweep, a million ticks. Each round has the energies of the first
// one, because nothing remains of earlier rounds.
TEST(DynamicWavesGridLasts, ThroughRoundsOfSourcesWithoutResidue) {
    for (const DynamicWavesStep step : {DynamicWavesStep::spectral, DynamicWavesStep::verlet}) {
        DynamicWavesOptions options = small(step);
        options.side_m = 16;
        options.border_m = 4;
        DynamicWavePool pool(options);
        std::vector<double> first_round;
        double highest = 0, max = 0, farthest = 0, left_over = 0;
        int denormal = 0;
        const int rounds = is_sanitized || is_emulated ? 2 : of_sweep(3, 100);
        for (int round = 0; round < rounds; ++round) {
            std::optional<VerletInDouble> in_double;
            double quiet_squares = 0;
            for (int tick = 0; tick < busy_ticks + quiet_ticks; ++tick) {
                apply_round_inputs(pool.grid, tick);
                pool.tick();
                if (in_double) {
                    in_double->tick();
                    quiet_squares += std::pow(in_double->highest_m(), 2);
                }
                if (tick == busy_ticks && step == DynamicWavesStep::verlet) in_double.emplace(pool.grid);
                if (tick % 100 != 99) continue;
                const Texels texels = texels_of(pool.grid);
                denormal += texels.denormal;
                highest = std::max(highest, texels.highest);
                max = std::max(max, texels.squares);
                const std::size_t at = static_cast<std::size_t>(tick / 100);
                if (round == 0) first_round.push_back(texels.squares);
                farthest = std::max(farthest, std::fabs(texels.squares - first_round[at]));
                if (tick + 1 == busy_ticks + quiet_ticks) left_over = std::max(left_over, texels.highest);
            }
            if (in_double) {
                // Each of a tick's four roundings changes a texel by at most 2^-24 of its height,
                // randomly from tick to tick. The waves of two texels have no group velocity, and
                // turn such a change into a height 1 / (omega dt) times as large.
                const double pushed = 4 * 0x1p-24 * std::sqrt(quiet_squares) / rotated_by_shortest(options);
                EXPECT_LT(in_double->farthest_from(pool.grid), pushed);
                EXPECT_LT(pushed, 0.01 * in_double->highest_m()) << "what is left is no rounding";
            }
        }
        const std::string name = step == DynamicWavesStep::spectral ? "spectral_" : "verlet_";
        RecordProperty(name + "highest_m", std::to_string(highest));
        RecordProperty(name + "squares", std::to_string(max));
        RecordProperty(name + "squares_off_the_first_round", std::to_string(farthest));
        RecordProperty(name + "highest_at_rest_m", std::to_string(left_over));
        EXPECT_EQ(denormal, 0);
        // During a minute without sources waves cross the border several times. If a fraction of
        // their amplitude remains, squares differ by twice that fraction. With Verlet's step the
        // longest waves remain, which a border of a quarter of the grid reflects, and waves of two
        // texels, which do not travel. The step in double leaves the same amount.
        EXPECT_LT(left_over, 5e-4 * highest);
        EXPECT_LT(farthest, 1e-3 * max);
        EXPECT_GT(highest, 0.3);
    }
}

TEST(DynamicWavesFoam, AppearsWhereWaterIsHighAndDecays) {
    DynamicWavesOptions options = small(DynamicWavesStep::spectral);
    options.foam_height_m = 0.2;
    DynamicWavePool pool(options);
    pool.grid.sources().add_impulse({.mode = Disturbance::Mode::impulse, .radius_m = 3, .height_m = 0.6});
    pool.tick();
    EXPECT_EQ(pool.grid.foam(0, 0), 255);  // the height is more than twice the threshold
    EXPECT_EQ(pool.grid.foam(15, 0), 0);
    // Decay by 90 byte steps per second: zero 2.9 seconds after the height falls below the
    // threshold.
    pool.tick(4 * 60);
    EXPECT_EQ(pool.grid.foam(0, 0), 0);
}

}  // namespace
}  // namespace pelagic
