// Misuse of the C++ interface, each case caught by an assertion that names it. Only in builds with
// assertions: `asan` and `debug`, not `release`, which defines NDEBUG.
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "pelagic/sim/buffers/fold_map.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/sim/surface_ray.hpp"

namespace pelagic {
namespace {

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

TEST_F(MisuseDeathTest, SchedulingAFrameWhileOneIsInFlight) {
    EXPECT_DEATH((ocean_.schedule(0), ocean_.schedule(1)), "complete\\(\\) the frame in flight first");
    EXPECT_DEATH((ocean_.schedule(0), ocean_.frame_at(1)), "complete\\(\\) the frame in flight first");
}

TEST_F(MisuseDeathTest, SchedulingAFrameForANonFiniteTime) {
    EXPECT_DEATH(ocean_.schedule(std::numeric_limits<double>::quiet_NaN()), "isfinite\\(time_s\\)");
    EXPECT_DEATH(ocean_.schedule(-std::numeric_limits<double>::infinity()), "isfinite\\(time_s\\)");
}

TEST_F(MisuseDeathTest, CompletingAFrameBeforeTheFirst) {
    EXPECT_DEATH(ocean_.complete(), "schedule\\(\\) a frame first");
}

TEST_F(MisuseDeathTest, SchedulingASeaWhileOneIsBaked) {
    EXPECT_DEATH((ocean_.schedule_sea({.resolution = 16, .patch_size_m = 250}),
                  ocean_.schedule_sea({.resolution = 16, .patch_size_m = 250})),
                 "complete_sea\\(\\) first");
}

TEST_F(MisuseDeathTest, CompletingASeaWhileAFrameIsInFlight) {
    EXPECT_DEATH(
        (ocean_.schedule_sea({.resolution = 16, .patch_size_m = 250}), ocean_.schedule(0), ocean_.complete_sea()),
        "complete\\(\\) the frame in flight first");
}

TEST_F(MisuseDeathTest, QueryingWithoutATolerance) {
    const Frame& frame = ocean_.frame_at(0);
    EXPECT_DEATH(SurfaceQuery(frame, 0), "tolerance_m > 0");
    EXPECT_DEATH(SurfaceQuery(frame, std::numeric_limits<double>::quiet_NaN()), "tolerance_m > 0");
}

TEST_F(MisuseDeathTest, QueryingWithArraysOfUnequalLength) {
    const SurfaceQuery query(ocean_.frame_at(0));
    const std::vector<double> three(3), two(2);
    std::vector<float> too_few(2);
    EXPECT_DEATH(query.sample({three, two}, {}), "points.z.size\\(\\) == count");
    EXPECT_DEATH(query.sample({three, three}, {.height_m = too_few}), "points.z.size\\(\\) == count");
    EXPECT_DEATH(query.sample({three, three}, {.error_m = too_few}), "points.z.size\\(\\) == count");
}

TEST_F(MisuseDeathTest, CastingARayWithoutDirectionOrReach) {
    const SurfaceQuery query(ocean_.frame_at(0));
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_DEATH(first_hit(query, {{0, 5, 0}, {0, 0, 0}, 10}), "length > 0");
    EXPECT_DEATH(first_hit(query, {{0, 5, 0}, {0, -infinity, 0}, 10}), "length > 0");
    EXPECT_DEATH(first_hit(query, {{0, 5, 0}, {0, -1, 0}, -1}), "length > 0");
    EXPECT_DEATH(first_hit(query, {{0, 5, 0}, {0, -1, 0}, infinity}), "length > 0");
}

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
