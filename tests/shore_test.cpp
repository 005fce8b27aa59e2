// Shores in an ocean: their frames, queries and rays, and reproducibility.
#include "pelagic/sim/shore.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/sim/surface_ray.hpp"
#include "pelagic/tests/cascade_stack.hpp"
#include "pelagic/tests/each_executor.hpp"
#include "pelagic/tests/golden.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

const SeaState breeze{.cascades = 3, .resolution = 32, .wind_speed_mps = 8, .loop_period_s = 40};

OceanOptions with_bay(Isa isa = choose_isa(), std::shared_ptr<Executor> executor = make_serial_executor()) {
    return {.executor = std::move(executor), .isa = isa, .queries = true, .velocities = Velocities::drawn,
            .shore = bay()};
}

TEST(Shore, DoesNotChangeTheCascades) {
    Ocean with(breeze, with_bay()), without(breeze, {.executor = make_serial_executor()});
    EXPECT_EQ(hash_of(with.frame_at(3.5)), hash_of(without.frame_at(3.5)));
    EXPECT_NE(shore_hash_of(with.frame_at(3.5)), 0U);
    EXPECT_EQ(shore_hash_of(without.frame_at(3.5)), 0U);
}

TEST(Shore, HasTheGoldenHashesOnEveryInstructionSetAndExecutor) {
    for (const Computing& on : computings()) {
        SCOPED_TRACE(on.name);
        Ocean ocean(breeze, with_bay(on.isa, on.executor()));
        GoldenRows rows("shore");
        for (const char* time : {"0", "7.3"}) rows.row(time, {shore_hash_of(ocean.frame_at(std::stod(time)))});
        rows.expect();
    }
}

TEST(Shore, RepeatsWithTheLoop) {
    Ocean ocean(breeze, with_bay());
    for (const double t : {0.0, 11.7}) {
        const std::uint64_t expected = shore_hash_of(ocean.frame_at(t));
        EXPECT_EQ(shore_hash_of(ocean.frame_at(t + 40)), expected);
        EXPECT_EQ(shore_hash_of(ocean.frame_at(t - 4000)), expected);
    }
}

// There are two slots, so the views of a frame stay valid while the next frame is computed.
TEST(Shore, KeepsTheFrameWhileTheNextIsComputed) {
    Ocean ocean(breeze, with_bay());
    const Frame first = ocean.frame_at(1);
    const std::uint64_t expected = shore_hash_of(first);
    EXPECT_NE(shore_hash_of(ocean.frame_at(2)), expected);
    EXPECT_EQ(shore_hash_of(first), expected);
}

// Holds at edges in deep water. Beyond a dry edge there is no water.
TEST(Shore, ContinuesOutsideItsRectangleWithTheValuesAtItsEdge) {
    Ocean with(breeze, with_bay()), without(breeze, {.executor = make_serial_executor(), .queries = true});
    const Frame& frame = with.frame_at(9);
    const ShoreSurface& shore = frame.shore;
    const double right_m = shore.x_m + (shore.columns - 1) * shore.texel_m, top_m = shore.z_m;
    const double bottom_m = shore.z_m + (shore.rows - 1) * shore.texel_m;
    for (const double along : {0.0, 0.3, 0.77}) {
        const ShoreSample edge =
            sample(shore, shore.x_m + 1e-9, shore.z_m + along * (shore.rows - 1) * shore.texel_m);
        EXPECT_NEAR(edge.height_m, 0, 1e-9);
        EXPECT_NEAR(edge.weights[0], 1, 1e-9);
        EXPECT_NEAR(edge.weights[2], 1, 1e-9);
    }
    const std::vector<double> x = {-170.01, -500, 12, -1e7}, z = {3, 900, top_m - 0.01, -1e6};
    std::vector<float> found(4), expected(4);
    const SurfaceQuery query(frame);
    query.sample({x, z}, {.height_m = found});
    SurfaceQuery(without.frame_at(9)).sample({x, z}, {.height_m = expected});
    EXPECT_EQ(found, expected);

    // The bay's ground rises to 2 m at the right edge, above all swash.
    const std::vector<double> dry_x = {right_m - 0.01, right_m, right_m + 0.01, 1e7}, dry_z = {3, -40, 3, -1e6};
    query.sample({dry_x, dry_z}, {.height_m = found});
    EXPECT_EQ(found, std::vector<float>(4, 0.f));
    EXPECT_NEAR(sample(shore, 1e7, 3).depth_m, sample(shore, right_m, 3).depth_m, 1e-9);
    EXPECT_LT(sample(shore, 1e7, 3).depth_m, -1);

    // The height has no step anywhere on the rectangle's edge.
    std::vector<double> in_x, in_z, out_x, out_z;
    for (int i = 0; i < 400; ++i) {
        const double along = (i + 0.5) / 400, width = right_m - shore.x_m, length = bottom_m - top_m;
        for (const int side : {0, 1}) {
            in_x.push_back(shore.x_m + along * width), out_x.push_back(in_x.back());
            in_z.push_back(side == 0 ? top_m + 1e-4 : bottom_m - 1e-4);
            out_z.push_back(side == 0 ? top_m - 1e-4 : bottom_m + 1e-4);
            in_z.push_back(top_m + along * length), out_z.push_back(in_z.back());
            in_x.push_back(side == 0 ? shore.x_m + 1e-4 : right_m - 1e-4);
            out_x.push_back(side == 0 ? shore.x_m - 1e-4 : right_m + 1e-4);
        }
    }
    std::vector<float> inside(in_x.size()), outside(in_x.size());
    query.sample({in_x, in_z}, {.height_m = inside});
    query.sample({out_x, out_z}, {.height_m = outside});
    for (std::size_t i = 0; i < inside.size(); ++i) {
        // The bound is a slope of 1 over the distance, plus the tolerance of a query.
        EXPECT_NEAR(inside[i], outside[i], 5e-4f) << in_x[i] << " " << in_z[i];
    }
}

