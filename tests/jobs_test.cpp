// Executors: each block once, stages in their order, threads within the limit, nothing lost.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <latch>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>

#include "jobs/executor.hpp"

namespace pelagic {
namespace {

struct Kind {
    std::string name;
    std::shared_ptr<Executor> (*make)(int threads);
    int threads;
};

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

std::vector<Kind> kinds() {
    std::vector<Kind> all = {{"serial", [](int) { return make_serial_executor(); }, 1}};
    for (const int threads : {1, 2, 3, 8}) {
        all.push_back({"thread_" + std::to_string(threads), make_thread_executor, threads});
#if defined(PELAGIC_HAS_TBB)
        all.push_back({"tbb_" + std::to_string(threads), make_tbb_executor, threads});
#endif
    }
    return all;
}

class EachExecutor : public testing::TestWithParam<Kind> {
   protected:
    std::shared_ptr<Executor> executor_ = GetParam().make(GetParam().threads);
};
INSTANTIATE_TEST_SUITE_P(Kinds, EachExecutor, testing::ValuesIn(kinds()),
                         [](const auto& test) { return test.param.name; });

void run_once(GraphRun& run) {
    run.schedule();
    run.complete();
}

TEST_P(EachExecutor, RunsEveryItemOnceInTheDocumentedBlocks) {
    for (const auto& [count, batch] : {std::pair{0, 4}, {1, 1}, {7, 3}, {64, 64}, {65, 64}, {1000, 1}, {10, 100}}) {
        std::vector<std::atomic<int>> hits(static_cast<std::size_t>(count));
        std::mutex mutex;
        std::set<std::pair<std::size_t, std::size_t>> blocks;
        JobGraph graph;
        graph.add({.name = "count",
                   .count = static_cast<std::size_t>(count),
                   .batch = static_cast<std::size_t>(batch),
                   .body = [&](std::size_t begin, std::size_t end) {
                       for (std::size_t i = begin; i < end; ++i) ++hits[i];
                       const std::lock_guard lock(mutex);
                       EXPECT_TRUE(blocks.insert({begin, end}).second);
                   }});
        run_once(*executor_->prepare(graph));
        for (const auto& hit : hits) EXPECT_EQ(hit, 1);
        EXPECT_EQ(static_cast<int>(blocks.size()), (count + batch - 1) / batch);
        for (const auto& [begin, end] : blocks) {
            EXPECT_EQ(begin % static_cast<std::size_t>(batch), 0u);
            EXPECT_EQ(end, std::min(begin + static_cast<std::size_t>(batch), static_cast<std::size_t>(count)));
        }
    }
}

// A diamond with an empty stage in it, over and over: no stage may start before all that it waits for are done.
TEST_P(EachExecutor, StagesWaitForWhatTheyNameAThousandTimes) {
    constexpr std::size_t counts[] = {13, 40, 0, 25, 1};
    const std::vector<StageId> waits_for[] = {{}, {0}, {0}, {1, 2}, {3}};
    std::atomic<std::size_t> done[5];
    std::atomic<int> too_early = 0;
    JobGraph graph;
    for (std::size_t id = 0; id < 5; ++id) {
        graph.add({.name = "stage " + std::to_string(id),
                   .count = counts[id],
                   .batch = 2,
                   .waits_for = waits_for[id],
                   .body = [&, id](std::size_t begin, std::size_t end) {
                       for (const StageId earlier : waits_for[id])
                           if (done[earlier] != counts[earlier]) ++too_early;
                       done[id] += end - begin;
                   }});
    }
    const auto run = executor_->prepare(graph);
    for (int round = 0; round < 1000; ++round) {
        for (auto& count : done) count = 0;
        run_once(*run);
        for (std::size_t id = 0; id < 5; ++id) ASSERT_EQ(done[id], counts[id]);
        ASSERT_TRUE(run->is_done());
    }
    EXPECT_EQ(too_early, 0);
}

TEST_P(EachExecutor, NeverUsesMoreThreadsThanItsLimit) {
    EXPECT_EQ(executor_->thread_limit(), GetParam().threads);
    std::atomic<int> inside = 0, most = 0;
    JobGraph graph;
    for (int stage = 0; stage < 2; ++stage) {
        graph.add({.name = "crowd", .count = 64, .body = [&](std::size_t, std::size_t) {
                       const int here = ++inside;
                       for (int seen = most; here > seen && !most.compare_exchange_weak(seen, here);) {
                       }
                       std::this_thread::sleep_for(std::chrono::microseconds(200));
                       --inside;
                   }});
    }
    run_once(*executor_->prepare(graph));
    EXPECT_LE(most, GetParam().threads);
}

TEST_P(EachExecutor, TwoGraphsMayBeInFlightAtOnce) {
    std::atomic<int> first = 0, second = 0;
    JobGraph a, b;
    a.add({.name = "a", .count = 100, .body = [&](std::size_t, std::size_t) { ++first; }});
    b.add({.name = "b", .count = 100, .body = [&](std::size_t, std::size_t) { ++second; }});
    const auto run_a = executor_->prepare(a), run_b = executor_->prepare(b);
    for (int round = 1; round <= 200; ++round) {
        run_a->schedule();
        run_b->schedule();
        run_b->complete();
        run_a->complete();
        ASSERT_EQ(first, 100 * round);
        ASSERT_EQ(second, 100 * round);
    }
}

TEST_P(EachExecutor, DestroyingARunWaitsForIt) {
    std::atomic<int> done = 0;
    JobGraph graph;
    graph.add({.name = "slow", .count = 8, .body = [&](std::size_t, std::size_t) {
                   std::this_thread::sleep_for(std::chrono::milliseconds(1));
                   ++done;
               }});
    executor_->prepare(graph)->schedule();
    EXPECT_EQ(done, 8);
}

TEST_P(EachExecutor, CompletingNothingReturns) {
    JobGraph graph;
    graph.add({.name = "never", .count = 1, .body = [](std::size_t, std::size_t) { FAIL(); }});
    executor_->prepare(graph)->complete();
}

class ParallelExecutor : public EachExecutor {};
std::vector<Kind> parallel_kinds() {
    std::vector<Kind> all = kinds();
    std::erase_if(all, [](const Kind& kind) { return kind.threads == 1; });
    return all;
}
INSTANTIATE_TEST_SUITE_P(Kinds, ParallelExecutor, testing::ValuesIn(parallel_kinds()),
                         [](const auto& test) { return test.param.name; });

// The body can only end after schedule() has returned.
TEST_P(ParallelExecutor, SchedulingDoesNotBlock) {
    std::latch scheduled(1);
    JobGraph graph;
    graph.add({.name = "blocked", .count = 1, .body = [&](std::size_t, std::size_t) { scheduled.wait(); }});
    const auto run = executor_->prepare(graph);
    run->schedule();
    EXPECT_FALSE(run->is_done());
    scheduled.count_down();
    run->complete();
    EXPECT_TRUE(run->is_done());
}

// Bodies that wait for each other: as many as the limit must run at the same time, the completing thread among them.
TEST_P(ParallelExecutor, AsManyJobsAsTheLimitRunAtOnce) {
    const int threads = GetParam().threads;
    std::latch all_here(threads);
    std::atomic<int> timeouts = 0;
    JobGraph graph;
    graph.add({.name = "meet", .count = static_cast<std::size_t>(threads), .body = [&](std::size_t, std::size_t) {
                   all_here.count_down();
                   const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
                   while (!all_here.try_wait()) {
                       if (std::chrono::steady_clock::now() > deadline) {
                           ++timeouts;
                           return;
                       }
                       std::this_thread::yield();
                   }
               }});
    run_once(*executor_->prepare(graph));
    EXPECT_EQ(timeouts, 0);
}

TEST(ExecutorOptions, BadThreadCountsThrowTheRange) {
    for (const int threads : {-1, 1025}) {
        EXPECT_THROW(make_thread_executor(threads), std::invalid_argument);
        EXPECT_THROW(make_default_executor(threads), std::invalid_argument);
    }
    EXPECT_GE(make_default_executor(0)->thread_limit(), 1);
}

TEST(JobGraph, BadStagesThrow) {
    JobGraph graph;
    const JobBody nothing = [](std::size_t, std::size_t) {};
    EXPECT_THROW(graph.add({.name = "no batch", .count = 1, .batch = 0, .body = nothing}), std::invalid_argument);
    EXPECT_THROW(graph.add({.name = "no body", .count = 1, .body = {}}), std::invalid_argument);
    EXPECT_THROW(graph.add({.name = "itself", .count = 1, .waits_for = {0}, .body = nothing}), std::invalid_argument);
    EXPECT_EQ(graph.add({.name = "good", .count = 1, .body = nothing}), 0u);
}

}  // namespace
}  // namespace pelagic
