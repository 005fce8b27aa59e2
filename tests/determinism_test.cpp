// Frames and queries are bit-identical for every instruction set, executor, number of threads,
// order of times, and age of the ocean.
#include <algorithm>
#include <array>
#include <bit>
#include <cfenv>
#include <fstream>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "pelagic/sim/foam_report.hpp"
#include "pelagic/sim/forecast.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/slope_variance.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"
#include "pelagic/sim/surface_ray.hpp"
#include "pelagic/tests/application_jobs.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/emulated.hpp"
#include "pelagic/tests/golden.hpp"
#include "pelagic/tests/quadtree_scene.hpp"
#include "pelagic/tests/sanitized.hpp"
#include "pelagic/tests/test_paths.hpp"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace pelagic {
namespace {

std::uint64_t hash_at(const SeaState& sea, double time_s, Isa isa = choose_isa(),
                      std::shared_ptr<Executor> executor = make_serial_executor()) {
    Ocean ocean(sea, {.executor = std::move(executor), .isa = isa});
    return hash_of(ocean.frame_at(time_s));
}

/// All values that a query returns per point, as bits.
struct PointSamples {
    explicit PointSamples(std::size_t count) : values(9, std::vector<float>(count)), converged(count) {}
    SurfaceSamples view() {
        return {values[0], values[1], values[2], values[3], values[4],
                values[5], values[6], values[7], values[8], converged};
    }
    std::array<std::uint32_t, 9> of(std::size_t point) const {
        std::array<std::uint32_t, 9> bits{};
        for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = std::bit_cast<std::uint32_t>(values[i][point]);
        return bits;
    }
    /// FNV-1a hash of the bits, point by point.
    std::uint64_t hash() const {
        std::uint64_t hash = 0xcbf29ce484222325u;
        for (std::size_t point = 0; point < converged.size(); ++point)
            for (const std::uint32_t bits : of(point)) hash = (hash ^ bits) * 0x100000001b3u;
        return hash;
    }
    std::vector<std::vector<float>> values;
    std::vector<std::uint8_t> converged;
};

/// Random points without a standard library's distribution, whose results differ.
struct QueryPoints {
    explicit QueryPoints(std::size_t count) {
        std::mt19937 random(5);
        for (std::size_t i = 0; i < count; ++i) {
            x.push_back(static_cast<double>(random()) / 0x1p20 - 2000);
            z.push_back(static_cast<double>(random()) / 0x1p20 - 2000);
        }
    }
    SurfacePoints view() const { return {x, z}; }
    std::vector<double> x, z;
};

/// A sea that folds, and one that does not.
const SeaState overturning_sea{.spectrum = SpectrumModel::phillips_paper,
                               .resolution = 64,
                               .patch_size_m = 250,
                               .wind_speed_mps = 20,
                               .choppiness = 1};
const SeaState smooth_sea{.resolution = 256, .patch_size_m = 250, .choppiness = 1};
const SeaState sea_of_cascades{.cascades = 4, .resolution = 64, .choppiness = 1};
/// A sea of a few analytic waves.
const SeaState analytic_sea_state{.waves = WaveModel::analytic, .resolution = 64, .choppiness = 1};
const SeaState pond{.waves = WaveModel::pond, .resolution = 64};

std::unique_ptr<Ocean> queryable_ocean(const SeaState& sea, Isa isa = choose_isa(),
                                       std::shared_ptr<Executor> executor = make_serial_executor()) {
    return std::make_unique<Ocean>(
        sea, OceanOptions{.executor = std::move(executor), .isa = isa, .queries = true,
                          .velocities = Velocities::drawn});
}

PointSamples samples_at(const SeaState& sea, double time_s, Isa isa, const QueryPoints& points,
                        Interpolation interpolation = Interpolation::linear) {
    const auto ocean = queryable_ocean(sea, isa);
    PointSamples samples(points.x.size());
    SurfaceQuery(ocean->frame_at(time_s), {.interpolation = interpolation}).sample(points.view(), samples.view());
    return samples;
}

TEST(Determinism, FramesAreBitIdenticalOnEveryInstructionSetExecutorAndThreadCount) {
    std::vector<SeaState> seas;
    for (const int n : {16, 64, 128, 256})
        for (const double choppiness : {0.0, 1.0})
            seas.push_back(
                {.resolution = n, .patch_size_m = 250, .wind_direction_rad = 1, .choppiness = choppiness});
    for (SeaState sea : {analytic_sea_state, pond}) {
        sea.resolution = 128;
        seas.push_back(sea);
        sea.resolution = 16;
        sea.longest_wave_m = sea.shortest_wave_m = sea.patch_size_m = 8;
        seas.push_back(sea);
    }
    for (const SeaState& sea : seas) {
        ASSERT_EQ(check(sea), "");
        const std::uint64_t expected = hash_at(sea, 12.34, isas_here().front());
        for (const Isa isa : isas_here())
            for (const Application& application : applications())
                EXPECT_EQ(hash_at(sea, 12.34, isa, application.executor), expected)
                    << name_of(sea.waves) << " " << sea.resolution << " " << name_of(isa) << " " << application.name;
    }
}

TEST(Determinism, LargeFramesAreBitIdenticalEverywhere) {
    for (const int n : {512, 1024, 2048}) {
        if ((is_sanitized || is_emulated) && n > 512) break;  // larger sizes run no other jobs
        const SeaState sea{.resolution = n, .patch_size_m = 250};
        const std::uint64_t expected = hash_at(sea, 3.5, isas_here().front());
        for (const Isa isa : isas_here())
            EXPECT_EQ(hash_at(sea, 3.5, isa, make_thread_executor(3)), expected) << n << " " << name_of(isa);
    }
}

TEST(Determinism, WholeLoopPeriodsGiveTheFrameOfTimeZero) {
    for (const double period : {200.0, 8.0, 0.1, 7.3, 86400.0}) {
        Ocean ocean({.resolution = 32, .patch_size_m = 250, .loop_period_s = period},
                    {.executor = make_serial_executor()});
        const std::uint64_t start = hash_of(ocean.frame_at(0));
        for (const double periods : {1.0, 2.0, 1000.0, -1.0})
            EXPECT_EQ(hash_of(ocean.frame_at(periods * period)), start) << periods << " periods of " << period;
        EXPECT_NE(hash_of(ocean.frame_at(period * 0.37)), start) << "the sea does not move";
    }
}

TEST(Determinism, FrameZeroIsBitIdenticalAfterTenHours) {
    Ocean ocean({.resolution = 64, .patch_size_m = 250}, {.executor = make_serial_executor()});
    const std::uint64_t start = hash_of(ocean.frame_at(0)), later = hash_of(ocean.frame_at(1.25));
    // A sample of ten hours at 1 Hz; 36000 s is ten loops.
    for (int second = 0; second < 36000; second += 97) ocean.frame_at(second);
    EXPECT_EQ(hash_of(ocean.frame_at(36000)), start);
    EXPECT_EQ(hash_of(ocean.frame_at(36001.25)), later);
}

TEST(Determinism, FramesDoNotDependOnTheirOrder) {
    std::vector<double> times;
    for (int i = 0; i < 24; ++i) times.push_back(i * 8.3 - 40);
    // smaller frames are computed without jobs
    const SeaState sea{.resolution = 128, .patch_size_m = 250};
    std::map<double, std::uint64_t> expected;
    for (const double time : times) expected[time] = hash_at(sea, time);

    std::mt19937 random(9);
    Ocean ocean(sea, {.executor = make_default_executor(3)});
    for (int round = 0; round < 4; ++round) {
        std::shuffle(times.begin(), times.end(), random);
        for (const double time : times) EXPECT_EQ(hash_of(ocean.frame_at(time)), expected[time]) << time;
    }
}

TEST(Determinism, AFrameIsValidWhileTheNextOneIsComputed) {
    const SeaState sea{.resolution = 128, .patch_size_m = 250};
    Ocean ocean(sea, {.executor = make_thread_executor(2)});
    ocean.schedule(0);
    std::uint64_t expected = hash_at(sea, 0);
    for (int i = 1; i < 20; ++i) {
        const Frame& frame = ocean.complete();
        ocean.schedule(i * 0.4);
        EXPECT_EQ(hash_of(frame), expected);
        EXPECT_EQ(frame.time_s, (i - 1) * 0.4);
        expected = hash_at(sea, i * 0.4);
    }
    ocean.complete();
}

TEST(Determinism, ANewSeaAppliesCompletelyAfterCompleteSea) {
    const SeaState before{.resolution = 128, .patch_size_m = 250},
        after{.resolution = 128, .patch_size_m = 250, .wind_speed_mps = 20, .choppiness = 0.3, .seed = 4};
    for (const Application& application : applications()) {
        Ocean ocean(before, {.executor = application.executor});
        ocean.schedule_sea(after);
        EXPECT_EQ(hash_of(ocean.frame_at(2)), hash_at(before, 2)) << application.name;
        ocean.complete_sea();
        EXPECT_TRUE(ocean.sea_is_ready());
        EXPECT_EQ(hash_of(ocean.frame_at(2)), hash_at(after, 2)) << application.name;
    }
}

TEST(Determinism, OceansCanBeDestroyedWhileFramesAreInFlight) {
    for (const Application& application : applications()) {
        for (int i = 0; i < 10; ++i) {
            Ocean ocean({.resolution = 128, .patch_size_m = 250}, {.executor = application.executor});
            ocean.schedule_sea({.resolution = 128, .patch_size_m = 250, .seed = 2});
            ocean.schedule(1);
        }
    }
}

TEST(Determinism, QueryDataDoesNotChangeTheFrame) {
    for (const SeaState& sea : {overturning_sea, smooth_sea, sea_of_cascades, analytic_sea_state, pond})
        for (const Application& application : applications())
            EXPECT_EQ(hash_of(queryable_ocean(sea, choose_isa(), application.executor)->frame_at(7)), hash_at(sea, 7))
                << application.name;
}

// Three frames: after a jump in time, with a tick, and between two ticks.
TEST(Determinism, FoamIsBitIdenticalOnEveryInstructionSetExecutorAndThreadCount) {
    const SeaState sea{.cascades = 2, .resolution = 64, .wind_speed_mps = 18};
    const auto hashes = [&](Isa isa, std::shared_ptr<Executor> executor) {
        Ocean ocean(sea, {.executor = std::move(executor), .isa = isa, .foam = true});
        std::vector<std::uint64_t> all;
        for (const double time : {12.34, 12.44, 12.48}) {
            ocean.schedule(time);
            all.push_back(foam_hash_of(ocean.complete()));
        }
        return all;
    };
    const auto expected = hashes(isas_here().front(), make_serial_executor());
    EXPECT_NE(expected[0], expected[1]);
    for (const Isa isa : isas_here()) EXPECT_EQ(hashes(isa, make_thread_executor(3)), expected) << name_of(isa);
    for (const Application& application : applications())
        EXPECT_EQ(hashes(choose_isa(), application.executor), expected) << application.name;
}

TEST(Determinism, QueriesAreBitIdenticalOnEveryInstructionSet) {
    const QueryPoints points(20000);
    for (const SeaState& sea : {overturning_sea, smooth_sea, sea_of_cascades, analytic_sea_state, pond}) {
        for (const Interpolation interpolation : {Interpolation::linear, Interpolation::cubic}) {
            const std::uint64_t expected = samples_at(sea, 3, isas_here().front(), points, interpolation).hash();
            for (const Isa isa : isas_here())
                EXPECT_EQ(samples_at(sea, 3, isa, points, interpolation).hash(), expected) << name_of(isa);
        }
    }
}

TEST(Determinism, QueriesDoNotDependOnOtherPointsOfTheBatch) {
    const QueryPoints points(1000);
    for (const auto& [sea, interpolation] : {std::pair{overturning_sea, Interpolation::linear},
                                             {smooth_sea, Interpolation::linear},
                                             {sea_of_cascades, Interpolation::linear},
                                             {overturning_sea, Interpolation::cubic},
                                             {sea_of_cascades, Interpolation::cubic}}) {
        const auto ocean = queryable_ocean(sea);
        const SurfaceQuery query(ocean->frame_at(3), {.interpolation = interpolation});
        PointSamples expected(points.x.size());
        query.sample(points.view(), expected.view());

        std::mt19937 random(1);
        for (const std::size_t batch : {1, 2, 3, 7, 127, 128, 129, 1000}) {
            std::vector<std::size_t> order(points.x.size());
            for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
            std::shuffle(order.begin(), order.end(), random);
            for (std::size_t first = 0; first < order.size(); first += batch) {
                const std::size_t count = std::min(batch, order.size() - first);
                std::vector<double> x, z;
                for (std::size_t i = 0; i < count; ++i) {
                    x.push_back(points.x[order[first + i]]);
                    z.push_back(points.z[order[first + i]]);
                }
                PointSamples some(count);
                query.sample({x, z}, some.view());
                for (std::size_t i = 0; i < count; ++i)
                    ASSERT_EQ(some.of(i), expected.of(order[first + i])) << "batch of " << batch;
            }
        }
        // Nor does a value depend on the set of requested outputs.
        std::vector<float> height(points.x.size());
        query.sample(points.view(), {.height_m = height});
        EXPECT_EQ(height, expected.values[0]);
    }
}

TEST(Determinism, QueriesAreBitIdenticalOnEveryExecutorAndThreadCount) {
    const QueryPoints points(30001);
    const auto ocean = queryable_ocean(overturning_sea);
    const SurfaceQuery query(ocean->frame_at(3));
    PointSamples expected(points.x.size());
    query.sample(points.view(), expected.view());
    for (const Application& application : applications()) {
        SurfaceQueryJobs jobs(application.executor);
        for (int again = 0; again < 3; ++again) {
            PointSamples samples(points.x.size());
            jobs.sample(query, points.view(), samples.view());
            EXPECT_EQ(samples.hash(), expected.hash()) << application.name;
        }
    }
}

// Threads query the completed frame without waiting while the next one is computed.
TEST(Determinism, EightThreadsQueryWhileFramesAreComputed) {
    const SeaState& sea = overturning_sea;
    const QueryPoints points(is_sanitized ? 200 : 2000);
    const auto executor = make_thread_executor(3);
    const auto ocean = queryable_ocean(sea, choose_isa(), executor);
    ocean->schedule(0);
    for (int i = 0; i < 6; ++i) {
        const Frame& frame = ocean->complete();
        ocean->schedule((i + 1) * 0.5);
        const std::uint64_t expected = samples_at(sea, i * 0.5, choose_isa(), points).hash();
        const SurfaceQuery query(frame);
        std::vector<std::uint64_t> hashes(8);
        std::vector<std::thread> threads;
        for (std::size_t t = 0; t < hashes.size(); ++t) {
            threads.emplace_back([&, t] {
                PointSamples samples(points.x.size());
                if (t % 2) {
                    query.sample(points.view(), samples.view());
                } else {
                    SurfaceQueryJobs jobs(executor);  // on the executor that computes the frame
                    jobs.sample(query, points.view(), samples.view());
                }
                hashes[t] = samples.hash();
                first_hit(query, {{points.x[t], 20, points.z[t]}, {1, -0.2, 0.5}, 200});
            });
        }
        for (std::thread& thread : threads) thread.join();
        for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, expected);
    }
    ocean->complete();
}

