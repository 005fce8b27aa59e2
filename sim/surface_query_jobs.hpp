// A large batch of surface queries on an executor's threads.
#pragma once

#include <memory>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

/// Samples batches of points on an executor. After construction a batch allocates nothing in
/// Pelagic's code. Results are bit-identical to those of SurfaceQuery::sample().
///
/// One thread at a time uses an object. Several objects may work concurrently, also on the executor
/// of an ocean whose frames are in flight.
class SurfaceQueryJobs {
   public:
    /// Creates jobs for an executor. Batches of several threads need an object each.
    /// \throws std::invalid_argument  if it is null
    explicit SurfaceQueryJobs(std::shared_ptr<Executor> executor);
    ~SurfaceQueryJobs();
    SurfaceQueryJobs(const SurfaceQueryJobs&) = delete;  // the stage points into it
    SurfaceQueryJobs& operator=(const SurfaceQueryJobs&) = delete;

    /// Samples the points and returns when all are done. The calling thread takes part in the work,
    /// and does a small batch alone.
    /// \throws std::invalid_argument  what SurfaceQuery::sample() throws, before anything is written
    /// \throws                        what executors throw
    void sample(const SurfaceQuery& query, const SurfacePoints& points, const SurfaceSamples& samples);

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic
