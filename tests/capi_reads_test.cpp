// What the C interface reads of a frame by its number, of a sea, and of options.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>

#include "pelagic/tests/capi_sea.hpp"

namespace pelagic {
namespace {

struct HeightsAtPoints {
    std::vector<double> x, z;
    std::vector<float> height;

    explicit HeightsAtPoints(std::size_t count) : height(count) {
        for (std::size_t i = 0; i < count; ++i) {
            x.push_back(std::fmod(7.3 * static_cast<double>(i), 240));
            z.push_back(std::fmod(-3.1 * static_cast<double>(i), 240));
        }
    }
    pelagic_points points(std::uint64_t frame = 0) const {
        auto points = pelagic_points_make();
        points.count = x.size();
        points.x = x.data();
        points.z = z.data();
        points.frame = frame;
        return points;
    }
    pelagic_status query(const COcean& ocean, const pelagic_points& points) {
        auto samples = pelagic_samples_make();
        samples.height_m = height.data();
        return pelagic_ocean_query(ocean.get(), &points, &samples);
    }
};

class CInterfaceReads : public testing::Test {
   protected:
    COceanExecutor pool = executor_of(PELAGIC_EXECUTOR_THREADS, 3);
    COcean ocean = ocean_of(small_sea(), pool.get());
};

TEST_F(CInterfaceReads, FrameIsReadByItsNumberUntilTheSecondScheduleAfterIt) {
    HeightsAtPoints now(20), later(20);
    const pelagic_frame first = complete(ocean, 1);
    const std::uint64_t hash = hash_of(ocean.get());
    ASSERT_EQ(now.query(ocean, now.points()), PELAGIC_OK);
    const pelagic_frame second = complete(ocean, 2);
    EXPECT_EQ(second.number, first.number + 1);
    ASSERT_EQ(later.query(ocean, later.points(first.number)), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(later.height, now.height);
    ASSERT_EQ(later.query(ocean, later.points(second.number)), PELAGIC_OK);
    EXPECT_NE(later.height, now.height);
    std::uint64_t found = 0;
    ASSERT_EQ(pelagic_ocean_frame_hash(ocean.get(), first.number, PELAGIC_HASH_FRAME, &found), PELAGIC_OK);
    EXPECT_EQ(found, hash);

    ASSERT_EQ(pelagic_ocean_schedule(ocean.get(), 3), PELAGIC_OK);
    expect_rejected(later.query(ocean, later.points(first.number)), PELAGIC_WRONG_ORDER,
                    "frame 1 is not in memory, expected one of the last two");
    EXPECT_EQ(pelagic_ocean_frame_hash(ocean.get(), first.number, PELAGIC_HASH_FRAME, &found), PELAGIC_WRONG_ORDER);
    EXPECT_EQ(later.query(ocean, later.points(second.number)), PELAGIC_OK);
    auto ray = pelagic_ray_make();
    pelagic_hit hit{};
    ray.origin_m[1] = 20;
    ray.direction[1] = -1;
    ray.reach_m = 40;
    ray.frame = first.number;
    EXPECT_EQ(pelagic_ocean_first_hit(ocean.get(), &ray, &hit), PELAGIC_WRONG_ORDER);
    ray.frame = second.number;
    ASSERT_EQ(pelagic_ocean_first_hit(ocean.get(), &ray, &hit), PELAGIC_OK);
    EXPECT_EQ(hit.is_hit, 1);
}

TEST_F(CInterfaceReads, HashesOfWhatAnOceanDoesNotHaveAreRejected) {
    complete(ocean, 3);
    std::uint64_t found = 0;
    expect_rejected(pelagic_ocean_frame_hash(ocean.get(), 0, PELAGIC_HASH_SHORE, &found),
                    "the ocean has no shore: it was created without pelagic_ocean_options.shore");
    expect_rejected(pelagic_ocean_frame_hash(ocean.get(), 0, PELAGIC_HASH_SPRAY, &found),
                    "the ocean has no spray: it was created without pelagic_ocean_options.spray");
    expect_rejected(pelagic_ocean_frame_hash(ocean.get(), 0, 9, &found),
                    "kind is 9, expected one of PELAGIC_HASH_...");
}

TEST_F(CInterfaceReads, ParallelQueriesAreBitIdentical) {
    complete(ocean, 1);
    HeightsAtPoints alone(5000), together(5000);
    ASSERT_EQ(alone.query(ocean, alone.points()), PELAGIC_OK);
    pelagic_points points = together.points();
    points.parallel = 1;
    ASSERT_EQ(together.query(ocean, points), PELAGIC_OK) << pelagic_last_error();
    EXPECT_EQ(together.height, alone.height);
}

TEST_F(CInterfaceReads, ToleranceOfACallReplacesThatOfTheOcean) {
    auto options = pelagic_ocean_options_make();
    options.queries = 1;
    options.query_tolerance_m = 0.5;
    const COcean coarse = ocean_of(small_sea(), options);
    complete(ocean, 1);
    complete(coarse, 1);
    HeightsAtPoints fine(50), rough(50);
    ASSERT_EQ(fine.query(ocean, fine.points()), PELAGIC_OK);
    ASSERT_EQ(rough.query(coarse, rough.points()), PELAGIC_OK);
    EXPECT_NE(rough.height, fine.height);
    pelagic_points points = rough.points();
    points.tolerance_m = 0.001;
    ASSERT_EQ(rough.query(coarse, points), PELAGIC_OK);
    EXPECT_EQ(rough.height, fine.height);
    points.tolerance_m = 2000;
    expect_rejected(rough.query(coarse, points), "tolerance_m is 2000, expected 0 or [1e-6, 1000]");
}

TEST_F(CInterfaceReads, UndisplacedWaterIsWhatAQueryFindsAtItsDrawnPosition) {
    complete(ocean, 1);
    const HeightsAtPoints rest(30);
    std::vector<double> displacement(90);
    std::vector<float> velocity(90);
    const pelagic_points points = rest.points();
    ASSERT_EQ(pelagic_ocean_sample_undisplaced(ocean.get(), &points, displacement.data(), velocity.data(), nullptr),
              PELAGIC_OK)
        << pelagic_last_error();
    HeightsAtPoints drawn = rest;
    for (std::size_t i = 0; i < 30; ++i) drawn.x[i] += displacement[3 * i], drawn.z[i] += displacement[3 * i + 2];
    std::vector<float> velocity_y(30);
    auto samples = pelagic_samples_make();
    samples.height_m = drawn.height.data();
    samples.velocity_y_mps = velocity_y.data();
    const pelagic_points there = drawn.points();
    ASSERT_EQ(pelagic_ocean_query(ocean.get(), &there, &samples), PELAGIC_OK);
    for (std::size_t i = 0; i < 30; ++i) {
        // The surface rises at most a few millimetres within the tolerance of a millimetre.
        EXPECT_NEAR(drawn.height[i], displacement[3 * i + 1], 1e-3) << i;
        EXPECT_NEAR(velocity_y[i], velocity[3 * i + 1], 5e-3) << i;
    }
    std::vector<float> foam(30);
    expect_rejected(
        pelagic_ocean_sample_undisplaced(ocean.get(), &points, nullptr, nullptr, foam.data()),
        "the frame has no foam: the ocean was created without pelagic_ocean_options.foam");
    drawn.z[2] = 2e9;
    const pelagic_points far = drawn.points();
    expect_rejected(pelagic_ocean_sample_undisplaced(ocean.get(), &far, displacement.data(), nullptr, nullptr),
                    "points.z[2] 2000000000 is out of range [-1e9, 1e9]");
}

/// A series of heights at points.
struct Series {
    std::vector<double> times;
    pelagic_points points;
    std::vector<float> height = std::vector<float>(times.size() * points.count);
    pelagic_frame last = {};

    /// Samples some times, and leaves the frame of the next in flight, if there is one.
    pelagic_status sample(const COcean& ocean, std::size_t begin, std::size_t count) {
        const std::size_t end = begin + count;
        auto samples = pelagic_samples_make();
        samples.height_m = height.data() + begin * points.count;
        return pelagic_ocean_query_series(ocean.get(), times.data() + begin, count,
                                          end < times.size() ? &times[end] : nullptr, &points, &samples, &last);
    }
};

TEST_F(CInterfaceReads, SeriesIsBitIdenticalToALoop) {
    const std::vector<double> times = {3.5, 0, 7.25, 7.25, -2};
    for (const std::int32_t interpolation : {PELAGIC_INTERPOLATION_LINEAR, PELAGIC_INTERPOLATION_CUBIC})
        for (const std::size_t count : {0u, 7u, 600u}) {
            HeightsAtPoints at(count);
            pelagic_points points = at.points();
            points.interpolation = interpolation;
            points.parallel = 1;
            std::vector<float> expected;
            for (const double time_s : times) {
                complete(ocean, time_s);
                ASSERT_EQ(at.query(ocean, points), PELAGIC_OK) << pelagic_last_error();
                expected.insert(expected.end(), at.height.begin(), at.height.end());
            }
            for (const std::vector<std::size_t>& pieces : {std::vector<std::size_t>{5}, {2, 3}, {0, 4, 1}}) {
                Series series{.times = times, .points = points};
                std::size_t begin = 0;
                for (const std::size_t piece : pieces) {
                    ASSERT_EQ(series.sample(ocean, begin, piece), PELAGIC_OK) << pelagic_last_error();
                    begin += piece;
                }
                EXPECT_EQ(series.height, expected) << pieces.size();
                EXPECT_EQ(series.last.time_s, times.back());
                EXPECT_EQ(complete(ocean, 1).number, series.last.number + 1);
            }
        }
}

TEST_F(CInterfaceReads, SeriesThatFailsLeavesAnUsableOcean) {
    const HeightsAtPoints at(3);
    Series series{.times = {1, 2}, .points = at.points()};
    ASSERT_EQ(pelagic_ocean_schedule(ocean.get(), 2), PELAGIC_OK);
    expect_rejected(series.sample(ocean, 0, 2), PELAGIC_WRONG_ORDER,
                    "the frame of 2 s is in flight; call pelagic_ocean_complete first");
    ASSERT_EQ(series.sample(ocean, 1, 1), PELAGIC_OK) << "the frame in flight is the first of the series";

    series.points.frame = series.last.number;
    expect_rejected(series.sample(ocean, 0, 2), "points.frame is 1, expected 0");
    series.points.frame = 0;
    series.times[1] = std::nan("");
    expect_rejected(series.sample(ocean, 0, 2), "times_s[1] is nan, expected a finite number");
    expect_rejected(series.sample(ocean, 0, 1), "next_s is nan, expected a finite number");

    auto samples = pelagic_samples_make();
    samples.foam = series.height.data();
    const double times_s[] = {1, 2};
    expect_rejected(pelagic_ocean_query_series(ocean.get(), times_s, 1, times_s + 1, &series.points, &samples, nullptr),
                    "the frame has no foam: the ocean was created without pelagic_ocean_options.foam");
    complete(ocean, 1);  // no frame is in flight
    EXPECT_EQ(pelagic_ocean_query_series(ocean.get(), nullptr, 0, nullptr, &series.points, &samples, nullptr),
              PELAGIC_OK);
}

TEST_F(CInterfaceReads, FrameHasItsWaveHeightSeaAndDroplets) {
    auto options = pelagic_ocean_options_make();
    auto spray = pelagic_spray_options_make();
    options.spray = &spray;
    pelagic_sea sea = stack_sea(3);
    sea.wind_speed_mps = 18;
    const COcean stormy = ocean_of(sea, options);
    auto shown = pelagic_sea_make();
    EXPECT_EQ(pelagic_ocean_sea(stormy.get(), &shown), PELAGIC_WRONG_ORDER);
    const pelagic_frame frame = complete(stormy, 7.25);
    pelagic_statistics statistics{};
    ASSERT_EQ(pelagic_sea_statistics(&sea, &statistics), PELAGIC_OK);
    EXPECT_NEAR(frame.wave_height_m, statistics.expected_wave_height_m, 1e-9);
    ASSERT_EQ(pelagic_ocean_sea(stormy.get(), &shown), PELAGIC_OK);
    EXPECT_EQ(shown.wind_speed_mps, 18);

    ASSERT_GT(frame.droplet_count, 10u);
}

TEST(CInterfaceSeas, PresetsHaveNamesAndSummaries) {
    std::vector<std::string> names;
    const char *name = nullptr, *summary = nullptr;
    auto sea = pelagic_sea_make();
    for (std::int32_t i = 0; pelagic_preset_at(i, &name, &summary) == PELAGIC_OK; ++i) {
        EXPECT_EQ(pelagic_sea_preset(name, &sea), PELAGIC_OK) << name;
        EXPECT_GT(std::strlen(summary), 5u) << name;
        names.emplace_back(name);
    }
    EXPECT_EQ(names.front(), "pond");
    EXPECT_EQ(names.back(), "beaufort-12");
    EXPECT_EQ(names.size(), 23u);
    EXPECT_EQ(pelagic_preset_at(-1, &name, &summary), PELAGIC_INVALID_ARGUMENT);
}

TEST(CInterfaceSeas, SpectraIntegrateToTheVarianceOfTheModel) {
    const pelagic_sea sea = small_sea();
    pelagic_statistics statistics{};
    ASSERT_EQ(pelagic_sea_statistics(&sea, &statistics), PELAGIC_OK);
    const double variance = statistics.model_wave_height_m * statistics.model_wave_height_m / 16;
    // From 1/8 to 32 of the peak, in steps so fine that the trapezoid rule errs by less than 1 %.
    const double peak_hz = 1 / statistics.expected_peak_period_s;
    const double peak_radpm = 2 * std::numbers::pi / statistics.peak_wavelength_m;
    for (const int is_by_wave_number : {0, 1}) {
        std::vector<double> at, energy(2000);
        const double first = (is_by_wave_number != 0 ? peak_radpm : peak_hz) / 8;
        for (std::size_t i = 0; i < energy.size(); ++i)
            at.push_back(first * std::exp2(8 * static_cast<double>(i) / 2000 * (is_by_wave_number != 0 ? 1.5 : 1)));
        ASSERT_EQ(pelagic_sea_spectrum(&sea, is_by_wave_number, at.data(), at.size(), energy.data()), PELAGIC_OK);
        double sum = 0;
        for (std::size_t i = 1; i < at.size(); ++i) sum += (at[i] - at[i - 1]) * (energy[i] + energy[i - 1]) / 2;
        EXPECT_NEAR(sum, variance, 0.01 * variance) << is_by_wave_number;
    }
    const double zero = 0;
    double energy = 0;
    expect_rejected(pelagic_sea_spectrum(&sea, 0, &zero, 1, &energy), "at 0 is out of range (0, 1e9)");
}

std::string warnings_of(const pelagic_sea& sea, double largest_peak_m) {
    auto forecast = pelagic_forecast_make();
    forecast.first = &sea;
    forecast.largest_peak_m = largest_peak_m;
    std::size_t count = 0;
    EXPECT_EQ(pelagic_forecast_warnings(&forecast, nullptr, 0, &count), PELAGIC_OK) << pelagic_last_error();
    std::string text(count, '?');
    EXPECT_EQ(pelagic_forecast_warnings(&forecast, text.data(), count, &count), PELAGIC_OK);
    EXPECT_EQ(text.back(), '\0');
    text.pop_back();
    return text;
}

TEST(CInterfaceSeas, WarningsNameLimitsOfASeaAndOfItsForecast) {
    EXPECT_EQ(warnings_of(stack_sea(4, 128), 0), "");
    EXPECT_NE(warnings_of(stack_sea(4, 64), 2000).find("hold no waves shorter than"), std::string::npos);
    pelagic_sea small = small_sea();
    small.patch_size_m = 20;
    EXPECT_NE(warnings_of(small, 0), "");
}

TEST(CInterfaceSeas, InstructionSetsAreThoseThatAnOceanAccepts) {
    std::int32_t count = 0;
    for (; const char* isa = pelagic_isa_at(count); ++count) {
        auto options = pelagic_ocean_options_make();
        options.isa = isa;
        pelagic_ocean_info info{};
        ASSERT_EQ(pelagic_ocean_describe(ocean_of(small_sea(), options).get(), &info), PELAGIC_OK);
        EXPECT_STREQ(info.isa, isa);
    }
    EXPECT_GT(count, 0);
    EXPECT_EQ(pelagic_isa_at(-1), nullptr);
}

TEST(CInterfaceOptions, AreCheckedByTheNameOfTheirStruct) {
    auto waves = pelagic_dynamic_waves_options_make();
    EXPECT_EQ(pelagic_options_check("pelagic_dynamic_waves_options", &waves), PELAGIC_OK) << pelagic_last_error();
    waves.side_m = 0;
    expect_rejected(pelagic_options_check("pelagic_dynamic_waves_options", &waves),
                    "dynamic_waves.side_m 0 is out of range [1, 10000]");
    auto disturbance = pelagic_disturbance_make();
    disturbance.radius_m = 0;
    expect_rejected(pelagic_options_check("pelagic_disturbance", &disturbance),
                    "radius_m 0 is out of range [0.001, 1000]");
    auto rain = pelagic_rain_make();
    rain.radius_m = 1;
    EXPECT_EQ(pelagic_options_check("pelagic_rain", &rain), PELAGIC_OK) << pelagic_last_error();
    rain.height_m = NAN;
    expect_rejected(pelagic_options_check("pelagic_rain", &rain), "height_m is nan, expected a finite number");
    auto ripple = pelagic_ripple_make();
    ripple.wavelength_m = 0;
    expect_rejected(pelagic_options_check("pelagic_ripple", &ripple),
                    "wavelength_m 0 is out of range [0.01, 1000]");
    auto spray = pelagic_spray_options_make();
    spray.reach_m = 0;
    expect_rejected(pelagic_options_check("pelagic_spray_options", &spray),
                    "spray.reach_m 0 is out of range [10, 200]");
    auto emitter = pelagic_spray_emitter_make();
    emitter.count = 9000;
    EXPECT_EQ(pelagic_options_check("pelagic_spray_emitter", &emitter), PELAGIC_INVALID_ARGUMENT);
    auto shore = pelagic_shore_options_make();
    EXPECT_EQ(pelagic_options_check("pelagic_shore_options", &shore), PELAGIC_INVALID_ARGUMENT);
    // Each wave alone: together these would be too steep.
    const double amplitudes[] = {0.3, 0.3}, lengths[] = {8, 8}, directions[] = {0, 1};
    auto gerstner = pelagic_waves_make();
    gerstner.count = 2;
    gerstner.amplitude_m = amplitudes;
    gerstner.wavelength_m = lengths;
    gerstner.direction_rad = directions;
    EXPECT_EQ(pelagic_options_check("pelagic_waves", &gerstner), PELAGIC_OK) << pelagic_last_error();
    pelagic_input* input = nullptr;
    EXPECT_EQ(pelagic_input_create_waves(&gerstner, &input), PELAGIC_INVALID_ARGUMENT);
    expect_rejected(pelagic_options_check("pelagic_ocean", &gerstner),
                    "type is pelagic_ocean, expected the name of a struct of options");
    expect_rejected(pelagic_options_check("pelagic_rain", nullptr), "rain is NULL, expected a pointer");
}

}  // namespace
}  // namespace pelagic
