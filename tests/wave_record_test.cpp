// Records of the height at fixed places, as a wave staff measures it: the mean level, and the
// distributions of heights and crests.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "pelagic/sim/buffers/shore_at.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/oracle/sea_oracle.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

/// Wave staffs at 8 x 8 places, read by cubic queries.
class Staffs {
   public:
    static constexpr std::size_t count = 64;

    explicit Staffs(const SeaState& sea, double apart_m = 97, double first_x_m = 0, double first_z_m = 0,
                    const std::optional<ShoreOptions>& shore = {})
        : ocean_(sea, {.executor = make_serial_executor(), .queries = true, .shore = shore}) {
        for (std::size_t i = 0; i < count; ++i) {
            x_.push_back(first_x_m + apart_m * static_cast<double>(i % 8));
            z_.push_back(first_z_m + apart_m * static_cast<double>(i / 8));
        }
    }

    /// Returns the frame that heights_at() read last.
    const Frame& frame() { return ocean_.complete(); }

    const std::vector<float>& heights_at(double time_s) {
        SurfaceQuery(ocean_.frame_at(time_s), {.interpolation = Interpolation::cubic})
            .sample({x_, z_}, {.height_m = heights_});
        return heights_;
    }

    /// Returns the mean height over all places and a whole loop.
    double mean_m(double step_s) {
        double sum = 0;
        const auto times = static_cast<int>(std::floor(ocean_.sea().loop_period_s / step_s + 0.5));
        for (int i = 0; i < times; ++i)
            for (const float height : heights_at(i * step_s)) sum += static_cast<double>(height);
        return sum / (static_cast<double>(times) * count);
    }

   private:
    Ocean ocean_;
    std::vector<double> x_, z_;
    std::vector<float> heights_ = std::vector<float>(count);
};

double level_of(const Frame& frame) {
    double level_m = 0;
    for (const Cascade& cascade : frame.cascades) level_m += static_cast<double>(cascade.level_m);
    return level_m;
}

// Without the cascades' levels the mean is lower by 4 and by 16 cm.
TEST(MeanLevel, AtFixedPlacesIsZeroOverALoop) {
    EXPECT_NEAR(Staffs(sea_preset_named("moderate")->sea).mean_m(4), 0, 0.003);
    EXPECT_NEAR(Staffs(sea_preset_named("storm")->sea).mean_m(4), 0, 0.015);
}

TEST(MeanLevel, OfACascadeIsTheSumOverItsWaves) {
    for (const double depth_m : {4000., 3.}) {
        const SeaState sea{.resolution = 64, .patch_size_m = 300, .depth_m = depth_m, .choppiness = 0.7};
        Ocean ocean(sea, {.executor = make_serial_executor()});
        const Frame& frame = ocean.frame_at(5.5);
        const double expected = oracle::mean_level(sea);
        EXPECT_NEAR(level_of(frame) / expected, 1, 1e-6) << depth_m;
        EXPECT_NEAR(report_on(sea).realised_level_m / expected, 1, 1e-9) << depth_m;
        double sum = 0;
        for (int j = 0; j < 64; ++j)
            for (int i = 0; i < 64; ++i) sum += static_cast<double>(frame.cascades[0].height.at(i, j));
        EXPECT_NEAR(sum / (64 * 64), expected, 1e-6) << depth_m;
    }
}

// Energies and choppiness are linear in the weight.
TEST(MeanLevel, OfATransitionBlendsEnergyAndChoppiness) {
    SeaState before{.resolution = 32, .wind_speed_mps = 8, .choppiness = 0.5};
    SeaState after = before;
    after.wind_speed_mps = 16;
    after.choppiness = 1;
    Ocean ocean(Forecast{.first = before, .changes = {{.sea = after, .from_s = 100, .over_s = 60}}},
                {.executor = make_serial_executor()});
    const double of_before = level_of(ocean.frame_at(0)) / 0.5, of_after = level_of(ocean.frame_at(300));
    ASSERT_GT(of_after, 2 * of_before);
    EXPECT_NEAR(level_of(ocean.frame_at(130)), 0.75 * (0.5 * of_before + 0.5 * of_after), 1e-6);
}

TEST(MeanLevel, IsZeroWithoutChoppiness) {
    Ocean ocean({.resolution = 32, .choppiness = 0}, {.executor = make_serial_executor()});
    EXPECT_EQ(level_of(ocean.frame_at(0)), 0);
}

