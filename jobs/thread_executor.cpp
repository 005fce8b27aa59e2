// A pool of threads that claim blocks of ready stages, one at a time, under one mutex. A claim
// takes 0.1 microseconds and a job 5 or more, so the mutex is rarely contended.
#include <algorithm>
#include <atomic>
#include <cassert>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "pelagic/jobs/cpu_mask.hpp"
#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/job_thread.hpp"
#include "pelagic/jobs/run_failure.hpp"
#include "pelagic/jobs/thread_count.hpp"
#include "pelagic/message/number_text.hpp"

namespace pelagic {
namespace {

/// Hints to the core that this thread spins.
void pause() {
#if defined(__x86_64__)
    _mm_pause();
#elif defined(__aarch64__)
    __asm__ __volatile__("yield");
#endif
}

struct Block {
    StageId stage;
    std::size_t number;
};

/// The progress of one run of a graph. The pool's mutex guards all members but `remaining_stages_`.
class Progress {
   public:
    explicit Progress(const JobGraph& graph) : graph_(graph), stages_(graph.stages().size()) {
        for (StageId id = 0; id < stages_.size(); ++id)
            for (const StageId earlier : graph.stages()[id].waits_for) stages_[earlier].followers.push_back(id);
    }

    void start() {
        remaining_stages_ = stages_.size();
        for (StageId id = 0; id < stages_.size(); ++id) {
            stages_[id].waiting_for = graph_.stages()[id].waits_for.size();
            stages_[id].claimed = stages_[id].done = 0;
        }
        for (StageId id = 0; id < stages_.size(); ++id)
            if (graph_.stages()[id].waits_for.empty()) end_stage_if_empty(id);
    }

    /// Claims a block that is ready to run, if there is one.
    std::optional<Block> claim() {
        for (StageId id = 0; id < stages_.size(); ++id) {
            State& stage = stages_[id];
            if (stage.waiting_for == 0 && stage.claimed < block_count(graph_.stages()[id]))
                return Block{id, stage.claimed++};
        }
        return {};
    }

    void run(Block block) noexcept {
        try {
            run_block(graph_.stages()[block.stage], block.number);
        } catch (...) {
            failure_.keep_current();
        }
    }

    /// Counts the block as done. Returns true if it was the last of its stage, so that other stages
    /// may have become ready.
    bool end(Block block) {
        if (++stages_[block.stage].done < block_count(graph_.stages()[block.stage])) return false;
        end_stage(block.stage);
        return true;
    }

    bool is_done() const { return remaining_stages_ == 0; }

    /// Throws the first exception of the run's blocks, if there is one. \pre is_done()
    void rethrow_failure() { failure_.rethrow(); }

   private:
    struct State {
        std::vector<StageId> followers;
        std::size_t waiting_for = 0;
        std::size_t claimed = 0;
        std::size_t done = 0;
    };

    void end_stage(StageId id) {
        for (const StageId follower : stages_[id].followers)
            if (--stages_[follower].waiting_for == 0) end_stage_if_empty(follower);
        --remaining_stages_;
    }

    void end_stage_if_empty(StageId id) {
        if (graph_.stages()[id].count == 0) end_stage(id);
    }

    const JobGraph& graph_;
    std::vector<State> stages_;
    std::atomic<std::size_t> remaining_stages_ = 0;
    RunFailure failure_;
};

/// The threads of the pool and all runs bound to it.
class Pool {
   public:
    // Delegates to Pool(), so that ~Pool joins the started threads if the system does not create
    // one.
    Pool(int threads, std::uint64_t cpu_mask) : Pool() {
        if (threads <= static_cast<int>(std::thread::hardware_concurrency())) max_spins_ = 2000;
        threads_.reserve(static_cast<std::size_t>(threads));
        try {
            for (int i = 1; i < threads; ++i)
                threads_.emplace_back([this, cpu_mask] {
                    keep_this_thread_on(cpu_mask);
                    work();
                });
        } catch (const std::system_error& error) {
            throw std::system_error(
                error.code(),
                number_text(threads) + " threads are wanted, and the system gives " + number_text(thread_count()));
        }
    }

