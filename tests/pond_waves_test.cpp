// Octaves of exp(sin - 1) compared with their sum in long double with libm.
#include "pelagic/analytic/pond_waves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "pelagic/tests/analytic_points.hpp"
#include "pelagic/tests/each_isa.hpp"

namespace pelagic {
namespace {

// I0(1) / e
const Long mean_exp = 1.26606587775200833559824462521471753760767031135496L / std::numbers::e_v<Long>;

/// Returns the height by the header's definition; slopes are computed from its differences.
Long height_of(const PondSea& sea, Long time_s, Long x, Long z) {
    Long parts = 0, part = 1;
    for (int i = 0; i < sea.octaves; ++i, part *= sea.decay) parts += part;
    Long height = 0, wavelength = sea.wavelength_m;
    part = 1;
    for (int i = 0; i < sea.octaves; ++i, part *= sea.decay, wavelength /= sea.growth) {
        const Long k = 2 * long_pi / wavelength, w = std::sqrt(9.80665L * k + 7.4e-5L * k * k * k);
        const Long golden = 0.6180339887498949, direction = sea.direction_rad + 2 * long_pi * i * golden;
        const Long way_x = std::cos(direction), way_z = std::sin(direction);
        const Long phase = k * (way_x * x + way_z * z) - w * time_s + 2 * long_pi * i * golden * golden;
        const Long wave = std::exp(std::sin(phase) - 1), drag = sea.drag * part * sea.wavelength_m / (2 * long_pi);
        height += sea.height_m * part / parts * (wave - mean_exp);
        x -= way_x * drag * wave * std::cos(phase);
        z -= way_z * drag * wave * std::cos(phase);
    }
    return height;
}

struct PondArrays {
    PondArrays(const PondWaves& water, double time_s, const AnalyticPositions& places,
               const std::vector<float>& footprint = {}) {
        for (auto* const array : {&height, &normal_x, &normal_y, &normal_z, &rise, &variance})
            array->resize(places.x.size());
        water.sample(time_s, places.view(), {height, normal_x, normal_y, normal_z, rise, variance}, footprint);
    }
    std::vector<float> height, normal_x, normal_y, normal_z, rise, variance;
};

class PondOnEachIsa : public testing::TestWithParam<Isa> {};
INSTANTIATE_TEST_SUITE_P(Isas, PondOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

// One octave is exp(sin - 1): sine, exponential and their last products each have an error of at
// most 2^-23.
TEST_P(PondOnEachIsa, ExponentialIsWithinAFewStepsOfAFloat) {
    const PondSea sea{.octaves = 1, .height_m = 1, .wavelength_m = 1};
    const PondWaves water(sea, GetParam());
    const AnalyticPositions places = random_positions(2000, 10, 4);
    const PondArrays samples(water, 0, places);
    for (std::size_t i = 0; i < places.x.size(); ++i)
        ASSERT_NEAR(samples.height[i], rounded(height_of(sea, 0, places.x[i], places.z[i])), 3 * 0x1p-23);
}

// The drag of later octaves amplifies the rounding errors of earlier ones, up to ten times an
// octave's own error.
TEST_P(PondOnEachIsa, IsTheSumOfItsOctavesWithExactDerivatives) {
    const PondSea sea;
    const PondWaves water(sea, GetParam());
    const AnalyticPositions places = random_positions(120, 1000, 4);
    const double t = 321.5;
    const PondArrays samples(water, t, places);
    const Long step = 1e-6L;
    for (std::size_t i = 0; i < places.x.size(); ++i) {
        const Long x = places.x[i], z = places.z[i];
        ASSERT_NEAR(samples.height[i], rounded(height_of(sea, t, x, z)), 1e-6 * sea.height_m);
        const Long h_x = (height_of(sea, t, x + step, z) - height_of(sea, t, x - step, z)) / (2 * step);
        const Long h_z = (height_of(sea, t, x, z + step) - height_of(sea, t, x, z - step)) / (2 * step);
        const Long length = std::sqrt(1 + h_x * h_x + h_z * h_z);
        ASSERT_NEAR(samples.normal_x[i], rounded(-h_x / length), 1e-5);
        ASSERT_NEAR(samples.normal_y[i], rounded(1 / length), 1e-5);
        ASSERT_NEAR(samples.normal_z[i], rounded(-h_z / length), 1e-5);
        const Long rises = (height_of(sea, t + step, x, z) - height_of(sea, t - step, x, z)) / (2 * step);
        ASSERT_NEAR(samples.rise[i], rounded(rises), 1e-5);
        ASSERT_EQ(samples.variance[i], 0);
    }
}

TEST_P(PondOnEachIsa, MatchesTheGoldenHashes) {
    const AnalyticPositions places = random_positions(501, 100, 4);
    std::vector<float> footprint;
    for (int i = 0; i < 501; ++i) footprint.push_back(0.001f * static_cast<float>(i % 50));
    const PondArrays s(PondWaves({}, GetParam()), 77, places, footprint);
    EXPECT_EQ(hash_of({s.height, s.normal_x, s.normal_y, s.normal_z, s.rise, s.variance}), 14251735415318672993u);
}

TEST(Pond, StaysWithinItsBoundsAndAroundZero) {
    const PondWaves water({});
    const PondArrays samples(water, 5, random_positions(20000, 500, 4));
    double sum = 0;
    for (const float h : samples.height) {
        EXPECT_GE(h, water.lowest_m());
        EXPECT_LE(h, water.highest_m());
        sum += h;
    }
    // Drag gathers waves on crests, so the mean differs slightly from that of each octave.
    EXPECT_NEAR(sum / 20000, 0, 0.05 * PondSea{}.height_m);
}

// Without drag the octaves are independent, and the slopes that a footprint filters out are counted
// in the variance: the sum is preserved. 20000 positions give a mean square within 3 %.
TEST(Pond, MeanSquareSlopeDoesNotDependOnTheFootprint) {
    const PondWaves water(PondSea{.drag = 0});
    const AnalyticPositions places = random_positions(20000, 500, 4);
    const auto mean_square_slope = [&](const PondArrays& samples) {
        double sum = 0;
        for (std::size_t i = 0; i < places.x.size(); ++i)
            sum += 1 / (double{samples.normal_y[i]} * samples.normal_y[i]) - 1;
        return sum / 20000;
    };
    const double all = mean_square_slope(PondArrays(water, 5, places));
    double before = all;
    for (const float footprint_m : {0.02f, 0.1f, 0.4f, 1.f}) {
        const PondArrays samples(water, 5, places, std::vector<float>(20000, footprint_m));
        const double shown = mean_square_slope(samples);
        EXPECT_LT(shown, before);
        EXPECT_NEAR(shown + samples.variance[0], all, 0.03 * all) << footprint_m;
        before = shown;
    }
    const PondArrays flat(water, 5, places, std::vector<float>(20000, 1.f));
    EXPECT_EQ(flat.normal_y[7], 1);
    EXPECT_EQ(flat.height[7], 0);
}

TEST(Pond, RaysMeetTheFirstWaterOnTheirPath) {
    const PondSea sea;
    const PondWaves water(sea);
    std::mt19937 random(9);
    const auto one = [&] { return static_cast<double>(random()) * 0x1p-32; };
    for (int i = 0; i < 60; ++i) {
        const bool grazes = i % 2 == 0;  // just below the highest crests, which are short
        const std::array<double, 3> from{10 * one(), grazes ? 0.03 : 1.5, 10 * one()};
        const std::array<double, 3> way{one() - 0.5, grazes ? -0.0005 : -0.1 - one(), one() - 0.5};
        const auto hit = water.first_hit(3, from, way, 50);
        ASSERT_TRUE(hit);
        const auto [x, y, z] = hit->position_m;
        // 1e-6 m along a ray, above water whose slope is below 1.
        EXPECT_NEAR(rounded(height_of(sea, 3, x, z)), y, 2e-6);
        // Samples every millimetre of the last metre: the ray does not meet the water earlier.
        const double length = std::hypot(way[0], way[1], way[2]);
        std::vector<double> at_x, at_y, at_z;
        for (double at = std::max(0.0, hit->distance_m - 1); at < hit->distance_m - 0.005; at += 0.001) {
            at_x.push_back(from[0] + at * way[0] / length);
            at_y.push_back(from[1] + at * way[1] / length);
            at_z.push_back(from[2] + at * way[2] / length);
        }
        std::vector<float> heights(at_x.size());
        water.sample(3, {at_x, at_z}, {.height_m = heights});
        for (std::size_t place = 0; place < heights.size(); ++place) ASSERT_GT(at_y[place], heights[place]);
    }
    EXPECT_FALSE(water.first_hit(3, {0, 1, 0}, {0, 1, 0}, 50));
    EXPECT_FALSE(water.first_hit(3, {0, 1, 0}, {1, 0, 0}, 50));
    EXPECT_FALSE(water.first_hit(3, {0, 1, 0}, {0, -1, 0}, 0.9));
    EXPECT_NEAR(water.first_hit(3, {2, 1, 5}, {0, -7, 0}, 2)->distance_m, 1 - rounded(height_of(sea, 3, 2, 5)), 2e-6);
}

TEST(Pond, NamesTheFirstInvalidNumber) {
    EXPECT_EQ(check(PondSea{}), "");
    EXPECT_EQ(check(PondSea{.octaves = 65}), "octaves is 65, expected 1 to 64");
    EXPECT_EQ(check(PondSea{.height_m = 0}), "height_m 0 is out of range (0, 10]");
    EXPECT_EQ(check(PondSea{.drag = std::nan("")}), "drag nan is out of range [0, 1]");
    EXPECT_EQ(check(PondSea{.octaves = 64}).substr(0, 34), "the last octave's wavelength_m is ");
    EXPECT_THROW(PondWaves(PondSea{.decay = 2}), std::invalid_argument);
}

}  // namespace
}  // namespace pelagic
