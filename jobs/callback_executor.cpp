// Graphs on an application's own job system, which knows two things: a parallel loop, and "do this soon".
//
// A submitted task and complete() both offer to do the run's work; whoever comes first does it, and the other one
// returns or waits. So an application that is slow to start a task never holds up a frame, and a task that comes late finds
// nothing to do, or begins the next run, which is as welcome.
//
// Applications make mistakes, and here they would be somebody else's memory. So each block is done once, however often and
// whenever it is called; what a loop leaves undone is done by us; no exception of a job gets into the application's frames; and
// tasks don't hold a pointer but the number of their run, which leads nowhere once that is gone.
#include <atomic>
#include <cassert>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/platform.hpp"
#include "pelagic/jobs/run_failure.hpp"
#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic {
namespace {

/// The blocks of one stage as the application's loop sees them.
class ApplicationLoop {
   public:
    /// Closed: until open() every block counts as taken.
    ApplicationLoop(const Stage& stage, RunFailure& failure)
        : stage_(stage),
          failure_(failure),
          taken_(block_count(stage)),
          done_(static_cast<std::uint32_t>(taken_.size())) {
        for (std::atomic<bool>& taken : taken_) taken = true;
    }

    std::size_t blocks() const { return taken_.size(); }

    void open() {
        done_ = 0;
        for (std::atomic<bool>& taken : taken_) taken = false;
    }

    /// Does what the application left undone and waits for what is still being done. False if there was any.
    bool close() {
        const bool application_did_all = done_ == blocks();
        for (std::size_t block = 0; block < blocks(); ++block) do_once(block);
        for (std::uint32_t now = done_; now != blocks(); now = done_) wait_while(done_, now);
        return application_did_all;
    }

    /// What the application's loop calls.
    static void job(void* loop, std::size_t block) { static_cast<ApplicationLoop*>(loop)->do_once(block); }

   private:
    void do_once(std::size_t block) noexcept {
        if (block >= blocks() || taken_[block].exchange(true)) return;
        try {
            run_block(stage_, block);
        } catch (...) {
            failure_.keep_current();
        }
        if (++done_ == blocks()) wake_all(done_);
    }

    const Stage& stage_;
    RunFailure& failure_;
    std::vector<std::atomic<bool>> taken_;
    std::atomic<std::uint32_t> done_;
};

/// What a run and its tasks share: it lives until the last of them is gone.
class ApplicationWork {
   public:
    ApplicationWork(const JobGraph& graph, const ApplicationJobs& jobs) : jobs_(jobs) {
        loops_.reserve(graph.stages().size());
        for (const Stage& stage : graph.stages())
            loops_.push_back(std::make_unique<ApplicationLoop>(stage, failure_));
    }

    /// \param number  what run_task() knows it by
    void schedule(std::uintptr_t number) {
        state_ = waiting;
        if (!jobs_.submit) return;
        // Kept until complete(): the task may have been taken in spite of the exception.
        call("submit", [&] { jobs_.submit(jobs_.user, &run_task, reinterpret_cast<void*>(number)); });
    }

    void finish() {
        begin_if_waiting();
        // No mutex: wake_all() is the last that a worker does with the state, and it holds on to this object.
        for (std::uint32_t now = state_; now != done; now = state_) wait_while(state_, now);
    }

    void rethrow_failure() { failure_.rethrow(); }
    bool is_done() const { return state_ == done; }

    void begin_if_waiting() {
        std::uint32_t expected = waiting;
        if (!state_.compare_exchange_strong(expected, running)) return;
        for (const auto& loop : loops_) run(*loop);
        state_ = done;
        wake_all(state_);
    }

   private:
    enum State : std::uint32_t { waiting, running, done };

    static void run_task(void* number);

