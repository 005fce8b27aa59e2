#include "pelagic/floating/floating_hulls.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr std::size_t jobs = 64;

}  // namespace

struct FloatingHulls::State {
    /// Steps a job's hulls: one query for all of them.
    void run(std::size_t job) {
        const DefaultFloatEnvironment environment;
        const std::size_t begin = job * hulls_a_job;
        if (begin >= hulls.size()) return;
        const std::span<FloatingHull> ours = hulls.subspan(begin, std::min(hulls_a_job, hulls.size() - begin));
        HullWorkspace& workspace = workspaces[job];
        workspace.x.clear();
        workspace.z.clear();
        for (FloatingHull& floating : ours) {
            Hull::drift(floating.state, 0.5 * step_s);
            floating.hull->append_points(floating.state, workspace);
        }
        workspace.sample(*water);
        std::size_t point = 0;
        for (FloatingHull& floating : ours) {
            floating.loads =
                floating.hull->loads_at(*water, point, floating.state, step_s, floating.inputs, workspace);
            floating.hull->complete_step(floating.state, floating.loads, step_s, floating.inputs);
            point += floating.hull->mesh().vertices().size();
        }
    }

    const SurfaceQuery* water = nullptr;
    std::span<FloatingHull> hulls;
    double step_s = 0;
    std::size_t hulls_a_job = 1;
    std::array<HullWorkspace, jobs> workspaces;
    std::shared_ptr<Executor> executor;
    JobGraph graph;
    std::unique_ptr<GraphRun> graph_run;
};

FloatingHulls::FloatingHulls(std::shared_ptr<Executor> executor) : state_(new State) {
    if (!executor) throw std::invalid_argument("executor is null, expected an executor");
    state_->executor = std::move(executor);
    state_->graph.add(
        {.name = "hulls", .count = jobs, .body = [state = state_.get()](std::size_t begin, std::size_t end) {
             for (std::size_t job = begin; job < end; ++job) state->run(job);
         }});
    state_->graph_run = state_->executor->prepare(state_->graph);
}

FloatingHulls::~FloatingHulls() = default;

bool FloatingHulls::step(const SurfaceQuery& water, std::span<FloatingHull> hulls, double step_s) {
    const DefaultFloatEnvironment environment;
    Hull::check_step(water, step_s);
    for (std::size_t i = 0; i < hulls.size(); ++i) {
        if (!hulls[i].hull) throw std::invalid_argument("hull " + std::to_string(i) + " is null, expected a hull");
        for (const std::string& reason : {Hull::check(hulls[i].state), Hull::check(hulls[i].inputs)})
            if (!reason.empty()) throw std::invalid_argument("hull " + std::to_string(i) + ": " + reason);
    }
    state_->water = &water;
    state_->hulls = hulls;
    const Hull::Steps steps(step_s);
    state_->step_s = steps.each_s;
    state_->hulls_a_job = std::max<std::size_t>(1, (hulls.size() + jobs - 1) / jobs);
    // as in Hull::step()
    if (steps.count > 1)
        for (FloatingHull& floating : hulls) floating.state.has_previous_step = false;
    for (int i = 0; i < steps.count; ++i) state_->graph_run->run();
    return steps.are_all;
}

}  // namespace pelagic