/// Interpolates a cascade bilinearly, by the definition.
double cascade_at(const Cascade& cascade, const PlaneView& plane, double x, double z) {
    const auto [along, across] = cascade.grid.in_cascade(x, z);
    const double u = along / cascade.texel_m(), v = across / cascade.texel_m(), i = std::floor(u), j = std::floor(v);
    const int n = cascade.resolution();
    const auto at = [&](double column, double row) {
        const auto wrapped = [n](double c) { return static_cast<int>(c - n * std::floor(c / n)); };
        return static_cast<double>(plane.at(wrapped(column), wrapped(row)));
    };
    const double above = at(i, j) + (u - i) * (at(i + 1, j) - at(i, j));
    const double below = at(i, j + 1) + (u - i) * (at(i + 1, j + 1) - at(i, j + 1));
    return above + (v - j) * (below - above);
}

// Evaluates the surface by its definition, from reference points q: q + sum of weight(p) D(q) = p.
TEST(Shore, MatchesQueries) {
    Ocean ocean(breeze, with_bay());
    const Frame& frame = ocean.frame_at(4.2);
    const SurfaceQuery query(frame);
    std::mt19937 random(3);
    const auto even = [&](double from, double to) {
        return from + (to - from) * static_cast<double>(random()) * 0x1p-32;
    };
    int in_fade = 0, at_shore = 0;
    for (int i = 0; i < 4000; ++i) {
        const double q_x = even(-190, 260), q_z = even(-150, 190);
        double x = q_x, z = q_z, height = 0, rise = 0, x_mps = 0, z_mps = 0;
        ShoreSample here;
        for (int step = 0; step < 60; ++step) {
            here = sample(frame.shore, x, z);
            x = q_x, z = q_z, height = here.height_m, rise = here.vertical_velocity_mps;
            x_mps = here.velocity_x_mps, z_mps = here.velocity_z_mps;
            for (std::size_t t = 0; t < frame.cascades.size(); ++t) {
                const Cascade& cascade = frame.cascades[t];
                x += here.weights[t] * cascade_at(cascade, cascade.dx, q_x, q_z);
                z += here.weights[t] * cascade_at(cascade, cascade.dz, q_x, q_z);
                height += here.weights[t] * cascade_at(cascade, cascade.height, q_x, q_z);
                rise += here.weights[t] * cascade_at(cascade, cascade.velocity_y, q_x, q_z);
                x_mps += here.weights[t] * cascade_at(cascade, cascade.velocity_x, q_x, q_z);
                z_mps += here.weights[t] * cascade_at(cascade, cascade.velocity_z, q_x, q_z);
            }
        }
        float found_height, found_vertical_velocity, found_x_mps, found_z_mps, jacobian;
        query.sample({{&x, 1}, {&z, 1}}, {.height_m = {&found_height, 1},
                                          .jacobian = {&jacobian, 1},
                                          .velocity_x_mps = {&found_x_mps, 1},
                                          .velocity_y_mps = {&found_vertical_velocity, 1},
                                          .velocity_z_mps = {&found_z_mps, 1}});
        // Near a fold another intersection may be the higher one.
        if (jacobian < 0.3f) continue;
        EXPECT_NEAR(static_cast<double>(found_height), height, 2e-4) << x << " " << z;
        EXPECT_NEAR(static_cast<double>(found_vertical_velocity), rise, 2e-3) << x << " " << z;
        EXPECT_NEAR(static_cast<double>(found_x_mps), x_mps, 2e-3) << x << " " << z;
        EXPECT_NEAR(static_cast<double>(found_z_mps), z_mps, 2e-3) << x << " " << z;
        in_fade += here.weights[0] > 0.05 && here.weights[0] < 0.95;
        at_shore += here.weights[1] < 0.5;
    }
    EXPECT_GT(in_fade, 500);
    EXPECT_GT(at_shore, 300);
}

