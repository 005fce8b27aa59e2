// The physics of shores: shoaling, refraction, shelter and breaking, compared with linear theory in
// closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "oracle/sea_oracle.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/shore/refraction.hpp"
#include "pelagic/sim/shore/shore_waves.hpp"
#include "pelagic/sim/spectrum/spectra.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

using oracle::wave_number_at;
using std::numbers::pi;

double group_velocity_at(double omega, double depth_m) {
    const double k = wave_number_at(omega, depth_m), kd = k * depth_m;
    return omega / k * (0.5 + (kd > 300 ? 0 : kd / std::sinh(2 * kd)));
}

/// One wave of 200 m, approximately along +x, and nothing else.
SeaState one_wave(double amplitude_m = 0.05) {
    return {.waves = WaveModel::analytic,
            .cascades = 2,
            .resolution = 64,
            .choppiness = 0,
            .loop_period_s = 600,
            .wave_count = 1,
            .longest_wave_m = 200,
            .wave_height_m = amplitude_m * 2 * std::sqrt(2.0)};
}

struct OpenWave {
    double omega, amplitude_m, along_x, along_z;
};

OpenWave wave_of(const SeaState& sea) {
    const std::vector<ShoreWave> waves = shore_waves(sea, plan_cascades(sea).front());
    EXPECT_EQ(waves.size(), 1U);
    return {waves[0].omega, waves[0].amplitude_m, waves[0].along_x, waves[0].along_z};
}

// Compares amplitudes at texels along the beach with Ks = sqrt(Cg0 / Cg), times the factor of
// Snell's law for oblique waves; for k d <= 0.3 also with Green's law, d^-1/4.
TEST(Shoaling, FollowsLinearTheoryAndGreensLaw) {
    const SeaState sea = one_wave();
    const OpenWave wave = wave_of(sea);
    EXPECT_NEAR(wave.amplitude_m, 0.05, 0.005);
    ShoreOptions shore = beach(1000, 400, 40, 150, 5);
    shore.swash_m = 0.01;
    Ocean ocean(sea, {.executor = make_serial_executor(), .shore = shore});
    const int row = ocean.frame_at(0).shore.rows / 2, columns = ocean.complete().shore.columns;
    std::vector<float> highest(static_cast<std::size_t>(columns), -1e9f), lowest(highest.size(), 1e9f),
        depth(highest.size());
    constexpr int times = 48;
    for (int i = 0; i < times; ++i) {
        const ShoreSurface& shown = ocean.frame_at(i * (2 * pi / wave.omega) / times).shore;
        for (std::size_t column = 0; column < highest.size(); ++column) {
            const float height = shown.height_m[static_cast<std::size_t>(row * columns) + column];
            highest[column] = std::max(highest[column], height);
            lowest[column] = std::min(lowest[column], height);
            depth[column] = shown.depth_m[static_cast<std::size_t>(row * columns) + column];
        }
    }
    const double open_speed = group_velocity_at(wave.omega, 4000);
    int shoaling = 0, green = 0;
    double min_ratio = 10, max_ratio = 0, green_height_m = 0, green_depth_m = 0;
    for (std::size_t column = 0; column < highest.size(); ++column) {
        const double d = static_cast<double>(depth[column]);
        const double x = static_cast<double>(column) * ocean.complete().shore.texel_m;
        const double amplitude = 0.5 * static_cast<double>(highest[column] - lowest[column]);
        // Inside the fade zone and before breaking.
        if (x < 60 || d < 0.45) continue;
        const double sine = wave.along_z * wave_number_at(wave.omega, 4000) / wave_number_at(wave.omega, d);
        const double spread = wave.along_x / std::sqrt(1 - sine * sine);
        const double expected = wave.amplitude_m * std::sqrt(spread * open_speed / group_velocity_at(wave.omega, d));
        EXPECT_NEAR(amplitude / expected, 1, 0.03) << "depth " << d;
        min_ratio = std::min(min_ratio, amplitude / wave.amplitude_m);
        max_ratio = std::max(max_ratio, amplitude / wave.amplitude_m);
        ++shoaling;
        if (wave_number_at(wave.omega, d) * d > 0.3) continue;
        if (green == 0) green_height_m = amplitude, green_depth_m = d;
        EXPECT_NEAR(amplitude / green_height_m / std::pow(green_depth_m / d, 0.25), 1, 0.03) << "depth " << d;
        ++green;
    }
    EXPECT_GT(shoaling, 100);
    EXPECT_GT(green, 8);
    // The ratio was lower in between and is higher at the end; otherwise the test would show
    // nothing.
    EXPECT_LT(min_ratio, 0.93);
    EXPECT_GT(max_ratio, 1.3);
}