// A weight w scales waves and level alike, but only w^2 of the level is needed.
TEST(MeanLevel, IsZeroOverAShoreToo) {
    const SeaState sea{.wind_speed_mps = 15, .choppiness = 1, .loop_period_s = 1200};
    const ShoreOptions shelf = shore_of(81, 81, 10, [](double, double) { return -4.0; });
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .shore = shelf});
    const Frame& frame = ocean.frame_at(0);
    double too_high_m = 0;
    for (std::size_t cascade = 0; cascade < frame.cascades.size(); ++cascade) {
        const double weight = ShoreAt(frame.shore, 400, 400).weight(cascade);
        too_high_m += (weight - weight * weight) * static_cast<double>(frame.cascades[cascade].level_m);
    }
    EXPECT_GT(too_high_m, 0.005);
    EXPECT_NEAR(Staffs(sea, 41, 250, 250, shelf).mean_m(1.5), 0, 0.002);
}

/// Heights at one place, and the waves between upward crossings of the mean.
struct Distribution {
    double count = 0, square = 0, cube = 0, fourth = 0;
    std::vector<double> waves, crests;  ///< heights from trough to crest, and of crests, m

    void add(const std::vector<double>& heights) {
        double low = 0, high = 0;
        bool has_begun = false;
        for (std::size_t i = 0; i < heights.size(); ++i) {
            const double h = heights[i];
            ++count, square += h * h, cube += h * h * h, fourth += h * h * h * h;
            if (i > 0 && heights[i - 1] < 0 && h >= 0) {
                if (has_begun) waves.push_back(high - low), crests.push_back(high);
                has_begun = true;
                low = high = 0;
            }
            low = std::min(low, h), high = std::max(high, h);
        }
    }
    double significant_m() const { return 4 * std::sqrt(square / count); }
    double skewness() const { return cube / count / std::pow(square / count, 1.5); }
    double kurtosis() const { return fourth / count / std::pow(square / count, 2); }
    /// Returns the fraction above a multiple of the significant height.
    double exceedance(const std::vector<double>& heights, double over_significant) const {
        const double level = over_significant * significant_m();
        return static_cast<double>(std::count_if(heights.begin(), heights.end(), [&](double h) { return h > level; })) /
               static_cast<double>(heights.size());
    }
};

constexpr double record_step_s = 1;
constexpr int record_samples = 1800;

/// Records of a linear sea: sums of cosines of the spectrum with random phases and amplitudes.
Distribution linear_records(const SeaState& sea, int records) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    Distribution found;
    constexpr double first_hz = 1.0 / 1800;
    for (int record = 0; record < records; ++record) {
        std::vector<std::complex<double>> waves, steps;
        for (int q = 50; q < 3600; ++q) {  // 0.03 to 2 Hz
            const double omega = 2 * std::numbers::pi * q * first_hz;
            const double deviation = std::sqrt(oracle::frequency_density(sea, omega) * 2 * std::numbers::pi * first_hz);
            const double re = normal(random), im = normal(random);
            waves.emplace_back(deviation * re, deviation * im);
            steps.push_back(std::polar(1.0, omega * record_step_s));
        }
        std::vector<double> heights(record_samples);
        for (double& height : heights)
            for (std::size_t i = 0; i < waves.size(); ++i) height += waves[i].real(), waves[i] *= steps[i];
        found.add(heights);
    }
    return found;
}

// Displacement changes neither the height nor the distribution of waves. Each bound is three standard
// errors or more: of 66,000 waves 0.6 % exceed 1.5 Hm0, in groups.
TEST(WaveRecords, AreThoseOfALinearSea) {
    Distribution found;
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        SeaState sea = sea_preset_named("moderate")->sea;
        sea.seed = seed;
        sea.cascades = 2;
        sea.resolution = 256;  // cubic interpolation of fewer texels loses 1 % of the height
        Staffs staffs(sea);
        std::vector<std::vector<double>> records(Staffs::count);
        double square = 0;  // of the significant height of all texels
        for (int i = 0; i < record_samples; ++i) {
            const std::vector<float>& heights = staffs.heights_at(i * record_step_s);
            for (std::size_t place = 0; place < Staffs::count; ++place)
                records[place].push_back(static_cast<double>(heights[place]));
            square += std::pow(measured_significant_wave_height_m(staffs.frame()), 2) / record_samples;
        }
        Distribution of_seed;
        for (const auto& record : records) of_seed.add(record), found.add(record);
        EXPECT_NEAR(of_seed.significant_m() / std::sqrt(square), 1, 0.01) << seed;
    }
    const Distribution linear = linear_records(sea_preset_named("moderate")->sea, 3 * Staffs::count);
    EXPECT_NEAR(found.kurtosis(), 3, 0.1);
    EXPECT_NEAR(found.skewness(), 0, 0.02);
    for (const auto& [over, bound] : {std::pair(0.5, 0.02), {0.75, 0.03}, {1.0, 0.06}, {1.25, 0.12}, {1.5, 0.25}}) {
        EXPECT_NEAR(found.exceedance(found.waves, over) / linear.exceedance(linear.waves, over), 1, bound) << over;
    }
}

}  // namespace
}  // namespace pelagic