TEST(Determinism, RayHitsAreBitIdenticalOnEveryInstructionSet) {
    std::vector<double> expected;
    for (const Isa isa : isas_here()) {
        const auto ocean = queryable_ocean(overturning_sea, isa);
        const SurfaceQuery query(ocean->frame_at(3));
        std::vector<double> hits;
        for (int i = 0; i < 100; ++i) {
            const auto hit = first_hit(query, {{i * 3.0, 10, i * 0.5}, {1, -0.1 - i * 0.01, 0.3}, 500});
            hits.push_back(hit ? hit->distance_m : -1);
            hits.push_back(hit ? hit->normal[0] : 0);
        }
        if (expected.empty()) expected = hits;
        EXPECT_EQ(hits, expected) << name_of(isa);
    }
}

// Engines set flush-to-zero or another rounding mode per thread. Frames must not depend on it, and
// the library must restore it.
TEST(Determinism, FramesDoNotDependOnTheCallersFloatingPointEnvironment) {
    const SeaState sea{
        .spectrum = SpectrumModel::phillips, .resolution = 64, .patch_size_m = 250, .wind_speed_mps = 2};
    const std::uint64_t expected = hash_at(sea, 5);
    const QueryPoints points(2000);
    const std::uint64_t expected_samples = samples_at(overturning_sea, 5, choose_isa(), points).hash();
#if !defined(__wasm__)  // WebAssembly has one rounding mode
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        std::fesetround(mode);
        const std::uint64_t hash = hash_at(sea, 5);
        const std::uint64_t sampled = samples_at(overturning_sea, 5, choose_isa(), points).hash();
        EXPECT_EQ(std::fegetround(), mode);
        std::fesetround(FE_TONEAREST);
        EXPECT_EQ(hash, expected);
        EXPECT_EQ(sampled, expected_samples);
    }
    // What else computes: plans, statistics and samples. The arguments are exact in every mode.
    const auto answers = [] {
        const SeaState storm{.resolution = 64, .patch_size_m = 400, .wind_speed_mps = 19};
        std::vector<double> values;
        for (const CascadePlan& plan : plan_cascades(SeaState{.cascades = 3, .wind_speed_mps = 13.7}))
            values.insert(values.end(), {double{plan.grid.side_m}, plan.min_k, plan.foam_weight()});
        values.push_back(sea_between({.wind_speed_mps = 7}, {.wind_speed_mps = 17}, 1 / 3.0).wind_speed_mps);
        values.push_back(measured_slopes(11.3).upwind);
        Ocean ocean(storm, {.executor = make_serial_executor(),
                            .queries = true,
                            .foam = true,
                            .dynamic_waves = DynamicWavesOptions{.resolution = 64, .side_m = 64, .border_m = 8}});
        ocean.dynamic_waves().add_impulse({.x_m = 1.3, .z_m = 0.7, .radius_m = 2, .height_m = 0.3});
        const Frame* frame = nullptr;
        for (int i = 0; i < 4; ++i) frame = &ocean.frame_at(i * 0.125);
        values.push_back(report_on_foam(*frame).whitecap_cover);
        for (int i = 0; i < 20; ++i)
            values.push_back(sample(frame->dynamic_waves, 0.125 * i, 0.3125 * i).height_m);
        return values;
    };
    const std::vector<double> expected_answers = answers();
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
        std::fesetround(mode);
        const std::vector<double> found = answers();
        std::fesetround(FE_TONEAREST);
        ASSERT_EQ(found.size(), expected_answers.size());
        for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], expected_answers[i]) << mode << " " << i;
    }
