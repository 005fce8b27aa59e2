// Misuse of the C++ interface. The application's mistakes throw in every build. Broken inner
// invariants are caught by assertions, so only in builds with them: `asan` and `debug`.
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <typeinfo>
#include <vector>

#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/floating/hull_plan.hpp"
#include "pelagic/floating/hull_wake.hpp"
#include "pelagic/quadtree/level_map.hpp"
#include "pelagic/quadtree/skirt.hpp"
#include "pelagic/sim/buffers/fold_map.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"
#include "pelagic/sim/surface_ray.hpp"
#include "pelagic/tests/hull_meshes.hpp"

namespace pelagic {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN(),
                 no_end = std::numeric_limits<double>::infinity();

/// Returns the message of an exception of exactly this type.
template <class Error>
std::string thrown(const std::function<void()>& call) {
    try {
        call();
    } catch (const std::logic_error& error) {
        if (typeid(error) == typeid(Error)) return error.what();
        return std::string("another type: ") + error.what();
    }
    return "nothing";
}
std::string invalid(const std::function<void()>& call) { return thrown<std::invalid_argument>(call); }
std::string wrong_order(const std::function<void()>& call) { return thrown<std::logic_error>(call); }

class MisuseTest : public testing::Test {
   protected:
    static constexpr const char *complete_first = "a frame is in flight; call complete() first",
                                *complete_sea_first = "a sea is being computed; call complete_sea() first";
    static OceanOptions options() {
        return {.executor = make_serial_executor(), .queries = true, .velocities = Velocities::drawn};
    }
    const SeaState sea_{.resolution = 16, .patch_size_m = 250};
    Ocean ocean_{sea_, options()};
};

TEST_F(MisuseTest, AFrameInFlightIsNotLost) {
    ocean_.schedule(1);
    EXPECT_EQ(wrong_order([&] { ocean_.schedule(2); }), complete_first);
    EXPECT_EQ(wrong_order([&] { ocean_.frame_at(2); }), complete_first);
    ocean_.schedule_sea(sea_);
    EXPECT_EQ(wrong_order([&] { ocean_.schedule_sea(sea_); }), complete_sea_first);
    EXPECT_EQ(wrong_order([&] { ocean_.schedule_sea(sea_, 10, 20); }), complete_sea_first);
    EXPECT_EQ(wrong_order([&] { ocean_.complete_sea(); }), complete_first);
    EXPECT_EQ(ocean_.complete().time_s, 1);
    ocean_.complete_sea();
}

TEST_F(MisuseTest, AFrameHasATimeAndIsScheduledFirst) {
    EXPECT_EQ(wrong_order([&] { ocean_.complete(); }), "there is no frame; call schedule() first");
    EXPECT_EQ(invalid([&] { ocean_.schedule(no_number); }), "time_s is nan, expected a finite number");
    EXPECT_EQ(invalid([&] { ocean_.frame_at(-no_end); }), "time_s is -inf, expected a finite number");
    EXPECT_EQ(ocean_.frame_at(3).time_s, 3);
}

TEST_F(MisuseTest, QueriesWriteWithinTheirArrays) {
    const SurfaceQuery query(ocean_.frame_at(0));
    const std::vector<double> four(4), two(2), many(4096);
    std::vector<float> few(2, 7.f);
    std::vector<std::uint8_t> bytes(5);
    EXPECT_EQ(invalid([&] { query.sample({four, two}, {}); }), "z has 2 elements, expected 4, as x has");
    EXPECT_EQ(invalid([&] { query.sample({four, four}, {.height_m = few}); }),
              "height_m has 2 elements, expected 4 or none");
    EXPECT_EQ(invalid([&] { query.sample({four, four}, {.error_m = few}); }),
              "error_m has 2 elements, expected 4 or none");
    EXPECT_EQ(invalid([&] { query.sample({four, four}, {.converged = bytes}); }),
              "converged has 5 elements, expected 4 or none");
    SurfaceQueryJobs jobs(make_serial_executor());
    EXPECT_EQ(invalid([&] { jobs.sample(query, {many, many}, {.velocity_y_mps = few}); }),
              "velocity_y_mps has 2 elements, expected 4096 or none");
    EXPECT_EQ(few, std::vector<float>(2, 7.f));
}

TEST_F(MisuseTest, QueriesNeedAToleranceAndRaysADirection) {
    const Frame& frame = ocean_.frame_at(0);
    EXPECT_EQ(invalid([&] { SurfaceQuery(frame, 0); }), "tolerance_m is 0, expected a number above 0");
    EXPECT_EQ(invalid([&] { SurfaceQuery(frame, no_number); }), "tolerance_m is nan, expected a number above 0");
    EXPECT_EQ(invalid([&] { SurfaceQuery(Frame{}); }), "the frame has no cascades, expected a frame of an ocean");
    const SurfaceQuery query(frame);
    EXPECT_EQ(invalid([&] { first_hit(query, {{0, 5, 0}, {0, 0, 0}, 10}); }),
              "direction's length is 0, expected a finite number above 0");
    EXPECT_EQ(invalid([&] { first_hit(query, {{0, 5, 0}, {0, -no_end, 0}, 10}); }),
              "direction's length is inf, expected a finite number above 0");
    EXPECT_EQ(invalid([&] { first_hit(query, {{0, no_number, 0}, {0, -1, 0}, 10}); }),
              "origin_m is nan, expected a finite number");
    EXPECT_EQ(invalid([&] { first_hit(query, {{0, 5, 0}, {0, -1, 0}, -1}); }),
              "reach_m is -1, expected a finite number of 0 or more");
    EXPECT_EQ(invalid([&] { first_hit(query, {{0, 5, 0}, {0, -1, 0}, no_end}); }),
              "reach_m is inf, expected a finite number of 0 or more");
}

TEST_F(MisuseTest, DynamicWavesOfAnOceanAdvanceWithIt) {
    Ocean ocean(sea_, {.executor = make_serial_executor(), .dynamic_waves = DynamicWavesOptions{.resolution = 64}});
    DynamicWaves& waves = ocean.dynamic_waves();
    EXPECT_EQ(wrong_order([&] { waves.advance(1); }), "the ocean advances these waves");
    const std::vector<std::uint8_t> saved = waves.save_state();
    ocean.schedule(1);
    EXPECT_EQ(wrong_order([&] { static_cast<void>(waves.save_state()); }), complete_first);
    EXPECT_EQ(wrong_order([&] { waves.restore_state(saved); }), complete_first);
    EXPECT_EQ(ocean.complete().time_s, 1);

    DynamicWaves alone({.resolution = 64}, {.executor = make_serial_executor()});
    EXPECT_EQ(invalid([&] { alone.advance(no_number); }), "time_s is nan, expected a finite number");
    EXPECT_EQ(invalid([&] { static_cast<void>(alone.tick_at(no_end)); }), "time_s is inf, expected a finite number");
    EXPECT_TRUE(alone.advance(1));
}

TEST_F(MisuseTest, ExecutorsAreNotNull) {
    const auto no_executor = "executor is null, expected an executor";
    EXPECT_EQ(invalid([] { SurfaceQueryJobs(nullptr); }), no_executor);
    EXPECT_EQ(invalid([] { FloatingBodies(nullptr); }), no_executor);
}

TEST_F(MisuseTest, HullsKeepToTheirArrays) {
    const Hull hull(box_mesh({4, 2, 2}), {.mass_kg = 5000});
    EXPECT_EQ(invalid([&] { hull.at_rest(0, 0, no_number); }), "heading_rad is nan, expected a finite number");
    EXPECT_EQ(invalid([&] { plan_of(hull.mesh(), 0, 4); }), "columns 0 is out of range [1, 1024]");
    EXPECT_EQ(invalid([&] { plan_of(hull.mesh(), 4, 99999); }), "rows 99999 is out of range [1, 1024]");
    DynamicWaves waves({.resolution = 64}, {.executor = make_serial_executor()});
    const HullWake wake(waves, hull, hull.at_rest(0, 0));
    const std::vector<double> three(3), two(2);
    std::vector<float> heights(3), few(2);
    const Frame& frame = ocean_.frame_at(0);
    const auto sizes = "x, z, height_m, velocity_y_mps, wake_m and wake_up_mps differ in length";
    EXPECT_EQ(invalid([&] { wake.leave_out(frame, three, two, heights, heights); }), sizes);
    EXPECT_EQ(invalid([&] { wake.leave_out(frame, three, three, few, heights); }), sizes);
    EXPECT_EQ(invalid([&] { wake.leave_out(frame, three, three, heights, few); }), sizes);
}

TEST_F(MisuseTest, OptionsAreCheckedWhereTheyAreUsed) {
    EXPECT_EQ(invalid([] { LevelMap({.size_m = -1}); }), check(QuadtreeOptions{.size_m = -1}));
    EXPECT_EQ(invalid([] { SkirtMesh(-3); }), "vertices is -3, expected an even number from 2 to 128");
}

class MisuseDeathTest : public testing::Test {
   protected:
    void SetUp() override {
#if defined(NDEBUG)
        GTEST_SKIP() << "assertions are not compiled in";
#endif
        testing::GTEST_FLAG(death_test_style) = "threadsafe";
    }

    Ocean ocean_{{.resolution = 16, .patch_size_m = 250}, {.executor = make_serial_executor(), .queries = true}};
};

TEST_F(MisuseDeathTest, BuildingAFoldMapForACascadeOfAnotherSize) {
    Cascade cascade = ocean_.frame_at(0).cascades[0];
    FoldMap folds(32);
    EXPECT_DEATH(folds.update(cascade, kernels_for(ocean_.isa())), "resolution\\(\\) == resolution_");
}

TEST_F(MisuseDeathTest, RequestingKernelsThatThisProcessorCannotRun) {
    for (const Isa isa : {Isa::sse4_2, Isa::avx2, Isa::avx512, Isa::neon})
        if (!runs_here(isa)) {
            EXPECT_DEATH(kernels_for(isa), "runs_here\\(isa\\)") << name_of(isa);
        }
}

}  // namespace
}  // namespace pelagic
