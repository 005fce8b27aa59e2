#include "pelagic/sim/surface_query_jobs.hpp"

#include <algorithm>
#include <stdexcept>

namespace pelagic {
namespace {

// A job takes tens of microseconds, as long as waking a thread. The number of jobs in a graph is
// fixed, so a batch is divided into that many jobs, or fewer if it is small. Results do not depend
// on the division, because points are independent.
constexpr std::size_t query_jobs = 64, min_points_a_job = 512;

template <class T>
std::span<T> piece(std::span<T> all, std::size_t begin, std::size_t count) {
    return all.empty() ? all : all.subspan(begin, count);
}

}  // namespace

struct SurfaceQueryJobs::State {
    void run(std::size_t job) const {
        const std::size_t begin = job * points_a_job;
        if (begin >= points.x.size()) return;
        const std::size_t count = std::min(points_a_job, points.x.size() - begin);
        query->sample({.x = piece(points.x, begin, count),
                       .z = piece(points.z, begin, count),
                       .footprint_m = points.footprint_m},
                      {.height_m = piece(samples.height_m, begin, count),
                       .normal_x = piece(samples.normal_x, begin, count),
                       .normal_y = piece(samples.normal_y, begin, count),
                       .normal_z = piece(samples.normal_z, begin, count),
                       .jacobian = piece(samples.jacobian, begin, count),
                       .velocity_x_mps = piece(samples.velocity_x_mps, begin, count),
                       .velocity_y_mps = piece(samples.velocity_y_mps, begin, count),
                       .velocity_z_mps = piece(samples.velocity_z_mps, begin, count),
                       .error_m = piece(samples.error_m, begin, count),
                       .converged = piece(samples.converged, begin, count),
                       .foam = piece(samples.foam, begin, count)});
    }

    const SurfaceQuery* query = nullptr;
    SurfacePoints points;
    SurfaceSamples samples;
    std::size_t points_a_job = 0;
    std::shared_ptr<Executor> executor;
    JobGraph graph;
    std::unique_ptr<GraphRun> graph_run;
};

SurfaceQueryJobs::SurfaceQueryJobs(std::shared_ptr<Executor> executor) : state_(new State) {
    if (!executor) throw std::invalid_argument("executor is null, expected an executor");
    state_->executor = std::move(executor);
    state_->graph.add(
        {.name = "queries", .count = query_jobs, .body = [state = state_.get()](std::size_t begin, std::size_t end) {
             for (std::size_t job = begin; job < end; ++job) state->run(job);
         }});
    state_->graph_run = state_->executor->prepare(state_->graph);
}

SurfaceQueryJobs::~SurfaceQueryJobs() = default;

void SurfaceQueryJobs::sample(const SurfaceQuery& query, const SurfacePoints& points, const SurfaceSamples& samples) {
    const std::size_t count = points.x.size();
    if (count <= min_points_a_job) return query.sample(points, samples);
    query.check(points, samples);
    state_->query = &query;
    state_->points = points;
    state_->samples = samples;
    state_->points_a_job = std::max(min_points_a_job, (count + query_jobs - 1) / query_jobs);
    state_->graph_run->schedule();
    state_->graph_run->complete();
}

}  // namespace pelagic