TEST(Shoaling, EndsWhereWavesBreak) {
    const SeaState sea = one_wave(0.8);
    const OpenWave wave = wave_of(sea);
    ShoreOptions shore = beach(1000, 400, 40, 150, 5);
    shore.swash_m = 0.25;
    Ocean ocean(sea, {.executor = make_serial_executor(), .shore = shore});
    bool breaks = false;
    for (int i = 0; i < 16; ++i) {
        const ShoreSurface& shown = ocean.frame_at(i * (2 * pi / wave.omega) / 16).shore;
        for (std::size_t texel = 0; texel < shown.height_m.size(); ++texel) {
            const double d = static_cast<double>(shown.depth_m[texel]);
            // The deviation is 0.42 d over sqrt 8, and an amplitude is sqrt 2 of it. Waves run up
            // on sand to the height of the swash.
            const double stands = d > 0.02 ? 0.21 * d : shore.swash_m;
            EXPECT_LE(std::fabs(static_cast<double>(shown.height_m[texel])), stands * 1.0001);
            breaks |= shown.foam[texel] > 128;
            if (d > 6) {
                EXPECT_EQ(shown.foam[texel], 0) << d;
            }
        }
    }
    EXPECT_TRUE(breaks);
}

// A wave that broke on a bar keeps its reduced height, except for shoaling.
TEST(Shoaling, HeightStaysReducedBehindABar) {
    const SeaState sea = one_wave(0.8);
    ShoreOptions shore = shore_of(201, 81, 5, [](double x, double) {
        const double from_bar = std::fabs(x - 500);
        return from_bar < 60 ? -1.0 : from_bar < 200 ? -1 - (from_bar - 60) / 140 * 19 : -20.0;
    });
    shore.swash_m = 0.01;
    Ocean ocean(sea, {.executor = make_serial_executor(), .shore = shore});
    const ShoreSurface& shown = ocean.frame_at(0).shore;
    const double before = sample(shown, 250, 200).reach_m, on = sample(shown, 500, 200).reach_m,
                 behind = sample(shown, 750, 200).reach_m;
    EXPECT_GT(before, 0.6);
    EXPECT_NEAR(on, 0.21, 0.005);
    // The energy is that on the bar: 0.21 m at the Cg of 1 m depth.
    const double omega = wave_of(sea).omega;
    EXPECT_NEAR(behind, 0.21 * std::sqrt(group_velocity_at(omega, 1) / group_velocity_at(omega, 20)), 0.02);
}

/// Heights at several places over a whole loop, in lines of one depth each.
struct Surf {
    static constexpr int lines = 60, places = 16, times = 400;
    struct Line {
        double depth_m = 0, hm0_m = 0, highest_hm0_m = 0, crest_m = 0;
    };

    Surf(const SeaState& sea, ShoreOptions shore, double from_x, double to_x) {
        shore.resolution = 128;
        Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .shore = shore});
        std::vector<double> x, z;
        for (int line = 0; line < lines; ++line)
            for (int place = 0; place < places; ++place) {
                x.push_back(from_x + (to_x - from_x) * line / (lines - 1));
                z.push_back(150 + 300.0 * place / places);
            }
        std::vector<float> heights(x.size());
        std::vector<double> squares(x.size());
        for (int i = 0; i < times; ++i) {
            SurfaceQuery(ocean.frame_at(sea.loop_period_s * i / times)).sample({x, z}, {.height_m = heights});
            for (std::size_t at = 0; at < x.size(); ++at) {
                const double height = static_cast<double>(heights[at]);
                squares[at] += height * height / times;
                Line& line = line_of[at / places];
                line.crest_m = std::max(line.crest_m, height);
            }
        }
        for (std::size_t at = 0; at < x.size(); ++at) {
            Line& line = line_of[at / places];
            line.depth_m = sample(ocean.complete().shore, x[at], z[at]).depth_m;
            line.hm0_m += squares[at] / places;
            line.highest_hm0_m = std::max(line.highest_hm0_m, 4 * std::sqrt(squares[at]));
        }
        for (Line& line : line_of) line.hm0_m = 4 * std::sqrt(line.hm0_m);
    }

    Line line_of[lines];
};

