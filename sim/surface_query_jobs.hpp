// A large batch of surface queries on an executor's threads.
#pragma once

#include <memory>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

/// Built once; afterwards a batch allocates nothing in Pelagic's code. One thread at a time uses an object, but several
/// objects may work side by side, on the executor of an ocean whose frames run meanwhile, too. The same bits as
/// SurfaceQuery::sample().
class SurfaceQueryJobs {
   public:
    explicit SurfaceQueryJobs(std::shared_ptr<Executor> executor);
    ~SurfaceQueryJobs();
    SurfaceQueryJobs(const SurfaceQueryJobs&) = delete;  // the stage points into it
    SurfaceQueryJobs& operator=(const SurfaceQueryJobs&) = delete;

    /// Returns when all is done; the calling thread helps, and does a small batch alone. Throws as
    /// SurfaceQuery::sample(), before anything is written.
    void sample(const SurfaceQuery& query, const SurfacePoints& points, const SurfaceSamples& samples);

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic
