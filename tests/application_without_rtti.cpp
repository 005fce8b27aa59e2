// An application compiled with -fno-rtti, as many engines are. The library calls the application's
// own executor and trace sink, and the application catches the library's exceptions. It prints the
// hashes of two golden frames.
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"

#if defined(__cpp_rtti)
#error "this application is to be compiled with -fno-rtti"
#endif

namespace {

class ApplicationRun final : public pelagic::GraphRun {
   public:
    ApplicationRun(std::unique_ptr<GraphRun> run, int& completed) : run_(std::move(run)), completed_(completed) {}
    void schedule() override { run_->schedule(); }
    void complete() override {
        run_->complete();
        ++completed_;
    }
    bool is_done() const override { return run_->is_done(); }

   private:
    std::unique_ptr<GraphRun> run_;
    int& completed_;
};

class CallbackExecutor final : public pelagic::Executor {
   public:
    std::unique_ptr<pelagic::GraphRun> prepare(const pelagic::JobGraph& graph) override {
        return std::make_unique<ApplicationRun>(pool_->prepare(graph), completed_);
    }
    int thread_limit() const override { return pool_->thread_limit(); }
    std::string_view name() const override { return "application"; }
    int completed() const { return completed_; }

   private:
    std::shared_ptr<pelagic::Executor> pool_ = pelagic::make_thread_executor(2);
    int completed_ = 0;
};

struct ApplicationTrace final : pelagic::TraceSink {
    void work(const pelagic::TraceSpan&) noexcept override { has_seen_work = true; }
    void in_flight(const pelagic::TraceSpan&) noexcept override {}
    bool has_seen_work = false;
};

bool refuses_wind_below_zero() {
    try {
        const pelagic::Ocean ocean(pelagic::SeaState{.wind_speed_mps = -1});
        return false;
    } catch (const std::invalid_argument& error) {
        return std::string_view(error.what()).starts_with("wind_speed_mps -1");
    }
}

bool floats(const pelagic::Frame& frame) {
    const double x[] = {10}, z[] = {5};
    float height[] = {1e9f};
    pelagic::SurfaceQuery(frame).sample({.x = x, .z = z}, {.height_m = height});
    return height[0] >= frame.bounds.height_min_m && height[0] <= frame.bounds.height_max_m;
}

}  // namespace

int main() {
    const auto executor = std::make_shared<CallbackExecutor>();
    const auto trace = std::make_shared<ApplicationTrace>();
    pelagic::Ocean ocean(pelagic::SeaState{}, {.executor = executor, .trace = trace, .queries = true});
    pelagic::Selection selection(pelagic::quadtree_preset_named("low")->options(1024));
    for (const double time_s : {0.0, 12.34}) {
        const pelagic::Frame& frame = ocean.frame_at(time_s);
        const bool draws = !selection.select({.viewer_m = {1, 2, 3}, .bounds = frame.bounds}).instances.empty();
        if (floats(frame) && draws && executor->completed() > 0 && trace->has_seen_work && refuses_wind_below_zero())
            std::printf("default@%g %llx\n", time_s, static_cast<unsigned long long>(hash_of(frame)));
    }
}