// Cascades with weights are cascades of smaller displacement, also where the surface overlaps
// itself.
TEST(Shore, WeightsFoldedCascadesToo) {
    constexpr int part = 153;
    std::vector<CascadeStack::Part> all = CascadeStack::of_scales(3, 14, 1, 7, 32), less = all;
    for (std::size_t t = 0; t < all.size(); ++t) {
        all[t].factor *= 8;
        less[t].factor = all[t].factor * part / 255;
    }
    const CascadeStack whole(all, 3), expected(less, 3);
    constexpr int texels = 16;
    const std::vector<std::uint32_t> parts(texels * texels, part * 0x01010101U);
    const std::vector<float> flat(parts.size());
    const std::vector<std::uint8_t> no_foam(parts.size());
    Frame frame = whole.frame();
    frame.shore = {.columns = texels,
                   .rows = texels,
                   .texel_m = 100,
                   .x_m = -700,
                   .z_m = -700,
                   .depth_m = flat,
                   .weights_rgba8 = parts,
                   .height_m = flat,
                   .vertical_velocity_mps = flat,
                   .potential_m2ps = flat,
                   .reach_m = flat,
                   .foam = no_foam,
                   .bounds = {}};
    std::mt19937 random(5);
    std::vector<double> x, z;
    for (int i = 0; i < 3000; ++i) {
        x.push_back(static_cast<double>(random()) * 0x1p-32 * 1000 - 500);
        z.push_back(static_cast<double>(random()) * 0x1p-32 * 1000 - 500);
    }
    std::vector<float> height(x.size()), normal(x.size()), expected_height(x.size()), expected_normal(x.size());
    SurfaceQuery(frame).sample({x, z}, {.height_m = height, .normal_x = normal});
    SurfaceQuery(expected.frame()).sample({x, z}, {.height_m = expected_height, .normal_x = expected_normal});
    double contracted = 0;
    for (const Cascade& cascade : expected.frame().cascades) contracted += cascade.contraction.max();
    int differ = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        // At the edge of a fold, rounding decides how many intersections there are.
        differ +=
            !(std::fabs(height[i] - expected_height[i]) < 2e-3f && std::fabs(normal[i] - expected_normal[i]) < 2e-2f);
    }
    // The sum of contractions is above the fold limit, 1; otherwise the iteration alone would pass.
    EXPECT_GT(contracted, 1.2);
    EXPECT_LE(differ, 6);
}

TEST(Shore, VerticalVelocityIsTheDerivativeOfTheHeight) {
    Ocean ocean(breeze, with_bay());
    // Powers of two; otherwise the rounding of float heights would be noise in the differences.
    const double dt = 1.0 / 64;
    const auto heights = [&](double t) {
        const std::span<const float> all = ocean.frame_at(t).shore.height_m;
        return std::vector<float>(all.begin(), all.end());
    };
    const std::vector<float> before = heights(5 - dt), after = heights(5 + dt);
    const ShoreSurface& shore = ocean.frame_at(5).shore;
    double squares = 0, errors = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const double change = static_cast<double>(after[i] - before[i]) / (2 * dt);
        const double error = change - static_cast<double>(shore.vertical_velocity_mps[i]);
        squares += change * change;
        errors += error * error;
    }
    // The bound covers the third derivative, (omega dt)^2 / 6 for waves up to 3 rad/s, and the kink
    // where a wave begins to break.
    EXPECT_LT(std::sqrt(errors / squares), 0.01);
}