/// 1.5 m of water over the bar, 20 m on both sides.
ShoreOptions bar() {
    return shore_of(201, 121, 5, [](double x, double) {
        const double from_bar = std::fabs(x - 500);
        return from_bar < 40 ? -1.5 : from_bar < 200 ? -1.5 - (from_bar - 40) / 160 * 18.5 : -20.0;
    });
}

// All waves together, of the shore and of the cascades: Hrms = 0.42 d (Thornton and Guza 1983),
// which is Hm0 = 0.594 d, and crests of 0.66 d, in water deeper than the swash.
TEST(Breaking, LimitsHeightsToTheDepth) {
    SeaState storm{.resolution = 64, .wind_speed_mps = 20};
    storm.fetch_m = 500e3f;
    const SeaState sea{.resolution = 64};
    const ShoreOptions shore = beach(1000, 600, 20, 150, 5);
    for (const Surf& surf : {Surf(sea, shore, 600, 905), Surf(storm, shore, 300, 905), Surf(sea, bar(), 200, 800)}) {
        int saturated = 0;
        for (const Surf::Line& line : surf.line_of) {
            ASSERT_GT(line.depth_m, 0.25 / 0.66);
            EXPECT_LE(line.hm0_m, 0.6 * line.depth_m) << line.depth_m;
            // The cascades' contribution at one place varies from loop to loop.
            EXPECT_LE(line.highest_hm0_m, 0.64 * line.depth_m) << line.depth_m;
            EXPECT_LE(line.crest_m, 0.66 * line.depth_m) << line.depth_m;
            saturated += line.hm0_m > 0.5 * line.depth_m;
        }
        EXPECT_GT(saturated, 6);
    }
}

/// A slope of 1:55 from 10 m of water to 3 m of sand, for waves of 3 m and 10 s.
struct SwashSea {
    static constexpr double hs_m = 3, wavelength_m = 156.1, slope = 1.0 / 55, waterline_m = 200 + 10 / slope;
    SeaState sea{.waves = WaveModel::analytic,
                 .cascades = 2,
                 .resolution = 64,
                 .loop_period_s = 1200,
                 .wave_count = 32,
                 .longest_wave_m = wavelength_m,
                 .wave_height_m = hs_m};
    ShoreOptions shore = shore_of(461, 76, 2, [](double x, double) { return -10 + std::max(0.0, x - 200) * slope; });
};

// R2 = 0.043 sqrt(H0 L0) on dissipative beaches (Stockdon et al. 2006, equation 18).
TEST(Swash, ReachesTheRunUpOf2PercentOfTheWaves) {
    const SwashSea of;
    Ocean ocean(of.sea, {.executor = make_serial_executor(), .shore = of.shore});
    constexpr int lines = 8, steps = 2400, half_wave = 10;
    std::vector<double> run_up[lines];
    for (int step = 0; step < steps; ++step) {
        const ShoreSurface& shown = ocean.frame_at(step * of.sea.loop_period_s / steps).shore;
        for (int line = 0; line < lines; ++line) {
            double highest_m = 0;
            for (double ground_m = 0.02; ground_m < 2.5; ground_m += 0.02)
                if (sample(shown, of.waterline_m + ground_m / of.slope, 40 + 10 * line).height_m >= ground_m)
                    highest_m = ground_m;
            run_up[line].push_back(highest_m);
        }
    }
    std::vector<double> crests;
    for (const std::vector<double>& each : run_up)
        for (int i = half_wave; i + half_wave < steps; ++i) {
            const auto at = each.begin() + i;
            if (*at > 0 && *at == *std::max_element(at - half_wave, at + half_wave + 1) && *at > *(at - 1))
                crests.push_back(*at);
        }
    std::sort(crests.begin(), crests.end());
    ASSERT_GT(crests.size(), 200u);
    const double r2_m = crests[static_cast<std::size_t>(0.98 * static_cast<double>(crests.size()))];
    std::printf("run-up of 2 %%: %.2f m, median %.2f m, %d crests\n", r2_m, crests[crests.size() / 2],
                static_cast<int>(crests.size()));
    EXPECT_NEAR(r2_m / (0.043 * std::sqrt(of.hs_m * of.wavelength_m)), 1, 0.2);
}

