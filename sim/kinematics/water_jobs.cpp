#include "pelagic/sim/water_jobs.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <utility>

namespace pelagic {
namespace {

// A point takes up to tens of microseconds. The number of jobs in a graph is fixed, so a batch is divided
// into that many jobs, or fewer if it is small.
constexpr std::size_t exact_jobs = 64, min_exact_points = 16;

/// A chunk of points and what its query calls.
constexpr std::size_t exact_stack_bytes = 128 * 1024;

}  // namespace

struct WaterJobs::State {
    /// Runs work(begin, count) for pieces of all points.
    template <class Work>
    void run(std::size_t points, const Work& work) {
        const std::size_t points_a_job = std::max(min_exact_points, (points + exact_jobs - 1) / exact_jobs);
        piece = [points, points_a_job, &work](std::size_t job) {
            const std::size_t begin = job * points_a_job;
            if (begin < points) work(begin, std::min(points_a_job, points - begin));
        };
        graph_run->run();
    }

    std::shared_ptr<Executor> executor;
    std::function<void(std::size_t)> piece;
    JobGraph graph;
    std::unique_ptr<GraphRun> graph_run;
};

WaterJobs::WaterJobs(std::shared_ptr<Executor> executor) : state_(new State) {
    if (!executor) throw std::invalid_argument("executor is null, expected an executor");
    state_->executor = std::move(executor);
    state_->graph.add({.name = "water",
                       .count = exact_jobs,
                       .body =
                           [state = state_.get()](std::size_t begin, std::size_t end) {
                               for (std::size_t job = begin; job < end; ++job) state->piece(job);
                           },
                       .stack_bytes = exact_stack_bytes});
    state_->graph_run = state_->executor->prepare(state_->graph);
}

WaterJobs::~WaterJobs() = default;

void WaterJobs::sample(const WaterKinematics& water, const WaterPoints& points, const WaterSamples& samples) {
    water.require_valid(points, samples);
    state_->run(points.x.size(), [&](std::size_t begin, std::size_t count) {
        const auto of = [begin, count](auto all) { return all.empty() ? all : all.subspan(begin, count); };
        water.sample({.x = of(points.x), .y = of(points.y), .z = of(points.z), .footprint_m = points.footprint_m,
                      .whole_cascades = points.whole_cascades},
                     {.depth_m = of(samples.depth_m),
                      .pressure_pa = of(samples.pressure_pa),
                      .velocity_x_mps = of(samples.velocity_x_mps),
                      .velocity_y_mps = of(samples.velocity_y_mps),
                      .velocity_z_mps = of(samples.velocity_z_mps),
                      .acceleration_x_mps2 = of(samples.acceleration_x_mps2),
                      .acceleration_y_mps2 = of(samples.acceleration_y_mps2),
                      .acceleration_z_mps2 = of(samples.acceleration_z_mps2)});
    });
}

void WaterJobs::sample_surface(const ExactWater& water, const SurfacePoints& points,
                                    const SurfaceSamples& samples) {
    water.check(points, samples);
    state_->run(points.x.size(), [&](std::size_t begin, std::size_t count) {
        const auto of = [begin, count](auto all) { return all.empty() ? all : all.subspan(begin, count); };
        water.sample_surface({.x = of(points.x), .z = of(points.z), .footprint_m = points.footprint_m},
                             {.height_m = of(samples.height_m),
                              .normal_x = of(samples.normal_x),
                              .normal_y = of(samples.normal_y),
                              .normal_z = of(samples.normal_z),
                              .jacobian = of(samples.jacobian),
                              .velocity_x_mps = of(samples.velocity_x_mps),
                              .velocity_y_mps = of(samples.velocity_y_mps),
                              .velocity_z_mps = of(samples.velocity_z_mps),
                              .error_m = of(samples.error_m),
                              .converged = of(samples.converged)});
    });
}

}  // namespace pelagic
