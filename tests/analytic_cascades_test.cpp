// Analytic seas on cascades: texels are compared with sums in long double by libm, and the analytic
// evaluators with frames.
#include "pelagic/sim/analytic_cascades.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "pelagic/analytic/analytic_surface.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/forecast.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/spectrum/wave_list.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/message_of.hpp"

namespace pelagic {
namespace {

using Long = long double;
constexpr Long full_turn = 2 * std::numbers::pi_v<Long>;

const SeaState moderate{.waves = WaveModel::analytic, .choppiness = 1};
const SeaState on_one_cascade{.waves = WaveModel::analytic,
                              .resolution = 256,
                              .patch_size_m = 300,
                              .wind_direction_rad = 0.4,
                              .choppiness = 0.9,
                              .longest_wave_m = 90,
                              .shortest_wave_m = 5};
/// So many waves on so small a grid that some share a wave vector.
const SeaState crowded{.waves = WaveModel::analytic,
                       .resolution = 64,
                       .patch_size_m = 100,
                       .wave_count = 64,
                       .longest_wave_m = 90,
                       .shortest_wave_m = 20,
                       .wave_strength = 0};
const SeaState pond{.waves = WaveModel::pond, .resolution = 64, .wind_direction_rad = 1};

OceanOptions everything() { return {.executor = make_serial_executor(), .queries = true,
                                    .velocities = Velocities::drawn}; }

double amplitudes_of(const PlaneWaves& sea) {
    double sum = 0;
    for (const PlaneWave& wave : sea.waves) sum += wave.amplitude_m;
    return sum;
}

struct Oracle {
    Long height = 0, dx = 0, dz = 0;
};

/// The waves of a cascade at the reference position of texel (i, j), from the definition: integer
/// wave numbers and periods per loop.
Oracle sum_of(const std::vector<GridWave>& waves, const SeaState& sea, const CascadePlan& cascade, Long time_s, int i,
              int j) {
    Oracle sum;
    const Long n = cascade.resolution, side = cascade.grid.side_m;
    for (const GridWave& wave : waves) {
        const Long steps = std::hypot(Long(wave.at.m), Long(wave.at.n));
        const Long periods = std::max(
            Long(1), std::round(std::sqrt(9.80665L * full_turn * steps / side) * sea.loop_period_s / full_turn));
        const Long phase = full_turn * (wave.at.m * i / n + wave.at.n * j / n - periods * time_s / sea.loop_period_s +
                                        wave.phase_turns);
        sum.height += wave.amplitude_m * std::cos(phase);
        const Long moved = -Long(sea.choppiness) * wave.amplitude_m * std::sin(phase) / steps;
        const Long along = moved * wave.at.m, across = moved * wave.at.n;
        sum.dx += cascade.grid.cosine * along - cascade.grid.sine * across;
        sum.dz += cascade.grid.sine * along + cascade.grid.cosine * across;
    }
    return sum;
}

// A frame's transforms are within 3e-7 of the largest wave's sum; phases are rounded to 2^-32 of a
// turn, times a harmonic of up to 300.
/// Returns the height that makes the mean at fixed places 0. Waves of one wave vector are one wave.
double level_of(const std::vector<GridWave>& waves, const SeaState& sea, const CascadePlan& plan) {
    std::map<std::pair<int, int>, std::complex<double>> amplitudes;
    for (const GridWave& wave : waves)
        amplitudes[{wave.at.m, wave.at.n}] += std::polar(wave.amplitude_m, 2 * std::numbers::pi * wave.phase_turns);
    double sum = 0;
    for (const auto& [at, amplitude] : amplitudes)
        sum += 2 * std::numbers::pi / plan.grid.side_m * std::hypot(at.first, at.second) * std::norm(amplitude) / 2;
    return sea.choppiness * sum;
}

TEST(AnalyticCascades, TexelsAreTheSumOfTheirWaves) {
    for (const SeaState& sea : {moderate, on_one_cascade, crowded}) {
        ASSERT_EQ(check(sea), "");
        const std::vector<CascadePlan> plans = plan_cascades(sea);
        const double bound = 1e-6 * amplitudes_of(waves_of_cascades(sea));
        Ocean ocean(sea, everything());
        std::size_t waves_seen = 0;
        for (const double time_s : {0.0, 12.34, -77.7}) {
            const Frame& frame = ocean.frame_at(time_s);
            for (std::size_t cascade = 0; cascade < plans.size(); ++cascade) {
                const std::vector<GridWave> waves = grid_waves(sea, plans[cascade]);
                waves_seen += waves.size();
                const double level_m = level_of(waves, sea, plans[cascade]);
                for (int j = 0; j < plans[cascade].resolution; j += 7) {
                    for (int i = 0; i < plans[cascade].resolution; i += 5) {
                        const Oracle expected = sum_of(waves, sea, plans[cascade], time_s, i, j);
                        ASSERT_NEAR(frame.cascades[cascade].height.at(i, j),
                                    static_cast<double>(expected.height) + level_m, bound);
                        ASSERT_NEAR(frame.cascades[cascade].dx.at(i, j), static_cast<double>(expected.dx), bound);
                        ASSERT_NEAR(frame.cascades[cascade].dz.at(i, j), static_cast<double>(expected.dz), bound);
                    }
                }
            }
        }
        EXPECT_EQ(waves_seen, 3 * waves_of_cascades(sea).waves.size());
    }
}

TEST(AnalyticCascades, SomeWavesShareAWaveVector) {
    std::set<std::pair<int, int>> places;
    const auto waves = grid_waves(crowded, plan_cascades(crowded)[0]);
    for (const GridWave& wave : waves) places.insert({wave.at.m, wave.at.n});
    EXPECT_EQ(waves.size(), 64u);
    EXPECT_LT(places.size(), 60u);
}

// The documented bound is 1e-5 of the sum of amplitudes; for velocities, 1e-5 of the sum of A w.
TEST(AnalyticCascades, AnalyticSurfaceMatchesTexels) {
    for (const SeaState& sea : {on_one_cascade, crowded}) {
        const PlaneWaves waves = waves_of_cascades(sea);
        const AnalyticSurface water(waves);
        double velocity_sum = 0;
        for (const PlaneWave& wave : waves.waves)
            velocity_sum += static_cast<double>(full_turn) * wave.frequency_hz * wave.amplitude_m;
        Ocean ocean(sea, everything());
        for (const double time_s : {3.0, 1e5}) {
            const Cascade& cascade = ocean.frame_at(time_s).cascades[0];
            for (int j = 0; j < cascade.resolution(); j += 9) {
                std::vector<double> x, z(static_cast<std::size_t>(cascade.resolution()), j * cascade.texel_m());
                for (int i = 0; i < cascade.resolution(); ++i) x.push_back(i * cascade.texel_m());
                std::vector<float> sampled[6];
                for (auto& each : sampled) each.resize(x.size());
                water.sample_undisplaced(time_s, {x, z},
                                         {.height_m = sampled[0],
                                          .horizontal_x_m = sampled[1],
                                          .horizontal_z_m = sampled[2],
                                          .velocity_x_mps = sampled[3],
                                          .velocity_y_mps = sampled[4],
                                          .velocity_z_mps = sampled[5]});
                const PlaneView* planes[] = {&cascade.height,     &cascade.dx,         &cascade.dz,
                                             &cascade.velocity_x, &cascade.velocity_y, &cascade.velocity_z};
                for (int i = 0; i < cascade.resolution(); ++i)
                    for (std::size_t plane = 0; plane < 6; ++plane)
                        ASSERT_NEAR(planes[plane]->at(i, j), sampled[plane][static_cast<std::size_t>(i)],
                                    1e-5 * (plane < 3 ? amplitudes_of(waves) : velocity_sum))
                            << plane;
            }
        }
    }
}

// Between texels a frame is bilinear. With wave number k and texel size d, the error along each
// axis is at most (k d)^2 / 8 of the amplitude. In sum it is (k_x^2 + k_z^2) d^2 / 8. Displacements
// have an equal error, on slopes of 0.4.
TEST(AnalyticCascades, QueriesMatchTheAnalyticSurface) {
    for (const SeaState& sea : {moderate, on_one_cascade}) {
        double bound = SurfaceQuery::default_tolerance_m;
        for (const CascadePlan& cascade : plan_cascades(sea)) {
            const double texel = static_cast<double>(full_turn) / cascade.resolution;
            for (const GridWave& wave : grid_waves(sea, cascade))
                bound += 1.6 * wave.amplitude_m * std::pow(wave.at.steps() * texel, 2) / 8;
        }
        EXPECT_LT(bound, 0.12 * significant_height_m(waves_of_cascades(sea))) << "all waves at their worst at once";
        const AnalyticSurface water(waves_of_cascades(sea));
        std::mt19937 random(3);
        std::vector<double> x, z;
        for (int i = 0; i < 1000; ++i) {
            x.push_back(static_cast<double>(random()) / 0x1p20 - 2000);
            z.push_back(static_cast<double>(random()) / 0x1p20 - 2000);
        }
        Ocean ocean(sea, everything());
        const SurfaceQuery query(ocean.frame_at(55.5));
        std::vector<float> found(x.size()), expected(x.size()), found_up(x.size()), expected_up(x.size());
        query.sample({x, z}, {.height_m = found, .normal_x = {}, .normal_y = found_up});
        water.sample(55.5, {x, z}, {.height_m = expected, .normal_y = expected_up});
        double squares = 0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            ASSERT_NEAR(found[i], expected[i], bound);
            // The normal's deviation from the vertical: texels smooth the shortest waves.
            ASSERT_NEAR(found_up[i], expected_up[i], 0.03);
            squares += (found[i] - expected[i]) * (found[i] - expected[i]);
        }
        EXPECT_LT(std::sqrt(squares / 1000), 0.2 * bound);
    }
}

TEST(AnalyticCascades, DefaultCascadesChangeWavelengthsByLessThan7Percent) {
    const PlaneWaves given = plane_waves_of(analytic_sea_of(moderate)), held = waves_of_cascades(moderate);
    ASSERT_EQ(held.waves.size(), given.waves.size());
    double squares = 0, turned = 0;
    for (const PlaneWave& wave : held.waves) {
        const auto same = std::find_if(given.waves.begin(), given.waves.end(), [&](const PlaneWave& other) {
            return other.phase_turns == wave.phase_turns && other.amplitude_m == wave.amplitude_m;
        });
        ASSERT_NE(same, given.waves.end());
        const double change = wave.turns_per_m() / same->turns_per_m() - 1;
        EXPECT_LT(std::fabs(change), 0.07) << "half a step of eight";
        squares += change * change;
        const double angle =
            std::atan2(wave.turns_per_m_z, wave.turns_per_m_x) - std::atan2(same->turns_per_m_z, same->turns_per_m_x);
        turned = std::max(turned, std::fabs(std::remainder(angle, static_cast<double>(full_turn))));
        const double periods = wave.frequency_hz * moderate.loop_period_s;
        EXPECT_NEAR(periods, std::round(periods), 1e-12);
        EXPECT_NEAR(wave.frequency_hz, deep_water_frequency_hz(wave.turns_per_m()), 0.5001 / moderate.loop_period_s);
    }
    EXPECT_LT(std::sqrt(squares / 16), 0.02);
    EXPECT_LT(turned, 1 / 16.0) << "the same";
}

TEST(AnalyticCascades, CascadePresetsEqualAnalyticPresets) {
    for (const AnalyticPreset& preset : analytic_presets()) {
        const SeaPreset* const on_cascades = sea_preset_named(preset.name);
        ASSERT_NE(on_cascades, nullptr) << preset.name;
        const AnalyticSea sea = analytic_sea_of(on_cascades->sea);
        EXPECT_EQ(sea.choppiness, preset.sea.choppiness);
        ASSERT_EQ(sea.waves.size(), preset.sea.waves.size());
        for (std::size_t i = 0; i < sea.waves.size(); ++i) {
            EXPECT_EQ(sea.waves[i].amplitude_m, preset.sea.waves[i].amplitude_m) << i;
            EXPECT_EQ(sea.waves[i].wavelength_m, preset.sea.waves[i].wavelength_m) << i;
            EXPECT_EQ(sea.waves[i].direction_rad, preset.sea.waves[i].direction_rad) << i;
            EXPECT_EQ(sea.waves[i].phase_rad, preset.sea.waves[i].phase_rad) << i;
        }
    }
}

TEST(AnalyticCascades, HeightGrowsContinuouslyWithStrength) {
    double before = 0;
    for (int i = 0; i <= 40; ++i) {
        SeaState sea = moderate;
        sea.wave_strength = i / 20.0;
        const double height = significant_height_m(waves_of_cascades(sea));
        EXPECT_GT(height, before);
        if (i > 0) {
            EXPECT_LT(height - before, 0.165) << "1.5 twentieths of 2.2 m, the steepest of a smoothstep";
        }
        before = height;
    }
}

TEST(AnalyticCascades, ReportedHeightEqualsFrameHeight) {
    for (const SeaState& sea : {moderate, on_one_cascade}) {
        const SeaReport report = report_on(sea);
        const double held = significant_height_m(waves_of_cascades(sea));
        EXPECT_NEAR(report.expected.significant_wave_height_m, held, 1e-9);
        EXPECT_NEAR(report.realised_significant_wave_height_m, held, 1e-9) << "no seed draws them";
        EXPECT_NEAR(*report.expected.model_significant_wave_height_m, significant_height_m(analytic_sea_of(sea)),
                    1e-12);
        Ocean ocean(sea, everything());
        const Frame& frame = ocean.frame_at(9);
        EXPECT_NEAR(frame.statistics.significant_wave_height_m, held, 1e-9);
        EXPECT_NEAR(measured_significant_wave_height_m(frame), held, 1e-5 * held)
            << "waves of a grid are independent";
    }
    SeaState other_seed = moderate;
    other_seed.seed = 99;
    EXPECT_EQ(hash_of(Ocean(moderate, everything()).frame_at(3)),
              hash_of(Ocean(other_seed, everything()).frame_at(3)));
    SeaState of_height = moderate;
    of_height.wave_height_m = 2;
    EXPECT_NEAR(expected_waves(of_height).significant_wave_height_m, 2, 1e-9);
}

// A transition interpolates each wave's energy: A = sqrt((1 - s) A0^2 + s A1^2), s = u^2 (3 - 2u).
// Wavelength, direction and phase are kept.
TEST(AnalyticCascades, TransitionsInterpolateEachWavesEnergy) {
    SeaState before = on_one_cascade, after = on_one_cascade;
    before.wave_strength = 0.3;
    after.wave_strength = 1.4;
    PlaneWaves waves = waves_of_cascades(before);
    const PlaneWaves last = waves_of_cascades(after);
    const double u = 0.25, s = u * u * (3 - 2 * u);
    std::set<std::pair<int, int>> lines;
    for (std::size_t i = 0; i < waves.waves.size(); ++i) {
        const GridIndex at = grid_waves(before, plan_cascades(before)[0])[i].at;
        lines.insert({at.n < 0 ? -at.m : at.m, std::abs(at.n)});
        const double a = waves.waves[i].amplitude_m, b = last.waves[i].amplitude_m;
        waves.waves[i].amplitude_m = std::sqrt((1 - s) * a * a + s * b * b);
    }
    ASSERT_EQ(lines.size(), waves.waves.size()) << "waves that meet blend together";
    waves.level_m = (1 - s) * waves.level_m + s * last.level_m;
    Ocean ocean(Forecast{.first = before, .changes = {{.sea = after, .from_s = 10, .over_s = 40}}}, everything());
    const Frame& frame = ocean.frame_at(20);
    EXPECT_NEAR(frame.statistics.significant_wave_height_m, significant_height_m(waves), 1e-6);
    const Cascade& cascade = frame.cascades[0];
    const AnalyticSurface water(waves);
    std::vector<double> x, z;
    for (int i = 0; i < 256; ++i) {
        x.push_back(i * cascade.texel_m());
        z.push_back((i * 37 % 256) * cascade.texel_m());
    }
    std::vector<float> height(x.size()), horizontal(x.size());
    water.sample_undisplaced(20, {x, z}, {.height_m = height, .horizontal_x_m = horizontal});
    for (int i = 0; i < 256; ++i) {
        ASSERT_NEAR(cascade.height.at(i, i * 37 % 256), height[static_cast<std::size_t>(i)],
                    1e-5 * amplitudes_of(waves));
        ASSERT_NEAR(cascade.dx.at(i, i * 37 % 256), horizontal[static_cast<std::size_t>(i)],
                    1e-5 * amplitudes_of(waves));
    }
    EXPECT_EQ(hash_of(ocean.frame_at(60)), hash_of(Ocean(after, everything()).frame_at(60)));
}

TEST(AnalyticCascades, JacobiansStayPositive) {
    SeaState intense = moderate;
    intense.wave_strength = 2;
    Ocean ocean(intense, everything());
    std::mt19937 random(8);
    std::vector<double> x, z;
    for (int i = 0; i < 4000; ++i) {
        x.push_back(static_cast<double>(random()) / 0x1p20);
        z.push_back(static_cast<double>(random()) / 0x1p20);
    }
    std::vector<float> jacobian(x.size());
    std::vector<std::uint8_t> converged(x.size());
    SurfaceQuery(ocean.frame_at(30)).sample({x, z}, {.jacobian = jacobian, .converged = converged});
    // 1 - 0.4 from exact slopes; finite differences overestimate the slopes of the shortest waves
    // at texels, by at most a tenth.
    EXPECT_GT(*std::min_element(jacobian.begin(), jacobian.end()), 0.55f);
    EXPECT_EQ(std::count(converged.begin(), converged.end(), 0), 0);
}

TEST(AnalyticCascades, FramesDoNotDependOnTheOrderOfTimes) {
    for (const SeaState& sea : {moderate, pond}) {
        Ocean ocean(sea, everything());
        std::map<double, std::uint64_t> forwards;
        for (int i = 0; i < 8; ++i) forwards[i * 3.7] = hash_of(ocean.frame_at(i * 3.7));
        for (auto at = forwards.rbegin(); at != forwards.rend(); ++at)
            EXPECT_EQ(hash_of(ocean.frame_at(at->first)), at->second) << "backwards, " << at->first;
        const std::uint64_t paused = hash_of(ocean.frame_at(7.4));
        EXPECT_EQ(hash_of(ocean.frame_at(7.4)), paused);
        EXPECT_EQ(hash_of(ocean.frame_at(0)), hash_of(ocean.frame_at(5 * sea.loop_period_s)));
        EXPECT_NE(forwards[0], forwards[3.7]) << "the sea does not move";
    }
}

TEST(AnalyticCascades, InvalidOptionsAreNamed) {
    const auto with = [](SeaState sea, auto change) {
        change(sea);
        return check(sea);
    };
    EXPECT_EQ(check(moderate), "");
    EXPECT_EQ(check(pond), "");
    EXPECT_EQ(with(moderate, [](SeaState& sea) { sea.waves = static_cast<WaveModel>(4); }),
              "waves is no known model");
    EXPECT_EQ(with(moderate, [](SeaState& sea) { sea.wave_height_m = 6; }).substr(0, 14), "steepness is 0");
    EXPECT_EQ(with(moderate, [](SeaState& sea) { sea.patch_size_m = 100; }),
              "patch_size_m is 100, expected at least longest_wave_m, 120, where waves is analytic");
    EXPECT_EQ(with(moderate, [](SeaState& sea) { sea.shortest_wave_m = 200; }),
              "shortest_wave_m is 200, expected at most longest_wave_m, 120");
    EXPECT_EQ(with(moderate, [](SeaState& sea) { sea.swell_height_m = 1; }),
              "swell_height_m is 1, expected 0 where waves is analytic");
    EXPECT_EQ(with(moderate, [](SeaState& sea) { sea.wave_count = 65; }),
              "wave_count is 65, expected 1 to 64, or 0: chosen");
    EXPECT_EQ(with(pond, [](SeaState& sea) { sea.cascades = 2; }), "cascades is 2, expected 1 where waves is pond");
    EXPECT_EQ(with(pond, [](SeaState& sea) { sea.wave_count = 2; }),
              "wave_count is 2, expected more octaves from longest_wave_m 1.2 to shortest_wave_m 0.02667: each at "
              "least a quarter of the one before");
    EXPECT_EQ(with(pond, [](SeaState& sea) { sea.wave_height_m = 20; }),
              "wave_height_m is 20, expected at most 4.05 where waves is pond with so many octaves");
}

TEST(AnalyticCascades, OnlySeasOfTheSameKindReplaceARunningSea) {
    Ocean sea({.resolution = 128}, everything());
    sea.schedule_sea(moderate);  // spectra and analytic seas are both sums of waves
    sea.complete_sea();
    EXPECT_EQ(hash_of(sea.frame_at(2)), hash_of(Ocean(moderate, everything()).frame_at(2)));
    Ocean small(pond, everything());
    SeaState other = pond;
    other.wave_height_m = 0.04;
    small.schedule_sea(other);
    small.complete_sea();
    EXPECT_EQ(hash_of(small.frame_at(2)), hash_of(Ocean(other, everything()).frame_at(2)));
    EXPECT_EQ(message_of([&] { small.schedule_sea({.resolution = 64, .patch_size_m = 10}); }),
              "waves is spectrum, expected pond, as the ocean was built");
}

/// The heights of a pond's octaves by libm, each attenuated as its texels attenuate it.
Long pond_height(const std::vector<GridOctave>& octaves, const SeaState& sea, Long time_s, Long x, Long z) {
    // I0(1) / e
    const Long mean = 1.26606587775200833559824462521471753760767031135496L / std::numbers::e_v<Long>;
    Long height = 0;
    for (const GridOctave& moved : octaves) {
        const PondOctave& octave = moved.octave;
        const Long turns = octave.turns_per_m_x * x + octave.turns_per_m_z * z -
                           moved.harmonic * time_s / sea.loop_period_s + octave.phase_turns;
        const Long phase = full_turn * turns, wave = std::exp(std::sin(phase) - 1);
        const Long length = std::hypot(Long(octave.turns_per_m_x), Long(octave.turns_per_m_z));
        height += octave.height_m * moved.shown * (wave - mean);
        const Long drag = octave.drag_m * moved.shown * wave * std::cos(phase) / length;
        x -= octave.turns_per_m_x * drag;
        z -= octave.turns_per_m_z * drag;
    }
    return height;
}

// The kernel is within 1e-6 of the octaves' heights (pond_waves_test.cpp). `shown` is rounded to
// float, and each octave is displaced by the rounding errors of the others.
TEST(PondCascade, TexelsAreTheSumOfOctaves) {
    const CascadePlan cascade = plan_cascades(pond)[0];
    const std::vector<GridOctave> octaves = grid_octaves(pond, cascade);
    double heights = 0;
    for (const GridOctave& octave : octaves) heights += octave.octave.height_m;
    Ocean ocean(pond, everything());
    for (const double time_s : {0.0, 12.34, 1e6}) {
        const Cascade& found = ocean.frame_at(time_s).cascades[0];
        for (int j = 0; j < 64; j += 3)
            for (int i = 0; i < 64; ++i) {
                ASSERT_NEAR(
                    found.height.at(i, j),
                    static_cast<double>(pond_height(octaves, pond, time_s, i * found.texel_m(), j * found.texel_m())),
                    2e-6 * heights);
                ASSERT_EQ(found.dx.at(i, j), 0);
                ASSERT_EQ(found.dz.at(i, j), 0);
            }
    }
}

TEST(PondCascade, PondWavesMatchTexels) {
    const PondWaves water = PondWaves::of(octaves_of_cascade(pond));
    Ocean ocean(pond, everything());
    const Cascade& cascade = ocean.frame_at(4).cascades[0];
    const std::vector<float> footprint(64, static_cast<float>(cascade.texel_m()));
    for (int j = 0; j < 64; j += 5) {
        std::vector<double> x, z(64, (j - 128) * cascade.texel_m());  // the row repeats
        for (int i = 0; i < 64; ++i) x.push_back((i + 64) * cascade.texel_m());
        std::vector<float> height(64), rise(64);
        water.sample(4, {x, z}, {.height_m = height, .vertical_velocity_mps = rise}, footprint);
        for (std::size_t i = 0; i < 64; ++i) {
            ASSERT_NEAR(cascade.height.at(static_cast<int>(i), j), height[i], 1e-6 * 0.05);
            ASSERT_NEAR(cascade.velocity_y.at(static_cast<int>(i), j), rise[i], 1e-5);
        }
    }
}

TEST(PondCascade, ReportsMatchFrames) {
    for (const double drag : {0.0, 0.38}) {
        SeaState sea = pond;
        sea.resolution = 256;
        sea.wave_drag = drag;
        sea.wave_height_m = 0.03;
        Ocean ocean(sea, everything());
        double squares = 0, slopes = 0;
        for (int frame = 0; frame < 8; ++frame) {
            const Frame& now = ocean.frame_at(frame * 23.7);
            squares += std::pow(measured_significant_wave_height_m(now), 2) / 8;
            const Cascade& cascade = now.cascades[0];
            EXPECT_FALSE(cascade.makes_whitecaps());
            for (int j = 0; j < 256; ++j)
                for (int i = 0; i < 256; ++i) {
                    const double x = (cascade.height.at((i + 1) % 256, j) - cascade.height.at((i + 255) % 256, j)) /
                                     2,
                                 z = (cascade.height.at(i, (j + 1) % 256) - cascade.height.at(i, (j + 255) % 256)) /
                                     2;
                    slopes += (x * x + z * z) / (cascade.texel_m() * cascade.texel_m()) / (8 * 65536);
                }
        }
        // Without drag the octaves are independent, except the few that share a wave vector, within
        // the scatter of eight frames. With drag they gather on crests.
        const double allowed = drag == 0 ? 0.05 : 0.12;
        const SeaReport report = report_on(sea);
        EXPECT_NEAR(std::sqrt(squares), report.expected.significant_wave_height_m, allowed * 0.03) << drag;
        EXPECT_NEAR(*report.expected.model_significant_wave_height_m, 0.03, 1e-12);
        const SeaStatistics& statistics = ocean.frame_at(0).statistics;
        EXPECT_EQ(statistics.significant_wave_height_m, report.expected.significant_wave_height_m);
        if (drag == 0) {
            EXPECT_NEAR(slopes, statistics.resolved_slopes.total(), 0.1 * slopes)
                << "a crest is steeper than its first harmonic";
        }
        EXPECT_GT(statistics.unresolved_slopes.total(), 0);
        EXPECT_NEAR(statistics.roughness, std::sqrt(statistics.unresolved_slopes.total()), 1e-12);
    }
}

// Options at the limits of their ranges give frames of finite numbers or are rejected.
TEST(AnalyticCascades, EdgesOfRangesGiveFiniteFrames) {
    for (const SeaState& base : {moderate, pond}) {
        int taken = 0;
        for (const SeaStateField& field : sea_state_fields()) {
            if (field.name == "resolution") continue;
            for (const double edge : {field.min, std::nextafter(field.min, field.max), field.max}) {
                SeaState sea = base;
                sea.resolution = 32;
                if (field.accepts(edge)) field.set(sea, edge);
                if (const std::string reason = check(sea); !reason.empty()) {
                    EXPECT_TRUE(reason.find(" expected ") != reason.npos ||
                                reason.find(" out of range ") != reason.npos)
                        << reason;
                    continue;
                }
                ++taken;
                Ocean ocean(sea, everything());
                for (const double time_s : {0.0, 0.7 * sea.loop_period_s}) {
                    const Frame& frame = ocean.frame_at(time_s);
                    for (const Cascade& cascade : frame.cascades)
                        for (int j = 0; j < 32; ++j)
                            for (int i = 0; i < 32; ++i)
                                for (const PlaneView* plane :
                                     {&cascade.dx, &cascade.height, &cascade.dz, &cascade.velocity_y})
                                    ASSERT_TRUE(std::isfinite(plane->at(i, j))) << field.name << " " << edge;
                    ASSERT_TRUE(frame.statistics.roughness >= 0 && frame.statistics.roughness <= 1) << field.name;
                }
                warnings_about(sea);
            }
        }
        EXPECT_GT(taken, 40);
    }
}

}  // namespace
}  // namespace pelagic
