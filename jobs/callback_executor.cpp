// Executor on an application's job system, which offers a parallel loop and, optionally, submission
// of tasks.
//
// The submitted task and complete() compete for the work of a run. The first one does it; the other
// one returns or waits. An application that starts a task late therefore never delays a frame. A
// late task finds nothing to do, or begins the next run, which is correct too.
//
// Errors of the application must not corrupt memory:
// - Each block runs once, whenever and however often the application calls it.
// - close() runs the blocks that the application's loop omitted.
// - No exception of a job propagates into the application's code.
// - Tasks hold the number of their run instead of a pointer; the number of a destroyed run is not
// found.
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

/// The blocks of one stage, which the application's loop calls.
class ApplicationLoop {
   public:
    /// Constructs a closed loop: every block counts as taken until open().
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

    /// Runs the blocks that the application omitted and waits for blocks that are still running.
    /// Returns true if the application had run all blocks.
    bool close() {
        const bool application_did_all = done_ == blocks();
        for (std::size_t block = 0; block < blocks(); ++block) do_once(block);
        for (std::uint32_t now = done_; now != blocks(); now = done_) wait_while(done_, now);
        return application_did_all;
    }

    /// The callback that the application's loop calls.
    static void job(void* loop, std::size_t block) { static_cast<ApplicationLoop*>(loop)->do_once(block); }

   private:
    void do_once(std::size_t block) noexcept {
        const std::size_t count = blocks();
        if (block >= count || taken_[block].exchange(true)) return;
        try {
            run_block(stage_, block);
        } catch (...) {
            failure_.keep_current();
        }
        // After the last block the run may be destroyed at any time: nothing is read, and wake_all()
        // uses the address only.
        if (++done_ == count) wake_all(done_);
    }

    const Stage& stage_;
    RunFailure& failure_;
    std::vector<std::atomic<bool>> taken_;
    std::atomic<std::uint32_t> done_;
};

/// State that a run and its tasks share. The last of them destroys it.
class ApplicationWork {
   public:
    ApplicationWork(const JobGraph& graph, const ApplicationJobs& jobs) : jobs_(jobs) {
        loops_.reserve(graph.stages().size());
        for (const Stage& stage : graph.stages())
            loops_.push_back(std::make_unique<ApplicationLoop>(stage, failure_));
    }

    /// \param number  the number by which run_task() finds this run
    void schedule(std::uintptr_t number) {
        state_ = waiting;
        if (!jobs_.submit) return;
        // A failure is stored until complete(), because a task may run in spite of the exception.
        call("submit", [&] { jobs_.submit(jobs_.user, &run_task, reinterpret_cast<void*>(number)); });
    }

    void finish() {
        begin_if_waiting();
        // No mutex is needed: wake_all() is a worker's last access to the state, and the worker
        // holds a reference to this object.
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
    /// One loop per stage, in order. They refer to the graph. Only the thread that began a run uses
    /// them, and the run waits for that thread.
    std::vector<std::unique_ptr<ApplicationLoop>> loops_;
    std::atomic<std::uint32_t> state_ = done;
};

/// All existing runs by number. Numbers are never reused.
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
    /// Returns null if the run has been destroyed.
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

/// Returns the process-wide registry, which is never destroyed because tasks may run at any time.
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
    if (!jobs.parallel_for) throw std::invalid_argument("parallel_for is null; expected a function");
    if (jobs.threads < 1 || jobs.threads > 1024)
        throw std::invalid_argument(invalid_value_message("threads", jobs.threads, "1 to 1024"));
    return std::make_shared<CallbackExecutor>(jobs);
}

}  // namespace pelagic
