// Transitions between seas: the forecast, the blend of two spectra, and frames as functions of
// forecast and time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/cascades/packed_spectrum.hpp"
#include "pelagic/sim/cascades/spectrum_cache.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/frame_bits.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

constexpr double degree = std::numbers::pi / 180;

// In loops of 200 s a change may take a million loops.
const SeaState calm_sea{
    .resolution = 64, .wind_speed_mps = 4, .fetch_m = 20e3, .choppiness = 0.6, .loop_period_s = 200};
const SeaState storm_sea{.resolution = 64,
                         .wind_speed_mps = 19,
                         .wind_direction_rad = 90 * degree,
                         .fetch_m = 400e3,
                         .choppiness = 1,
                         .loop_period_s = 200};

Forecast calm_to_storm(double from_s = 10, double over_s = 20) {
    return {.first = calm_sea, .changes = {{.sea = storm_sea, .from_s = from_s, .over_s = over_s}}};
}

OceanOptions serial(Isa isa = choose_isa()) { return {.executor = make_serial_executor(), .isa = isa}; }

std::uint64_t forecast_hash(const Forecast& forecast, double time_s, OceanOptions options = serial()) {
    Ocean ocean(forecast, std::move(options));
    return hash_of(ocean.frame_at(time_s));
}

TEST(Forecast, ReturnsTheTwoSeasAndTheWeightOfTheSecond) {
    Forecast forecast = calm_to_storm(10, 20);
    forecast.changes.push_back({.sea = calm_sea, .from_s = 30, .over_s = 4});
    const auto expect = [&](double time_s, std::size_t before, std::size_t after, double part) {
        const ForecastMoment moment = forecast.at(time_s);
        EXPECT_EQ(moment.before, before) << time_s;
        EXPECT_EQ(moment.after, after) << time_s;
        EXPECT_DOUBLE_EQ(moment.weight, part) << time_s;
    };
    expect(-1e6, 0, 0, 0);
    expect(10, 0, 0, 0);
    expect(15, 0, 1, 3 * 0.0625 - 2 * 0.015625);  // u = 1/4
    expect(20, 0, 1, 0.5);
    expect(30, 1, 1, 0);
    expect(33, 1, 2, 3 * 0.5625 - 2 * 0.421875);  // u = 3/4
    expect(34, 2, 2, 0);
    expect(1e9, 2, 2, 0);
}

TEST(Forecast, InvalidSeasAreRejectedWithOneLine) {
    const auto refused = [](auto alter) {
        Forecast forecast = calm_to_storm();
        alter(forecast);
        const std::string reason = check(forecast);
        EXPECT_EQ(reason.find('\n'), std::string::npos);
        EXPECT_THROW(Ocean(forecast, serial()), std::invalid_argument);
        return reason;
    };
    EXPECT_EQ(check(calm_to_storm()), "");
    EXPECT_EQ(refused([](Forecast& f) { f.first.wind_speed_mps = -3; }),
              "first sea: wind_speed_mps -3 is out of range (0, 60]");
    EXPECT_EQ(refused([](Forecast& f) { f.changes[0].sea.choppiness = 2; }),
              "change 1: choppiness 2 is out of range [0, 1]");
    EXPECT_EQ(refused([](Forecast& f) { f.changes[0].sea.depth_m = 20; }),
              "change 1: depth_m is 20, expected 4000 as the first sea has it");
    EXPECT_EQ(refused([](Forecast& f) { f.changes[0].sea.seed = 7; }),
              "change 1: seed is 7, expected 1 as the first sea has it");
    EXPECT_EQ(refused([](Forecast& f) { f.changes[0].sea.loop_period_s = 100; }),
              "change 1: loop_period_s is 100, expected 200 as the first sea has it");
    EXPECT_EQ(refused([](Forecast& f) { f.changes[0].sea.resolution = 128; }),
              "change 1: resolution is 128, expected 64 as the first sea has it");
    EXPECT_EQ(refused([](Forecast& f) { f.changes[0].sea.cascades = 3; }),
              "change 1: cascades is 3, expected 4 as the first sea has it");
    EXPECT_EQ(refused([](Forecast& f) { f.changes[0].sea.patch_size_m = 250; }),
              "change 1: patch_size_m is 250, expected 0 as the first sea has it");
    EXPECT_EQ(refused([](Forecast& f) { f.changes[0].sea.spectrum = SpectrumModel::phillips_paper; }),
              "change 1: spectrum is phillips-paper, expected a physical one as the first sea has it");
    EXPECT_EQ(refused([](Forecast& f) { f.changes[0].over_s = 0; }), "change 1: over_s 0 is out of range (0, 1e9]");
    EXPECT_EQ(refused([](Forecast& f) { f.changes.push_back({.sea = calm_sea, .from_s = 29, .over_s = 1}); }),
              "change 2: from_s is 29, expected at least 30, when the change before is over");
    EXPECT_EQ(refused([](Forecast& f) { f.changes[0].from_s = std::nan(""); }),
              "change 1: from_s nan is out of range [-1e12, 1e12]");
    EXPECT_EQ(refused([](Forecast& f) { f.largest_peak_m = 50; }).substr(0, 31), "change 1: peak_wavelength_m is ");
}

