// The oneTBB executor in an application that uses oneTBB, too.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <chrono>
#include <future>

#include "pelagic/jobs/executor.hpp"

namespace pelagic {
namespace {

// The application's arena is full, as that of the main loop of Blender on one of two cores, and
// oneTBB has one worker. The run ends before the worker has begun its task.
TEST(TbbExecutor, IsDestroyedInAFullArenaOfTheApplication) {
    constexpr int rounds = 1000, blocks = 64;
    const tbb::global_control one_worker(tbb::global_control::max_allowed_parallelism, 2);
    tbb::task_arena application(1);
    std::atomic<int> done = 0;
    application.execute([&] {
        for (int round = 0; round < rounds; ++round) {
            const auto executor = make_tbb_executor(2);
            JobGraph graph;
            graph.add({.name = "blocks", .count = blocks, .body = [&](std::size_t, std::size_t) { ++done; }});
            executor->prepare(graph)->run();
            const auto run = executor->prepare(graph);
            run->schedule();
            run->complete();
        }
    });
    EXPECT_EQ(done, 2 * rounds * blocks);
}

// The application keeps the only worker of oneTBB busy, so that no worker begins the run's tasks.
TEST(TbbExecutor, IsDestroyedInAFullArenaWithoutAWorker) {
    const tbb::global_control one_worker(tbb::global_control::max_allowed_parallelism, 2);
    tbb::task_arena application(1), elsewhere(2);
    std::promise<void> begun, destroyed, ended;
    std::atomic<bool> waited_in_vain = false;
    elsewhere.enqueue([&] {
        begun.set_value();
        waited_in_vain = destroyed.get_future().wait_for(std::chrono::seconds(20)) != std::future_status::ready;
        ended.set_value();
    });
    begun.get_future().wait();
    std::atomic<int> done = 0;
    application.execute([&] {
        JobGraph graph;
        graph.add({.name = "blocks", .count = 9, .body = [&](std::size_t, std::size_t) { ++done; }});
        const auto run = make_tbb_executor(2)->prepare(graph);
        run->schedule();
        run->complete();
    });
    destroyed.set_value();
    ended.get_future().wait();
    EXPECT_FALSE(waited_in_vain);
    EXPECT_EQ(done, 9);
}

}  // namespace
}  // namespace pelagic
