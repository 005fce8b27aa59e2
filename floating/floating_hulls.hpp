// Many hulls on an executor's threads.
#pragma once

#include <memory>
#include <span>

#include "pelagic/floating/hull.hpp"
#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

/// A hull of a batch. Hulls of one kind share a Hull.
struct FloatingHull {
    const Hull* hull = nullptr;  ///< outlives the step
    HullState state;
    HullInputs inputs = {};
    HullLoads loads = {};  ///< of the last step
};

/// Steps hulls on an executor. Results are bit-identical to those of Hull::step(), for any number
/// of threads. One thread at a time uses an object.
class FloatingHulls {
   public:
    /// Creates jobs for an executor.
    /// \throws std::invalid_argument  if it is null
    explicit FloatingHulls(std::shared_ptr<Executor> executor);
    ~FloatingHulls();
    FloatingHulls(const FloatingHulls&) = delete;  // the stage points into it
    FloatingHulls& operator=(const FloatingHulls&) = delete;

    /// Advances the hulls as Hull::step() does, and returns its result when all are done. The calling
    /// thread takes part.
    /// Allocates nothing in Pelagic's code once each job has had as many vertices.
    /// \throws std::invalid_argument  what Hull::step() throws, after the number of the hull, such
    ///                                as "hull 3: ", or for a null hull; no hull is changed then
    bool step(const SurfaceQuery& water, std::span<FloatingHull> hulls, double step_s);

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic
