// An executor that throws when a run is scheduled. That frame is lost, and the frame completed last
// stays valid and unchanged while the next one is computed.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

constexpr int never = std::numeric_limits<int>::max();

struct NoThreads : std::runtime_error {
    NoThreads() : std::runtime_error("no threads") {}
};

class FailingRun final : public GraphRun {
   public:
    FailingRun(std::unique_ptr<GraphRun> run, int& left) : run_(std::move(run)), remaining_(left) {}
    void schedule() override {
        if (remaining_ != never && remaining_-- == 0) {
            remaining_ = never;
            throw NoThreads();
        }
        run_->schedule();
    }
    void complete() override { run_->complete(); }
    bool is_done() const override { return run_->is_done(); }

   private:
    std::unique_ptr<GraphRun> run_;
    int& remaining_;
};

class FailingExecutor final : public Executor {
   public:
    /// Makes one later schedule() throw: the one after `schedules` successful ones.
    void fail_after(int schedules) { remaining_ = schedules; }
    bool has_failed() const { return remaining_ == never; }

    std::unique_ptr<GraphRun> prepare(const JobGraph& graph) override {
        return std::make_unique<FailingRun>(pool_->prepare(graph), remaining_);
    }
    int thread_limit() const override { return pool_->thread_limit(); }
    std::string_view name() const override { return "failing"; }

   private:
    std::shared_ptr<Executor> pool_ = make_thread_executor(2);
    int remaining_ = never;
};

struct Rings {
    std::string name;
    bool foam, dynamic_waves, shore;
    bool changes = false;  ///< seas are baked while frames are computed
};

class FailedSchedule : public testing::TestWithParam<Rings> {
   protected:
    FailedSchedule() : executor_(std::make_shared<FailingExecutor>()), ocean_(forecast(), options(executor_)) {}

    Forecast forecast() const {
        // More texels than a frame that is computed without jobs.
        Forecast forecast{.first = {.cascades = 2, .resolution = 64, .wind_speed_mps = 14, .loop_period_s = 40}};
        SeaState other = forecast.first;
        other.wind_direction_rad = 1;
        if (GetParam().changes)
            forecast.changes = {{.sea = other, .from_s = 1, .over_s = 1},
                                {.sea = forecast.first, .from_s = 3, .over_s = 1}};
        return forecast;
    }
    OceanOptions options(std::shared_ptr<Executor> executor) const {
        OceanOptions options{.executor = std::move(executor), .foam = GetParam().foam};
        if (GetParam().dynamic_waves) options.dynamic_waves = DynamicWavesOptions{.resolution = 64};
        if (GetParam().shore) {
            options.shore = beach(400, 200, 10, 100, 10);
            options.shore->resolution = 64;
        }
        return options;
    }

    using Hashes = std::array<std::uint64_t, 4>;
    static Hashes hashes_of(const Frame& frame) {
        return {hash_of(frame), foam_hash_of(frame), hash_of(frame.dynamic_waves), shore_hash_of(frame)};
    }
    void disturb(double time_s) {
        if (GetParam().dynamic_waves)
            ocean_.dynamic_waves().add_impulse({.x_m = time_s, .radius_m = 3, .height_m = 0.2});
    }

    std::shared_ptr<FailingExecutor> executor_;
    Ocean ocean_;
};

INSTANTIATE_TEST_SUITE_P(OfOceans, FailedSchedule,
                         testing::Values(Rings{"Waves", false, false, false}, Rings{"Foam", true, false, false},
                                         Rings{"DynamicWaves", false, true, false},
                                         Rings{"Shore", false, false, true}, Rings{"All", true, true, true},
                                         Rings{"Changes", true, true, false, true}),
                         [](const auto& rings) { return rings.param.name; });

TEST_P(FailedSchedule, KeepsTheLastFrameValidDuringTheNextOne) {
    const Rings rings = GetParam();
    // Steps within a tick of foam, of one tick, and of several ticks, which complete() computes.
    Ocean unfailing(forecast(), options(make_serial_executor()));
    int failures = 0;
    double time_s = 0;
    for (const double step_s : {0.01, 0.1, 0.35}) {
        for (int after = 0;; ++after) {
            ocean_.frame_at(time_s += 0.05);
            disturb(time_s);
            const Frame& last = ocean_.frame_at(time_s += 0.05);
            const Hashes before = hashes_of(last);
            executor_->fail_after(after);
            disturb(time_s);
            try {
                ocean_.schedule(time_s += step_s);
                ocean_.complete();
            } catch (const NoThreads&) {
            }
            if (!executor_->has_failed()) {
                executor_->fail_after(never);
                EXPECT_GT(after, 0) << "at least the waves are a run";
                break;
            }
            ++failures;
            EXPECT_EQ(&ocean_.complete(), &last) << "schedule " << after << ", step " << step_s;
            EXPECT_EQ(hashes_of(last), before) << "schedule " << after << ", step " << step_s;
            const double next_s = time_s += 0.05;
            ocean_.schedule(next_s);
            EXPECT_EQ(hashes_of(last), before) << "schedule " << after << ", step " << step_s;
            const Frame& next = ocean_.complete();
            EXPECT_NE(&next, &last) << "schedule " << after << ", step " << step_s;
            EXPECT_EQ(hashes_of(last), before) << "schedule " << after << ", step " << step_s;

            const Frame& expected = unfailing.frame_at(next_s);
            EXPECT_EQ(hash_of(next), hash_of(expected));
            EXPECT_EQ(foam_hash_of(next), foam_hash_of(expected));
            EXPECT_EQ(shore_hash_of(next), shore_hash_of(expected));
        }
    }
    EXPECT_GE(failures, 3 * (1 + (rings.dynamic_waves ? 1 : 0)));
}

}  // namespace
}  // namespace pelagic
