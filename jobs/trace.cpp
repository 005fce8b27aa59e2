#include "pelagic/jobs/trace.hpp"

#include <cstdint>
#include <utility>

namespace pelagic {
namespace {

class TracedRun final : public GraphRun {
   public:
    TracedRun(Executor& executor, const JobGraph& graph, std::shared_ptr<TraceSink> sink, const char* run_name,
              std::shared_ptr<std::uint64_t> runs)
        : sink_(std::move(sink)), run_name_(run_name), runs_(std::move(runs)) {
        for (const Stage& stage : graph.stages())
            timed_graph_.add(
                {.name = stage.name,
                 .count = stage.count,
                 .batch = stage.batch,
                 .waits_for = stage.waits_for,
                 .body =
                     [this, &stage](std::size_t begin, std::size_t end) {
                         const auto block = static_cast<double>(begin / stage.batch);
                         const TraceScope scope(sink_.get(), stage.name, "job", {run_number(), {"block", block}});
                         stage.body(begin, end);
                     },
                 .stack_bytes = stage.stack_bytes});
        timed_run_ = executor.prepare(timed_graph_);
    }
    ~TracedRun() override {
        try {
            complete();
        } catch (...) {  // a destructor cannot report the failure
        }
    }

    void schedule() override {
        start_ = TraceClock::now();
        scheduled_ = true;
        timed_run_->schedule();
    }

    void run() override {
        start_ = TraceClock::now();
        scheduled_ = true;
        const EndOfRun at_the_end{*this};
        timed_run_->run();
    }

    void complete() override {
        const EndOfRun at_the_end{*this};
        timed_run_->complete();
    }

    bool is_done() const override { return timed_run_->is_done(); }

   private:
    /// Ends a run, also if it failed.
    struct EndOfRun {
        TracedRun& traced;
        ~EndOfRun() { traced.end(); }
    };

    void end() {
        if (!scheduled_) return;
        sink_->in_flight({run_name_, "flight", {run_number()}, start_, TraceClock::now()});
        scheduled_ = false;
        // Incremented after all jobs, which read it.
        ++*runs_;
    }

    TraceArg run_number() const { return {run_name_, static_cast<double>(*runs_)}; }

    std::shared_ptr<TraceSink> sink_;
    const char* run_name_;
    std::shared_ptr<std::uint64_t> runs_;
    bool scheduled_ = false;
    TraceClock::time_point start_;
    JobGraph timed_graph_;
    std::unique_ptr<GraphRun> timed_run_;
};

}  // namespace

std::unique_ptr<GraphRun> prepare_traced(Executor& executor, const JobGraph& graph, std::shared_ptr<TraceSink> sink,
                                         const char* run_name, std::shared_ptr<std::uint64_t> runs) {
    if (!sink) return executor.prepare(graph);
    return std::make_unique<TracedRun>(executor, graph, std::move(sink), run_name, std::move(runs));
}

}  // namespace pelagic
