#include "pelagic/jobs/sliced_executor.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <deque>
#include <mutex>

#include "pelagic/jobs/run_failure.hpp"

namespace pelagic {
namespace {

class SlicedRun;

/// Runs in flight, in the order in which they were scheduled.
class Queue {
   public:
    void push(SlicedRun& run) {
        const std::lock_guard lock(mutex_);
        runs_.push_back(&run);
    }
    void remove(SlicedRun& run) {
        const std::lock_guard lock(mutex_);
        runs_.erase(std::remove(runs_.begin(), runs_.end(), &run), runs_.end());
    }
    SlicedRun* first() {
        const std::lock_guard lock(mutex_);
        return runs_.empty() ? nullptr : runs_.front();
    }

   private:
    std::mutex mutex_;
    std::deque<SlicedRun*> runs_;
};

/// A run and the position of its next job.
class SlicedRun final : public GraphRun {
   public:
    SlicedRun(const JobGraph& graph, std::shared_ptr<Queue> queue) : graph_(graph), queue_(std::move(queue)) {}
    ~SlicedRun() override { finish(); }

    void schedule() override {
        assert(!scheduled_);
        scheduled_ = true;
        stage_ = block_ = 0;
        queue_->push(*this);
        leave_empty_stages();
    }

    void complete() override {
        finish();
        failure_.rethrow();
    }

    bool is_done() const override { return !scheduled_; }

    /// \pre the run is scheduled
    void run_next_job() noexcept {
        try {
            run_block(graph_.stages()[stage_], block_);
        } catch (...) {
            failure_.keep_current();
        }
        ++block_;
        leave_empty_stages();
    }

   private:
    /// Advances to the next stage with a job. Ends the run if there is none.
    void leave_empty_stages() {
        for (; stage_ < graph_.stages().size(); ++stage_, block_ = 0)
            if (block_ < block_count(graph_.stages()[stage_])) return;
        queue_->remove(*this);
        scheduled_ = false;
    }

    void finish() noexcept {
        while (scheduled_) run_next_job();
    }

    const JobGraph& graph_;
    std::shared_ptr<Queue> queue_;
    RunFailure failure_;
    std::size_t stage_ = 0, block_ = 0;  ///< position of the next job
    std::atomic<bool> scheduled_ = false;
};

class QueueExecutor final : public SlicedExecutor {
   public:
    std::unique_ptr<GraphRun> prepare(const JobGraph& graph) override {
        return std::make_unique<SlicedRun>(graph, queue_);
    }
    int thread_limit() const override { return 1; }
    std::string_view name() const override { return "sliced"; }

    bool advance(std::chrono::nanoseconds budget) override {
        const auto end = std::chrono::steady_clock::now() + budget;
        SlicedRun* run = queue_->first();
        if (!run) return true;
        do {
            run->run_next_job();
            run = queue_->first();
        } while (run && std::chrono::steady_clock::now() < end);
        return !run;
    }

   private:
    std::shared_ptr<Queue> queue_ = std::make_shared<Queue>();
};

}  // namespace

std::shared_ptr<SlicedExecutor> make_sliced_executor() { return std::make_shared<QueueExecutor>(); }

}  // namespace pelagic