    void run(ApplicationLoop& loop) {
        loop.open();
        if (loop.blocks() > 1)
            call("parallel_for",
                 [&] { jobs_.parallel_for(jobs_.user, loop.blocks(), &ApplicationLoop::job, &loop); });
        if (!loop.close() && loop.blocks() > 1) fail("parallel_for returned before all of its jobs were done");
    }

    template <class Call>
    void call(const std::string& function, Call application) {
        try {
            application();
        } catch (const std::exception& error) {
            fail(function + " threw an exception: " + error.what());
        } catch (...) {
            fail(function + " threw an exception");
        }
    }

    void fail(const std::string& reason) { failure_.keep(std::make_exception_ptr(ApplicationJobsError(reason))); }

    const ApplicationJobs jobs_;
    RunFailure failure_;
    /// One a stage, in order; they refer to the graph, and only who began a run touches them, for which the run waits.
    std::vector<std::unique_ptr<ApplicationLoop>> loops_;
    std::atomic<std::uint32_t> state_ = done;
};

/// The runs that there are, by a number that no other ever has.
class LiveRuns {
   public:
    std::uintptr_t add(const std::shared_ptr<ApplicationWork>& work) {
        const std::lock_guard lock(mutex_);
        runs_.emplace(++last_, work);
        return last_;
    }
    void remove(std::uintptr_t number) {
        const std::lock_guard lock(mutex_);
        runs_.erase(number);
    }
    /// None if it is gone.
    std::shared_ptr<ApplicationWork> find(std::uintptr_t number) {
        const std::lock_guard lock(mutex_);
        const auto found = runs_.find(number);
        return found == runs_.end() ? nullptr : found->second;
    }

   private:
    std::mutex mutex_;
    std::uintptr_t last_ = 0;
    std::map<std::uintptr_t, std::shared_ptr<ApplicationWork>> runs_;
};

/// Never destroyed: tasks may come at any time.
LiveRuns& live_runs() {
    static LiveRuns& runs = *new LiveRuns;
    return runs;
}

void ApplicationWork::run_task(void* number) {
    if (const auto work = live_runs().find(reinterpret_cast<std::uintptr_t>(number))) work->begin_if_waiting();
}

class ApplicationRun final : public GraphRun {
   public:
    ApplicationRun(const JobGraph& graph, const ApplicationJobs& jobs)
        : work_(std::make_shared<ApplicationWork>(graph, jobs)), number_(live_runs().add(work_)) {}
    ~ApplicationRun() override {
        work_->finish();
        live_runs().remove(number_);
    }
    ApplicationRun(const ApplicationRun&) = delete;
    ApplicationRun& operator=(const ApplicationRun&) = delete;

    void schedule() override {
        assert(is_done());
        work_->schedule(number_);
    }
    void complete() override {
        work_->finish();
        work_->rethrow_failure();
    }
    bool is_done() const override { return work_->is_done(); }

   private:
    std::shared_ptr<ApplicationWork> work_;
    std::uintptr_t number_;
};

class CallbackExecutor final : public Executor {
   public:
    explicit CallbackExecutor(const ApplicationJobs& jobs) : jobs_(jobs) {}
    std::unique_ptr<GraphRun> prepare(const JobGraph& graph) override {
        return std::make_unique<ApplicationRun>(graph, jobs_);
    }
    int thread_limit() const override { return jobs_.threads; }
    bool runs_ahead() const override { return jobs_.submit != nullptr; }
    std::string_view name() const override { return "application"; }

   private:
    ApplicationJobs jobs_;
};

}  // namespace

std::shared_ptr<Executor> make_callback_executor(const ApplicationJobs& jobs) {
    if (!jobs.parallel_for) throw std::invalid_argument("parallel_for is null, needs the application's function");
    if (jobs.threads < 1 || jobs.threads > 1024)
        throw std::invalid_argument(invalid_value_message("threads", jobs.threads, "1 to 1024"));
    return std::make_shared<CallbackExecutor>(jobs);
}

}  // namespace pelagic
