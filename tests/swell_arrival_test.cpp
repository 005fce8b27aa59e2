// Swell from a distance: the arrival time of each wave, in frames and statistics.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/cascades/packed_spectrum.hpp"
#include "pelagic/sim/kernels/harmonic_bands.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/swell_arrival.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/tests/each_executor.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/frame_bits.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

constexpr double peak_period_s = 12;

SeaState with_swell(SeaState sea) {
    sea.swell_height_m = 3;
    sea.swell_period_s = peak_period_s;
    sea.swell_direction_rad = 0.6;
    return sea;
}

/// In its loop each long wave of the swell has a frequency band of its own.
const SeaState ripples{.resolution = 64, .wind_speed_mps = 3, .fetch_m = 5e3, .loop_period_s = 200};
const SeaState sea_with_swell = with_swell(ripples);

Forecast from_afar(double distance_m, double over_s) {
    return {.first = ripples,
            .changes = {{.sea = sea_with_swell, .from_s = 10, .over_s = over_s, .swell_from_m = distance_m}}};
}

/// In deep water cg = g / 2 omega. Returns the delay from the start of the change to the arrival of
/// waves of `omega`.
double deep_delay_s(double omega, double distance_m) {
    const double first = two_pi / (1.5 * peak_period_s), last = two_pi / (peak_period_s / 3);
    return 2 * distance_m / gravity_mps2 * (std::clamp(omega, first, last) - first);
}

double fraction_of(double omega, const SeaChange& change, double time_s) {
    const double begins_s = change.from_s + deep_delay_s(omega, change.swell_from_m.value());
    const double u = std::clamp((time_s - begins_s) / change.over_s, 0.0, 1.0);
    return u * u * (3 - 2 * u);
}

TEST(SwellArrival, FrequenciesArriveAtAConstantRateInDeepWater) {
    const SwellArrival arrival(sea_with_swell, 4e6);
    for (const double omega : {0.1, two_pi / 18, 0.4, two_pi / peak_period_s, 1.0, two_pi / 4, 3.0})
        EXPECT_NEAR(arrival.delay_s(omega), deep_delay_s(omega, 4e6), 1e-9 * arrival.span_s()) << omega;
    EXPECT_EQ(arrival.delay_s(0.1), 0);
    EXPECT_EQ(arrival.delay_s(3), arrival.span_s());
    EXPECT_EQ(arrival.delay_of_peak_s(), arrival.delay_s(two_pi / peak_period_s));
}

TEST(SwellArrival, ArrivalTimesSpreadLessInShallowWater) {
    SeaState shallow = sea_with_swell;
    shallow.depth_m = 2;
    // Long waves have a group speed of sqrt(g depth); waves of 18 s are 1 % slower, and waves of 4
    // s (k depth 0.77) 22 %: 1/0.78 - 1/0.99.
    EXPECT_NEAR(SwellArrival(shallow, 1e6).span_s(), 0.27 * 1e6 / std::sqrt(gravity_mps2 * 2), 0.02 * 1e6 / 4.4);
}

TEST(SwellArrival, ForecastHasTheEndAndTheWeightOfThePeak) {
    const Forecast forecast = from_afar(1e5, 600);
    const SeaChange& change = forecast.changes[0];
    const double last_s = deep_delay_s(two_pi / 4, 1e5);
    EXPECT_NEAR(change.end_s(), 10 + 600 + last_s, 1e-6);
    for (const double since_s : {1.0, 9000.0, 11000.0, last_s + 599}) {
        const ForecastMoment moment = forecast.at(10 + since_s);
        EXPECT_EQ(moment.before, 0u);
        EXPECT_EQ(moment.after, 1u);
        EXPECT_NEAR(moment.weight, fraction_of(two_pi / peak_period_s, change, 10 + since_s), 1e-9);
    }
    EXPECT_EQ(forecast.at(10).after, 0u);
    EXPECT_EQ(forecast.at(change.end_s()).before, 1u);
}