TEST(Swash, Of0EndsWavesAtTheWaterline) {
    SwashSea of;
    of.shore.swash_m = 0;
    Ocean ocean(of.sea, {.executor = make_serial_executor(), .shore = of.shore});
    for (const double time_s : {0.0, 100.0, 200.0, 300.0}) {
        const ShoreSurface& shown = ocean.frame_at(time_s).shore;
        for (std::size_t texel = 0; texel < shown.height_m.size(); ++texel)
            if (shown.depth_m[texel] < 0) {
                EXPECT_LT(std::fabs(shown.height_m[texel]), 1e-5f) << shown.depth_m[texel];
            }
    }
}

TEST(Swash, DoesNotLiftWavesInTheWater) {
    SwashSea of;
    for (const double swash_m : {-1.0, 0.0, 1.0, 3.0}) {
        of.shore.swash_m = swash_m;
        Ocean ocean(of.sea, {.executor = make_serial_executor(), .queries = true, .shore = of.shore});
        std::vector<double> x, z;
        for (const double depth_m : {0.19, 0.3, 0.5, 1.0})
            for (int place = 0; place < 8; ++place) {
                x.push_back(of.waterline_m - depth_m / of.slope);
                z.push_back(40 + 10 * place);
            }
        std::vector<float> heights(x.size());
        std::vector<double> squares(x.size());
        constexpr int times = 300;
        for (int i = 0; i < times; ++i) {
            SurfaceQuery(ocean.frame_at(of.sea.loop_period_s * i / times)).sample({x, z}, {.height_m = heights});
            for (std::size_t at = 0; at < x.size(); ++at)
                squares[at] += static_cast<double>(heights[at]) * static_cast<double>(heights[at]) / times;
        }
        for (std::size_t at = 0; at < x.size(); ++at) {
            const double depth_m = (of.waterline_m - x[at]) * of.slope;
            EXPECT_LE(4 * std::sqrt(squares[at]), 0.64 * depth_m) << depth_m << " m, swash " << swash_m;
        }
    }
}

// Broken waves do not recover: in the deep water behind the bar they are lower than on it.
TEST(Breaking, ReducesAllWavesBehindABar) {
    const SeaState sea{.resolution = 64};
    const Surf surf(sea, bar(), 200, 800);
    const Surf::Line &before = surf.line_of[0], &on = surf.line_of[Surf::lines / 2],
                     &behind = surf.line_of[Surf::lines - 1];
    EXPECT_GT(before.depth_m, 19);
    EXPECT_GT(behind.depth_m, 19);
    EXPECT_NEAR(on.depth_m, 1.5, 0.01);
    EXPECT_GT(before.hm0_m, 2);
    EXPECT_LT(on.hm0_m, 0.9);
    EXPECT_LT(behind.hm0_m, on.hm0_m);
}

// The ground rises to 3.7 m at the edge of the field. No wave comes from beyond it, and the swash
// ends far below.
TEST(Breaking, LeavesNoWavesOnDryGroundAtTheEdge) {
    const SeaState sea{.resolution = 64};
    ShoreOptions shore =
        shore_of(101, 101, 10, [](double x, double) { return x < 600 ? -20.0 : -20 + (x - 600) / 400 * 23.7; });
    shore.resolution = 128;
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .shore = shore});
    std::vector<double> x, z;
    for (int i = 0; i < 300; ++i) {
        x.push_back(985 + 0.1 * i);
        z.push_back(-100 + 4.0 * i);
    }
    std::vector<float> heights(x.size());
    for (int i = 0; i < 20; ++i) {
        SurfaceQuery(ocean.frame_at(7.3 * i)).sample({x, z}, {.height_m = heights});
        for (const float height : heights) EXPECT_EQ(height, 0);
    }
}

