// Wave inputs of applications: compared with closed forms in double, in everything that is derived
// from cascades, and rejection of invalid values.
#include "pelagic/sim/wave_input.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/analytic/analytic_surface.hpp"
#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/sim/gerstner_input.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/sim/ripple_input.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/tests/each_executor.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/message_of.hpp"

namespace pelagic {
namespace {

constexpr double loop_s = 20;

const SeaState stack{
    .cascades = 4, .resolution = 64, .wind_speed_mps = 7.5, .fetch_m = 93e3, .loop_period_s = loop_s};
const SeaState one_cascade{.resolution = 64, .patch_size_m = 80, .wind_speed_mps = 5, .loop_period_s = loop_s};
/// Almost no wind.
const SeaState still_sea{.resolution = 64, .patch_size_m = 80, .wind_speed_mps = 0.3f, .loop_period_s = loop_s};

OceanOptions with(std::vector<std::shared_ptr<WaveInput>> inputs, Isa isa = choose_isa(),
                  std::shared_ptr<Executor> executor = make_serial_executor()) {
    return {.executor = std::move(executor),
            .isa = isa,
            .queries = true,
            .velocities = Velocities::drawn,
            .slopes = true,
            .inputs = std::move(inputs)};
}

/// Returns waves for each of the stack's cascades; the sum of k A is 0.35.
AnalyticSea some_waves() {
    return {.waves = {{.amplitude_m = 0.7, .wavelength_m = 90, .direction_rad = 0.3, .phase_rad = 1},
                      {.amplitude_m = 0.4, .wavelength_m = 33, .direction_rad = -2},
                      {.amplitude_m = 0.06, .wavelength_m = 7, .direction_rad = 2.5, .phase_rad = -3},
                      {.amplitude_m = 0.02, .wavelength_m = 2.5, .direction_rad = 1.2, .phase_rad = 0.4},
                      {.amplitude_m = 0.005, .wavelength_m = 0.9, .direction_rad = -1.2, .phase_rad = 2}},
            .choppiness = 0.8};
}

std::shared_ptr<GerstnerInput> gerstner(const AnalyticSea& waves = some_waves()) {
    return std::make_shared<GerstnerInput>(waves);
}
std::shared_ptr<RippleInput> ripple(const Ripple& ripple) { return std::make_shared<RippleInput>(ripple); }
std::shared_ptr<CallbackInput> callback(CallbackInput::Add add, double largest_slope = 0.5) {
    return std::make_shared<CallbackInput>(std::move(add), largest_slope);
}

constexpr PlaneView Cascade::*planes[] = {&Cascade::dx,         &Cascade::height,     &Cascade::dz,
                                          &Cascade::velocity_x, &Cascade::velocity_y, &Cascade::velocity_z};
struct SixFields {
    double of[6] = {};
};

/// Calls check(cascade, plane, difference of a and b, i, j) for texels all over a frame.
template <class Check>
void for_differences(const Frame& a, const Frame& b, Check check) {
    ASSERT_EQ(a.cascades.size(), b.cascades.size());
    for (std::size_t cascade = 0; cascade < a.cascades.size(); ++cascade) {
        const int n = a.cascades[cascade].resolution();
        for (int j = 0; j < n; ++j)
            for (int i = j % 3; i < n; i += 3)
                for (std::size_t plane = 0; plane < 6; ++plane)
                    check(cascade, plane,
                          static_cast<double>((a.cascades[cascade].*planes[plane]).at(i, j)) -
                              static_cast<double>((b.cascades[cascade].*planes[plane]).at(i, j)),
                          i, j);
    }
}

/// The cascade, wave vector and frequency of a wave as documented in the header, implemented a
/// second time.
struct Told {
    int cascade = -1;
    double m = 0, n = 0, omega = 0;
};
Told told_of(const AnalyticWave& wave, std::span<const Cascade> cascades) {
    Told told;
    for (std::size_t i = 0; i < cascades.size(); ++i) {
        const double texels = wave.wavelength_m / cascades[i].texel_m();
        const double steps = cascades[i].grid.side_m / wave.wavelength_m;
        const bool above_has_none =
            told.cascade < 0 || wave.wavelength_m <= 3 * cascades[static_cast<std::size_t>(told.cascade)].texel_m();
        if (texels > (cascades.size() == 1 ? 2 : 3) && (steps >= 8 || above_has_none))
            told.cascade = static_cast<int>(i);
    }
    if (told.cascade < 0) return told;
    const CascadeGrid& grid = cascades[static_cast<std::size_t>(told.cascade)].grid;
    const double turn = std::atan2(grid.sine, grid.cosine), steps = grid.side_m / wave.wavelength_m;
    told.m = std::round(steps * std::cos(wave.direction_rad - turn));
    told.n = std::round(steps * std::sin(wave.direction_rad - turn));
    const double k = two_pi / grid.side_m * std::hypot(told.m, told.n);
    told.omega = two_pi / loop_s * std::max(1.0, std::round(std::sqrt(9.80665 * k) * loop_s / two_pi));
    return told;
}

/// Returns the sum at a texel, in double.
SixFields closed_form(const AnalyticSea& sea, std::span<const Cascade> cascades, std::size_t cascade, int i, int j,
                      double t) {
    SixFields sum;
    const CascadeGrid& grid = cascades[cascade].grid;
    const double n = cascades[cascade].resolution();
    for (const AnalyticWave& wave : sea.waves) {
        const Told told = told_of(wave, cascades);
        if (told.cascade != static_cast<int>(cascade)) continue;
        const double steps = std::hypot(told.m, told.n);
        const auto [x, z] = grid.in_world(told.m / steps, told.n / steps);
        const double angle = two_pi * (told.m * i + told.n * j) / n - told.omega * t + wave.phase_rad;
        const double a = wave.amplitude_m, horizontal = sea.choppiness * a;
        sum.of[0] -= horizontal * x * std::sin(angle);
        sum.of[1] += a * std::cos(angle);
        sum.of[2] -= horizontal * z * std::sin(angle);
        sum.of[3] += horizontal * told.omega * x * std::cos(angle);
        sum.of[4] += a * told.omega * std::sin(angle);
        sum.of[5] += horizontal * told.omega * z * std::cos(angle);
    }
    return sum;
}

// Differences of floats: two roundings of 2e-7 m for a sea of some metres, and as much for the
// factors of the waves.
constexpr double float_m = 2e-6;

TEST(WaveInput, GerstnerWavesMatchTheClosedFormAtTexels) {
    for (const SeaState& sea : {stack, one_cascade}) {
        Ocean pure(sea, with({})), ocean(sea, with({gerstner()}));
        for (const double t : {0.0, 3.21, 1e4 + 0.7}) {
            const Frame &a = ocean.frame_at(t), &b = pure.frame_at(t);
            std::vector<double> largest(6 * a.cascades.size());
            for_differences(a, b, [&](std::size_t cascade, std::size_t plane, double difference, int i, int j) {
                const double expected = closed_form(some_waves(), a.cascades, cascade, i, j, t).of[plane];
                ASSERT_NEAR(difference, expected, float_m) << cascade << ' ' << plane << ' ' << i << ' ' << j;
                double& max = largest[6 * cascade + plane];
                max = std::max(max, std::fabs(expected));
            });
            // Each cascade and field has waves.
            for (const double max : largest) EXPECT_GT(max, 0.004);
        }
    }
}

// Cascades of similar size, several of which could represent a wave.
TEST(WaveInput, AWaveIsAddedToTheCascadeThatRepresentsItBest) {
    const SeaState close{.waves = WaveModel::analytic,
                         .cascades = 4,
                         .resolution = 64,
                         .loop_period_s = loop_s,
                         .longest_wave_m = 30,
                         .shortest_wave_m = 2};
    const auto input = std::make_shared<GerstnerInput>();
    Ocean ocean(close, with({input}));
    int by_steps = 0, held = 0;
    for (double wavelength = 150; wavelength > 0.5; wavelength *= 0.97) {
        const AnalyticWave wave{.amplitude_m = 0.01 * std::min(wavelength, 1.0),
                                .wavelength_m = wavelength,
                                .direction_rad = std::remainder(wavelength, two_pi)};
        input->set({.waves = {wave}});
        const Frame& frame = ocean.frame_at(0);
        const Told told = told_of(wave, frame.cascades);
        ASSERT_EQ(input->held().waves.size(), told.cascade < 0 ? 0U : 1U) << wavelength;
        if (told.cascade < 0) continue;
        const CascadeGrid& grid = frame.cascades[static_cast<std::size_t>(told.cascade)].grid;
        const auto [x, z] = grid.in_world(told.m / grid.side_m, told.n / grid.side_m);
        EXPECT_NEAR(input->held().waves[0].turns_per_m_x, x, 1e-12) << wavelength;
        EXPECT_NEAR(input->held().waves[0].turns_per_m_z, z, 1e-12) << wavelength;
        ++held;
        by_steps +=
            told.cascade > 0 && wavelength > 3 * frame.cascades[static_cast<std::size_t>(told.cascade - 1)].texel_m();
    }
    EXPECT_GT(held, 100);
    EXPECT_GT(by_steps, 2);  // The next coarser cascade could have represented it, too.
}

// The evaluator of the closed form gives the same values for the waves that held() returns.
TEST(WaveInput, ReturnsTheWavesThatItAdds) {
    const auto input = gerstner();
    Ocean pure(one_cascade, with({})), ocean(one_cascade, with({input}));
    const double t = 7.3;
    const Frame &a = ocean.frame_at(t), &b = pure.frame_at(t);
    // The wave of 2.5 m has exactly two texels of 1.25 m, the one of 0.9 m fewer.
    EXPECT_EQ(input->held().waves.size(), 3U);
    const AnalyticSurface water(input->held());
    for_differences(a, b, [&](std::size_t, std::size_t plane, double difference, int i, int j) {
        const double x[] = {80.0 / 64 * i}, z[] = {80.0 / 64 * j};
        float told[6];
        const auto one = [&](int field) { return std::span<float>(told + field, 1); };
        water.sample_undisplaced(t, {x, z},
                                 {.height_m = one(1),
                                  .horizontal_x_m = one(0),
                                  .horizontal_z_m = one(2),
                                  .velocity_x_mps = one(3),
                                  .velocity_y_mps = one(4),
                                  .velocity_z_mps = one(5)});
        ASSERT_NEAR(difference, told[plane], float_m);
    });
    // In a stack, texel (0, 0) of all cascades has the same position.
    Ocean pure_stack(stack, with({})), stacked(stack, with({input}));
    const Frame &c = stacked.frame_at(t), &d = pure_stack.frame_at(t);
    EXPECT_EQ(input->held().waves.size(), 5U);
    double height = 0;
    for (std::size_t i = 0; i < c.cascades.size(); ++i)
        height +=
            static_cast<double>(c.cascades[i].height.at(0, 0)) - static_cast<double>(d.cascades[i].height.at(0, 0));
    const double origin[] = {0};
    float told[1];
    AnalyticSurface(input->held()).sample_undisplaced(t, {origin, origin}, {.height_m = told});
    EXPECT_NEAR(height, told[0], float_m);
}

TEST(WaveInput, RingsMatchTheClosedFormAndDoNotOverlapTheirRepetitions) {
    // The second ring is cut at half of the cascade's side; the third crosses the cascade's edges,
    // far from the origin.
    for (const Ripple& asked :
         {Ripple{.x_m = 3, .z_m = -2, .wavelength_m = 2, .amplitude_m = 0.2, .reach_m = 6},
          Ripple{.x_m = 11.7, .z_m = 0.2, .wavelength_m = 11, .amplitude_m = 1, .phase_rad = 2},
          Ripple{.x_m = 12345.6, .z_m = -6543.2, .wavelength_m = 3, .amplitude_m = 0.4, .reach_m = 1e5}}) {
        const auto input = ripple(asked);
        Ocean pure(stack, with({})), ocean(stack, with({input}));
        for (const double t : {0.0, 4.56}) {
            const Frame &a = ocean.frame_at(t), &b = pure.frame_at(t);
            const auto home =
                static_cast<std::size_t>(told_of({.wavelength_m = asked.wavelength_m}, a.cascades).cascade);
            ASSERT_EQ(input->held().cascade, home);
            const CascadeGrid& grid = a.cascades[home].grid;
            const double half = grid.side_m / 2;
            const double reach = asked.reach_m > 0 ? std::min(asked.reach_m, half) : half;
            EXPECT_EQ(input->held().reach_m, reach);
            const double omega =
                two_pi / loop_s * std::round(std::sqrt(9.80665 * two_pi / asked.wavelength_m) * loop_s / two_pi);
            EXPECT_NEAR(input->held().frequency_hz, omega / two_pi, 1e-12);
            double largest = 0;
            int untouched = 0;
            for_differences(a, b, [&](std::size_t cascade, std::size_t plane, double difference, int i, int j) {
                const auto [x, z] = grid.in_world(a.cascades[home].texel_m() * i, a.cascades[home].texel_m() * j);
                const auto [u, v] = grid.in_cascade(x - asked.x_m, z - asked.z_m);
                const double r = std::hypot(std::remainder(u, grid.side_m), std::remainder(v, grid.side_m));
                if (cascade != home || (plane != 1 && plane != 4) || r >= reach * (1 + 1e-6)) {
                    ASSERT_EQ(difference, 0) << cascade << ' ' << plane << ' ' << i << ' ' << j;
                    untouched += cascade == home && plane == 1;
                    return;
                }
                const double wave = asked.wavelength_m, q = std::hypot(r, wave / 2);
                const double fade = std::max(0.0, 1 - r * r / (reach * reach));
                const double high = asked.amplitude_m * fade * fade * std::sqrt(wave / 2 / q);
                const double angle = two_pi * (q - wave / 2) / wave - omega * t + asked.phase_rad;
                const double expected = plane == 1 ? high * std::cos(angle) : high * omega * std::sin(angle);
                // The phase of a ring, about ten turns, is a float: 2^-20 of a turn.
                ASSERT_NEAR(difference, expected, float_m + 1e-5 * asked.amplitude_m * (plane == 1 ? 1 : omega));
                largest = std::max(largest, std::fabs(expected));
            });
            EXPECT_GT(largest, asked.amplitude_m / 3);
            EXPECT_GT(untouched, 10);
        }
    }
}

TEST(WaveInput, WavesTooShortTooLongOrFlatAreOmitted) {
    const auto waves = gerstner({.waves = {{.amplitude_m = 0.0001, .wavelength_m = 0.011},
                                           {.amplitude_m = 0, .wavelength_m = 30},
                                           {.amplitude_m = 1, .wavelength_m = 900}}});
    const auto rings = ripple({.wavelength_m = 2, .amplitude_m = 0.1});
    const auto nothing = std::make_shared<GerstnerInput>();
    Ocean pure(one_cascade, with({})), ocean(one_cascade, with({waves, rings, nothing}));
    EXPECT_EQ(hash_of(ocean.frame_at(5)), hash_of(pure.frame_at(5)));
    EXPECT_TRUE(waves->held().waves.empty());
    EXPECT_EQ(rings->held().reach_m, 0);
    // With cascades = 1, two texels of 1.25 m suffice.
    waves->set({.waves = {{.amplitude_m = 0.01, .wavelength_m = 2.6}, {.amplitude_m = 0.01, .wavelength_m = 2.4}}});
    ocean.frame_at(5);
    EXPECT_EQ(waves->held().waves.size(), 1U);
}

TEST(WaveInput, CascadesWithoutInputsAreBitIdentical) {
    Ocean pure(stack, with({})), ocean(stack, with({ripple({.wavelength_m = 3, .amplitude_m = 0.1})}));
    const Frame &a = ocean.frame_at(2), &b = pure.frame_at(2);
    for (const std::size_t cascade : {0U, 1U, 3U}) {
        const Cascade &x = a.cascades[cascade], &y = b.cascades[cascade];
        EXPECT_TRUE(std::equal(x.slopes_rgba8.begin(), x.slopes_rgba8.end(), y.slopes_rgba8.begin()));
        EXPECT_TRUE(
            std::equal(x.displacement_rgba16f.begin(), x.displacement_rgba16f.end(), y.displacement_rgba16f.begin()));
        EXPECT_EQ(x.bounds.height_max_m, y.bounds.height_max_m);
        EXPECT_EQ(x.slope_ranges.slope, y.slope_ranges.slope);
    }
    EXPECT_NE(hash_of(a), hash_of(b));
    // On threads only these edges of the graph order it after both.
    for (const Stage& stage : ocean.graph().stages()) {
        if (stage.name != "inputs c1") continue;
        ASSERT_EQ(stage.waits_for.size(), 2U);
        EXPECT_EQ(ocean.graph().stages()[stage.waits_for[0]].name, "columns+finalize c1");
        EXPECT_EQ(ocean.graph().stages()[stage.waits_for[1]].name, "velocity columns c1");
    }
    Ocean without(stack, {.executor = make_serial_executor()});
    EXPECT_EQ(hash_of(without.frame_at(2)), hash_of(pure.frame_at(2)));
    for (const Stage& stage : without.graph().stages()) EXPECT_EQ(stage.name.find("inputs"), std::string::npos);
}

// The callback adds to some cascades only, and some cascades have no foam ticks.
TEST(WaveInput, InputsAreNotCalledForUnusedRows) {
    std::array<std::atomic<int>, 4> frames{}, ticks{};
    const auto count = [&](const InputRows& rows) {
        ++(rows.moment.pass_index == 0 ? frames : ticks)[rows.cascade];
        EXPECT_EQ(rows.velocity_x.empty(), rows.moment.pass_index == 1);
    };
    OceanOptions options = with({std::make_shared<CallbackInput>(count, 0.5, 0b1101)});
    options.foam = true;
    SeaState wide = stack;
    wide.resolution = 128;  // The waves of the finest cascade are shorter than a metre.
    wide.wind_speed_mps = 12;
    Ocean ocean(wide, options);
    const Frame& frame = ocean.frame_at(1);
    int whites = 0;
    for (std::size_t cascade = 0; cascade < 4; ++cascade) {
        const bool is_asked = cascade != 1;
        EXPECT_EQ(frames[cascade] > 0, is_asked) << cascade;
        EXPECT_EQ(ticks[cascade] > 0, is_asked && frame.cascades[cascade].makes_whitecaps()) << cascade;
        whites += frame.cascades[cascade].makes_whitecaps();
    }
    EXPECT_GT(whites, 0);
    EXPECT_LT(whites, 4);
}

// Float addition is not associative: the order is that of the list.
TEST(WaveInput, InputsAreAddedInTheirOrder) {
    const auto constant = [](float value) {
        return callback([value](const InputRows& rows) {
            for (const std::span<float> field : {rows.dx, rows.height, rows.dz, rows.velocity_y})
                for (float& texel : field) {
                    ASSERT_EQ(texel, 0.f);  // without the inputs before it
                    texel = value;
                }
        });
    };
    const float a = 1e-8f, b = 700.3f, c = -700.1f;
    Ocean pure(stack, with({})), ocean(stack, with({constant(a), constant(b), constant(c)}));
    Ocean other(stack, with({constant(b), constant(c), constant(a)}));
    const Frame &sum = ocean.frame_at(1), &sea = pure.frame_at(1), &otherwise = other.frame_at(1);
    int unlike = 0;
    for (std::size_t cascade = 0; cascade < 4; ++cascade)
        for (const auto plane : {&Cascade::dx, &Cascade::height, &Cascade::dz, &Cascade::velocity_y})
            for (int j = 0; j < 64; ++j)
                for (int i = 0; i < 64; ++i) {
                    const float of_sea = (sea.cascades[cascade].*plane).at(i, j);
                    ASSERT_EQ((sum.cascades[cascade].*plane).at(i, j), ((of_sea + a) + b) + c);
                    ASSERT_EQ((otherwise.cascades[cascade].*plane).at(i, j), ((of_sea + b) + c) + a);
                    unlike += ((of_sea + a) + b) + c != ((of_sea + b) + c) + a;
                }
    EXPECT_GT(unlike, 0);
}

TEST(WaveInput, BoundsAreThoseOfTheSum) {
    Ocean ocean(stack, with({gerstner(), ripple({.wavelength_m = 3, .amplitude_m = 0.4})}));
    const Frame& frame = ocean.frame_at(6);
    FrameBounds sums;
    for (const Cascade& cascade : frame.cascades) {
        FrameBounds exact{1e9f, -1e9f, 0, 0};
        for (int j = 0; j < 64; ++j)
            for (int i = 0; i < 64; ++i) {
                exact.height_min_m = std::min(exact.height_min_m, cascade.height.at(i, j));
                exact.height_max_m = std::max(exact.height_max_m, cascade.height.at(i, j));
                exact.horizontal_x_max_m = std::max(exact.horizontal_x_max_m, std::fabs(cascade.dx.at(i, j)));
                exact.horizontal_z_max_m = std::max(exact.horizontal_z_max_m, std::fabs(cascade.dz.at(i, j)));
            }
        EXPECT_EQ(cascade.bounds.height_min_m, exact.height_min_m);
        EXPECT_EQ(cascade.bounds.height_max_m, exact.height_max_m);
        EXPECT_EQ(cascade.bounds.horizontal_x_max_m, exact.horizontal_x_max_m);
        EXPECT_EQ(cascade.bounds.horizontal_z_max_m, exact.horizontal_z_max_m);
        sums.height_max_m += exact.height_max_m;
    }
    EXPECT_EQ(frame.bounds.height_max_m, sums.height_max_m);
}

// A query at a texel's displaced position returns that texel's values.
TEST(WaveInput, QueriesReturnTheSum) {
    for (const SeaState& sea : {one_cascade, stack}) {
        Ocean ocean(sea, with({gerstner(), ripple({.x_m = 4, .wavelength_m = 4, .amplitude_m = 0.3})}));
        const Frame& frame = ocean.frame_at(9.5);
        const SurfaceQuery query(frame);
        std::vector<double> x, z;
        std::vector<float> height, rise;
        if (frame.cascades.size() > 1) {  // one position that is a texel of all cascades
            x = {0}, z = {0}, height = {0}, rise = {0};
            for (const Cascade& cascade : frame.cascades) {
                x[0] += static_cast<double>(cascade.dx.at(0, 0)), z[0] += static_cast<double>(cascade.dz.at(0, 0));
                height[0] += cascade.height.at(0, 0), rise[0] += cascade.velocity_y.at(0, 0);
            }
        } else {
            const Cascade& cascade = frame.cascades[0];
            for (int j = 0; j < 64; j += 5)
                for (int i = 0; i < 64; i += 3) {
                    x.push_back(cascade.texel_m() * i + static_cast<double>(cascade.dx.at(i, j)));
                    z.push_back(cascade.texel_m() * j + static_cast<double>(cascade.dz.at(i, j)));
                    height.push_back(cascade.height.at(i, j)), rise.push_back(cascade.velocity_y.at(i, j));
                }
        }
        std::vector<float> found(x.size()), rises(x.size());
        query.sample({x, z}, {.height_m = found, .velocity_y_mps = rises});
        for (std::size_t i = 0; i < x.size(); ++i) {
            EXPECT_NEAR(found[i], height[i], 1e-3);  // the query's tolerance, at slopes below 1
            EXPECT_NEAR(rises[i], rise[i], 5e-3);
        }
    }
}

/// Returns the largest deviation of a byte of h_x from zero, and its slope.
std::pair<int, double> steepest(const Cascade& cascade) {
    int max = 0;
    for (const std::uint32_t texel : cascade.level_of(cascade.slopes_rgba8, 0))
        max = std::max(max, std::abs(static_cast<int>(texel & 0xFF) - 128));
    return {max, max / 127.0 * static_cast<double>(cascade.slope_ranges.slope)};
}

// The bytes of a calm sea represent slopes of thousandths.
TEST(WaveInput, SteepWavesExtendTheSlopeRange) {
    // 8 texels a wave
    const AnalyticSea steep{.waves = {{.amplitude_m = 0.6, .wavelength_m = 10}}, .choppiness = 0};
    Ocean pure(still_sea, with({})), ocean(still_sea, with({gerstner(steep)}));
    const Cascade& sea = pure.frame_at(0).cascades[0];
    EXPECT_LT(sea.slope_ranges.slope, 0.15f);
    const Cascade& cascade = ocean.frame_at(0).cascades[0];
    const auto [byte, slope] = steepest(cascade);
    EXPECT_LT(byte, 127);
    // A quarter of a wave of 8 texels is a texel, and there the derivative's stencil (kernels.hpp)
    // is an eighth too large. The sea's slopes may add to it, and a byte has an error of half its
    // step.
    const double x = two_pi / 8, stencil = 2 * (0.9388 * std::sin(x) - 0.2194 * std::sin(2 * x)) / x;
    EXPECT_NEAR(slope, stencil * two_pi * 0.6 / 10,
                steepest(sea).second + static_cast<double>(cascade.slope_ranges.slope) / 254 + 1e-4);
    // A callback gives its maximum slope; if the value is too small, bytes are clamped.
    const auto bumps = [](double told) {
        return callback(
            [](const InputRows& rows) {
                for (std::size_t row = 0; row < rows.row_count; ++row)
                    for (std::size_t i = 0; i < 64; ++i)
                        rows.height[row * 64 + i] =
                            0.7f * static_cast<float>(std::sin(two_pi * 8 / 64 * static_cast<double>(i)));
            },
            told);
    };
    Ocean honest(still_sea, with({bumps(0.5)})), wrong(still_sea, with({bumps(0.001)}));
    EXPECT_LT(steepest(honest.frame_at(0).cascades[0]).first, 127);
    EXPECT_GE(steepest(wrong.frame_at(0).cascades[0]).first, 127);
}

TEST(WaveInput, WavesRepeatAfterOneLoop) {
    const auto make = [] {
        OceanOptions options = with({gerstner(), ripple({.wavelength_m = 3, .amplitude_m = 0.4})});
        options.foam = true;
        return options;
    };
    SeaState windy = stack;
    windy.wind_speed_mps = 15;
    Ocean ocean(windy, make()), later(windy, make());
    const std::uint64_t now = hash_of(ocean.frame_at(1.25)), foam = foam_hash_of(ocean.frame_at(1.25));
    EXPECT_EQ(hash_of(later.frame_at(1.25 + 3 * loop_s)), now);
    EXPECT_EQ(foam_hash_of(later.frame_at(1.25 + 3 * loop_s)), foam);
    EXPECT_NE(hash_of(later.frame_at(1.35)), now);
}

TEST(WaveInput, ChangesTakeEffectAtTheNextFrame) {
    const Ripple first{.wavelength_m = 4, .amplitude_m = 0.2},
        second{.x_m = 9, .wavelength_m = 4, .amplitude_m = 0.3};
    const auto hashes_with = [&](auto&& alter) {
        const auto waves = gerstner();
        const auto rings = ripple(first);
        Ocean ocean(stack, with({waves, rings}, choose_isa(), make_thread_executor(2)));
        std::vector<std::uint64_t> hashes;
        for (int frame = 0; frame < 3; ++frame) {
            ocean.schedule(frame);
            if (frame == 1) alter(*waves, *rings);
            hashes.push_back(hash_of(ocean.complete()));
        }
        return hashes;
    };
    const AnalyticSea few{.waves = {{.amplitude_m = 0.3, .wavelength_m = 25, .direction_rad = 1}}, .choppiness = 1};
    const auto before = hashes_with([](GerstnerInput&, RippleInput&) {});
    const auto after = hashes_with([&](GerstnerInput& waves, RippleInput& rings) {
        waves.set(few);
        rings.set(second);
    });
    EXPECT_EQ(after[0], before[0]);
    EXPECT_EQ(after[1], before[1]);
    Ocean fresh(stack, with({gerstner(few), ripple(second)}));
    EXPECT_EQ(after[2], hash_of(fresh.frame_at(2)));
    EXPECT_NE(after[2], before[2]);
}

// Ticks of a jump are computed after it was scheduled, and one tick with the frame itself. Neither
// changes the waves of a frame.
TEST(WaveInput, FoamTicksChangeOnlyTheFoam) {
    SeaState windy = stack;
    windy.wind_speed_mps = 15;
    const auto waves = gerstner();
    const auto rings = ripple({.wavelength_m = 9, .amplitude_m = 0.4});
    OceanOptions options = with({waves, rings});
    options.foam = true;
    Ocean ocean(windy, options), plain(windy, with({gerstner(), ripple({.wavelength_m = 9, .amplitude_m = 0.4})}));
    for (const double t : {1.0, 1.15, 9.07}) EXPECT_EQ(hash_of(ocean.frame_at(t)), hash_of(plain.frame_at(t))) << t;
    const std::uint64_t foam = foam_hash_of(ocean.frame_at(14.03));
    ocean.frame_at(1);
    ocean.schedule(14.03);
    waves->set({});
    rings->set({});
    const Frame& frame = ocean.complete();
    EXPECT_EQ(hash_of(frame), hash_of(plain.frame_at(14.03)));
    EXPECT_EQ(foam_hash_of(frame), foam);
}

// Accumulated foam is computed from ticks: an input that adds to ticks only changes only the foam.
TEST(WaveInput, FoamTicksIncludeInputs) {
    SeaState sea = one_cascade;
    sea.wind_speed_mps = 8;
    const auto contraction = callback([](const InputRows& rows) {
        if (rows.moment.pass_index == 0) return;
        for (std::size_t row = 0; row < rows.row_count; ++row)
            // A gradient of -0.95: the water converges there.
            for (std::size_t i = 16; i < 48; ++i)
                rows.dx[row * 64 + i] = -0.95f * 1.25f * (static_cast<float>(i) - 31.5f);
    });
    OceanOptions options = with({contraction}), pure_options = with({});
    options.foam = pure_options.foam = true;
    Ocean ocean(sea, options), pure(sea, pure_options);
    const Frame &a = ocean.frame_at(4.02), &b = pure.frame_at(4.02);
    ASSERT_TRUE(a.cascades[0].makes_whitecaps());
    const FoamSampler foam(a), pure_foam(b);
    const double texel_m = a.cascades[0].texel_m();
    int white = 0, more = 0;
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 64; ++i) {
            const bool is_contracting = i > 20 && i < 43;
            const float with = foam.at(i * texel_m, j * texel_m), without = pure_foam.at(i * texel_m, j * texel_m);
            white += is_contracting && with > 0.8f;
            more += (i < 10 || i > 53) && with != without;
        }
    EXPECT_GT(white, 64 * 20);
    EXPECT_EQ(more, 0);
    EXPECT_EQ(a.cascades[0].height.at(20, 20), b.cascades[0].height.at(20, 20));
    EXPECT_EQ(a.cascades[0].dx.at(20, 20), b.cascades[0].dx.at(20, 20));
}

// An input that adds other waves one loop later gives their foam.
TEST(WaveInput, FoamDependsOnTheAbsoluteTime) {
    SeaState sea = one_cascade;
    sea.wind_speed_mps = 8;
    const auto later = callback([](const InputRows& rows) {
        if (rows.moment.time_s < loop_s) return;
        for (std::size_t row = 0; row < rows.row_count; ++row)
            for (std::size_t i = 16; i < 48; ++i)
                rows.dx[row * 64 + i] = -0.95f * 1.25f * (static_cast<float>(i) - 31.5f);
    });
    OceanOptions options = with({later});
    options.foam = true;
    Ocean walks(sea, options), jumps(sea, options);
    walks.frame_at(5);
    const std::uint64_t there = foam_hash_of(walks.frame_at(5 + loop_s));
    EXPECT_EQ(there, foam_hash_of(jumps.frame_at(5 + loop_s)));
    EXPECT_NE(there, foam_hash_of(jumps.frame_at(5)));
}

// Another sea has other cascades, and waves are assigned to those.
TEST(WaveInput, UsesTheCascadesOfAnotherSea) {
    SeaState storm = stack;
    storm.wind_speed_mps = 20;
    const auto waves = gerstner();
    const auto rings = ripple({.wavelength_m = 9, .amplitude_m = 0.4});
    Ocean ocean(stack, with({waves, rings})),
        fresh(storm, with({gerstner(), ripple({.wavelength_m = 9, .amplitude_m = 0.4})}));
    const double side = ocean.frame_at(1).cascades[0].grid.side_m;
    ocean.schedule_sea(storm);
    ocean.complete_sea();
    const Frame& frame = ocean.frame_at(2);
    EXPECT_NE(frame.cascades[0].grid.side_m, side);
    EXPECT_EQ(hash_of(frame), hash_of(fresh.frame_at(2)));
}

// A tick's time is absolute and its own, and so is its loop fraction.
TEST(WaveInput, ReceivesTheTimeOfFramesAndTicks) {
    struct Spy final : WaveInput {
        void begin(const InputMoment& moment) override { moments.push_back(moment); }
        bool adds_to(std::size_t) const override { return false; }
        double largest_slope(std::size_t) const override { return 0; }
        void add(const InputRows&) const override { ADD_FAILURE(); }
        std::vector<InputMoment> moments;
    };
    const auto spy = std::make_shared<Spy>();
    OceanOptions options = with({spy});
    options.foam = true;
    Ocean ocean(stack, options);
    ocean.frame_at(3 * loop_s + 5.04);
    ASSERT_EQ(spy->moments.size(), 17U);  // the frame, and 16 ticks before it
    EXPECT_EQ(spy->moments[0].time_s, 3 * loop_s + 5.04);
    EXPECT_NEAR(spy->moments[0].loop_turns * 0x1p-32, 5.04 / loop_s, 1e-9);
    const TickClock clock(loop_s);
    const auto last = static_cast<std::int64_t>((3 * loop_s + 5.04) / clock.tick_s());
    for (std::size_t i = 1; i < 17; ++i) {
        const InputMoment& tick = spy->moments[i];
        EXPECT_EQ(tick.pass_index, 1U);
        EXPECT_NEAR(tick.time_s, clock.time_s(last - 16 + static_cast<std::int64_t>(i)), 1e-9);
        EXPECT_NEAR(tick.loop_turns * 0x1p-32, (tick.time_s - 3 * loop_s) / loop_s, 1e-9);
        EXPECT_EQ(tick.grids.size(), 4U);
        EXPECT_EQ(tick.resolution, 64);
        EXPECT_EQ(tick.loop_period_s, loop_s);
    }
}

TEST(WaveInput, InvalidValuesAreRejectedAndTheNextFrameIsCorrect) {
    const std::uint64_t expected = [] {
        Ocean pure(stack, with({}));
        return hash_of(pure.frame_at(2));
    }();
    for (const ExecutorKind& kind : executor_kinds()) {
        float value = 0;
        std::size_t field = 0;
        const auto bad = callback([&](const InputRows& rows) {
            const std::span<float> fields[] = {rows.dx,         rows.height,     rows.dz,
                                               rows.velocity_x, rows.velocity_y, rows.velocity_z};
            if (rows.cascade == 1 && rows.first_row == 32) fields[field][77] = value;
        });
        Ocean ocean(stack, with({std::make_shared<GerstnerInput>(), bad}, choose_isa(), kind.make(kind.threads)));
        const auto complete = [&] { ocean.frame_at(1); };
        value = std::numeric_limits<float>::quiet_NaN();
        EXPECT_EQ(message_of(complete),
                  "inputs[1]'s dx nan is out of range [-1000, 1000], metres or metres a second");
        value = -1001, field = 1;
        EXPECT_EQ(message_of(complete),
                  "inputs[1]'s height -1001 is out of range [-1000, 1000], metres or metres a second");
        value = std::numeric_limits<float>::infinity(), field = 5;
        EXPECT_EQ(message_of(complete),
                  "inputs[1]'s velocity_z inf is out of range [-1000, 1000], metres or metres a second");
        value = 0, field = 0;
        EXPECT_EQ(hash_of(ocean.frame_at(2)), [&] {
            // Adding zeros gives the sea's own values, except for the slope ranges.
            Ocean same(stack, with({callback([](const InputRows&) {})}));
            return hash_of(same.frame_at(2));
        }()) << kind.name;
    }
    Ocean untouched(stack, with({std::make_shared<GerstnerInput>()}));
    EXPECT_EQ(hash_of(untouched.frame_at(2)), expected);
}

TEST(WaveInput, AnExceptionAffectsOnlyItsFrame) {
    struct Lost : std::runtime_error {
        using std::runtime_error::runtime_error;
    };
    for (const ExecutorKind& kind : executor_kinds()) {
        bool throws = false;
        const auto throwing = callback([&](const InputRows&) {
            if (throws) throw Lost("no such wave");
        });
        OceanOptions options = with({throwing}, choose_isa(), kind.make(kind.threads));
        options.foam = true;
        Ocean ocean(stack, options);
        const std::uint64_t before = hash_of(ocean.frame_at(1));
        for (const double t : {1.01, 1.25, 9.0}) {  // without a tick, with one, with thirty
            throws = true;
            EXPECT_THROW(ocean.frame_at(t), Lost) << kind.name;
            throws = false;
            EXPECT_EQ(hash_of(ocean.frame_at(1)), before) << kind.name;
        }
    }
}

TEST(WaveInput, AFrameThatFailsDoesNotDelayChanges) {
    bool throws = false;
    const auto throwing = callback([&](const InputRows&) {
        if (throws) throw std::runtime_error("no such wave");
    });
    Ocean ocean(stack, with({throwing}));
    ocean.frame_at(1);
    std::vector<float> height(static_cast<std::size_t>(ocean.resolution()) * ocean.resolution());
    const std::vector<FrameBuffers> buffers(ocean.cascade_count(), FrameBuffers{.height = height});
    throws = true;
    EXPECT_THROW(ocean.frame_at(100, buffers), std::runtime_error);
    throws = false;
    ocean.schedule_sea(ocean.sea(), 10, 5);
    EXPECT_EQ(ocean.forecast().changes.back().from_s, 10);
}

TEST(WaveInput, InvalidInputsAreRejectedWithOneLine) {
    EXPECT_EQ(message_of([] {
                  Ocean ocean(stack, with({gerstner(), nullptr}));
              }),
              "inputs[1] is null, expected an input");
    for (const auto& [slope, text] : {std::pair{-1.0, "-1"}, {std::nan(""), "nan"}, {1e9, "1000000000"}}) {
        const auto steep = callback([](const InputRows&) {}, slope);
        Ocean ocean(stack, with({steep}));
        EXPECT_EQ(message_of([&] { ocean.frame_at(0); }),
                  "inputs[0]'s largest_slope " + std::string(text) + " is out of range [0, 100]");
    }
    const auto waves = gerstner();
    AnalyticSea bad = some_waves();
    bad.waves[1].wavelength_m = std::nan("");
    EXPECT_EQ(message_of([&] { waves->set(bad); }), "waves[1].wavelength_m nan is out of range [0.01, 1000]");
    bad = some_waves();
    bad.waves[0].amplitude_m = 50;
    EXPECT_NE(message_of([&] { waves->set(bad); }).find("steepness is "), std::string::npos);
    const auto rings = ripple({.wavelength_m = 3, .amplitude_m = 0.4});
    EXPECT_EQ(message_of([&] { rings->set({.x_m = std::nan("")}); }), "x_m nan is out of range [-1e8, 1e8]");
    EXPECT_EQ(message_of([&] { rings->set({.wavelength_m = 0}); }), "wavelength_m 0 is out of range [0.01, 1000]");
    EXPECT_EQ(message_of([&] { rings->set({.wavelength_m = 1, .amplitude_m = 0.2}); }),
              "amplitude_m is 0.2, expected at most wavelength_m / (2 pi), 0.1592");
    EXPECT_EQ(message_of([&] { rings->set({.reach_m = -1}); }), "reach_m -1 is out of range [0, 1e5]");
    // The inputs keep their previous values.
    Ocean ocean(stack, with({waves, rings})),
        same(stack, with({gerstner(), ripple({.wavelength_m = 3, .amplitude_m = 0.4})}));
    EXPECT_EQ(hash_of(ocean.frame_at(1)), hash_of(same.frame_at(1)));
}

// 20 waves along x around 69 m, their centre by the first harmonic of h^2 around the side. Waves
// one step dk apart make that harmonic, so it travels at the mean of (w(k + dk) - w(k)) / dk,
// weighted by their products. Every frequency is rounded to a harmonic of the loop: in a loop of
// 200 s, steps of 6 m/s.
TEST(WaveGroups, TravelAtTheGroupVelocityInTheDefaultLoop) {
    constexpr double side_m = 1200, middle = side_m / 69;
    const auto frequency = [](int m) { return std::sqrt(gravity_mps2 * m * two_pi / side_m); };
    AnalyticSea packet;
    double weights = 0, expected_mps = 0;
    const auto amplitude_m = [&](int m) { return 0.1 * std::exp(-(m - middle) * (m - middle) / 18); };
    for (int m = 8; m < 28; ++m) {
        packet.waves.push_back({.amplitude_m = amplitude_m(m), .wavelength_m = side_m / m});
        const double weight = amplitude_m(m) * amplitude_m(m + 1);
        weights += weight;
        expected_mps += weight * (frequency(m + 1) - frequency(m)) * side_m / two_pi;
    }
    expected_mps /= weights;
    ASSERT_NEAR(expected_mps, std::sqrt(gravity_mps2 * 69 / two_pi) / 2, 0.05);

    Ocean ocean({.resolution = 128, .patch_size_m = side_m, .wind_speed_mps = 0.3}, with({gerstner(packet)}));
    const auto centre_m = [&](double time_s) {
        ocean.schedule(time_s);
        const PlaneView height = ocean.complete().cascades[0].height;
        double cosine = 0, sine = 0;
        for (int i = 0; i < 128; ++i) {
            const double h = height.at(i, 0), turns = two_pi * i / 128;
            cosine += h * h * std::cos(turns);
            sine += h * h * std::sin(turns);
        }
        return std::atan2(sine, cosine) * side_m / two_pi;
    };
    const double travelled_m = std::remainder(centre_m(60) - centre_m(0), side_m);
    EXPECT_NEAR(travelled_m / 60, expected_mps, 0.01 * expected_mps);
}

}  // namespace
}  // namespace pelagic