TEST(SwellArrival, InvalidValuesAreRejectedWithOneLine) {
    Forecast forecast = from_afar(500, 10);
    EXPECT_EQ(check(forecast), "change 1: swell_from_m 500 is out of range [1e3, 2e7]");
    forecast.changes[0].swell_from_m = 3e7;
    EXPECT_EQ(check(forecast).substr(0, 44), "change 1: swell_from_m 30000000 is out of ra");
    forecast.changes[0].swell_from_m = std::nan("");
    EXPECT_NE(check(forecast), "");
    forecast.changes[0].swell_from_m = 1e3;
    EXPECT_EQ(check(forecast), "");
    forecast.changes.push_back({.sea = ripples, .from_s = 50, .over_s = 1});
    EXPECT_EQ(check(forecast).substr(0, 45), "change 2: from_s is 50, expected at least 269")
        << "the last waves come then";
    forecast.changes = {{.sea = ripples, .from_s = 10, .over_s = 1, .swell_from_m = 1e5}};
    EXPECT_EQ(check(forecast), "change 1: swell_from_m is 100000, expected none where the sea has no swell");
}

TEST(HarmonicBands, AreOneHarmonicAtFirstAndThenASixteenthOfAnOctave) {
    for (std::uint32_t harmonic = 1; harmonic < 32; ++harmonic) {
        EXPECT_GT(harmonic_band(harmonic + 1), harmonic_band(harmonic));
        EXPECT_EQ(middle_harmonic(harmonic_band(harmonic)), harmonic);
    }
    for (std::uint32_t harmonic = 32; harmonic < 0x70000000; harmonic += harmonic / 7) {
        const std::size_t band = harmonic_band(harmonic);
        EXPECT_EQ(harmonic_band(static_cast<std::uint32_t>(middle_harmonic(band))), band) << harmonic;
        EXPECT_NEAR(middle_harmonic(band) / harmonic, 1, 0.5 / 16) << harmonic;
    }
}

class ArrivalOnEachIsa : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(Isas, ArrivalOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

TEST_P(ArrivalOnEachIsa, EachWaveBlendsWithItsOwnWeight) {
    const std::size_t lanes = kernels().lanes, pairs = 16, floats = pairs * wave_quantities * lanes;
    AlignedBuffer<float> before(floats), after(floats), out(floats), alone(floats);
    AlignedBuffer<std::uint32_t> harmonics(pairs * lanes);
    std::mt19937 random(5);
    const auto uniform = [&] { return static_cast<float>(random()) * 0x1p-31f - 1; };
    for (std::size_t i = 0; i < floats; ++i) {
        before[i] = uniform();
        after[i] = uniform();
    }
    for (std::size_t i = 0; i < pairs * lanes; ++i)
        harmonics[i] = static_cast<std::uint32_t>(random()) >> (1 + i % 31);  // 0: no wave
    std::vector<float> parts(100);
    for (float& part : parts) part = 0.5f + 0.5f * uniform();
    kernels().blend_arriving_waves({before.data(), after.data(), harmonics.data(), pairs, parts.data(),
                                    static_cast<std::int32_t>(parts.size()) - 1, out.data()});
    for (std::size_t wave = 0; wave < pairs * lanes; ++wave) {
        if (harmonics[wave] == 0) continue;
        const float part = parts[std::min(harmonic_band(harmonics[wave]), parts.size() - 1)];
        kernels().blend_waves({before.data(), after.data(), pairs, part, alone.data()});
        for (std::size_t i = 0; i < wave_quantities; ++i) {
            const std::size_t at = (wave / lanes * wave_quantities + i) * lanes + wave % lanes;
            EXPECT_EQ(out[at], alone[at]) << "harmonic " << harmonics[wave];
        }
    }
}

/// Returns one term of a cascade's discrete Fourier transform.
std::complex<double> term(const Cascade& cascade, int m, int n) {
    const int size = cascade.resolution();
    std::complex<double> sum;
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i)
            sum += static_cast<double>(cascade.height.at(i, j)) * std::polar(1.0, -two_pi * (m * i + n * j) / size);
    return sum;
}