TEST(Shore, ReachesAreAtLeastTheHeights) {
    Ocean ocean(breeze, with_bay());
    const Frame& frame = ocean.frame_at(13);
    float max = 0, min = 0;
    for (std::size_t i = 0; i < frame.shore.height_m.size(); ++i) {
        EXPECT_GE(frame.shore.reach_m[i], frame.shore.height_m[i] - 1e-5f);
        max = std::max(max, frame.shore.height_m[i]);
        min = std::min(min, frame.shore.height_m[i]);
    }
    EXPECT_GT(max, 0.1f);
    // Between texels a cubic exceeds the range by at most 0.28125 of the range.
    EXPECT_FLOAT_EQ(frame.shore.bounds.height_max_m, max + 0.28125f * (max - min));
    EXPECT_FLOAT_EQ(frame.shore.bounds.height_min_m, min - 0.28125f * (max - min));
    // Culling boxes include the heights.
    EXPECT_GE(frame.bounds.height_max_m, frame.shore.bounds.height_max_m);
    EXPECT_LE(frame.bounds.height_min_m, frame.shore.bounds.height_min_m);
}

/// A moat one texel wide along the diagonal near an edge, where no land shelters the cascades, in
/// ground 5 m above the sea.
ShoreOptions moat() {
    ShoreOptions shore = shore_of(64, 64, 1, [](double x, double z) { return x - z == 20 ? -60.0 : 5.0; });
    shore.resolution = 64;
    shore.fade_m = 31;
    return shore;
}

TEST(Shore, BoundsTheGradientOfTheWeights) {
    Ocean ocean(breeze, {.executor = make_serial_executor(), .shore = moat()});
    const ShoreSurface& shore = ocean.frame_at(0).shore;
    constexpr double far_m = 1e-3;
    double fastest = 0;
    for (double x = 20; x < 26; x += 0.05)
        for (double z = 0; z < 6; z += 0.05)
            for (const double way : {0.0, far_m, -far_m})
                for (std::size_t cascade = 0; cascade < 3; ++cascade)
                    fastest = std::max(fastest, std::fabs(sample(shore, x, z).weights[cascade] -
                                                          sample(shore, x + far_m, z + way).weights[cascade]) /
                                                    std::sqrt(far_m * far_m + way * way));
    EXPECT_LE(fastest, static_cast<double>(shore.weights_change_per_m));
    // On the diagonal from a texel of weight 1 to a texel of weight 0.
    EXPECT_GT(fastest, 0.9 * std::sqrt(2.0));
}