    ~Pool() {
        {
            const std::lock_guard lock(mutex_);
            stopping_ = true;
            announce_change();
        }
        for (JobThread& thread : threads_) thread.join();
    }

    int thread_count() const { return static_cast<int>(threads_.size()) + 1; }

    void add(Progress& run) {
        const std::lock_guard lock(mutex_);
        runs_.push_back(&run);
    }

    void remove(Progress& run) {
        const std::lock_guard lock(mutex_);
        std::erase(runs_, &run);
    }

    void start(Progress& run) {
        const std::lock_guard lock(mutex_);
        run.start();
        announce_change();
    }

    /// Works on `run` until it is done.
    void finish(Progress& run) {
        std::unique_lock lock(mutex_);
        while (!run.is_done()) {
            if (const auto block = run.claim())
                run_unlocked(run, *block, lock);
            else
                wait_for_change(lock);
        }
    }

   private:
    Pool() = default;

    void work() {
        std::unique_lock lock(mutex_);
        while (!stopping_)
            if (!work_on_any_run(lock)) wait_for_change(lock);
    }

    /// Spins for a while before it sleeps, because stages follow each other within microseconds and
    /// waking a thread takes longer. Does not spin if there are more threads than cores, where it
    /// would delay others.
    void wait_for_change(std::unique_lock<std::mutex>& lock) {
        const std::size_t seen = changes_;
        lock.unlock();
        for (int spin = 0; spin < max_spins_ && changes_ == seen; ++spin) pause();
        lock.lock();
        changed_.wait(lock, [&] { return changes_ != seen; });
    }

    /// \pre the mutex is locked
    void announce_change() {
        ++changes_;
        changed_.notify_all();
    }

    bool work_on_any_run(std::unique_lock<std::mutex>& lock) {
        for (Progress* run : runs_) {
            if (run->is_done()) continue;
            if (const auto block = run->claim()) {
                run_unlocked(*run, *block, lock);
                return true;
            }
        }
        return false;
    }

    void run_unlocked(Progress& run, Block block, std::unique_lock<std::mutex>& lock) {
        lock.unlock();
        run.run(block);
        lock.lock();
        if (run.end(block)) announce_change();
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::atomic<std::size_t> changes_ = 0;  ///< count of announced changes; written under the mutex
    int max_spins_ = 0;
    bool stopping_ = false;
    std::vector<Progress*> runs_;
    std::vector<JobThread> threads_;
};

class ThreadRun final : public GraphRun {
   public:
    ThreadRun(const JobGraph& graph, std::shared_ptr<Pool> pool) : pool_(std::move(pool)), progress_(graph) {
        pool_->add(progress_);
    }
    ~ThreadRun() override {
        pool_->finish(progress_);
        pool_->remove(progress_);
    }

    void schedule() override {
        assert(is_done());
        pool_->start(progress_);
    }
    void complete() override {
        pool_->finish(progress_);
        progress_.rethrow_failure();
    }
    bool is_done() const override { return progress_.is_done(); }

   private:
    std::shared_ptr<Pool> pool_;
    Progress progress_;
};

class ThreadExecutor final : public Executor {
   public:
    ThreadExecutor(int threads, std::uint64_t cpu_mask) : pool_(std::make_shared<Pool>(threads, cpu_mask)) {}
    std::unique_ptr<GraphRun> prepare(const JobGraph& graph) override {
        return std::make_unique<ThreadRun>(graph, pool_);
    }
    int thread_limit() const override { return pool_->thread_count(); }
    std::string_view name() const override { return "thread"; }

   private:
    std::shared_ptr<Pool> pool_;
};

}  // namespace

std::shared_ptr<Executor> make_thread_executor(int threads) { return make_thread_executor_on(0, threads); }

std::shared_ptr<Executor> make_thread_executor_on(std::uint64_t cpu_mask, int threads) {
    const int wanted = checked_thread_count(threads);
    const int cpus = checked_cpus(cpu_mask);
    return std::make_shared<ThreadExecutor>(threads == 0 && cpu_mask != 0 ? cpus : wanted, cpu_mask);
}

}  // namespace pelagic
