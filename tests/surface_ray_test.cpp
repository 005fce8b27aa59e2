// Rays compared with an oracle that marches in small steps.
#include "pelagic/sim/surface_ray.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/oracle/surface_oracle.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

class SurfaceRayTest : public testing::Test {
   protected:
    SurfaceRayTest()
        : ocean_(sea_, {.executor = make_serial_executor(), .queries = true}),
          frame_(ocean_.frame_at(4)),
          query_(frame_),
          surface_(frame_, sea_.patch_size_m) {}

    double height_at(double x, double z) const { return surface_.intersections_at(x, z).front().height; }

    SeaState sea_{.resolution = 64, .patch_size_m = 128, .wind_speed_mps = 12, .choppiness = 1};
    Ocean ocean_;
    const Frame& frame_;
    SurfaceQuery query_;
    oracle::Surface surface_;
};

TEST_F(SurfaceRayTest, StraightDownHitsTheSurfaceHeight) {
    for (int i = 0; i < 50; ++i) {
        const double x = i * 7.3 - 100, z = 50 - i * 3.1;
        const double height = height_at(x, z);
        const auto down = first_hit(query_, {{x, 30, z}, {0, -2, 0}, 100});
        ASSERT_TRUE(down);
        EXPECT_NEAR(down->distance_m, 30 - height, 2e-3);
        EXPECT_NEAR(down->position_m[1], height, 2e-3);
        EXPECT_FALSE(down->from_below);
        EXPECT_GT(down->normal[1], 0.5f);
        const auto up = first_hit(query_, {{x, -30, z}, {0, 1, 0}, 100});
        ASSERT_TRUE(up);
        EXPECT_NEAR(up->distance_m, 30 + height, 2e-3);
        EXPECT_TRUE(up->from_below);
    }
}

TEST_F(SurfaceRayTest, FirstHitMatchesAMarchInSmallSteps) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> horizontal(-1, 1), height(-4, 4), steepness(-0.3, 0.3);
    int hits = 0, from_below = 0;
    for (int i = 0; i < (is_sanitized ? 60 : 300); ++i) {
        const double angle = 3.14159 * horizontal(random);
        const SurfaceRay ray{{200 * horizontal(random), height(random), 200 * horizontal(random)},
                             {std::cos(angle), i % 10 ? steepness(random) : 0.0, std::sin(angle)},
                             60};
        const double length = std::hypot(1, ray.direction[1]);
        const auto clearance = [&](double t) {
            return ray.origin_m[1] + t * ray.direction[1] / length -
                   height_at(ray.origin_m[0] + t * ray.direction[0] / length,
                             ray.origin_m[2] + t * ray.direction[2] / length);
        };
        // A twentieth of the library's step. A crest that the oracle finds and the library may miss
        // is shorter than half a texel.
        const double texel_m = sea_.patch_size_m / sea_.resolution, small = texel_m / 40;
        const bool below = clearance(0) < 0;
        std::optional<double> expected;
        bool grazes = false;
        for (double t = 0; t + small <= ray.reach_m; t += small) {
            if ((clearance(t + small) < 0) == below) continue;
            // Measures how long the ray stays on the other side.
            double out = t + small;
            while (out - t < texel_m && (clearance(out) < 0) != below) out += small;
            if (out - t < texel_m / 2 * 1.1 || t + texel_m > ray.reach_m) {
                grazes = true;
                break;
            }
            expected = t;
            break;
        }
        if (grazes) continue;
        const auto hit = first_hit(query_, ray);
        ASSERT_EQ(hit.has_value(), expected.has_value()) << i;
        if (!hit) continue;
        ++hits;
        from_below += below;
        EXPECT_EQ(hit->from_below, below);
        EXPECT_GE(hit->distance_m, *expected - 2e-3);
        EXPECT_LE(hit->distance_m, *expected + small + 2e-3);
        // On the surface: within the tolerance along the ray, whose slope relative to the water is
        // at most 2.
        EXPECT_NEAR(clearance(hit->distance_m), 0, 4e-3);
        EXPECT_NEAR(std::hypot(hit->normal[0], hit->normal[1], hit->normal[2]), 1, 1e-5);
    }
    EXPECT_GT(hits, is_sanitized ? 4 : 100);
    EXPECT_GT(from_below, is_sanitized ? 0 : 30);
}

TEST_F(SurfaceRayTest, MissesWhatItNeverReaches) {
    const double top = frame_.bounds.height_max_m, bottom = frame_.bounds.height_min_m;
    EXPECT_FALSE(first_hit(query_, {{0, top + 1, 0}, {1, 0, 0}, 1e4}));
    EXPECT_FALSE(first_hit(query_, {{0, top + 1, 0}, {0.1, 1, 0}, 1e9}));
    EXPECT_FALSE(first_hit(query_, {{0, bottom - 1, 0}, {0, 0, -1}, 1e4}));
    EXPECT_FALSE(first_hit(query_, {{0, bottom - 1, 0}, {0.3, -1, 0}, 1e9}));
    EXPECT_FALSE(first_hit(query_, {{0, top + 10, 0}, {0, -1, 0}, 5}));
    EXPECT_FALSE(first_hit(query_, {{0, top + 10, 0}, {0, -1, 0}, 0}));
}

TEST_F(SurfaceRayTest, FromFarAwayIsAsExactAsDoubles) {
    // 50 km away and 5 km up: a ray of 50 km that crosses the water's height range in its last tens
    // of metres.
    const auto hit = first_hit(query_, {{-50e3, 5e3, 20}, {50e3, -5e3, 0}, 1e5});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->position_m[1], height_at(hit->position_m[0], hit->position_m[2]), 5e-3);
}

}  // namespace
}  // namespace pelagic
