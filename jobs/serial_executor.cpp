// The executor without threads, which runs the stages in order. Tests compare other executors with
// it.
#include <atomic>
#include <cassert>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/run_failure.hpp"

namespace pelagic {
namespace {

class SerialRun final : public GraphRun {
   public:
    explicit SerialRun(const JobGraph& graph) : graph_(graph) {}
    ~SerialRun() override { finish(); }

    void schedule() override {
        assert(!scheduled_);
        scheduled_ = true;
    }

    void complete() override {
        finish();
        failure_.rethrow();
    }

    bool is_done() const override { return !scheduled_; }

   private:
    void finish() noexcept {
        if (!scheduled_) return;
        for (const Stage& stage : graph_.stages())
            for (std::size_t block = 0; block < block_count(stage); ++block) try {
                    run_block(stage, block);
                } catch (...) {
                    failure_.keep_current();
                }
        scheduled_ = false;
    }

    const JobGraph& graph_;
    RunFailure failure_;
    std::atomic<bool> scheduled_ = false;
};

class SerialExecutor final : public Executor {
   public:
    std::unique_ptr<GraphRun> prepare(const JobGraph& graph) override { return std::make_unique<SerialRun>(graph); }
    int thread_limit() const override { return 1; }
    std::string_view name() const override { return "serial"; }
};

}  // namespace

std::shared_ptr<Executor> make_serial_executor() { return std::make_shared<SerialExecutor>(); }

}  // namespace pelagic
