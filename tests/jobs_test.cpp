// Executors run each block once, run stages in order, respect the thread limit and lose no work.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <latch>
#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/job_thread.hpp"
#include "pelagic/jobs/platform.hpp"
#include "pelagic/jobs/sharing_choice.hpp"
#include "pelagic/jobs/thread_count.hpp"
#include "pelagic/jobs/worker_group.hpp"
#include "pelagic/tests/application_jobs.hpp"
#include "pelagic/tests/each_executor.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/platform/platform.hpp"
#include "pelagic/tests/sanitized.hpp"
#if defined(__linux__)
#include "pelagic/jobs/cpu_quota.hpp"
#endif

namespace pelagic {
namespace {

/// Far longer than any machine needs; a test that waits for an event that never comes fails instead
/// of hanging.
constexpr std::chrono::seconds patience(20);

bool wait_until(const std::function<bool()>& condition) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > deadline) return false;
        std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
    return true;
}

class EachExecutor : public testing::TestWithParam<ExecutorKind> {
   protected:
    std::shared_ptr<Executor> executor_ = GetParam().make(GetParam().threads);
};
INSTANTIATE_TEST_SUITE_P(Kinds, EachExecutor, testing::ValuesIn(executor_kinds()),
                         [](const auto& test) { return test.param.name; });

using Blocks = std::set<std::pair<std::size_t, std::size_t>>;

void run_once(GraphRun& run) {
    run.schedule();
    run.complete();
}

TEST_P(EachExecutor, RunsEveryItemOnceInTheDocumentedBlocks) {
    for (const auto& [count, batch] : {std::pair{0, 4}, {1, 1}, {7, 3}, {64, 64}, {65, 64}, {1000, 1}, {10, 100}}) {
        std::vector<std::atomic<int>> hits(static_cast<std::size_t>(count));
        std::mutex mutex;
        Blocks blocks;
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

// A batch of maximum size must not overflow to a batch of no blocks, which would never end.
TEST(JobGraph, BatchMayHaveTheMaximumSize) {
    constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{5}, all}) {
        Blocks blocks;
        const Stage stage{
            .name = "all", .count = count, .batch = all, .body = [&](std::size_t begin, std::size_t end) {
                blocks.insert({begin, end});
            }};
        for (std::size_t block = 0; block < block_count(stage); ++block) run_block(stage, block);
        EXPECT_EQ(blocks, count == 0 ? Blocks{} : (Blocks{{0, count}}));
    }
}

