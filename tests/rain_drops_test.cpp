// Rain has the requested number of drops, each of the documented shape. Drops add no volume and do
// not depend on the position of the grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "pelagic/tests/dynamic_wave_pool.hpp"

namespace pelagic {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Waves too slow to move: drops stay where they fell.
const DynamicWavesOptions stiff{.step = DynamicWavesStep::verlet,
                                .resolution = 64,
                                .side_m = 16,
                                .border_m = 0,
                                .wave_speed_mps = 1e-6,
                                .decay_per_s = 0};
constexpr double cell_m = 0.25;
/// The radius is two texels, so sums over texels equal integrals to 1e-8. A drop reaches six texels
/// and one more on either side.
const Rain wide_drops{.drops_per_m2_s = 1, .radius_m = 2 * cell_m, .height_m = 0.03, .seed = 7};
constexpr std::int64_t drop_texels = 6;
/// The area on which drops of this radius fall completely inside a grid of 64 texels.
constexpr double fallen_on_m2 = (64 - 2 * drop_texels - 1) * (64 - 2 * drop_texels - 1) * cell_m * cell_m;

std::vector<double> heights(const DynamicWaveGrid& grid) {
    std::vector<double> all;
    for (std::int64_t z = 0; z < grid.options().resolution; ++z)
        for (std::int64_t x = 0; x < grid.options().resolution; ++x)
            all.push_back(static_cast<double>(grid.height_m(grid.first_x() + x, grid.first_z() + z)));
    return all;
}

/// Calls `of_tick` with the heights that each of `ticks` ticks added, on a grid without wave
/// motion.
template <class OfTick>
void for_ticks(const Rain& rain, int ticks, OfTick of_tick) {
    DynamicWavePool pool(stiff);
    pool.grid.set_rain(rain);
    std::vector<double> before = heights(pool.grid);
    for (int tick = 0; tick < ticks; ++tick) {
        pool.tick();
        std::vector<double> now = heights(pool.grid), added(now.size());
        for (std::size_t i = 0; i < now.size(); ++i) added[i] = now[i] - before[i];
        of_tick(added);
        before = std::move(now);
    }
}

struct Crater {
    std::int64_t x, z;
};

/// Returns the texels that are lower than all neighbours and lower than -0.6 of a drop's height. A
/// drop's deepest texel has 0.77 of its height or more.
std::vector<Crater> craters(const std::vector<double>& added, double height_m) {
    std::vector<Crater> found;
    const auto at = [&](std::int64_t x, std::int64_t z) { return added[static_cast<std::size_t>(z * 64 + x)]; };
    for (std::int64_t z = 1; z < 63; ++z)
        for (std::int64_t x = 1; x < 63; ++x) {
            bool lowest = at(x, z) < -0.6 * height_m;
            for (const auto& [dx, dz] : {Crater{-1, -1}, {0, -1}, {1, -1}, {-1, 0}})
                lowest = lowest && at(x, z) < at(x + dx, z + dz) && at(x, z) <= at(x - dx, z - dz);
            if (lowest) found.push_back({x, z});
        }
    return found;
}

TEST(RainDrops, HasTheRequestedNumberOfDrops) {
    constexpr int ticks = 1000;
    constexpr double mean = 3;  // drops a tick
    Rain sparse = wide_drops;
    sparse.drops_per_m2_s = mean * stiff.ticks_per_s / fallen_on_m2;
    std::vector<double> counts;
    double quarters[4] = {};
    for_ticks(sparse, ticks, [&](const std::vector<double>& added) {
        const std::vector<Crater> fallen = craters(added, sparse.height_m);
        counts.push_back(static_cast<double>(fallen.size()));
        for (const Crater& each : fallen) quarters[(each.x < 32 ? 0 : 1) + (each.z < 32 ? 0 : 2)] += 1;
    });
    double sum = 0, squares = 0;
    for (const double count : counts) sum += count, squares += (count - mean) * (count - mean);
    // Poisson distribution: mean and variance are equal. Bounds: four standard deviations, and 2 %
    // for overlapping drops. Craters closer than three texels are not distinguished; one pair in a
    // hundred is closer, and there are 1.5 pairs a drop.
    EXPECT_GT(sum / ticks, mean * (1 - 4 / std::sqrt(mean * ticks) - 0.02));
    EXPECT_LT(sum / ticks, mean * (1 + 4 / std::sqrt(mean * ticks)));
    EXPECT_NEAR(squares / ticks / mean, 1, 4 * std::sqrt(2.0 / ticks) + 0.04);
    for (const double quarter : quarters) EXPECT_NEAR(quarter, sum / 4, 4 * std::sqrt(sum * 3 / 16));
}

// Campbell's theorem: independent drops of mean zero have the summed energy of the single drops.
// The square of height_m (q - 1) e^-q has the integral height_m^2 pi radius_m^2 / 4.
TEST(RainDrops, HasTheEnergyOfIndependentDrops) {
    for (const double drops : {1.0, 20.0}) {
        Rain rain = wide_drops;
        rain.drops_per_m2_s = drops;
        constexpr int ticks = 300;
        double sum = 0;
        for_ticks(rain, ticks, [&](const std::vector<double>& added) {
            for (const double height : added) sum += height * height * cell_m * cell_m;
        });
        const double fallen = drops * fallen_on_m2 * ticks / stiff.ticks_per_s;
        const double expected = fallen * rain.height_m * rain.height_m * pi * rain.radius_m * rain.radius_m / 4;
        // Four standard deviations of the number of drops. The variation by overlaps in one tick is
        // smaller than that of the number.
        EXPECT_NEAR(sum / expected, 1, 4 * std::sqrt(2 / fallen)) << drops;
    }
}

TEST(RainDrops, HasDropsOfTheDocumentedShape) {
    Rain sparse = wide_drops;
    sparse.drops_per_m2_s = 0.3;
    double seen = 0, same = 0, parts = 0;
    for_ticks(sparse, 600, [&](const std::vector<double>& added) {
        const std::vector<Crater> fallen = craters(added, sparse.height_m);
        if (fallen.size() != 1) return;
        const Crater deepest = fallen.front();
        double min = std::numeric_limits<double>::infinity();
        std::int64_t best_x = 0, best_z = 0;
        // The centre is within one texel of the deepest texel, at a multiple of 1/8 texel.
        for (std::int64_t part = 0; part < 17 * 17; ++part) {
            const std::int64_t eighths_x = 8 * deepest.x + part % 17 - 8, eighths_z = 8 * deepest.z + part / 17 - 8;
            double largest = 0;
            for (std::int64_t i = 0; i < 17 * 17; ++i) {
                const std::int64_t x = deepest.x + i % 17 - 8, z = deepest.z + i / 17 - 8;
                if (x < 0 || x > 63 || z < 0 || z > 63) continue;
                const double s =
                    (static_cast<double>(x) - static_cast<double>(eighths_x) / 8) * cell_m / wide_drops.radius_m;
                const double t =
                    (static_cast<double>(z) - static_cast<double>(eighths_z) / 8) * cell_m / wide_drops.radius_m;
                const double q = s * s + t * t, height = sparse.height_m * (q - 1) * std::exp(-q);
                largest = std::max(largest, std::fabs(added[static_cast<std::size_t>(z * 64 + x)] - height));
            }
            if (largest >= min) continue;
            min = largest;
            best_x = eighths_x, best_z = eighths_z;
        }
        // The drop is cut off where it is 9 e^-9 of its height.
        EXPECT_LT(min, 1.2e-3 * sparse.height_m);
        for (const std::int64_t at : {best_x, best_z})
            ++seen, same += (at & 7) == (at >> 3 & 7), parts += static_cast<double>(at & 7);
    });
    // The texel index modulo 8 and the eighth within the texel are independent: they are equal for
    // one drop in eight. Bounds are four standard deviations.
    EXPECT_GT(seen, 300);
    EXPECT_NEAR(same / seen, 1.0 / 8, 4 * std::sqrt(7.0 / 64 / seen));
    EXPECT_NEAR(parts / seen, 3.5, 4 * std::sqrt(63.0 / 12 / seen));
}

TEST(RainDrops, DropsHaveNoVolume) {
    for (const double texels :
         // Up to 12 texels of reach, over rows of several jobs.
         {1.0, 5.0 / 3, 2.0, 8.0 / 3, 4.0}) {
        Rain rain = wide_drops;
        rain.radius_m = texels * cell_m;
        for_ticks(rain, 200, [&](const std::vector<double>& added) {
            double volume = 0, moved = 0;
            for (const double height : added) volume += height, moved += std::fabs(height);
            if (moved < rain.height_m) return;                     // no drop fell
            EXPECT_LE(std::fabs(volume), 3e-6 * moved) << texels;  // rounding of floats
        });
    }
}

TEST(RainDrops, AddsNoWater) {
    for (const DynamicWavesStep step : {DynamicWavesStep::spectral, DynamicWavesStep::verlet})
        for (const double radius_m : {0.05, 0.25, 0.6}) {
            DynamicWavesOptions open{.step = step, .resolution = 64, .side_m = 16, .border_m = 0};
            open.wave_speed_mps = 3;
            DynamicWavePool pool(open);
            pool.grid.set_rain({.drops_per_m2_s = 20, .radius_m = radius_m, .height_m = 0.05});
            pool.tick(300);
            double sum = 0, squares = 0;
            for (const double height : heights(pool.grid)) sum += height, squares += height * height;
            const double rms = std::sqrt(squares / 4096);
            EXPECT_GT(rms, 1e-4);
            // Rounding of floats: 1e-7 of the waves in each of 300 ticks. Truncated drops would
            // give 1e-3.
            EXPECT_LT(std::fabs(sum / 4096), 3e-5 * rms) << radius_m;
        }
}

/// Compares the texels that both grids have, `margin` texels or more from their edges.
void expect_same_inside(const DynamicWaveGrid& a, const DynamicWaveGrid& b, std::int64_t margin) {
    std::int64_t compared = 0, wet = 0;
    const auto end = [](std::int64_t first, const DynamicWaveGrid& grid) {
        return first + grid.options().resolution;
    };
    const std::int64_t first_x = std::max(a.first_x(), b.first_x()) + margin;
    const std::int64_t first_z = std::max(a.first_z(), b.first_z()) + margin;
    const std::int64_t end_x = std::min(end(a.first_x(), a), end(b.first_x(), b)) - margin;
    const std::int64_t end_z = std::min(end(a.first_z(), a), end(b.first_z(), b)) - margin;
    for (std::int64_t z = first_z; z < end_z; ++z)
        for (std::int64_t x = first_x; x < end_x; ++x, ++compared) {
            ASSERT_EQ(a.height_m(x, z), b.height_m(x, z)) << x << ' ' << z;
            wet += a.height_m(x, z) != 0;
        }
    EXPECT_GT(compared, 300);
    EXPECT_GT(wet, compared / 4);
}

TEST(RainDrops, DoesNotDependOnTheGridPosition) {
    // the reach of a drop that only one grid holds completely
    constexpr std::int64_t margin = 2 * drop_texels + 2;
    DynamicWavesOptions large = stiff;
    large.resolution = 128;
    large.side_m = 32;
    DynamicWavePool here(stiff), there(stiff), larger(large), goes(stiff);
    there.grid.set_center(3.1, -2.3);
    larger.grid.set_center(-4, 5.2);
    for (DynamicWavePool* pool : {&here, &there, &larger, &goes}) pool->grid.set_rain(wide_drops);
    for (int tick = 0; tick < 40; ++tick) {
        // eight texels along x and six along z in all
        goes.grid.set_center(0.05 * tick, -0.04 * tick);
        for (DynamicWavePool* pool : {&here, &there, &larger, &goes}) pool->tick();
    }
    expect_same_inside(here.grid, there.grid, margin);
    expect_same_inside(here.grid, larger.grid, margin);
    expect_same_inside(here.grid, goes.grid, margin);
    // The drops also agree far away, where cell numbers are large and negative.
    there.grid.set_center(-9e7, 9e7);
    larger.grid.set_center(-9e7 + 2, 9e7 - 1);
    DynamicWavePool fresh(large);
    fresh.grid.set_center(-9e7, 9e7);
    fresh.grid.set_rain(wide_drops);
    fresh.tick(40);
    larger.tick(40);
    there.tick(40);
    expect_same_inside(there.grid, larger.grid, margin);
    bool differs = false;  // Other ticks have other drops.
    for (std::int64_t i = 0; i < 64; ++i)
        differs |= fresh.grid.height_m(fresh.grid.first_x() + i + 32, fresh.grid.first_z() + 64) !=
                   there.grid.height_m(fresh.grid.first_x() + i + 32, fresh.grid.first_z() + 64);
    EXPECT_TRUE(differs);
}

const DynamicWavesOptions small_pond{.resolution = 64, .side_m = 32, .border_m = 6};
const Rain pours{.drops_per_m2_s = 5, .radius_m = 0.8, .height_m = 0.05, .seed = 3};

void rain_and_pan(DynamicWavePool& pool, int from, int to) {
    for (int tick = from; tick < to; ++tick) {
        if (tick == 60) pool.grid.set_rain({.drops_per_m2_s = 12, .radius_m = 0.3, .height_m = 0.1});
        pool.grid.set_center(0.07 * tick, 0.2 * tick);
        pool.tick();
    }
}

TEST(RainDrops, RestoredStateContinuesBitIdentically) {
    for (const DynamicWavesStep step : {DynamicWavesStep::spectral, DynamicWavesStep::verlet}) {
        DynamicWavesOptions options = small_pond;
        options.step = step;
        DynamicWavePool stays(options), late(options);
        stays.grid.set_rain(pours);
        rain_and_pan(stays, 0, 40);
        late.grid.restore(stays.grid.saved());
        rain_and_pan(stays, 40, 80);
        rain_and_pan(late, 40, 80);
        EXPECT_EQ(late.grid.saved(), stays.grid.saved());
    }
}

TEST(RainDrops, RateZeroDisablesRain) {
    DynamicWavePool dry(small_pond), over(small_pond), other(small_pond), same(small_pond);
    over.grid.set_rain(pours);
    over.grid.set_rain({.drops_per_m2_s = 0, .radius_m = 1e9, .height_m = std::numeric_limits<double>::quiet_NaN()});
    same.grid.set_rain(pours);
    other.grid.set_rain({.drops_per_m2_s = 5, .radius_m = 0.8, .height_m = 0.05, .seed = 4});
    for (DynamicWavePool* pool : {&dry, &over, &same, &other}) {
        pool->grid.sources().add_impulse({.mode = Disturbance::Mode::impulse, .height_m = 0.4});
        pool->tick(20);
    }
    EXPECT_EQ(over.grid.saved(), dry.grid.saved());
    EXPECT_NE(same.grid.hash(), dry.grid.hash());
    EXPECT_NE(same.grid.hash(), other.grid.hash());
}

// A drop with a radius of half a texel becomes one texel wide and a quarter as high. Factors of two
// are exact.
TEST(RainDrops, DropsNarrowerThanATexelAreWidenedAndFlattened) {
    DynamicWavePool wider(stiff), narrow(stiff);
    Rain rain{.drops_per_m2_s = 3, .radius_m = cell_m, .height_m = 0.04};
    wider.grid.set_rain(rain);
    rain.radius_m = cell_m / 2;
    narrow.grid.set_rain(rain);
    wider.tick();
    narrow.tick();
    const std::vector<double> a = heights(wider.grid), b = heights(narrow.grid);
    EXPECT_GT(*std::max_element(a.begin(), a.end()), 1e-3);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(b[i], a[i] / 4);
}

TEST(RainDrops, InvalidOptionsAreRejected) {
    const DynamicWavesOptions water;  // side_m is 64
    Rain rain{.drops_per_m2_s = 1};
    EXPECT_EQ(check(rain, water), "");
    rain.radius_m = 4.1;
    EXPECT_EQ(check(rain, water), "radius_m 4.1 is out of range [0.001, 4], to a 16th of side_m");
    rain.radius_m = 0;
    EXPECT_EQ(check(rain, water), "radius_m 0 is out of range [0.001, 4], to a 16th of side_m");
    rain = {.drops_per_m2_s = 1, .height_m = std::numeric_limits<double>::quiet_NaN()};
    EXPECT_NE(check(rain, water), "");
    // A drop covers eight by eight texels, 2 m by 2 m; 16 drops cover a texel in each of 60 ticks a
    // second.
    rain = {.drops_per_m2_s = 16.0 * 60 / 4};
    EXPECT_EQ(check(rain, water), "");
    rain.drops_per_m2_s = 250;
    EXPECT_EQ(check(rain, water),
              "drops_per_m2_s 250 is out of range [0, 240] for drops of this radius on this grid");
    rain.drops_per_m2_s = -1;
    EXPECT_NE(check(rain, water), "");
    rain.drops_per_m2_s = std::numeric_limits<double>::infinity();
    EXPECT_NE(check(rain, water), "");
    EXPECT_THROW(DynamicWaves(water).set_rain(rain), std::invalid_argument);
    DynamicWavePool pool(water);
    // A saved state with invalid rain is rejected, and the grid is unchanged.
    pool.grid.set_rain({.drops_per_m2_s = 2});
    const std::vector<std::uint8_t> saved = pool.grid.saved();
    std::vector<std::uint8_t> wrong = saved;
    const double radius = 5;
    std::memcpy(wrong.data() + wrong.size() - 3 * sizeof radius, &radius, sizeof radius);
    EXPECT_THROW(pool.grid.restore(wrong), std::invalid_argument);
    EXPECT_EQ(pool.grid.saved(), saved);
}

}  // namespace
}  // namespace pelagic
