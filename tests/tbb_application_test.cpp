// The oneTBB executor in an application that uses oneTBB, too.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>

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

}  // namespace
}  // namespace pelagic