#endif
#if defined(__x86_64__)
    const unsigned found = _mm_getcsr();
    _mm_setcsr(found | 0x8040);  // flush to zero, denormals are zero
    const std::uint64_t hash = hash_at(sea, 5);
    EXPECT_EQ(_mm_getcsr() & 0x8040, 0x8040u);
    _mm_setcsr(found);
    EXPECT_EQ(hash, expected);
#endif
}

#if !defined(__wasm__)  // WebAssembly has one rounding mode
TEST(Determinism, PatchesDoNotDependOnTheCallersRoundingMode) {
    // of each patch: its place, stitches and morph weights
    const auto draws = [](int mode) {
        std::vector<std::uint8_t> bytes;
        Random random(5);
        for (int i = 0; i < 60; ++i) {
            const SelectionInput input = random_viewer(random, 2048, i);  // in the default mode
            std::fesetround(mode);
            Selection selection({.size_m = 2048, .vertices = 4, .lod_scale = 1.7});
            const DrawList& list = selection.select(input);
            std::fesetround(FE_TONEAREST);
            const auto* first = reinterpret_cast<const std::uint8_t*>(list.instances.data());
            bytes.insert(bytes.end(), first, first + list.instances.size() * sizeof list.instances[0]);
        }
        return bytes;
    };
    const std::vector<std::uint8_t> expected = draws(FE_TONEAREST);
    EXPECT_GT(expected.size(), 10'000u);
    for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) EXPECT_TRUE(draws(mode) == expected) << mode;
}
#endif

