// Graphs on a host's own job system, which knows two things: a parallel loop, and "do this soon".
//
// A submitted task and complete() both offer to do the run's work; whoever comes first does it, and the other one
// returns or waits. So a host that is slow to start a task never holds up a frame, and a task that comes late finds
// nothing to do, or begins the next run, which is as welcome.
#include <atomic>
#include <cassert>
#include <stdexcept>
#include <string>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/message/refusal.hpp"

namespace pelagic {
namespace {

/// What a run and its tasks share: it lives until the last of them is gone.
class HostWork {
   public:
    HostWork(const JobGraph& graph, const HostJobs& jobs) : graph_(graph), jobs_(jobs) {}

    void schedule() {
        state_ = State::waiting;
        if (!jobs_.submit) return;
        ++owners_;
        jobs_.submit(jobs_.user, &run_task, this);
    }

    void complete() {
        begin_if_waiting();
        // No mutex: notify_all() is the last that a worker does with the state, and an owner keeps it alive meanwhile.
        for (State now = state_; now != State::done; now = state_) state_.wait(now);
    }

    bool is_done() const { return state_ == State::done; }

    void drop_owner() {
        if (--owners_ == 0) delete this;
    }

   private:
    enum class State { waiting, running, done };

    ~HostWork() = default;

    static void run_task(void* work) {
        auto* const self = static_cast<HostWork*>(work);
        self->begin_if_waiting();
        self->drop_owner();
    }

    void begin_if_waiting() {
        State expected = State::waiting;
        if (!state_.compare_exchange_strong(expected, State::running)) return;
        for (const Stage& stage : graph_.stages()) run(stage);
        state_ = State::done;
        state_.notify_all();
    }

    void run(const Stage& stage) const {
        const std::size_t blocks = block_count(stage);
        const auto job = [](void* work, std::size_t block) { run_block(*static_cast<const Stage*>(work), block); };
        if (blocks == 1)
            run_block(stage, 0);
        else if (blocks > 1)
            jobs_.parallel_for(jobs_.user, blocks, job, const_cast<Stage*>(&stage));
    }

    const JobGraph& graph_;  ///< touched only by who began a run, and the run waits for that
    const HostJobs jobs_;
    std::atomic<State> state_ = State::done;
    std::atomic<int> owners_ = 1;
};

class HostRun final : public GraphRun {
   public:
    HostRun(const JobGraph& graph, const HostJobs& jobs) : work_(new HostWork(graph, jobs)) {}
    ~HostRun() override {
        complete();
        work_->drop_owner();
    }
    HostRun(const HostRun&) = delete;
    HostRun& operator=(const HostRun&) = delete;

    void schedule() override {
        assert(is_done());
        work_->schedule();
    }
    void complete() override { work_->complete(); }
    bool is_done() const override { return work_->is_done(); }

   private:
    HostWork* work_;
};

class HostExecutor final : public Executor {
   public:
    explicit HostExecutor(const HostJobs& jobs) : jobs_(jobs) {}
    std::unique_ptr<GraphRun> prepare(const JobGraph& graph) override {
        return std::make_unique<HostRun>(graph, jobs_);
    }
    int thread_limit() const override { return jobs_.threads; }
    bool runs_ahead() const override { return jobs_.submit != nullptr; }
    std::string_view name() const override { return "host"; }

   private:
    HostJobs jobs_;
};

}  // namespace

std::shared_ptr<Executor> make_host_executor(const HostJobs& jobs) {
    if (!jobs.parallel_for) throw std::invalid_argument("parallel_for is null, needs the host's function");
    if (jobs.threads < 1 || jobs.threads > 1024)
        throw std::invalid_argument(refusal("threads", jobs.threads, "1 to 1024"));
    return std::make_shared<HostExecutor>(jobs);
}

}  // namespace pelagic