// The cascades' weights change from 0 to 1 and back over the moat's diagonal, so the water in it is
// a narrow wall. A ray with too small a bound of the weights' change would miss it. The oracle
// evaluates the definition in double; the displacement is vertical only.
TEST(Shore, RaysHitTheSurfaceWhereWeightsChangeAbruptly) {
    const SeaState sea{.waves = WaveModel::analytic,
                       .cascades = 4,
                       .resolution = 512,
                       .choppiness = 0,
                       .loop_period_s = 60,
                       .wave_count = 1,
                       .longest_wave_m = 150,
                       .wave_height_m = 12};
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .shore = moat()});
    std::mt19937 random(17);
    const auto even = [&](double from, double to) {
        return from + (to - from) * static_cast<double>(random()) * 0x1p-32;
    };
    const auto height_of_cascades = [](const Frame& frame, double x, double z) {
        double height = 0;
        for (const Cascade& cascade : frame.cascades) height += cascade_at(cascade, cascade.height, x, z);
        return height;
    };
    double crest_s = 0, highest_m = 0;
    for (double t = 0; t < 12; t += 1)
        if (const double height_m = height_of_cascades(ocean.frame_at(t), 22, 2); height_m > highest_m)
            highest_m = height_m, crest_s = t;
    EXPECT_GT(highest_m, 4);
    int hits = 0, misses = 0;
    for (int i = 0; i < 600; ++i) {
        if (i % 20 == 0) ocean.frame_at(crest_s + even(-1, 1));
        const Frame& frame = ocean.complete();
        // Only then does the surface consist of the cascades alone.
        ASSERT_EQ(frame.shore.bounds.height_max_m - frame.shore.bounds.height_min_m, 0);
        const double middle_z = even(0.5, 3.5), from_m = even(2, 6), tilt = even(-0.1, 0.1);
        const double high = even(0.6, 1.1) * height_of_cascades(frame, 22, 2);
        const SurfaceRay ray{.origin_m = {20 + middle_z - from_m, high - from_m * tilt, middle_z + from_m},
                             .direction = {1, tilt, -1},
                             .reach_m = 12};
        const double length = std::sqrt(2 + tilt * tilt);
        const auto clearance = [&](double distance) {
            const double x = ray.origin_m[0] + distance / length, z = ray.origin_m[2] - distance / length;
            double height = 0;
            const ShoreSample here = sample(frame.shore, x, z);
            for (std::size_t t = 0; t < frame.cascades.size(); ++t)
                height += here.weights[t] * cascade_at(frame.cascades[t], frame.cascades[t].height, x, z);
            return ray.origin_m[1] + distance * tilt / length - height;
        };
        double expected = 0, inside_m = 0, max_inside_m = 0;
        constexpr double step = 1.0 / 256;
        for (double distance = 0; distance < ray.reach_m; distance += step) {
            inside_m = clearance(distance) < 0 ? inside_m + step : 0;
            if (inside_m > 0 && expected == 0) expected = distance;
            max_inside_m = std::max(max_inside_m, inside_m);
        }
        // A ray may miss water that it crosses for less than about half a texel of the finest
        // cascade.
        const double texel_m = frame.cascades.back().texel_m();
        if (max_inside_m > 0 && max_inside_m < 0.6 * texel_m) continue;
        const auto hit = first_hit(SurfaceQuery(frame), ray);
        ASSERT_EQ(hit.has_value(), max_inside_m > 0) << i << ", at " << expected;
        if (hit) {
            EXPECT_NEAR(hit->distance_m, expected, 2 * step) << i;
        }
        (hit ? hits : misses) += 1;
    }
    EXPECT_GT(hits, 40);
    EXPECT_GT(misses, 60);
}

// The ray's hit agrees with a march in small steps.
TEST(Shore, RaysHitTheSurface) {
    Ocean ocean(breeze, with_bay());
    const Frame& frame = ocean.frame_at(2.5);
    const SurfaceQuery query(frame);
    std::mt19937 random(11);
    const auto even = [&](double from, double to) {
        return from + (to - from) * static_cast<double>(random()) * 0x1p-32;
    };
    for (int i = 0; i < 40; ++i) {
        const SurfaceRay ray{.origin_m = {even(-200, 250), 6, even(-150, 190)},
                             .direction = {even(-1, 1), -0.25, even(-1, 1)},
                             .reach_m = 60};
        const double length =
            std::sqrt(ray.direction[0] * ray.direction[0] + 0.0625 + ray.direction[2] * ray.direction[2]);
        const auto height_over = [&](double distance) {
            const double x = ray.origin_m[0] + distance * ray.direction[0] / length;
            const double z = ray.origin_m[2] + distance * ray.direction[2] / length;
            float height;
            query.sample({{&x, 1}, {&z, 1}}, {.height_m = {&height, 1}});
            return ray.origin_m[1] - distance * 0.25 / length - static_cast<double>(height);
        };
        double expected = 0;
        while (expected < ray.reach_m && height_over(expected) > 0) expected += 0.01;
        const auto hit = first_hit(query, ray);
        ASSERT_EQ(hit.has_value(), expected < ray.reach_m);
        // Two steps may straddle a crest that is thinner than a step.
        if (hit) {
            EXPECT_NEAR(hit->distance_m, expected, 0.02 + query.texel_m());
        }
    }
}