/// FNV-1a hash of the bits of all displacement planes, row by row.
std::uint64_t hash_of_displacement(const Frame& frame) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const Cascade& cascade : frame.cascades)
        for (const PlaneView* plane : {&cascade.dx, &cascade.height, &cascade.dz})
            for (int j = 0; j < plane->resolution; ++j)
                for (int i = 0; i < plane->resolution; ++i)
                    hash = (hash ^ std::bit_cast<std::uint32_t>(plane->at(i, j))) * 0x100000001b3u;
    return hash;
}

/// Seas in deep water with cascades = 1: the first version's defaults and presets.
std::map<std::string, SeaState> seas_of_one_cascade() {
    std::map<std::string, SeaState> seas = {
        {"one-cascade-256", {.resolution = 256, .patch_size_m = 250, .roughness = 0.1}},
        {"one-cascade-calm",
         {.resolution = 256,
          .patch_size_m = 50,
          .wind_speed_mps = 3,
          .fetch_m = 20e3,
          .choppiness = 0.6,
          .roughness = 0.05}},
        {"one-cascade-rough",
         {.resolution = 256,
          .patch_size_m = 300,
          .wind_speed_mps = 12,
          .fetch_m = 200e3,
          .choppiness = 0.9,
          .roughness = 0.15,
          .wind_alignment = 0.6}},
        {"one-cascade-storm",
         {.resolution = 512,
          .patch_size_m = 800,
          .wind_speed_mps = 19,
          .fetch_m = 400e3,
          .choppiness = 1,
          .roughness = 0.2,
          .wind_alignment = 0.7}}};
    for (const SpectrumModel model : values_of<SpectrumModel>())
        seas[std::string(name_of(model)) + "-64"] = {.spectrum = model,
                                                     .resolution = 64,
                                                     .patch_size_m = 250,
                                                     .roughness = 0.1,
                                                     .swell_height_m = model == SpectrumModel::none ? 2.0 : 0};
    for (auto& [name, sea] : seas) {
        sea.spreading = SpreadingModel::paper;
        sea.lean = 0;
        sea.loop_period_s = 200;
    }
    return seas;
}