TEST(Forecast, SeaBetweenInterpolatesTheOptions) {
    SeaState north = calm_sea, west = storm_sea;
    north.wind_direction_rad = 350 * degree;
    west.wind_direction_rad = -340 * degree;  // 20
    EXPECT_NEAR(sea_between(north, west, 0.5).wind_direction_rad,
                2 * std::numbers::pi + 5 * degree - 2 * std::numbers::pi, 1e-12)
        << "the shorter way is 30 degrees through 0";
    EXPECT_DOUBLE_EQ(sea_between(north, west, 0.25).wind_speed_mps, 0.75 * 4 + 0.25 * 19);
    west.swell_height_m = 3;
    west.swell_period_s = 15;
    const SeaState half = sea_between(north, west, 0.25);
    EXPECT_DOUBLE_EQ(half.swell_height_m, 1.5) << "a quarter of the energy";
    EXPECT_EQ(half.swell_period_s, 15) << "calm has no swell";
    for (const double part : {0.1, 0.5, 0.9}) EXPECT_EQ(check(sea_between(north, west, part)), "");
}

TEST(CascadePlan, SeasOfOneForecastShareGridsAndBands) {
    WaveReach reach = WaveReach::of(calm_sea);
    reach.extend_to(WaveReach::of(storm_sea));
    const auto of_calm = plan_cascades(calm_sea, reach), of_storm = plan_cascades(storm_sea, reach);
    EXPECT_GE(of_storm.front().grid.side_m, plan_cascades(storm_sea).front().grid.side_m);
    ASSERT_EQ(of_calm.size(), of_storm.size());
    for (std::size_t cascade = 0; cascade < of_calm.size(); ++cascade) {
        EXPECT_EQ(of_calm[cascade].grid.side_m, of_storm[cascade].grid.side_m);
        EXPECT_EQ(of_calm[cascade].grid.sine, of_storm[cascade].grid.sine);
        EXPECT_EQ(of_calm[cascade].min_k, of_storm[cascade].min_k);
        if (cascade + 1 < of_calm.size()) {
            EXPECT_EQ(of_calm[cascade].max_k, of_storm[cascade].max_k);
        }
    }
}