// A diamond with an empty stage, repeated: a stage must not start before all of its predecessors
// have ended.
TEST_P(EachExecutor, StagesWaitForTheirPredecessorsAThousandTimes) {
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

// Empty stages in a row, at the start and at the end: only their order makes them run.
TEST_P(EachExecutor, ChainsContinueThroughEmptyStages) {
    std::vector<std::size_t> order;
    std::mutex mutex;
    JobGraph graph;
    for (const std::size_t count : {0, 0, 1, 0, 0, 1, 1, 0}) {
        const StageId id = graph.stages().size();
        graph.add({.name = "link",
                   .count = count,
                   .waits_for = id == 0 ? std::vector<StageId>{} : std::vector<StageId>{id - 1, id - 1},
                   .body = [&, id](std::size_t, std::size_t) {
                       const std::lock_guard lock(mutex);
                       order.push_back(id);
                   }});
    }
    const auto run = executor_->prepare(graph);
    for (int round = 0; round < 100; ++round) {
        order.clear();
        run_once(*run);
        ASSERT_EQ(order, (std::vector<std::size_t>{2, 5, 6}));
    }
}

TEST_P(EachExecutor, GraphWithoutWorkIsDoneAtOnce) {
    JobGraph nothing, empty;
    empty.add({.name = "empty", .body = [](std::size_t, std::size_t) { FAIL(); }});
    for (const JobGraph* graph : {&nothing, &empty}) {
        const auto run = executor_->prepare(*graph);
        run_once(*run);
        EXPECT_TRUE(run->is_done());
    }
}

TEST_P(EachExecutor, IsNotDoneWhileABodyRuns) {
    GraphRun* running = nullptr;
    std::atomic<int> bodies = 0, done_too_early = 0;
    JobGraph graph;
    graph.add({.name = "ask", .count = 5, .body = [&](std::size_t, std::size_t) {
                   ++bodies;
                   if (running->is_done()) ++done_too_early;
               }});
    const auto run = executor_->prepare(graph);
    running = run.get();
    EXPECT_TRUE(run->is_done());
    run_once(*run);
    EXPECT_TRUE(run->is_done());
    EXPECT_EQ(bodies, 5);
    EXPECT_EQ(done_too_early, 0);
}

TEST_P(EachExecutor, NeverUsesMoreThreadsThanItsLimit) {
    EXPECT_EQ(executor_->thread_limit(), GetParam().threads);
    std::atomic<int> inside = 0, max = 0;
    JobGraph graph;
    for (int stage = 0; stage < 2; ++stage) {
        graph.add({.name = "crowd", .count = 64, .body = [&](std::size_t, std::size_t) {
                       const int here = ++inside;
                       for (int seen = max; here > seen && !max.compare_exchange_weak(seen, here);) {
                       }
                       std::this_thread::sleep_for(std::chrono::microseconds(200));
                       --inside;
                   }});
    }
    run_once(*executor_->prepare(graph));
    EXPECT_LE(max, GetParam().threads);
}

TEST_P(EachExecutor, TwoGraphsRunConcurrently) {
    std::atomic<int> first = 0, second = 0;
    JobGraph a, b;
    a.add({.name = "a", .count = 100, .body = [&](std::size_t, std::size_t) { ++first; }});
    b.add({.name = "b", .count = 100, .body = [&](std::size_t, std::size_t) { ++second; }});
    const auto run_a = executor_->prepare(a), run_b = executor_->prepare(b);
    for (int round = 1; round <= 200; ++round) {
        run_a->schedule();
        run_b->schedule();
        // Two graphs from two threads at once, and from one thread in sequence.
        std::thread elsewhere([&] {
            if (round % 2 == 0) run_a->complete();
        });
        run_b->complete();
        elsewhere.join();
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

// A worker that is awake, asleep or about to sleep: runs in a row, after a pause, and after pauses
// near the time of spinning.
TEST_P(EachExecutor, RunsInOneCallRunEveryBlockOnce) {
    std::atomic<int> first = 0, last = 0, too_early = 0;
    JobGraph graph;
    const StageId before =
        graph.add({.name = "first", .count = 9, .body = [&](std::size_t, std::size_t) { ++first; }});
    graph.add({.name = "last", .count = 5, .waits_for = {before}, .body = [&](std::size_t, std::size_t) {
                   if (first % 9 != 0) ++too_early;
                   ++last;
               }});
    const auto run = executor_->prepare(graph);
    for (int round = 1; round <= 2000; ++round) {
        if (round % 50 == 0) std::this_thread::sleep_for(std::chrono::microseconds(round % 300));
        run->run();
        ASSERT_TRUE(run->is_done());
        ASSERT_EQ(first, 9 * round);
        ASSERT_EQ(last, 5 * round);
    }
    EXPECT_EQ(too_early, 0);
}

TEST_P(EachExecutor, RunInOneCallThrowsABodysExceptionOnce) {
    std::atomic<int> done = 0;
    JobGraph graph;
    graph.add({.name = "throws", .count = 20, .body = [&](std::size_t begin, std::size_t) {
                   if (begin == 13) throw std::runtime_error("thirteen");
                   ++done;
               }});
    const auto run = executor_->prepare(graph);
    for (int round = 1; round <= 20; ++round) {
        EXPECT_THROW(run->run(), std::runtime_error);
        run->complete();
        ASSERT_EQ(done, 19 * round);
    }
}

TEST_P(EachExecutor, WorksWithoutSpinning) {
    executor_->set_spin_us(0);
    std::atomic<int> done = 0;
    JobGraph graph;
    const StageId first = graph.add({.name = "first", .count = 6, .body = [&](std::size_t, std::size_t) { ++done; }});
    graph.add({.name = "last", .count = 6, .waits_for = {first}, .body = [&](std::size_t, std::size_t) { ++done; }});
    const auto run = executor_->prepare(graph);
    for (int round = 1; round <= 500; ++round) {
        round % 2 == 0 ? run->run() : run_once(*run);
        ASSERT_EQ(done, 12 * round);
    }
}

TEST_P(EachExecutor, CompletingAnIdleRunReturns) {
    JobGraph graph;
    graph.add({.name = "never", .count = 1, .body = [](std::size_t, std::size_t) { FAIL(); }});
    executor_->prepare(graph)->complete();
}

class ParallelExecutor : public EachExecutor {};
std::vector<ExecutorKind> kinds_with_at_least(int threads) {
    std::vector<ExecutorKind> all = executor_kinds();
    std::erase_if(all, [&](const ExecutorKind& kind) { return kind.threads < threads; });
    return all;
}
INSTANTIATE_TEST_SUITE_P(Kinds, ParallelExecutor, testing::ValuesIn(kinds_with_at_least(2)),
                         [](const auto& test) { return test.param.name; });

// The body can end only after schedule() has returned.
TEST_P(ParallelExecutor, SchedulingDoesNotBlock) {
    std::latch scheduled(1);
    JobGraph graph;
    graph.add({.name = "blocked", .count = 1, .body = [&](std::size_t, std::size_t) {
                   wait_until([&] { return scheduled.try_wait(); });
               }});
    const auto run = executor_->prepare(graph);
    run->schedule();
    EXPECT_FALSE(run->is_done());
    scheduled.count_down();
    run->complete();
    EXPECT_TRUE(run->is_done());
}

TEST_P(ParallelExecutor, WorkRunsWithoutComplete) {
    std::atomic<int> done = 0;
    JobGraph graph;
    const StageId first = graph.add({.name = "first", .count = 5, .body = [&](std::size_t, std::size_t) { ++done; }});
    graph.add({.name = "last", .count = 5, .waits_for = {first}, .body = [&](std::size_t, std::size_t) { ++done; }});
    const auto run = executor_->prepare(graph);
    run->schedule();
    EXPECT_TRUE(wait_until([&] { return run->is_done(); }));
    EXPECT_EQ(done, 10);
}

// The next run is scheduled while the worker goes to sleep. Nobody completes it, so a wake-up that
// is lost leaves it undone.
TEST_P(ParallelExecutor, NoWakeUpIsLostBetweenRuns) {
    const int rounds = is_sanitized ? 2000 : 30000;
    for (const int spin_us : {0, default_spin_us}) {
        executor_->set_spin_us(spin_us);
        JobGraph graph;
        graph.add({.name = "one", .count = 1, .body = [](std::size_t, std::size_t) {}});
        const auto run = executor_->prepare(graph);
        // A busy machine searches less; a round waits there until the worker has its turn.
        const auto enough = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        for (int round = 0; round < rounds && (round < 500 || std::chrono::steady_clock::now() < enough); ++round) {
            const auto deadline = std::chrono::steady_clock::now() + patience;
            run->schedule();
            while (!run->is_done()) {
                ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "round " << round;
                std::this_thread::yield();
            }
            for (volatile int wait = round % 300; wait > 0;) wait = wait - 1;
        }
    }
}

TEST_P(ParallelExecutor, RunsChangeNoAffinityOfThreadsOfOthers) {
    if (!has_cpu_masks()) GTEST_SKIP() << "no masks on this system";
    const std::uint64_t usable = cpus_of_this_process();
    const bool owns_workers = executor_->name() == "thread";
    const std::thread::id completing = std::this_thread::get_id();
    std::atomic<int> changed = 0;
    JobGraph graph;
    graph.add({.name = "look", .count = 4, .body = [&](std::size_t, std::size_t) {
                   const std::uint64_t lost = usable & ~cpus_of_this_process();
                   const int may_lose = owns_workers && std::this_thread::get_id() != completing ? 1 : 0;
                   if (std::popcount(lost) > may_lose) ++changed;
               }});
    const auto run = executor_->prepare(graph);
    for (int round = 0; round < 200; ++round) {
        run->schedule();
        if (round % 2 == 0) std::this_thread::sleep_for(std::chrono::microseconds(200));
        run->complete();
    }
    EXPECT_EQ(changed, 0);
    EXPECT_EQ(cpus_of_this_process(), usable);
}

// A worker of a pool stays away from one CPU at a time, a thread of others from none.
TEST(Platform, LeavingACpuTakesOneCpuAtMost) {
    if (!has_cpu_masks()) GTEST_SKIP() << "no masks on this system";
    bool has_left = false;
    std::thread([&] {
        const std::uint64_t all = cpus_of_this_process(), rest = all & (all - 1);
        if (rest == 0) return;
        const int first = std::countr_zero(all), second = std::countr_zero(rest);
        leave_cpu(first, false);
        EXPECT_EQ(cpus_of_this_process(), all);
        leave_cpu(first, true);
        has_left = cpus_of_this_process() != all;
        if (!has_left) return;
        EXPECT_EQ(cpus_of_this_process(), rest);
        leave_cpu(second, true);
        EXPECT_EQ(cpus_of_this_process(), all & ~(std::uint64_t{1} << second));
    }).join();
    if (!has_left) GTEST_SKIP() << "no second CPU, or no such function on this system";
}

/// With one worker, beside the completing thread.
class TwoThreadExecutor : public EachExecutor {};
INSTANTIATE_TEST_SUITE_P(Kinds, TwoThreadExecutor, testing::ValuesIn([] {
                             std::vector<ExecutorKind> all = executor_kinds();
                             std::erase_if(all, [](const ExecutorKind& kind) { return kind.threads != 2; });
                             return all;
                         }()),
                         [](const auto& test) { return test.param.name; });

// A run that was bound first, as that of frames, is done before the rest of a long one, as that of
// the spectrum of a later sea.
TEST_P(TwoThreadExecutor, RunBoundFirstTakesPrecedence) {
    std::latch is_scheduled(1);
    std::atomic<bool> begun = false, first_ran = false;
    std::atomic<int> too_early = 0;
    JobGraph frame, spectrum, other;
    frame.add({.name = "frame", .count = 1, .body = [&](std::size_t, std::size_t) { first_ran = true; }});
    spectrum.add({.name = "spectrum", .count = 100, .body = [&](std::size_t, std::size_t) {
                      if (begun.exchange(true)) {
                          if (!first_ran) ++too_early;
                      } else {
                          wait_until([&] { return is_scheduled.try_wait(); });
                      }
                  }});
    other.add({.name = "other", .count = 1, .body = [&](std::size_t, std::size_t) {
                   if (!first_ran) ++too_early;
               }});
    const auto frame_run = executor_->prepare(frame), spectrum_run = executor_->prepare(spectrum),
               other_run = executor_->prepare(other);
    spectrum_run->schedule();
    ASSERT_TRUE(wait_until([&] { return begun.load(); }));
    other_run->schedule();
    frame_run->schedule();
    is_scheduled.count_down();
    EXPECT_TRUE(wait_until([&] { return spectrum_run->is_done() && other_run->is_done(); }));
    EXPECT_EQ(too_early, 0);
    for (GraphRun* const run : {frame_run.get(), spectrum_run.get(), other_run.get()}) run->complete();
}

// The second stage of one chain runs while the first stage of another chain is running, as stages
// of different cascades do.
TEST_P(ParallelExecutor, StagesOfDifferentChainsOverlap) {
    std::atomic<bool> second_ran = false;
    std::atomic<int> waited_in_vain = 0;
    JobGraph graph;
    const StageId first = graph.add({.name = "first", .count = 1, .body = [](std::size_t, std::size_t) {}});
    graph.add({.name = "second", .count = 1, .waits_for = {first}, .body = [&](std::size_t, std::size_t) {
                   second_ran = true;
               }});
    graph.add({.name = "other chain", .count = 1, .body = [&](std::size_t, std::size_t) {
                   if (!wait_until([&] { return second_ran.load(); })) ++waited_in_vain;
               }});
    const auto run = executor_->prepare(graph);
    for (int round = 0; round < 20; ++round) {
        second_ran = false;
        run_once(*run);
    }
    EXPECT_EQ(waited_in_vain, 0);
}

/// One thread for each block of `stage` and one for a neighbour.
class ThreeThreadExecutor : public EachExecutor {};
INSTANTIATE_TEST_SUITE_P(Kinds, ThreeThreadExecutor, testing::ValuesIn(kinds_with_at_least(3)),
                         [](const auto& test) { return test.param.name; });

// A thread that has run its blocks of `stage` takes other work while another thread runs the last
// block. If it took `neighbour`, which here waits for `follower`, then `stage` could not end and
// `follower` would never start.
TEST_P(ThreeThreadExecutor, StageEndsWithItsLastBlockRegardlessOfItsNeighbours) {
    const int threads = GetParam().threads;
    std::latch all_busy(3);
    const auto meet = [&] {
        all_busy.count_down();
        wait_until([&] { return all_busy.try_wait(); });
    };
    std::atomic<bool> gate_ended = false, follower_ran = false;
    std::atomic<int> waited_in_vain = 0;
    JobGraph graph;
    const StageId stage = graph.add({.name = "stage", .count = 2, .body = [&](std::size_t block, std::size_t) {
                                         meet();
                                         wait_until([&] { return gate_ended.load(); });
                                         if (block == 1) std::this_thread::sleep_for(std::chrono::milliseconds(20));
                                     }});
    graph.add({.name = "follower", .count = 1, .waits_for = {stage}, .body = [&](std::size_t, std::size_t) {
                   follower_ran = true;
               }});
    const StageId gate = graph.add({.name = "gate", .count = 1, .body = [&](std::size_t, std::size_t) {
                                        meet();
                                        gate_ended = true;
                                    }});
    // As many as can wait without occupying the follower's thread.
    for (int i = 1; i < threads; ++i) {
        graph.add({.name = "neighbour", .count = 1, .waits_for = {gate}, .body = [&](std::size_t, std::size_t) {
                       if (!wait_until([&] { return follower_ran.load(); })) ++waited_in_vain;
                   }});
    }
    run_once(*executor_->prepare(graph));
    EXPECT_EQ(waited_in_vain, 0);
}

// Bodies wait for each other: as many as the limit must run concurrently, the completing thread
// included.
TEST_P(ParallelExecutor, AsManyJobsAsTheLimitRunConcurrently) {
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
    // The run keeps its threads after the executor has been destroyed.
    const auto run = executor_->prepare(graph);
    executor_.reset();
    run_once(*run);
    EXPECT_EQ(timeouts, 0);
}

// ---- Threads that take part -----------------------------------------------------------------

/// Runs whose times are known. Sharing makes each block take 1.4 times as long.
struct KnownRuns {
    SharingChoice choice;
    int shared = 0;  ///< number of runs

    void run(int count, std::int64_t alone_ns, std::int64_t shared_ns, int slow_each = 0) {
        for (int i = 0; i < count; ++i) {
            const bool is_slow = slow_each > 0 && i % slow_each == 0;
            shared += choice.shares();
            const std::int64_t time = (choice.shares() ? shared_ns : alone_ns) * (is_slow ? 20 : 1);
            choice.count(time, choice.shares() ? alone_ns * 7 / 5 : 0);
        }
    }
};

// The bounds are the trials: 8 runs after 64, 128, ... and 4096 runs.
TEST(SharingChoice, TakesTheFasterWayExceptInTrials) {
    constexpr int runs = 5000, trials = 8 * 8;
    for (const int slow_each : {0, 37}) {
        for (const auto& [alone_us, shared_us] : {std::pair{46, 90}, {46, 900}, {120, 125}, {120, 115}}) {
            KnownRuns known;
            known.run(runs, alone_us * 1000, shared_us * 1000, slow_each);
            EXPECT_LE(known.shared, trials) << alone_us << " " << shared_us;
        }
        for (const auto& [alone_us, shared_us] : {std::pair{120, 100}, {500, 330}, {500, 270}, {900, 120}}) {
            KnownRuns known;
            known.run(runs, alone_us * 1000, shared_us * 1000, slow_each);
            EXPECT_GE(known.shared, runs - trials) << alone_us << " " << shared_us;
        }
    }
}

TEST(SharingChoice, FirstAndLongRunsAreShared) {
    KnownRuns first, slow, eight_threads;
    first.run(SharingChoice::trial_runs, 1, 1000);
    EXPECT_EQ(first.shared, SharingChoice::trial_runs);
    slow.run(5000, 2'000'000, 3'000'000);  // another program takes the workers' CPUs
    EXPECT_EQ(slow.shared, 5000);
    eight_threads.run(5000, 700'000, 100'000);  // alone, a run would be a hitch
    EXPECT_EQ(eight_threads.shared, 5000);
}

TEST(SharingChoice, FollowsAChange) {
    KnownRuns known;
    known.run(5000, 120'000, 200'000);
    ASSERT_FALSE(known.choice.shares());
    known.run(SharingChoice::max_patience + SharingChoice::trial_runs, 120'000, 80'000);
    EXPECT_TRUE(known.choice.shares());
    known.run(60, 120'000, 200'000);
    EXPECT_FALSE(known.choice.shares());
}

/// Waking takes 20 us, and no worker comes.
class SleepyWorkers final : public WorkerGroup {
   public:
    SleepyWorkers() : WorkerGroup(2) {}
    int wakes = 0;

   private:
    int wake(int) noexcept override {
        ++wakes;
        const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(20);
        while (std::chrono::steady_clock::now() < end) {
        }
        return 0;
    }
};

// The bound is three trials in runs that follow each other at once, and as many in others.
TEST(WorkerGroup, TinyRunsWakeNoThreadExceptInTrials) {
    constexpr int runs = 250, max_shared = 2 * 3 * SharingChoice::trial_runs;
    const auto workers = std::make_shared<SleepyWorkers>();
    int done = 0;
    JobGraph graph;
    graph.add({.name = "tiny", .count = 8, .body = [&](std::size_t, std::size_t) { ++done; }});
    const auto run = WorkerGroup::prepare(graph, workers);
    for (int i = 0; i < runs; ++i) run->run();
    EXPECT_EQ(done, 8 * runs);
    EXPECT_GE(workers->wakes, SharingChoice::trial_runs);
    EXPECT_LE(workers->wakes, max_shared);
}

// Tests have more threads than CPUs. An application has not.
TEST(ExecutorOptions, MoreThreadsThanCpusAreNotStarted) {
    const auto restore = std::exchange(min_assumed_cpus, 1);
    const int cpus = default_thread_count();
    for (const int threads : {cpus, cpus + 1, 1024})
        for (const auto make : {make_thread_executor, make_default_executor}) {
            std::mutex mutex;
            std::set<std::thread::id> seen;
            JobGraph graph;
            graph.add({.name = "look", .count = 256, .body = [&](std::size_t, std::size_t) {
                           std::this_thread::sleep_for(std::chrono::microseconds(50));
                           const std::lock_guard lock(mutex);
                           seen.insert(std::this_thread::get_id());
                       }});
            const auto executor = make(threads);
            EXPECT_EQ(executor->thread_limit(), cpus);
            run_once(*executor->prepare(graph));
            EXPECT_LE(seen.size(), static_cast<std::size_t>(cpus));
        }
    if (threads_have_cpu_masks()) {
        const std::uint64_t usable = cpus_of_this_process();
        EXPECT_EQ(make_thread_executor_on(std::bit_floor(usable), 1024)->thread_limit(), std::min(cpus, 2));
    }
    min_assumed_cpus = restore;
}

// ---- Errors ---------------------------------------------------------------------------------

/// Writes to `bytes` bytes of the stack.
[[gnu::noinline]] int use_stack(std::size_t bytes) {
    auto* const memory = static_cast<volatile char*>(__builtin_alloca(bytes));
    for (std::size_t i = 0; i < bytes; i += 512) memory[i] = 1;
    return memory[0];
}

// With `ulimit -s 64` a program's first thread, and the threads that it starts, have no larger
// stack.
TEST_P(EachExecutor, JobsHaveTheRequestedStackSize) {
    constexpr std::size_t needed = std::size_t{3} << 20;  // more than the library's threads have
    std::atomic<int> done = 0;
    JobGraph graph;
    graph.add({.name = "deep",
               .count = 16,
               .body =
                   [&](std::size_t begin, std::size_t end) {
                       for (std::size_t i = begin; i < end; ++i) done += use_stack(needed - 64 * 1024);
                   },
               .stack_bytes = needed});
    const auto run = executor_->prepare(graph);
    JobThread application([&] { run_once(*run); }, 128 * 1024);
    application.join();
    EXPECT_EQ(done, 16);
}

// The stack of a fiber is no thread's, and its size is unknown.
TEST_P(EachExecutor, JobsHaveTheRequestedStackSizeOnAFiber) {
    if (is_sanitized) GTEST_SKIP() << "sanitizers do not know the fiber";
    constexpr std::size_t needed = std::size_t{1} << 20;
    std::atomic<int> done = 0;
    JobGraph graph;
    graph.add({.name = "deep",
               .count = 16,
               .body = [&](std::size_t, std::size_t) { done += use_stack(needed - 64 * 1024); },
               .stack_bytes = needed});
    const auto run = executor_->prepare(graph);
    run_once(*run);  // the thread's own stack has been measured
    if (!run_on_a_fiber(64 * 1024, [&] { run_once(*run); })) GTEST_SKIP() << "no fibers on this system";
    EXPECT_EQ(done, 2 * 16);
}

TEST_P(EachExecutor, CompleteThrowsABodysExceptionAfterAllBlocks) {
    std::atomic<int> done = 0;
    std::atomic<bool> throws = true;
    JobGraph graph;
    const StageId first = graph.add({.name = "throws", .count = 100, .body = [&](std::size_t begin, std::size_t) {
                                         if (throws && begin == 13) throw std::runtime_error("thirteen");
                                         ++done;
                                     }});
    graph.add({.name = "after", .count = 1, .waits_for = {first}, .body = [](std::size_t, std::size_t) {}});
    const auto run = executor_->prepare(graph);
    for (int n = 0; n < 20; ++n) {
        run->schedule();
        EXPECT_THROW(run->complete(), std::runtime_error);
        EXPECT_TRUE(run->is_done());
        run->complete();  // the exception is thrown once
    }
    executor_->prepare(graph)->schedule();  // destroyed in flight: the exception is dropped
    throws = false;
    done = 0;
    run_once(*run);
    EXPECT_EQ(done, 100);
}

// Limits the address space to a few stacks, like a process limit would; a sanitizer needs more by
// itself.
TEST(ExecutorDeathTest, FailureToStartThreadsIsAnErrorAndNotACrash) {
    if (is_sanitized) GTEST_SKIP() << "it maps terabytes";
    if (!has_address_space_limits()) GTEST_SKIP() << "no limits of address space on this system";
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    const auto ask = [](std::shared_ptr<Executor> (*make)(int)) {
        limit_address_space(std::size_t{700} << 20);
        try {
            make(1000);
        } catch (const std::system_error& error) {
            std::fprintf(stderr, "%s\n", error.what());
            std::exit(7);
        }
        std::exit(0);
    };
    const char* const line =
        "1000 threads are requested, but the system provides [0-9]+: Resource temporarily unavailable";
    EXPECT_EXIT(ask(make_thread_executor), testing::ExitedWithCode(7), line);
#if defined(PELAGIC_HAS_TBB)
    EXPECT_EXIT(ask(make_tbb_executor), testing::ExitedWithCode(7), line);
#endif
}

#if !defined(NDEBUG)  // assertions are compiled in
class MisuseDeathTest : public EachExecutor {};
INSTANTIATE_TEST_SUITE_P(Kinds, MisuseDeathTest, testing::ValuesIn(executor_kinds()),
                         [](const auto& test) { return test.param.name; });

TEST_P(MisuseDeathTest, SchedulingARunInFlightIsAsserted) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    JobGraph graph;
    graph.add({.name = "long", .count = 1, .body = [](std::size_t, std::size_t) {
                   std::this_thread::sleep_for(patience);
               }});
    const auto run = executor_->prepare(graph);
    EXPECT_DEATH((run->schedule(), run->schedule()), "schedule");
}
#endif

TEST(ExecutorOptions, BadThreadCountsThrowTheRange) {
    for (const auto make : {make_thread_executor, make_default_executor}) {
        EXPECT_EQ(message_of([&] { make(-3); }), "threads is -3, expected 0 to 1024");
        EXPECT_EQ(message_of([&] { make(1025); }), "threads is 1025, expected 0 to 1024");
    }
}

TEST(ExecutorOptions, BadSpinTimesThrowTheRange) {
    for (const auto& executor : {make_thread_executor(2), make_default_executor(2)}) {
        EXPECT_EQ(message_of([&] { executor->set_spin_us(-1); }), "spin_us is -1, expected 0 to 1000");
        EXPECT_EQ(message_of([&] { executor->set_spin_us(1001); }), "spin_us is 1001, expected 0 to 1000");
    }
}

TEST(ExecutorOptions, ZeroThreadsMeansOnePerUsableCpu) {
    const int cpus = default_thread_count();
    EXPECT_GE(cpus, 1);
    EXPECT_LE(cpus, std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
    EXPECT_EQ(make_thread_executor(0)->thread_limit(), cpus);
    EXPECT_EQ(make_default_executor(0)->thread_limit(), cpus);
}

TEST(ExecutorOptions, ZeroThreadsMeansOneOnOneCpu) {
    if (!has_cpu_masks()) GTEST_SKIP() << "no masks on this system";
    int pool = 0, fallback = 0;
    bool is_restricted = false;
    std::thread([&] {
        const std::uint64_t usable = cpus_of_this_process(), last = std::bit_floor(usable);
        keep_this_thread_on_cpus(last);
        is_restricted = last != 0 && cpus_of_this_process() == last;  // Windows restricts processes
        pool = make_thread_executor(0)->thread_limit();
        fallback = make_default_executor(0)->thread_limit();
    }).join();
    if (!is_restricted) GTEST_SKIP() << "threads inherit no mask on this system";
    EXPECT_EQ(pool, 1);
    EXPECT_EQ(fallback, 1);
}

#if defined(__linux__)
TEST(CpuQuota, SmallestLimitOfAllGroupsIsRoundedUp) {
    const std::filesystem::path root = std::filesystem::path(testing::TempDir()) / "pelagic_cpu_quota";
    const auto write = [&](const std::string& path, const std::string& text) {
        const std::filesystem::path file = root / path;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file) << text;
    };
    std::filesystem::remove_all(root);
    EXPECT_EQ(cpus_of_quota(root.string()), 0);
    write("proc/self/cgroup", "0::/kube/pod/app\n");
    write("sys/fs/cgroup/kube/pod/app/cpu.max", "max 100000\n");
    EXPECT_EQ(cpus_of_quota(root.string()), 0);
    write("sys/fs/cgroup/kube/cpu.max", "250000 100000\n");
    EXPECT_EQ(cpus_of_quota(root.string()), 3);
    write("sys/fs/cgroup/kube/pod/app/cpu.max", "25000 50000\n");
    EXPECT_EQ(cpus_of_quota(root.string()), 1);
    // version 1; the path is one of the host, and a container sees its own group at the top
    write("proc/self/cgroup", "9:cpuset:/docker/1\n4:cpu,cpuacct:/docker/1\n0::/\n");
    write("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1\n");
    write("sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(cpus_of_quota(root.string()), 0);
    write("sys/fs/cgroup/cpu/cpu.cfs_quota_us", "400000\n");
    EXPECT_EQ(cpus_of_quota(root.string()), 4);
    std::filesystem::remove_all(root);
}
#endif

TEST(ExecutorOptions, MaskOfCoresMustContainAnAvailableCore) {
    if (!threads_have_cpu_masks()) GTEST_SKIP() << "no masks on this system";
    EXPECT_EQ(make_thread_executor_on(~std::uint64_t{0}, 3)->thread_limit(), 3);
    EXPECT_GE(make_thread_executor_on(~std::uint64_t{0})->thread_limit(), 1);
    if (std::thread::hardware_concurrency() < 64) {
        EXPECT_EQ(message_of([] { make_thread_executor_on(std::uint64_t{1} << 63); }),
                  "cpu_mask is 0x8000000000000000, expected a CPU that this process may use");
    }
}

TEST(ThreadExecutor, ThreadsStayOnTheMasksCores) {
    if (!threads_have_cpu_masks()) GTEST_SKIP() << "no masks on this system";
    const int last = 63 - std::countl_zero(cpus_of_this_process());
    if (last < 0) GTEST_SKIP() << "no CPU below 64 may be used";
    const std::thread::id completing = std::this_thread::get_id();
    std::atomic<int> elsewhere = 0;
    JobGraph graph;
    graph.add({.name = "look", .count = 64, .body = [&](std::size_t, std::size_t) {
                   std::this_thread::sleep_for(std::chrono::microseconds(100));
                   if (std::this_thread::get_id() != completing && cpu_of_this_thread() != last) ++elsewhere;
               }});
    run_once(*make_thread_executor_on(std::uint64_t{1} << last, 3)->prepare(graph));
    EXPECT_EQ(elsewhere, 0);
}

TEST(ExecutorOptions, ApplicationsJobsAreChecked) {
    EXPECT_EQ(message_of([] { make_callback_executor({}); }), "parallel_for is null; expected a function");
    TestApplication application;
    ApplicationJobs jobs = application.jobs();
    jobs.threads = 0;
    EXPECT_EQ(message_of([&] { make_callback_executor(jobs); }), "threads is 0, expected 1 to 1024");
}

TEST(CallbackExecutor, RunsStagesInOrderAThousandTimes) {
    TestApplication application;
    std::atomic<std::size_t> first_done = 0;
    std::atomic<int> too_early = 0, last_done = 0;
    JobGraph graph;
    const StageId first =
        graph.add({.name = "first", .count = 5, .body = [&](std::size_t, std::size_t) { ++first_done; }});
    graph.add({.name = "last", .count = 3, .waits_for = {first}, .body = [&](std::size_t, std::size_t) {
                   if (first_done != 5) ++too_early;
                   ++last_done;
               }});
    const auto run = make_callback_executor(application.jobs())->prepare(graph);
    for (int round = 1; round <= 1000; ++round) {
        first_done = 0;
        run_once(*run);
        ASSERT_TRUE(run->is_done());
        ASSERT_EQ(last_done, 3 * round);
    }
    EXPECT_EQ(too_early, 0);
}

TEST(CallbackExecutor, WorkRunsWithoutComplete) {
    TestApplication application;
    std::atomic<int> done = 0;
    JobGraph graph;
    graph.add({.name = "some", .count = 5, .body = [&](std::size_t, std::size_t) { ++done; }});
    const auto run = make_callback_executor(application.jobs())->prepare(graph);
    run->schedule();
    EXPECT_TRUE(wait_until([&] { return run->is_done(); }));
    EXPECT_EQ(done, 5);
}

TEST(SlicedExecutor, SliceWithoutABudgetIsOneJobInSchedulingOrder) {
    const auto executor = make_sliced_executor();
    std::string done;
    const auto graph_of = [&](char name) {
        JobGraph graph;
        graph.add({.name = "none", .count = 0, .body = [](std::size_t, std::size_t) { FAIL(); }});
        graph.add({.name = "two", .count = 3, .batch = 2, .body = [&done, name](std::size_t begin, std::size_t) {
                       done += name;
                       done += std::to_string(begin);
                   }});
        return graph;
    };
    const JobGraph a = graph_of('a'), b = graph_of('b');
    const auto run_a = executor->prepare(a), run_b = executor->prepare(b);
    EXPECT_TRUE(executor->advance({}));
    run_b->schedule();
    run_a->schedule();
    EXPECT_FALSE(executor->advance({}));
    EXPECT_EQ(done, "b0");
    EXPECT_FALSE(run_b->is_done());
    EXPECT_FALSE(executor->advance({}));
    EXPECT_TRUE(run_b->is_done());
    EXPECT_FALSE(executor->advance({}));
    EXPECT_TRUE(executor->advance({}));
    EXPECT_TRUE(run_a->is_done());
    EXPECT_EQ(done, "b0b2a0a2");
}

TEST(SlicedExecutor, LargeBudgetRunsAllJobs) {
    const auto executor = make_sliced_executor();
    int done = 0;
    JobGraph graph;
    graph.add({.name = "many", .count = 1000, .body = [&](std::size_t, std::size_t) { ++done; }});
    const auto run = executor->prepare(graph);
    run->schedule();
    EXPECT_TRUE(executor->advance(patience));
    EXPECT_EQ(done, 1000);
}

TEST(SlicedExecutor, CompletingRunsTheRemainingJobs) {
    const auto executor = make_sliced_executor();
    std::vector<std::size_t> done;
    JobGraph graph;
    graph.add({.name = "some", .count = 5, .body = [&](std::size_t i, std::size_t) { done.push_back(i); }});
    auto run = executor->prepare(graph);
    run->schedule();
    executor->advance({});
    run->complete();
    EXPECT_EQ(done, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
    run->schedule();
    executor->advance({});
    run.reset();  // also waits for work in flight, and leaves nothing to advance
    EXPECT_EQ(done.size(), 10u);
    EXPECT_TRUE(executor->advance({}));
}

TEST(SlicedExecutor, ExceptionInAJobDoesNotEndASlice) {
    const auto executor = make_sliced_executor();
    JobGraph graph;
    graph.add({.name = "throws", .count = 3, .body = [](std::size_t begin, std::size_t) {
                   if (begin == 1) throw std::runtime_error("one");
               }});
    const auto run = executor->prepare(graph);
    run->schedule();
    EXPECT_TRUE(executor->advance(patience));
    EXPECT_THROW(run->complete(), std::runtime_error);
}

TEST(ExecutorOptions, DefaultIsOneTbbIfItIsBuilt) {
#if defined(PELAGIC_HAS_TBB)
    EXPECT_EQ(make_default_executor(2)->name(), "tbb");
#else
    EXPECT_EQ(make_default_executor(2)->name(), "thread");
#endif
    EXPECT_EQ(make_default_executor(2)->thread_limit(), 2);
}

TEST(JobGraph, BadStagesThrowTheReasonAndAreNotAdded) {
    JobGraph graph;
    const JobBody nothing = [](std::size_t, std::size_t) {};
    EXPECT_EQ(message_of([&] { graph.add({.name = "rows", .count = 1, .batch = 0, .body = nothing}); }),
              "stage rows has a batch of 0, expected at least 1");
    EXPECT_EQ(message_of([&] { graph.add({.name = "rows", .count = 1, .body = {}}); }), "stage rows has no body");
    EXPECT_EQ(message_of([&] { graph.add({.name = "rows", .count = 1, .waits_for = {0}, .body = nothing}); }),
              "stage rows waits for stage number 0, expected one of the 0 added before it");
    EXPECT_EQ(graph.add({.name = "good", .count = 1, .body = nothing}), 0u);
}

}  // namespace
}  // namespace pelagic