// The displacement of a deep cascade equals that of the first version. Its normals, which then used
// only the roughness option, are covered by the hashes of whole frames.
TEST(Determinism, DeepCascadesKeepTheirDisplacement) {
    GoldenRows rows("displacement");
    for (const auto& [name, sea] : seas_of_one_cascade()) {
        Ocean ocean(sea, {.executor = make_serial_executor()});
        for (const std::string time : {"0", "12.34"})
            rows.row(name + "@" + time, {hash_of_displacement(ocean.frame_at(std::stod(time)))});
    }
    rows.expect();
}

// A change of these hashes changes every user's sea; its commit message must give the reason.
TEST(Determinism, FramesHaveTheGoldenHashes) {
    std::map<std::string, SeaState> seas = {{"default", {}}};
    for (const SpectrumModel model : values_of<SpectrumModel>())
        seas[std::string(name_of(model)) + "-64"] = {.spectrum = model,
                                                     .resolution = 64,
                                                     .patch_size_m = 250,
                                                     .swell_height_m = model == SpectrumModel::none ? 2.0 : 0};
    for (const SpreadingModel model : values_of<SpreadingModel>())
        if (model != SeaState{}.spreading)
            seas["spreading-" + std::string(name_of(model)) + "-64"] = {
                .spreading = model, .resolution = 64, .patch_size_m = 250};
    seas["shallow-64"] = {.resolution = 64, .patch_size_m = 250, .depth_m = 8};
    seas["breaking-swell-64"] = {
        .resolution = 64, .patch_size_m = 250, .depth_m = 2, .swell_height_m = 1, .swell_direction_rad = 2};
    seas["analytic-64"] = analytic_sea_state;
    seas["pond-64"] = pond;
    seas["short-wave-cutoff-64"] = {.resolution = 64, .patch_size_m = 250, .short_wave_cutoff = 0.8};
    const auto with_systems = [](SeaState sea) {
        sea.systems = {
            {.height_m = 1.2, .peak_period_s = 12, .direction_rad = 2, .spread_rad = 0.26},
            {.spreading = SpreadingModel::hasselmann, .wind_speed_mps = 8, .fetch_m = 30e3, .direction_rad = -1},
            {.spectrum = SpectrumModel::pierson_moskowitz, .height_m = 0.5}};
        return sea;
    };
    seas["systems"] = with_systems({});
    seas["systems-64"] =
        with_systems({.spectrum = SpectrumModel::none, .resolution = 64, .patch_size_m = 900, .depth_m = 20});
    seas["wind-sea-by-height"] = {.peak_period_s = 7, .wave_height_m = 2};
    for (const std::string name : {"calm", "moderate", "rough", "storm"})
        seas["preset-" + name] = sea_preset_named(name)->sea;

    std::map<std::string, std::string> golden;
    std::ifstream file(in_sources("tests/golden/hashes.txt"));
    for (std::string name, hash; file >> name >> hash;) golden[name] = hash;
    std::size_t compared = 0;
    for (const auto& [name, sea] : seas) {
        for (const char* time : {"0", "12.34"}) {
            std::ostringstream hash;
            hash << std::hex << hash_at(sea, std::stod(time));
            const std::string key = name + "@" + time;
            EXPECT_EQ(golden[key], hash.str()) << "the line would be: " << key << " " << hash.str();
            ++compared;
        }
    }
    // Foam, of four cascades and of one.
    for (const auto& [name, sea] : {std::pair{"foam-cascades", sea_of_cascades}, {"foam-folded", overturning_sea}}) {
        Ocean ocean(sea, {.executor = make_serial_executor(), .foam = true});
        std::ostringstream hash;
        hash << std::hex << foam_hash_of(ocean.frame_at(12.34));
        EXPECT_EQ(golden[name], hash.str()) << "the line would be: " << name << " " << hash.str();
        ++compared;
    }
    // Query results, velocities included.
    const QueryPoints points(5000);
    for (const auto& [name, sea] : {std::pair{"queries-folded", overturning_sea},
                                    {"queries-smooth", smooth_sea},
                                    {"queries-cascades", sea_of_cascades},
                                    {"queries-analytic", analytic_sea_state},
                                    {"queries-pond", pond}}) {
        std::ostringstream hash;
        hash << std::hex << samples_at(sea, 12.34, choose_isa(), points).hash();
        EXPECT_EQ(golden[name], hash.str()) << "the line would be: " << name << " " << hash.str();
        ++compared;
    }
    EXPECT_EQ(golden.size(), compared) << "lines that no test reads";
}

}  // namespace
}  // namespace pelagic