// Linear theory: u = a omega coth(k d) in the direction of the wave, in phase with its height, at
// any depth.
TEST(Velocities, MatchAiryWaves) {
    const SeaState sea = one_wave();
    const OpenWave wave = wave_of(sea);
    for (const double depth_m : {3.0, 10.0, 40.0, 300.0}) {
        const ShoreOptions even = shore_of(101, 101, 10, [=](double, double) { return -depth_m; });
        Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .velocities = Velocities::drawn,
                          .shore = even});
        std::vector<double> x, z;
        for (int i = 0; i < 900; ++i) {
            x.push_back(300 + 13.7 * (i % 30));
            z.push_back(300 + 12.9 * (i / 30));
        }
        std::vector<float> height(x.size()), u(x.size()), v(x.size()), w(x.size());
        double heights = 0, along = 0, across = 0, both = 0;
        for (int i = 0; i < 12; ++i) {
            SurfaceQuery(ocean.frame_at(7.1 * i))
                .sample({x, z}, {.height_m = height, .velocity_x_mps = u, .velocity_y_mps = v, .velocity_z_mps = w});
            for (std::size_t at = 0; at < x.size(); ++at) {
                const double h = static_cast<double>(height[at]), u_x = static_cast<double>(u[at]),
                             u_z = static_cast<double>(w[at]);
                const double ahead = u_x * wave.along_x + u_z * wave.along_z;
                const double aside = u_z * wave.along_x - u_x * wave.along_z;
                heights += h * h, along += ahead * ahead, across += aside * aside, both += h * ahead;
            }
        }
        const double expected = wave.omega / std::tanh(wave_number_at(wave.omega, depth_m) * depth_m);
        EXPECT_NEAR(std::sqrt(along / heights) / expected, 1, 0.01) << depth_m;
        EXPECT_NEAR(both / heights / expected, 1, 0.01) << depth_m;
        EXPECT_LT(std::sqrt(across / along), 0.02) << depth_m;
    }
}

// A wave of 8 texels keeps 97 % of its height at the centre of cells too. Bilinear interpolation
// gives as little as 85 %.
TEST(Shoaling, KeepsWavesOfEightTexelsBetweenTexels) {
    const SeaState sea = one_wave(0.5);
    const OpenWave wave = wave_of(sea);
    const double depth_m = 1000, k = wave_number_at(wave.omega, depth_m);
    ShoreOptions even = shore_of(64, 64, 2 * pi / k / 8, [=](double, double) { return -depth_m; });
    even.resolution = 64;
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .shore = even});
    std::vector<double> x, z;
    for (int i = 0; i < 400; ++i) {
        x.push_back((20.5 + i % 20) * even.metres_per_sample);
        z.push_back((20.5 + i / 20) * even.metres_per_sample);
    }
    std::vector<float> height(x.size()), normal_x(x.size()), normal_y(x.size()), normal_z(x.size());
    double heights = 0, slopes = 0;
    constexpr int times = 16;
    for (int i = 0; i < times; ++i) {
        SurfaceQuery(ocean.frame_at(i * (2 * pi / wave.omega) / times))
            .sample({x, z}, {.height_m = height, .normal_x = normal_x, .normal_y = normal_y, .normal_z = normal_z});
        for (std::size_t at = 0; at < x.size(); ++at) {
            const double h = static_cast<double>(height[at]), y = static_cast<double>(normal_y[at]),
                         s_x = static_cast<double>(normal_x[at]) / y, s_z = static_cast<double>(normal_z[at]) / y;
            heights += h * h / times / 400;
            slopes += (s_x * s_x + s_z * s_z) / times / 400;
        }
    }
    const double kept = std::sqrt(2 * heights) / wave.amplitude_m;
    EXPECT_GT(kept, 0.97);
    EXPECT_LT(kept, 1.01);
    EXPECT_NEAR(std::sqrt(2 * slopes) / (wave.amplitude_m * k), 1, 0.06);
}

