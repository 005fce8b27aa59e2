// Executor on the threads of oneTBB.
#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/job_thread.hpp"
#include "pelagic/jobs/thread_count.hpp"
#include "pelagic/jobs/worker_group.hpp"

namespace pelagic {
namespace {

/// Threads of oneTBB that work in an arena. One slot of the arena is reserved for the thread that
/// destroys the group.
class ArenaWorkers final : public WorkerGroup {
   public:
    explicit ArenaWorkers(int threads) : WorkerGroup(threads), arena_(threads, 1) {
        // A graph waits in the arena of its constructor. In another arena that is full, such as
        // that of an application's loop, wait_for_all() would need a worker, and with one worker no
        // thread would run the tasks.
        arena_.execute([this] { tasks_.emplace(); });
    }
    /// Waits until all tasks have ended, and runs those that no thread has begun.
    ~ArenaWorkers() override {
        arena_.execute([this] { tasks_->wait_for_all(); });
    }

   private:
    int wake(int count) noexcept override {
        for (int woken = 0; woken < count; ++woken) {
            tasks_->reserve_wait();
            try {
                arena_.enqueue([this] {
                    work(tbb::this_task_arena::current_thread_index());
                    tasks_->release_wait();
                });
            } catch (...) {  // no memory for a task
                tasks_->release_wait();
                return woken;
            }
        }
        return count;
    }

    tbb::task_arena arena_;
    std::optional<tbb::flow::graph> tasks_;  ///< counts tasks; it has no nodes
};

// The stack size of oneTBB's workers on 64-bit systems, 4 MiB, and its guard page.
constexpr std::size_t worker_stack_bytes = (std::size_t{4} << 20) + 64 * 1024;

/// oneTBB ends the program if the system does not create a thread. It creates threads on demand and
/// keeps them. A count that was available once stays available unless other programs use the
/// threads.
void check_threads(int threads) {
    static std::mutex mutex;
    static int proven = 1;
    const std::lock_guard lock(mutex);
    if (threads <= proven) return;
    need_threads(threads, worker_stack_bytes);
    proven = threads;
}

class TbbExecutor final : public Executor {
   public:
    explicit TbbExecutor(int threads) {
        check_threads(threads);
        workers_ = std::make_shared<ArenaWorkers>(threads);
    }
    std::unique_ptr<GraphRun> prepare(const JobGraph& graph) override {
        return WorkerGroup::prepare(graph, workers_);
    }
    int thread_limit() const override { return workers_->threads(); }
    std::string_view name() const override { return "tbb"; }
    void set_spin_us(int us) override { workers_->set_spin_us(checked_spin_us(us)); }

   private:
    std::shared_ptr<ArenaWorkers> workers_;
};

}  // namespace

std::shared_ptr<Executor> make_tbb_executor(int threads) {
    // oneTBB has no more threads than CPUs of the affinity.
    const int cpus = std::min(default_thread_count(), tbb::info::default_concurrency());
    return std::make_shared<TbbExecutor>(checked_thread_count(threads, cpus));
}

}  // namespace pelagic
