// Statistics of a buoy's record, of waves whose statistics are known.
#include "pelagic/tools/measure/buoy_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

namespace pelagic {
namespace {

using std::numbers::pi;
using tools::BuoyRecord, tools::RecordStatistics;

struct ListedWave {
    double amplitude_m, period_s, direction_rad, phase_rad;
};

/// Returns k of omega^2 = g k tanh(k d), by bisection.
double wave_number_of(double omega, double depth_m) {
    double low = 0, high = 1e3;
    for (int i = 0; i < 200; ++i) {
        const double k = 0.5 * (low + high);
        (9.80665 * k * std::tanh(k * depth_m) < omega * omega ? low : high) = k;
    }
    return low;
}

BuoyRecord record_of(const std::vector<ListedWave>& waves, std::size_t samples, double rate_hz, double depth_m,
                     double level_m = 0) {
    BuoyRecord record{.rate_hz = rate_hz, .depth_m = depth_m};
    for (std::size_t i = 0; i < samples; ++i) {
        double h = level_m, x = 0, z = 0;
        for (const ListedWave& wave : waves) {
            const double omega = 2 * pi / wave.period_s, k = wave_number_of(omega, depth_m);
            const double phase = wave.phase_rad - omega * static_cast<double>(i) / rate_hz;
            h += wave.amplitude_m * std::cos(phase);
            x -= wave.amplitude_m * k * std::cos(wave.direction_rad) * std::sin(phase);
            z -= wave.amplitude_m * k * std::sin(wave.direction_rad) * std::sin(phase);
        }
        record.height_m.push_back(h);
        record.slope_x.push_back(x);
        record.slope_z.push_back(z);
    }
    return record;
}

TEST(BuoyRecords, OfOneWaveAreItsOwn) {
    for (const double depth_m : {4000.0, 8.0}) {
        const RecordStatistics found = statistics_of(record_of({{1.5, 9, -2.2, 0.4}}, 4800, 4, depth_m, 0.3));
        EXPECT_NEAR(found.significant_wave_height_m, 4 * 1.5 / std::sqrt(2), 0.01);
        EXPECT_NEAR(*found.peak_period_s, 9, 0.05);
        EXPECT_NEAR(*found.zero_crossing_period_s, 9, 0.001);
        EXPECT_NEAR(found.directions->mean_rad, -2.2, 0.005) << depth_m;
        EXPECT_NEAR(found.directions->spread_rad, 0, 0.05) << depth_m;
        EXPECT_NEAR(found.skewness, 0, 0.01);
        EXPECT_NEAR(found.highest_wave_m, 3, 0.01);
    }
}

// Two waves of equal energy, 60 degrees apart: the spread is sqrt(2 (1 - cos 30)).
TEST(BuoyRecords, OfTwoWavesHaveTheirMeanDirectionAndSpread) {
    const double apart_rad = pi / 3;
    const RecordStatistics found =
        statistics_of(record_of({{1, 10, 0.5, 1}, {1, 8, 0.5 + apart_rad, 2}}, 9600, 4, 4000));
    EXPECT_NEAR(found.directions->mean_rad, 0.5 + apart_rad / 2, 0.02);
    EXPECT_NEAR(found.directions->spread_rad, std::sqrt(2 * (1 - std::cos(apart_rad / 2))), 0.02);
    // Crest and trough are 4.5 s apart, in which the envelope of 40 s falls.
    EXPECT_NEAR(found.highest_wave_m, 3.9, 0.06);
}

// A wave with a bound harmonic in phase, a cos + b cos 2: the third moment is 3/4 a^2 b.
TEST(BuoyRecords, OfSharpCrestsHaveTheirSkewness) {
    BuoyRecord record = record_of({{1, 8, 0, 0}, {0.1, 4, 0, 0}}, 4800, 4, 4000);
    EXPECT_NEAR(statistics_of(record).skewness, 0.75 * 0.1 / std::pow(0.5 * 1.01, 1.5), 1e-3);
}

TEST(BuoyRecords, OfStillWaterHaveNoPeriods) {
    const RecordStatistics found = statistics_of(record_of({}, 64, 4, 10, 0.2));
    EXPECT_EQ(found.significant_wave_height_m, 0);
    EXPECT_EQ(found.highest_wave_m, 0);
    EXPECT_EQ(found.skewness, 0);
    EXPECT_FALSE(found.peak_period_s);
    EXPECT_FALSE(found.zero_crossing_period_s);
    EXPECT_FALSE(found.directions);
}

}  // namespace
}  // namespace pelagic
