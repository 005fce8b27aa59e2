// The executor for an application whose only thread has to come back soon, as that of a page: work goes on in slices.
//
//   auto executor = make_sliced_executor();
//   SkyBaker baker(executor, 256);
//   baker.schedule({});
//   while (!executor->advance(std::chrono::milliseconds(10))) draw_a_frame();
//   upload(baker.complete());
#pragma once

#include <chrono>
#include <memory>

#include "pelagic/jobs/executor.hpp"

namespace pelagic {

/// No threads: advance() does a part of the work on the calling thread, complete() what is left of its own run.
class SlicedExecutor : public Executor {
   public:
    /// Does jobs of what is scheduled, what came first before the rest, until `budget` is over or nothing is left: at least one
    /// job, so that a slice takes no longer than the budget and one job more. What a job throws comes out of complete().
    /// \pre no run of this executor is being completed meanwhile
    /// \return true if nothing is left
    virtual bool advance(std::chrono::nanoseconds budget) = 0;
};

std::shared_ptr<SlicedExecutor> make_sliced_executor();

}  // namespace pelagic