// The swell has no waves before the change, so each wave's height has the root of its energy
// weight, whatever its phase. Floats of metres have an error of 1e-3 of the short waves.
TEST(SwellArrival, LongWavesArriveBeforeShortWaves) {
    const Forecast forecast = from_afar(2e4, 1000);
    const SeaChange& change = forecast.changes[0];
    const double loop_s = sea_with_swell.loop_period_s;
    Ocean ocean(forecast, {.executor = make_thread_executor(2)});
    struct Seen {
        int m, n;
        double omega;
    };
    std::vector<Seen> waves;
    const double steady_s = 100 * loop_s;
    std::vector<std::complex<double>> whole;
    {
        const Cascade& cascade = ocean.frame_at(steady_s).cascades[0];
        const double spacing = two_pi / cascade.grid.side_m;
        for (int steps = 2; steps < 24; steps += 2) {
            // The swell's direction in the cascade's axes.
            const CascadeGrid::Vector along = cascade.grid.in_cascade(std::cos(0.6), std::sin(0.6));
            const int m = static_cast<int>(std::lround(steps * along.along));
            const int n = static_cast<int>(std::lround(steps * along.across));
            const double omega = angular_frequency(spacing * std::hypot(m, n), sea_with_swell.depth_m);
            const std::uint32_t harmonic = loop_harmonic(omega, loop_s);
            const std::complex<double> height = term(cascade, m, n);
            if (harmonic >= 32 || std::abs(height) < 1) continue;
            waves.push_back({m, n, two_pi * harmonic / loop_s});
            whole.push_back(height);
        }
    }
    ASSERT_GE(waves.size(), 4u);
    std::vector<double> came(waves.size(), -1);
    for (const int loop : {1, 4, 8, 12, 16, 20}) {
        const double time_s = loop * loop_s;
        const Cascade& cascade = ocean.frame_at(time_s).cascades[0];
        for (std::size_t i = 0; i < waves.size(); ++i) {
            const double part = std::norm(term(cascade, waves[i].m, waves[i].n) / whole[i]);
            EXPECT_NEAR(part, fraction_of(waves[i].omega, change, time_s), 3e-3) << "T " << two_pi / waves[i].omega;
            if (came[i] < 0 && part > 0.5) came[i] = time_s;
        }
    }
    RecordProperty("waves", static_cast<int>(waves.size()));
    EXPECT_LT(came.front(), came.back());
    EXPECT_GT(came.front(), 0);
}

/// Returns 4 sqrt of the mean energy of all waves of all cascades, each with the weight of its
/// frequency.
double expected_height(const Forecast& forecast, double time_s) {
    const SeaChange& change = forecast.changes[0];
    const auto plans = plan_cascades(forecast);
    double variance = 0;
    for (const CascadePlan& plan : plans) {
        const CascadeWaves before(forecast.first, plan), after(change.sea, plan);
        const int half = plan.resolution / 2;
        for (int n = 0; n < half; ++n)
            for (int m = n == 0 ? 1 : 1 - half; m < half; ++m) {
                const double k = std::hypot(m, n) * plan.spacing();
                const double part = fraction_of(angular_frequency(k, change.sea.depth_m), change, time_s);
                const auto energy = [&](const CascadeWaves& of) {
                    const auto both = of.variances(m, n).plus;
                    return 2 * (both.along + both.against);
                };
                variance += (1 - part) * energy(before) + part * energy(after);
            }
    }
    return 4 * std::sqrt(variance);
}

// Bands are a sixteenth of an octave, and long waves have the frequencies of a loop.
TEST(SwellArrival, StatisticsAreThoseOfTheWavesThatHaveArrived) {
    for (const double over_s : {400.0, 4000.0}) {
        const Forecast forecast = from_afar(2e4, over_s);
        Ocean ocean(forecast, {.executor = make_thread_executor(2)});
        const double end_s = forecast.changes[0].end_s();
        for (const double at : {0.15, 0.3, 0.5, 0.8}) {
            const SeaStatistics statistics = ocean.frame_at(at * end_s).statistics;
            const double expected = expected_height(forecast, at * end_s);
            EXPECT_NEAR(statistics.significant_wave_height_m, expected, 0.01 * expected) << over_s << " s, " << at;
        }
        const SeaStatistics last = ocean.frame_at(end_s).statistics;
        const SeaStatistics nearly = ocean.frame_at(end_s - 1e-3).statistics;
        EXPECT_NEAR(nearly.significant_wave_height_m, last.significant_wave_height_m, 1e-6);
        EXPECT_NEAR(nearly.foam_drift_x_mps, last.foam_drift_x_mps, 1e-6);
        EXPECT_NEAR(nearly.resolved_slopes.upwind, last.resolved_slopes.upwind, 1e-9);
    }
}

