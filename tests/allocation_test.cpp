// After its first frame, an ocean allocates no memory; a pool that gets none ends its threads. A
// separate program, because it replaces operator new.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <utility>
#include <vector>

#include "pelagic/analytic/analytic_surface.hpp"
#include "pelagic/analytic/pond_waves.hpp"
#include "pelagic/jobs/job_thread.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/gerstner_input.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/ripple_input.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"
#include "pelagic/sim/surface_ray.hpp"
#include "pelagic/tests/platform/platform.hpp"

namespace {
std::atomic<long> allocations = 0;
std::atomic<long> failing = -1;  // the allocation that fails

void* counted(std::size_t size, std::size_t alignment) {
    if (allocations++ == failing) throw std::bad_alloc();
    void* memory = pelagic::allocate_aligned(size, alignment);
    if (!memory) throw std::bad_alloc();
    return memory;
}
}  // namespace

void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
    return counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept { pelagic::free_aligned(memory); }
void operator delete(void* memory, std::size_t) noexcept { pelagic::free_aligned(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { pelagic::free_aligned(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { pelagic::free_aligned(memory); }

namespace pelagic {
namespace {

/// Calls `make` until it needs no further allocation. In call n, allocation n fails. Returns n.
template <class Make>
long failures_until_made(const Make& make) {
    for (long failures = 0;; ++failures) {
        failing = allocations + failures;
        try {
            make();
            failing = -1;
            return failures;
        } catch (const std::bad_alloc&) {
        }
    }
}

TEST(Allocation, ThreadsEndWhenThereIsNoMemoryForTheNextOne) {
    constexpr int threads = 4;
    EXPECT_GT(failures_until_made([] { make_thread_executor(threads); }), threads);
    EXPECT_GE(failures_until_made([] { need_threads(threads, std::size_t{1} << 20); }), threads);
}

// The default executor is left out: oneTBB allocates its tasks from its own pools.
TEST(Allocation, FramesAfterTheFirstAllocateNothing) {
    for (const auto& executor : {make_serial_executor(), make_thread_executor(3)}) {
        const long before_building = allocations;
        Ocean ocean({.resolution = 128, .patch_size_m = 250},
                    {.executor = executor});  // 64 would not use the executor
        EXPECT_GT(allocations, before_building) << "the counter does not count";
        ocean.frame_at(0);
        const long before = allocations;
        for (int i = 0; i < 100; ++i) ocean.frame_at(i * 0.1);
        EXPECT_EQ(allocations, before) << executor->name();
    }
}

TEST(Allocation, QueriesAndQueryableFramesDoNotAllocate) {
    // At these wind speeds the paper's sea folds, and hurricane cascades are nearly as steep. So
    // the queries also search for the highest of several surface sheets.
    const SeaState folded{.spectrum = SpectrumModel::phillips_paper,
                          .resolution = 64,
                          .patch_size_m = 250,
                          .wind_speed_mps = 20,
                          .choppiness = 1};
    const SeaState steep_cascades{.cascades = 4, .resolution = 64, .wind_speed_mps = 50, .choppiness = 1};
    const SeaState pond{.waves = WaveModel::pond, .resolution = 128};
    for (const auto& [executor, sea] : {std::pair{make_serial_executor(), folded},
                                        {make_thread_executor(3), folded},
                                        {make_serial_executor(), steep_cascades},
                                        {make_thread_executor(3), steep_cascades},
                                        {make_thread_executor(3), pond}}) {
        Ocean ocean(sea, {.executor = executor, .queries = true, .velocities = Velocities::drawn, .slopes = true,
                          .foam = true});
        SurfaceQueryJobs jobs(executor);
        std::vector<double> x(3000), z(3000);
        std::vector<float> height(3000), velocity(3000), normal(3000), foam(3000);
        for (std::size_t i = 0; i < x.size(); ++i)
            x[i] = static_cast<double>(i) * 0.7, z[i] = static_cast<double>(i) * 1.3;
        const SurfaceSamples wanted{.height_m = height, .normal_x = normal, .velocity_y_mps = velocity, .foam = foam};
        ocean.frame_at(0);
        const long before = allocations;
        // the last frame jumps in time, which resets its foam history
        for (int i = 0; i < 10; ++i) {
            const SurfaceQuery query(ocean.frame_at(i < 9 ? i * 0.1 : 77));
            query.sample({x, z}, wanted);
            jobs.sample(query, {x, z}, wanted);
            first_hit(query, {{0, 30, 0}, {1, -0.3, 0.2}, 500});
        }
        EXPECT_EQ(allocations, before) << executor->name();
    }
}

TEST(Allocation, WaveInputsDoNotAllocateInFrames) {
    for (const auto& executor : {make_serial_executor(), make_thread_executor(3)}) {
        const auto waves = std::make_shared<GerstnerInput>(), none = std::make_shared<GerstnerInput>();
        const auto rings = std::make_shared<RippleInput>(Ripple{.wavelength_m = 5, .amplitude_m = 0.2});
        const auto zeros = std::make_shared<CallbackInput>([](const InputRows&) {});
        Ocean ocean({.resolution = 128},
                    {.executor = executor, .velocities = Velocities::drawn, .foam = true, .inputs = {waves, none,
                                                                                                     rings, zeros}});
        ocean.frame_at(0);
        waves->set(analytic_sea({.waves = 64}));
        rings->set({.x_m = 30, .wavelength_m = 40, .amplitude_m = 1});
        const long before = allocations;
        for (int i = 0; i < 10; ++i) ocean.frame_at(i * 0.1);
        EXPECT_EQ(allocations, before) << executor->name();
        EXPECT_GT(waves->held().waves.size(), 60U);
    }
}

TEST(Allocation, AnalyticQueriesDoNotAllocate) {
    const AnalyticSurface sea(analytic_preset_named("analytic-intense")->sea);
    const PondWaves pond({});
    std::vector<double> x(1003, 1.5), z(1003, -2);
    std::vector<float> height(1003), normal(1003);
    const long before = allocations;
    sea.sample_undisplaced(1, {x, z}, {.height_m = height, .normal_x = normal});
    sea.sample(1, {x, z}, {.height_m = height, .velocity_y_mps = normal});
    pond.sample(1, {x, z}, {.height_m = height, .normal_x = normal}, normal);
    pond.first_hit(1, {0, 2, 0}, {1, -0.3, 0.2}, 50);
    EXPECT_EQ(allocations, before);
}

TEST(Allocation, MemoryBytesMatchesTheOceansBuffers) {
    Ocean ocean({.resolution = 256, .patch_size_m = 250}, {.executor = make_serial_executor()});
    // Bytes per texel: 12 for wave pairs (48 per pair, one pair per four texels);
    // 2 slots of 12 + 8 + 5.3; 0.5 for mip averages; 0.5 between column blocks. Tables add a
    // little.
    EXPECT_NEAR(static_cast<double>(ocean.memory_bytes()) / (256 * 256), 64, 1);
    // Two slots of 12 bytes of velocities, and a quarter byte of fold map.
    Ocean queryable({.resolution = 256, .patch_size_m = 250},
                    {.executor = make_serial_executor(), .queries = true, .velocities = Velocities::drawn});
    EXPECT_NEAR(static_cast<double>(queryable.memory_bytes() - ocean.memory_bytes()) / (256 * 256), 24.5, 0.7);
}

// With two frames in flight and every output; the paper's buffers take 7.5 MB for one frame.
TEST(Allocation, AnOceanOf256TakesLessThanSixMegabytes) {
    for (const Isa isa : isas_here()) {
        Ocean ocean({.resolution = 256, .patch_size_m = 250}, {.executor = make_serial_executor(), .isa = isa});
        EXPECT_LE(ocean.memory_bytes(), 6'000'000u) << name_of(isa);
    }
}

TEST(Allocation, SelectionsDoNotAllocate) {
    for (const QuadtreePreset& preset : quadtree_presets()) {
        QuadtreeOptions options = preset.options(8192);
        options.batch_limit = 3;
        Selection selection(options);
        const glm::dmat4 views[2] = {glm::dmat4(1), glm::dmat4(2)};
        const long before = allocations;
        for (int i = 0; i < 500; ++i) {
            const glm::dvec3 viewer(i * 37.1, i % 50, i * -11.3);
            selection.select({.viewer_m = viewer});
            selection.select({.viewer_m = viewer, .views = views});
        }
        EXPECT_EQ(allocations, before) << preset.name;
    }
}

}  // namespace
}  // namespace pelagic