TEST(Shore, HasFoamWhereWavesBreak) {
    Ocean ocean(breeze, with_bay());
    const ShoreSurface& shore = ocean.frame_at(6).shore;
    int white = 0;
    for (std::size_t i = 0; i < shore.foam.size(); ++i) {
        white += shore.foam[i] > 100;
        // Waves of Hs 1.5 m do not break in water deeper than 4 m.
        if (shore.depth_m[i] > 6) {
            EXPECT_EQ(shore.foam[i], 0);
        }
    }
    EXPECT_GT(white, 20);
    const std::vector<double> x = {220}, z = {0};
    std::vector<float> foam(1);
    EXPECT_TRUE(SurfaceQuery(ocean.complete()).has_foam());
    SurfaceQuery(ocean.complete()).sample({x, z}, {.foam = foam});
    EXPECT_NEAR(static_cast<double>(foam[0]), sample(ocean.complete().shore, 220, 0).foam, 1e-6);
}

TEST(Shore, WarnsOfTexelsTooCoarseForItsWaves) {
    // One wave of 60 m, to 2 %: its period divides the loop.
    const SeaState sea{.waves = WaveModel::analytic,
                       .cascades = 2,
                       .resolution = 64,
                       .loop_period_s = 600,
                       .wave_count = 1,
                       .longest_wave_m = 60};
    ShoreOptions shore = shore_of(64, 64, 7.3, [](double, double) { return -50; });
    shore.resolution = 64;
    EXPECT_EQ(warning_about(shore, sea), "");
    shore.metres_per_sample = 7.8;
    const std::string warning = warning_about(shore, sea);
    EXPECT_EQ(warning.find("texels of 7.8 m are coarse"), 0U) << warning;
    EXPECT_NE(warning.find("texels of 7.6 m do not"), std::string::npos) << warning;
    shore.resolution = 128;
    EXPECT_EQ(warning_about(shore, sea), "");
}

TEST(Shore, InvalidOptionsAreRejected) {
    const auto refused = [](auto change) {
        ShoreOptions shore = bay();
        change(shore);
        return check(shore);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refused([](ShoreOptions&) {}), "");
    EXPECT_EQ(refused([](ShoreOptions& shore) { shore.columns = 1; }), "columns is 1, expected 2 to 4096");
    EXPECT_EQ(refused([](ShoreOptions& shore) { shore.rows = 60; }),
              "heights_m' size is 4941, expected 4860, columns times rows");
    EXPECT_EQ(refused([=](ShoreOptions& shore) { shore.heights_m[7] = static_cast<float>(nan); }),
              "heights_m nan is out of range [-11000, 9000]");
    EXPECT_EQ(refused([](ShoreOptions& shore) { shore.heights_m.back() = 1e30f; }),
              "heights_m 1e+30 is out of range [-11000, 9000]");
    EXPECT_EQ(refused([=](ShoreOptions& shore) { shore.corner_x_m = nan; }),
              "corner_x_m nan is out of range [-1e8, 1e8]");
    EXPECT_EQ(refused([](ShoreOptions& shore) { shore.metres_per_sample = 0; }),
              "metres_per_sample 0 is out of range [0.001, 10000]");
    EXPECT_EQ(refused([](ShoreOptions& shore) { shore.resolution = 100; }),
              "resolution is 100, expected 64, 128, 256, 512 or 1024");
    EXPECT_EQ(refused([](ShoreOptions& shore) { shore.fade_m = 151; }),
              "fade_m is 151, expected at most half the field's shorter side, 150");

    EXPECT_EQ(check(bay(), SeaState{.patch_size_m = 100}),
              "cascades is 1, expected 2 to 4 where there is a shore, which takes the coarsest cascade's waves");
    EXPECT_EQ(check(bay(), SeaState{.waves = WaveModel::pond}),
              "waves is pond, expected spectrum or analytic where there is a shore");
    EXPECT_THROW(Ocean(SeaState{.resolution = 32, .patch_size_m = 100}, with_bay()), std::invalid_argument);
    Forecast changing{.first = breeze};
    changing.changes.push_back({.sea = breeze, .from_s = 5, .over_s = 5});
    EXPECT_THROW(Ocean(changing, with_bay()), std::invalid_argument);
    Ocean ocean(breeze, with_bay());
    const std::uint64_t expected = shore_hash_of(ocean.frame_at(1));
    EXPECT_THROW(ocean.schedule_sea(breeze), std::invalid_argument);
    EXPECT_THROW(ocean.schedule_sea(breeze, 1, 2), std::invalid_argument);
    EXPECT_EQ(shore_hash_of(ocean.frame_at(1)), expected);
}

}  // namespace
}  // namespace pelagic