TEST(SwellArrival, FramesAreBitIdenticalInAnyOrderOnEveryInstructionSet) {
    Forecast forecast = from_afar(1e3, 20);
    forecast.changes.push_back({.sea = ripples, .from_s = 300, .over_s = 5});
    const std::vector<double> times = {5, 12, 60, 90.5, 150, 250, 277, 280, 302};
    std::vector<FrameBits> alone;
    for (const double time_s : times) {
        Ocean ocean(forecast, {.executor = make_serial_executor(), .isa = isas_here().front(), .foam = true});
        alone.push_back(bits_of(ocean.frame_at(time_s)));
    }
    std::mt19937 random(2);
    for (const Isa isa : isas_here()) {
        Ocean ocean(forecast, {.executor = make_thread_executor(2), .isa = isa, .foam = true});
        for (int jump = 0; jump < (is_sanitized ? 4 : 20); ++jump) {
            const std::size_t i = random() % times.size();
            EXPECT_EQ(bits_of(ocean.frame_at(times[i])), alone[i]) << name_of(isa) << " at " << times[i] << " s";
        }
    }
}

/// Returns FNV-1a over all heights.
std::uint64_t height_hash(const Frame& frame) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const Cascade& cascade : frame.cascades) {
        std::vector<float> row(static_cast<std::size_t>(cascade.resolution()));
        for (int j = 0; j < cascade.resolution(); ++j) {
            cascade.height.copy_row(j, row.data());
            for (const float value : row) hash = (hash ^ std::bit_cast<std::uint32_t>(value)) * 0x100000001b3u;
        }
    }
    return hash;
}

// The waves of this moment on every machine. If this hash changes, every forecast changes.
TEST(SwellArrival, FrameMatchesTheGoldenHash) {
    Ocean ocean(from_afar(1e3, 20), {.executor = make_serial_executor()});
    EXPECT_EQ(height_hash(ocean.frame_at(90)), 3874481786162187305u);
}

TEST(SwellArrival, BeginsAndEndsWithTheSteadySeas) {
    const Forecast far = from_afar(1e3, 20);
    Forecast near = far;
    near.changes[0].swell_from_m.reset();
    Ocean arriving(far, {.executor = make_serial_executor()}), together(near, {.executor = make_serial_executor()});
    const auto hash_at = [](Ocean& ocean, double time_s) { return hash_of(ocean.frame_at(time_s)); };
    EXPECT_EQ(hash_at(arriving, 10), hash_at(together, 10));
    EXPECT_NE(hash_at(arriving, 29), hash_at(together, 29));
    EXPECT_EQ(hash_at(arriving, far.changes[0].end_s()), hash_at(together, far.changes[0].end_s()));
}

TEST(SwellArrival, ALiveOceanAcceptsItAfterOtherSeas) {
    const Forecast whole = from_afar(1e3, 20);
    Ocean live({.first = ripples, .largest_peak_m = reach_of(whole).peak_m}, {.executor = make_thread_executor(2)});
    live.frame_at(0);
    live.schedule_sea(whole.changes[0]);
    Ocean fresh(whole, {.executor = make_serial_executor()});
    for (const double time_s : {9.0, 100.0, 400.0})
        EXPECT_EQ(hash_of(live.frame_at(time_s)), hash_of(fresh.frame_at(time_s)));
    EXPECT_EQ(live.frame_at(100).statistics.significant_wave_height_m,
              fresh.frame_at(100).statistics.significant_wave_height_m);
}

}  // namespace
}  // namespace pelagic