// Over a slope the component of the wave vector along the contours is constant, and rays diverge:
// Kr = sqrt(cos0 / cos).
TEST(Refraction, MatchesSnellsLawOnABeach) {
    ShoreOptions options = beach(1000, 600, 40, 150, 5);
    const SeaBed bed(options);
    const double omega = 2 * pi / 9, angle = 0.6, open_k = wave_number_at(omega, 4000);
    Refraction wave(bed);
    wave.propagate({.omega = omega, .along_x = std::cos(angle), .along_z = std::sin(angle), .depth_m = 4000});
    int looked = 0;
    for (int i = 60; i < bed.columns; i += 10) {
        const double d = bed.depth_m[bed.at(i, bed.rows / 2)];
        if (d < 1) continue;
        const std::size_t upper = bed.at(i, 30), lower = bed.at(i, bed.rows - 30);
        const double along = (wave.phase()[lower] - wave.phase()[upper]) / ((bed.rows - 60) * bed.texel_m);
        EXPECT_NEAR(along / (open_k * std::sin(angle)), 1, 0.01) << d;
        const double k = wave_number_at(omega, d), sine = open_k * std::sin(angle) / k;
        const double spread = std::sqrt(std::cos(angle) / std::sqrt(1 - sine * sine));
        const std::size_t middle = bed.at(i, bed.rows / 2);
        EXPECT_NEAR(wave.height()[middle] / wave.shoaling(middle) / spread, 1, 0.04) << d;
        ++looked;
    }
    EXPECT_GT(looked, 10);
    // The wave has turned by then.
    EXPECT_LT(open_k * std::sin(angle) / wave_number_at(omega, 1), 0.2);
}

// Over an even floor the first arrival behind an island takes the shortest path: a tangent, an arc,
// a tangent.
TEST(Refraction, TakesTheShortestPathAroundAnIsland) {
    const double side = 1000, radius = 150;
    ShoreOptions options = island(side, radius, 60, 4);
    const SeaBed bed(options);
    const double omega = 2 * pi / 7, k = wave_number_at(omega, 60);
    Refraction wave(bed);
    wave.propagate({.omega = omega, .along_x = 1, .along_z = 0, .depth_m = 60});
    for (const double behind : {250.0, 350.0, 450.0}) {
        const int i = static_cast<int>(std::lround((side / 2 + behind) / bed.texel_m)), j = bed.rows / 2;
        const double x = i * bed.texel_m - side / 2;
        const double way = side / 2 + (pi / 2 - std::acos(radius / x)) * radius + std::sqrt(x * x - radius * radius);
        // The minimum depth, at the foot of the island, is within about a texel of its edge. The
        // scheme is of first order.
        EXPECT_NEAR(wave.phase()[bed.at(i, j)] / (k * way), 1, 0.02) << behind;
        EXPECT_LT(wave.height()[bed.at(i, j)], 0.35) << behind;
        EXPECT_NEAR(wave.height()[bed.at(i, 12)], 1, 0.1) << behind;
    }
}

// The energy through a line behind the island is at most the energy that came in, and equals what
// passes the island.
TEST(Refraction, LosesEnergyOnlyOnLand) {
    const double side = 1000;
    const SeaBed bed(island(side, 150, 60, 4));
    Refraction wave(bed);
    wave.propagate({.omega = 2 * pi / 7, .along_x = 1, .along_z = 0, .depth_m = 60});
    double energy = 0;
    const int i = bed.columns - 30;
    for (int j = 0; j < bed.rows; ++j) energy += wave.height()[bed.at(i, j)] * wave.height()[bed.at(i, j)];
    // 300 m of the line are the island's. Diffracted waves cross it obliquely, which the sum does
    // not include: a tenth.
    EXPECT_NEAR(energy / bed.rows, 0.7, 0.1);
}

