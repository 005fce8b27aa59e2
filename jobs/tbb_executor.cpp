// Executor on oneTBB: one flow graph node per stage, with a parallel loop in each node.
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <atomic>
#include <cassert>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/job_thread.hpp"
#include "pelagic/jobs/run_failure.hpp"
#include "pelagic/jobs/thread_count.hpp"

namespace pelagic {
namespace {

using tbb::flow::continue_msg;

/// A flow graph in a separate arena. A thread that completes one graph therefore never runs jobs of
/// another graph, and the reserved slot is always free for it.
class TbbRun final : public GraphRun {
   public:
    TbbRun(const JobGraph& graph, int threads) : arena_(threads, 1) {
        // A flow graph enqueues its tasks in the arena in which it was constructed.
        arena_.execute([&] { build(graph); });
    }
    ~TbbRun() override { finish(); }

    void schedule() override {
        assert(is_done());
        remaining_stages_ = nodes_.size();
        try {
            arena_.execute([&] { start_->try_put(continue_msg()); });
        } catch (...) {
            remaining_stages_ = 0;
            throw;
        }
    }
    void complete() override {
        finish();
        failure_.rethrow();
    }
    bool is_done() const override { return remaining_stages_ == 0; }

   private:
    using Node = tbb::flow::continue_node<continue_msg>;

    void finish() {
        arena_.execute([&] { flow_->wait_for_all(); });
    }

    void build(const JobGraph& graph) {
        flow_.emplace();
        start_.emplace(*flow_);
        for (const Stage& stage : graph.stages()) {
            Node& node = nodes_.emplace_back(*flow_, [this, &stage](const continue_msg&) { run(stage); });
            if (stage.waits_for.empty()) tbb::flow::make_edge(*start_, node);
            for (const StageId earlier : stage.waits_for) tbb::flow::make_edge(nodes_[earlier], node);
        }
    }

    /// Catches every exception, because oneTBB would cancel the graph's other nodes.
    void run(const Stage& stage) {
        try {
            const std::size_t blocks = block_count(stage);
            if (blocks == 1)
                run_block(stage, 0);
            else if (blocks > 1)
                tbb::this_task_arena::isolate([&] { run_blocks(stage, blocks); });
        } catch (...) {
            failure_.keep_current();
        }
        --remaining_stages_;
    }

    /// The caller isolates this function. Otherwise a thread that waits here for the last blocks
    /// would run another stage on the same stack, and would delay the stages that wait for this
    /// stage.
    static void run_blocks(const Stage& stage, std::size_t blocks) {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, blocks, 1),
            [&stage](const tbb::blocked_range<std::size_t>& range) {
                for (std::size_t block = range.begin(); block < range.end(); ++block) run_block(stage, block);
            },
            tbb::simple_partitioner());
    }

    tbb::task_arena arena_;
    std::optional<tbb::flow::graph> flow_;
    std::optional<tbb::flow::broadcast_node<continue_msg>> start_;
    std::deque<Node> nodes_;
    std::atomic<std::size_t> remaining_stages_ = 0;
    RunFailure failure_;
};

// The stack size of oneTBB's workers on 64-bit systems, 4 MiB, and its guard page.
constexpr std::size_t worker_stack_bytes = (std::size_t{4} << 20) + 64 * 1024;

/// Raises oneTBB's limit, which by default is the number of cores that the process may use. The
/// smallest of several global_control objects applies, so the program has one, with the largest
/// count requested.
void allow_threads(int threads) {
    static std::mutex mutex;
    static int allowed = tbb::info::default_concurrency();
    static std::unique_ptr<tbb::global_control> control;
    static int proven = 1;
    const std::lock_guard lock(mutex);
    // oneTBB ends the program if the system does not create a thread. It creates threads on demand
    // and keeps them. A count that was available once stays available unless other programs use the
    // threads.
    if (threads > proven) {
        need_threads(threads, worker_stack_bytes);
        proven = threads;
    }
    if (threads <= allowed) return;
    control.reset();
    control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads);
    allowed = threads;
}

class TbbExecutor final : public Executor {
   public:
    explicit TbbExecutor(int threads) : threads_(threads) { allow_threads(threads); }
    std::unique_ptr<GraphRun> prepare(const JobGraph& graph) override {
        return std::make_unique<TbbRun>(graph, threads_);
    }
    int thread_limit() const override { return threads_; }
    std::string_view name() const override { return "tbb"; }

   private:
    int threads_;
};

}  // namespace

std::shared_ptr<Executor> make_tbb_executor(int threads) {
    const int wanted = checked_thread_count(threads);
    return std::make_shared<TbbExecutor>(threads == 0 ? tbb::info::default_concurrency() : wanted);
}

}  // namespace pelagic