class BlendOnEachIsa : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(Isas, BlendOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

/// Equation 22.
std::array<double, 4> packed(const std::array<double, 4>& w) {
    return {w[0] + w[2], w[1] + w[3], w[1] - w[3], w[2] - w[0]};
}

// A component of a wave is the difference of two floats of the pair, so it is accurate to their
// steps: eight of them, including those of squares, root and sum. The smallest amplitudes are the
// minimum of a sea, whose squares underflow.
TEST_P(BlendOnEachIsa, EnergyOfEachWaveIsInterpolated) {
    const std::size_t lanes = kernels().lanes, pairs = 32, row = lanes, floats = pairs * wave_quantities * row;
    AlignedBuffer<float> before(floats), after(floats), out(floats);
    std::mt19937 random(3);
    const auto uniform = [&](double min, double max) {
        return min + (max - min) * static_cast<double>(random()) / 0x1p32;
    };
    for (const float part : {1e-6f, 0.25f, 0.5f, 0.999f}) {
        std::vector<std::array<double, 4>> expected;
        const auto each_wave = [&](auto use) {
            for (std::size_t pair = 0; pair < pairs; ++pair)
                for (const std::size_t first : {std::size_t{plus_cos_re}, std::size_t{minus_cos_re}})
                    for (std::size_t lane = 0; lane < lanes; ++lane)
                        use((pair * wave_quantities + first) * row + lane);
        };
        each_wave([&](std::size_t at) {
            std::array<double, 4> both{}, from{}, to{};
            const double size = std::pow(10, uniform(-20, 1)), growth = std::pow(10, uniform(-1, 1));
            for (std::size_t i = 0; i < 4; ++i) {
                from[i] = size * uniform(-1, 1);
                to[i] = from[i] * growth;
                both[i] = std::copysign(std::sqrt((1 - part) * from[i] * from[i] + part * to[i] * to[i]), from[i]);
            }
            const auto s0 = packed(from), s1 = packed(to);
            for (std::size_t i = 0; i < 4; ++i) {
                before[at + i * row] = static_cast<float>(s0[i]);
                after[at + i * row] = static_cast<float>(s1[i]);
            }
            expected.push_back(packed(both));
        });
        for (std::size_t pair = 0; pair < pairs; ++pair) {
            for (std::size_t i = 0; i < 2 * row; ++i)
                before[(pair * wave_quantities + direction_x) * row + i] = static_cast<float>(uniform(-1, 1));
            for (AlignedBuffer<float>* const waves : {&before, &after})
                for (std::size_t i = 0; i < row; ++i)
                    (*waves)[(pair * wave_quantities + lean_tangent) * row + i] =
                        pair % 2 == 0 ? 0 : static_cast<float>(uniform(0, 0.6));
        }
        kernels().blend_waves({before.data(), after.data(), pairs, part, out.data()});
        std::size_t number = 0;
        each_wave([&](std::size_t at) {
            double largest = 0;
            for (std::size_t i = 0; i < 4; ++i)
                largest = std::max({largest, std::abs(expected[number][i]),
                                    std::abs(static_cast<double>(before[at + i * row])),
                                    std::abs(static_cast<double>(part * after[at + i * row]))});
            for (std::size_t i = 0; i < 4; ++i)
                EXPECT_NEAR(out[at + i * row], expected[number][i], largest * 0x1p-21) << "part " << part;
            ++number;
        });
        // The direction's length is the cosine of the lean. Without lean no bit changes.
        for (std::size_t pair = 0; pair < pairs; ++pair)
            for (std::size_t i = 0; i < 2 * row; ++i) {
                const std::size_t at = (pair * wave_quantities + direction_x) * row + i;
                const std::size_t lean = (pair * wave_quantities + lean_tangent) * row + i % row;
                const double from = before[lean], to = (1 - part) * from + part * after[lean];
                EXPECT_NEAR(out[lean], to, 1e-7);
                if (pair % 2 == 0) {
                    EXPECT_EQ(out[at], before[at]);
                } else {
                    EXPECT_NEAR(out[at], before[at] * std::cos(std::atan(to)) / std::cos(std::atan(from)), 4e-7);
                }
            }
    }
}

TEST(SpectrumCache, KeepsSpectraInUseAndEvictsTheOldest) {
    SpectrumCache shelf;
    for (std::size_t number = 0; number < SpectrumCache::entries; ++number) shelf.put(number);
    shelf.need(Pass::tick, 0, 1);
    shelf.need(Pass::frame, 1, 2);
    shelf.put(7);
    EXPECT_FALSE(shelf.holds(3)) << "nobody took it";
    shelf.need(Pass::tick, 1, 2);
    shelf.need(Pass::frame, 2, 7);
    shelf.put(8);
    EXPECT_FALSE(shelf.holds(4)) << "nobody took it either";
    shelf.put(9);
    EXPECT_FALSE(shelf.holds(0));
    for (const std::size_t number : {1, 2, 7, 8, 9}) EXPECT_TRUE(shelf.holds(number)) << number;
}

// Seas of one forecast share their cascades, so either may come first.
TEST(Weather, EqualsTheFirstSeaBeforeAndTheSecondAfterTheChange) {
    const Forecast there = calm_to_storm();
    const Forecast back{.first = storm_sea, .changes = {{.sea = calm_sea, .from_s = 10, .over_s = 20}}};
    const double loop_s = calm_sea.loop_period_s;
    EXPECT_EQ(forecast_hash(there, 10), forecast_hash(back, 10 + loop_s));
    EXPECT_EQ(forecast_hash(there, 30 + loop_s), forecast_hash(back, 30 - loop_s));
    EXPECT_NE(forecast_hash(there, 10.5), forecast_hash(back, 10.5 + loop_s));
}

// A calm sea alone has other cascades than one that a storm follows. With `largest_peak_m` of the
// storm it has the same.
TEST(Weather, WithLargestPeakASeaIsIdenticalWithOrWithoutChanges) {
    const double peak_m = WaveReach::of(storm_sea).peak_m;
    EXPECT_EQ(forecast_hash({.first = calm_sea, .largest_peak_m = peak_m}, 3), forecast_hash(calm_to_storm(), 3));
    EXPECT_NE(forecast_hash({.first = calm_sea}, 3), forecast_hash(calm_to_storm(), 3));
    EXPECT_EQ(forecast_hash({.first = storm_sea}, 3), hash_of(Ocean(storm_sea, serial()).frame_at(3)));
}

Forecast some_weather() {
    Forecast forecast = calm_to_storm(10, 20);
    SeaState swell = calm_sea;
    swell.swell_height_m = 2;
    // Changes between two foam ticks, seas for a moment, and one that returns.
    forecast.changes.push_back({.sea = swell, .from_s = 30.5, .over_s = 0.05});
    forecast.changes.push_back({.sea = calm_sea, .from_s = 30.55, .over_s = 0.05});
    forecast.changes.push_back({.sea = storm_sea, .from_s = 30.7, .over_s = 3});
    forecast.changes.push_back({.sea = swell, .from_s = 60, .over_s = 12});
    return forecast;
}

// Foam depends on the 2.9 s before, in which there are five seas.
TEST(Weather, FramesAreBitIdenticalInAnyOrder) {
    const Forecast forecast = some_weather();
    const std::vector<double> times = {-3, 10.5, 20, 29.9, 30.52, 30.58, 30.65, 32, 50, 61, 61.05, 66, 80};
    std::vector<FrameBits> alone;
    for (const double time_s : times) {
        Ocean ocean(forecast, {.executor = make_serial_executor(), .foam = true});
        alone.push_back(bits_of(ocean.frame_at(time_s)));
    }
    Ocean ocean(forecast, {.executor = make_thread_executor(2), .foam = true});
    std::mt19937 random(11);
    const auto expect_same = [&](std::size_t i) {
        EXPECT_EQ(bits_of(ocean.frame_at(times[i])), alone[i]) << "at " << times[i] << " s";
    };
    for (std::size_t i = 0; i < times.size(); ++i) expect_same(i);
    for (std::size_t i = times.size(); i-- > 0;) expect_same(i);
    for (int jump = 0; jump < (is_sanitized ? 5 : 40); ++jump) expect_same(random() % times.size());
}

// Foam computed before a change stays valid unless the change begins before it.
TEST(Weather, FoamFollowsChangesOfALiveOcean) {
    const double peak_m = WaveReach::of(storm_sea).peak_m;
    Ocean live({.first = calm_sea, .largest_peak_m = peak_m}, {.executor = make_serial_executor(), .foam = true});
    for (const double over_s : {0.5, 0.4}) {
        const double from_s = live.forecast().changes.empty() ? 1 : 2;
        live.frame_at(2.9);
        live.frame_at(from_s);
        live.schedule_sea(over_s == 0.5 ? storm_sea : calm_sea, from_s, over_s);
        const Forecast now = live.forecast();
        for (const double time_s : {3.0, 3.3}) {
            Ocean fresh(now, {.executor = make_serial_executor(), .foam = true});
            EXPECT_EQ(bits_of(live.frame_at(time_s)), bits_of(fresh.frame_at(time_s))) << from_s << " " << time_s;
        }
    }
    live.schedule_sea(storm_sea, 3.5, 1);  // drops the first change, whose foam still counts
    Ocean fresh(live.forecast(), {.executor = make_serial_executor(), .foam = true});
    EXPECT_EQ(bits_of(live.frame_at(3.4)), bits_of(fresh.frame_at(3.4)));
}

TEST(Weather, VelocitiesMatchTheBlend) {
    const double step_s = 1e-3;
    Forecast slow = calm_to_storm(-1e5, 2e5);  // the waves change little in one step
    Ocean ocean(slow, {.executor = make_thread_executor(2), .velocities = Velocities::drawn});
    std::vector<double> moved;
    const auto heights = [&](double time_s) {
        const Cascade& cascade = ocean.frame_at(time_s).cascades[0];
        std::vector<double> all;
        for (int j = 0; j < cascade.resolution(); j += 7)
            for (int i = 0; i < cascade.resolution(); i += 5) all.push_back(cascade.height.at(i, j));
        return all;
    };
    const std::vector<double> earlier = heights(100 - step_s), later = heights(100 + step_s);
    const Cascade& cascade = ocean.frame_at(100).cascades[0];
    std::size_t number = 0;
    for (int j = 0; j < cascade.resolution(); j += 7)
        for (int i = 0; i < cascade.resolution(); i += 5, ++number)
            // Heights of metres have steps of 2^-22 m: 1e-4 m/s over two milliseconds.
            EXPECT_NEAR(cascade.velocity_y.at(i, j), (later[number] - earlier[number]) / (2 * step_s), 2e-3);
}

TEST(Weather, ExpectedHeightChangesFromTheFirstSeaToTheSecond) {
    Ocean ocean(calm_to_storm(), {.executor = make_thread_executor(2)});
    const auto height_at = [&](double time_s) { return ocean.frame_at(time_s).statistics.significant_wave_height_m; };
    const double low = height_at(10), high = height_at(30);
    double last = low;
    for (double time_s = 10.5; time_s < 30; time_s += 0.5) {
        const double now = height_at(time_s);
        EXPECT_GT(now, last) << time_s;
        EXPECT_LT(now, high) << time_s;
        last = now;
    }
    EXPECT_NEAR(height_at(20), std::sqrt((low * low + high * high) / 2), 1e-12 * high)
        << "half of the energy of each";
}

double mean_square_height(const Frame& frame) {
    double sum = 0;
    for (const Cascade& cascade : frame.cascades) {
        double of_cascade = 0;
        for (int j = 0; j < cascade.resolution(); ++j)
            for (int i = 0; i < cascade.resolution(); ++i) {
                const double height = cascade.height.at(i, j);
                of_cascade += height * height;
            }
        sum += of_cascade / cascade.resolution() / cascade.resolution();
    }
    return sum;
}

// Over a loop the energy of a wave that travels in both directions is that of both. So the mean of
// a dozen moments is near the energy, and the ratio to the blend of the two seas at the same
// moments is nearer. The difference is that of waves against others.
TEST(Weather, EnergyOfFramesMatchesTheBlend) {
    const double loop_s = calm_sea.loop_period_s, whole_s = 1e6 * loop_s;
    Ocean ocean(calm_to_storm(0, whole_s), {.executor = make_thread_executor(2)});
    const auto energy_around = [&](double part_of_change) {
        double sum = 0;
        for (int moment = 0; moment < 12; ++moment)
            sum += mean_square_height(ocean.frame_at(part_of_change * whole_s + moment * loop_s / 12));
        return sum / 12;
    };
    const double before = energy_around(-1), after = energy_around(1), storms = std::sqrt(after);
    for (const double u : {0.25, 0.5, 0.75}) {
        const double part = u * u * (3 - 2 * u);
        EXPECT_NEAR(std::sqrt(energy_around(u)), std::sqrt((1 - part) * before + part * after), 0.01 * storms) << u;
    }
}

double slope_variance(const Frame& frame) {
    double sum = 0;
    for (const Cascade& cascade : frame.cascades) sum += cascade.slope_variance;
    return sum;
}

/// Cox and Munk (1954): 0.00316 U upwind and 0.003 + 0.00192 U crosswind.
double measured_slope_variance(double wind_speed_mps) { return 0.003 + 0.00508 * wind_speed_mps; }

// The slopes of the textures and their expected values change with the energy. The subgrid
// roughness changes linearly, between the values for Cox and Munk's slopes in both winds.
TEST(Weather, SlopesChangeWithTheEnergyAndRoughnessLinearly) {
    const double loop_s = calm_sea.loop_period_s, whole_s = 1e6 * loop_s;
    Ocean ocean(calm_to_storm(0, whole_s), {.executor = make_thread_executor(2)});
    struct Slopes {
        double shown, expected, roughness;
    };
    const auto slopes_at = [&](double part_of_change) {
        Slopes slopes{};
        for (int moment = 0; moment < 12; ++moment) {
            const Frame& frame = ocean.frame_at(part_of_change * whole_s + moment * loop_s / 12);
            slopes.shown += slope_variance(frame) / 12;
            slopes.expected = frame.statistics.resolved_slopes.total();
            slopes.roughness = frame.statistics.roughness;
        }
        return slopes;
    };
    const Slopes before = slopes_at(-1), after = slopes_at(1);
    EXPECT_NEAR(before.roughness, std::sqrt(measured_slope_variance(4) - before.expected), 1e-12);
    EXPECT_NEAR(after.roughness, std::sqrt(measured_slope_variance(19) - after.expected), 1e-12);
    ASSERT_GT(after.roughness, 2 * before.roughness) << "else a wrong blend is hard to tell";
    for (const double u : {0.125, 0.25, 0.5, 0.75}) {
        const double part = u * u * (3 - 2 * u);
        const auto between = [&](double Slopes::*which) { return (1 - part) * before.*which + part * after.*which; };
        const Slopes now = slopes_at(u);
        // The bound covers waves against others, as in EnergyOfFramesMatchesTheBlend, and one byte
        // of slope.
        EXPECT_NEAR(now.shown, between(&Slopes::shown), 0.02 * after.shown) << u;
        // In 12 moments a change of 1e6 loops moves s by less than 2e-6.
        EXPECT_NEAR(now.expected, between(&Slopes::expected), 2e-6 * after.expected) << u;
        EXPECT_NEAR(now.roughness, between(&Slopes::roughness), 2e-6 * after.roughness) << u;
    }
}

TEST(Weather, SmoothnessChannelHasTheRoughnessOfTheBlend) {
    SeaState smooth = calm_sea, rough = storm_sea, swell = storm_sea;
    smooth.roughness = 0.04;
    rough.roughness = 0.64;
    swell.roughness = 0.25;
    swell.swell_height_m = 2;
    const Forecast forecast{.first = smooth,
                            .changes = {{.sea = rough, .from_s = 10, .over_s = 20},
                                        {.sea = swell, .from_s = 40, .over_s = 20, .swell_from_m = 1000}}};
    Ocean ocean(forecast, {.executor = make_serial_executor(), .gradients = true});
    const auto expect_roughness = [&](double time_s, double roughness) {
        const Frame& frame = ocean.frame_at(time_s);
        EXPECT_NEAR(frame.statistics.roughness, roughness, 1e-12) << time_s;
        for (const Cascade& cascade : frame.cascades)
            EXPECT_NEAR((cascade.gradient_level(0)[5] >> 24) / 255.0, 1 - std::sqrt(roughness), 0.51 / 255) << time_s;
    };
    for (const double time_s : {0.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0}) {
        const double u = std::clamp((time_s - 10) / 20, 0.0, 1.0);
        expect_roughness(time_s, 0.04 + u * u * (3 - 2 * u) * (0.64 - 0.04));
    }
    const double end_s = forecast.changes[1].end_s();
    ASSERT_GT(end_s, 100) << "waves of the swell's peak come first";
    for (double time_s = 40; time_s < end_s + 5; time_s += 20) {
        const ForecastMoment moment = forecast.at(time_s);
        const double part = moment.before == moment.after ? time_s < end_s ? 0 : 1 : moment.weight;
        expect_roughness(time_s, 0.64 + part * (0.25 - 0.64));
    }
}

struct Turn {
    std::string name;
    SeaState before, after;
    double over_s;
    std::optional<double> swell_from_m = {};
};

class WeatherMoves : public testing::TestWithParam<Turn> {};

Turn wind_turns_by_90_degrees(double over_s) {
    SeaState turned = storm_sea;
    turned.wind_direction_rad = 180 * degree;
    return {"WindTurns", storm_sea, turned, over_s};
}
/// Over 6 minutes.
Turn swell_comes_from_afar() {
    SeaState swell = calm_sea;
    swell.swell_height_m = 4;
    return {"SwellFromAfar", calm_sea, swell, 20, 1300};
}
INSTANTIATE_TEST_SUITE_P(Changes, WeatherMoves,
                         testing::Values(wind_turns_by_90_degrees(10), Turn{"CalmToStorm", calm_sea, storm_sea, 20},
                                         Turn{"StormToCalm", storm_sea, calm_sea, 10}, swell_comes_from_afar()),
                         [](const auto& changed) { return changed.param.name; });

// Compares all heights and all horizontal displacements of a cascade, at 72 frames a second.
TEST_P(WeatherMoves, FromFrameToFrameAtMostAsMuchAsTheLargerSea) {
    const Turn& turn = GetParam();
    const double frame_s = 1.0 / 72, loop_s = calm_sea.loop_period_s;
    const SeaChange change{.sea = turn.after, .from_s = 0, .over_s = turn.over_s, .swell_from_m = turn.swell_from_m};
    Ocean ocean({.first = turn.before, .changes = {change}}, {.executor = make_thread_executor(2)});
    const auto largest_step = [&](double time_s) {
        std::vector<std::vector<float>> earlier;
        double largest = 0;
        for (const double at_s : {time_s, time_s + frame_s}) {
            const Frame& frame = ocean.frame_at(at_s);
            std::size_t number = 0;
            for (const Cascade& cascade : frame.cascades)
                for (const PlaneView* plane : {&cascade.dx, &cascade.height, &cascade.dz})
                    for (int j = 0; j < cascade.resolution(); ++j, ++number) {
                        std::vector<float> row(static_cast<std::size_t>(cascade.resolution()));
                        plane->copy_row(j, row.data());
                        if (number < earlier.size())
                            for (std::size_t i = 0; i < row.size(); ++i)
                                largest = std::max<double>(largest, std::abs(row[i] - earlier[number][i]));
                        if (at_s == time_s) earlier.push_back(row);
                    }
        }
        return largest;
    };
    double steady = 0, changing = 0;
    const double every_s = (is_sanitized ? 4 : 0.5) * change.end_s() / turn.over_s;
    for (double time_s = 0; time_s < change.end_s(); time_s += every_s) {
        changing = std::max(changing, largest_step(time_s));
        steady = std::max({steady, largest_step(time_s - 5 * loop_s), largest_step(time_s + 5 * loop_s)});
    }
    RecordProperty("changing_over_steady", std::to_string(changing / steady));
    EXPECT_LE(changing, 1.2 * steady);
    EXPECT_GT(changing, 0.3 * steady) << "it does move";
}

TEST(Weather, ALiveOceanAcceptsSeveralChanges) {
    const double peak_m = WaveReach::of(storm_sea).peak_m;
    Ocean ocean({.first = calm_sea, .largest_peak_m = peak_m}, {.executor = make_thread_executor(2)});
    ocean.frame_at(8);
    ocean.schedule(9);
    ocean.schedule_sea(storm_sea, 10, 20);  // a frame is in flight
    ocean.complete();
    EXPECT_EQ(hash_of(ocean.frame_at(17)), forecast_hash(calm_to_storm(), 17));
    EXPECT_EQ(ocean.frame_at(17).sea.wind_speed_mps,
              sea_between(calm_sea, storm_sea, ocean.forecast().at(17).weight).wind_speed_mps);
    EXPECT_EQ(ocean.sea().wind_speed_mps, storm_sea.wind_speed_mps);

    EXPECT_THROW(ocean.schedule_sea(calm_sea, 29, 5), std::invalid_argument) << "the change before is not over";
    ocean.schedule_sea(calm_sea, 40, 5);
    EXPECT_EQ(hash_of(ocean.frame_at(17)), forecast_hash(calm_to_storm(), 17));
    ocean.schedule_sea(storm_sea, 50, 5);  // drops the first change
    EXPECT_EQ(ocean.forecast().changes.size(), 2u);
    EXPECT_EQ(ocean.frame_at(9).sea.wind_speed_mps, storm_sea.wind_speed_mps) << "the oldest that is left";
    EXPECT_EQ(ocean.frame_at(47).sea.wind_speed_mps, calm_sea.wind_speed_mps);
    EXPECT_EQ(ocean.frame_at(56).sea.wind_speed_mps, storm_sea.wind_speed_mps);
}

TEST(Weather, AChangeInThePastStartsWithTheFrameScheduledLast) {
    const double peak_m = WaveReach::of(storm_sea).peak_m, next_s = 9 + 1.0 / 90;
    Ocean ocean({.first = calm_sea, .largest_peak_m = peak_m}, serial());
    ocean.schedule(9);
    ocean.schedule_sea(storm_sea, -3, 20);  // a frame is in flight
    ocean.complete();
    EXPECT_EQ(ocean.forecast().changes[0].from_s, 9);
    EXPECT_EQ(hash_of(ocean.frame_at(next_s)), forecast_hash(calm_to_storm(9, 20), next_s));

    const std::vector<FrameBuffers> no_buffers(ocean.cascade_count());
    ocean.frame_at(1e4, no_buffers);
    ocean.schedule_sea(calm_sea, 30, 20);
    EXPECT_EQ(ocean.forecast().changes[1].from_s, 30) << "a frame in buffers is not the current one";
}

TEST(Weather, ALiveOceanRejectsALongerPeakThanItsLargest) {
    Ocean ocean(calm_sea, serial());
    EXPECT_EQ(message_of([&] { ocean.schedule_sea(storm_sea, 10, 20); }).substr(0, 27), "change 1: peak_wavelength_m")
        << "the storm's peak is longer than the cascades are laid out for";
    EXPECT_EQ(hash_of(ocean.frame_at(12)), hash_of(Ocean(calm_sea, serial()).frame_at(12)));
}

// Cascades of a longer peak are wider at the same resolution.
TEST(Weather, WarnsOfTheShortestWaveThatLongPeaksLeave) {
    const SeaState calm = sea_preset_named("calm")->sea;
    const Forecast forecast{.first = calm, .largest_peak_m = 300};
    const CascadePlan finest = plan_cascades(forecast).back();
    const std::string warning = warning_about(forecast);
    EXPECT_TRUE(warning.starts_with("cascades for a peak wavelength of 300 m hold no waves shorter than "))
        << warning;
    EXPECT_NE(warning.find(rounded_text(2 * finest.grid.side_m / finest.resolution, 2) + " m, where"),
              std::string::npos)
        << warning;
    EXPECT_EQ(warning_about(Forecast{.first = calm}), "");
}

TEST(Weather, AnotherSeaMayBeBakedWhileTheWeatherChanges) {
    Ocean ocean(calm_to_storm(), {.executor = make_thread_executor(2)});
    SeaState other = calm_sea;
    other.depth_m = 20;
    other.seed = 5;
    ocean.schedule_sea(other);
    EXPECT_EQ(hash_of(ocean.frame_at(17)), forecast_hash(calm_to_storm(), 17))
        << "whose storm had to be baked meanwhile";
    EXPECT_TRUE(ocean.sea_is_ready());
    EXPECT_EQ(hash_of(ocean.frame_at(17)), forecast_hash(calm_to_storm(), 17));
    ocean.complete_sea();
    EXPECT_EQ(hash_of(ocean.frame_at(17)), hash_of(Ocean(other, serial()).frame_at(17)));
    EXPECT_TRUE(ocean.forecast().changes.empty());
}

}  // namespace
}  // namespace pelagic