TEST(ShoreWaves, HaveTheEnergyOfTheCoarsestCascade) {
    for (const double wind : {6.0, 15.0}) {
        const SeaState sea{.wind_speed_mps = wind, .wind_direction_rad = 0.7};
        const CascadePlan cascade = plan_cascades(sea).front();
        const WaveSpectrum spectrum(sea, cascade);
        double expected = 0, found = 0, x = 0, z = 0;
        const double max_k = std::min(cascade.max_k, pi * cascade.resolution / cascade.grid.side_m);
        constexpr int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            const double k = (i + 0.5) / steps * max_k;
            expected += spectrum.radial_density(k) * max_k / steps;
        }
        const std::vector<ShoreWave> waves = shore_waves(sea, cascade);
        ASSERT_EQ(waves.size(), max_shore_waves);
        for (std::size_t i = 0; i < waves.size(); ++i) {
            found += waves[i].variance();
            x += waves[i].along_x;
            z += waves[i].along_z;
            EXPECT_NEAR(waves[i].along_x * waves[i].along_x + waves[i].along_z * waves[i].along_z, 1, 1e-12);
            if (i > 0) {
                EXPECT_GE(waves[i].harmonic, waves[i - 1].harmonic);
            }
        }
        EXPECT_NEAR(found / expected, 1, 0.005);
        EXPECT_NEAR(std::atan2(z, x), 0.7, 0.3);
    }
}

// One wave: sqrt(phi), phi = t^3 / (t + k d (1 - t^2)), until it breaks.
TEST(ShoreWaves, AreAttenuatedByDepthAsTheTmaSpectrum) {
    const SeaState sea = one_wave();
    const DepthAttenuation part(sea, plan_cascades(sea).front());
    const double omega = wave_of(sea).omega, variance = 0.5 * wave_of(sea).amplitude_m * wave_of(sea).amplitude_m;
    const std::vector<double> depths_m = {2000.0, 100.0, 30.0, 8.0, 2.0, 0.5, 0.05};
    const std::vector<double> factors = part.at(depths_m);
    for (std::size_t i = 0; i < depths_m.size(); ++i) {
        const double d = depths_m[i], kd = wave_number_at(omega, d) * d, t = std::tanh(kd);
        const double left = std::sqrt(t * t * t / (t + kd * (1 - t * t)));
        const double highest = std::min(1.0, 0.6 * d / (4 * std::sqrt(variance) * left));
        // A shore's frequency is a whole number of the loop's, with an error of up to 1 %.
        EXPECT_NEAR(factors[i], left * highest, 6e-3) << d;
    }
    EXPECT_EQ(part.at(std::array{0.0, -3.0}), (std::vector{0.0, 0.0}));
}

// The sea behind an island is calm compared with the sea in front of it: a root mean square over
// places and times.
TEST(Islands, HaveCalmWaterBehindThem) {
    const SeaState sea{
        .spreading = SpreadingModel::donelan_banner, .cascades = 3, .resolution = 64, .wind_speed_mps = 9};
    ShoreOptions shore = island(1000, 180, 30, 5);
    shore.resolution = 128;
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .shore = shore});
    double before = 0, behind = 0, beside = 0;
    std::vector<double> x, z;
    for (int i = 0; i < 400; ++i) {
        x.push_back(180 + i % 20 * 5);
        z.push_back(450 + i / 20 * 5);
        x.push_back(720 + i % 20 * 5);
        z.push_back(450 + i / 20 * 5);
        x.push_back(720 + i % 20 * 5);
        z.push_back(150 + i / 20 * 5);
    }
    std::vector<float> heights(x.size());
    for (int i = 0; i < 40; ++i) {
        SurfaceQuery(ocean.frame_at(4.7 * i)).sample({x, z}, {.height_m = heights});
        for (std::size_t point = 0; point < heights.size(); point += 3) {
            const auto square = [&](std::size_t at) {
                return static_cast<double>(heights[at]) * static_cast<double>(heights[at]);
            };
            before += square(point), behind += square(point + 1), beside += square(point + 2);
        }
    }
    EXPECT_LT(std::sqrt(behind / before), 0.5);
    // Open water has the sea's own height. About sixteen by sixteen peak waves vary by a tenth.
    const double expected = ocean.complete().statistics.significant_wave_height_m / 4;
    EXPECT_NEAR(std::sqrt(before / (400 * 40)) / expected, 1, 0.2);
    EXPECT_NEAR(std::sqrt(beside / (400 * 40)) / expected, 1, 0.2);
}

}  // namespace
}  // namespace pelagic
