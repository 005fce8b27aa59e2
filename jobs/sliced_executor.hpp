// Executor for applications with a single thread that must not block, such as web pages. Work is
// done in time slices.
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

/// An executor without threads. advance() does a slice of the work on the calling thread;
/// complete() does the remaining work of its run.
class SlicedExecutor : public Executor {
   public:
    /// Runs jobs of the scheduled runs, in the order of scheduling, until `budget` has elapsed or
    /// no job remains. Runs at least one job, so a call takes at most the budget plus one job.
    /// Exceptions of jobs are stored for GraphRun::complete().
    /// \pre no thread is in complete() of a run of this executor
    /// \return true if no job remains
    virtual bool advance(std::chrono::nanoseconds budget) = 0;
};

/// Returns an executor that works only in advance() and complete(), on the calling thread.
std::shared_ptr<SlicedExecutor> make_sliced_executor();

}  // namespace pelagic
