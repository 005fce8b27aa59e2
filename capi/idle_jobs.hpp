// Jobs of many points, for any number of threads that call at once.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "pelagic/jobs/executor.hpp"

namespace pelagic::capi {

/// \tparam Jobs  made from an executor, and used by one thread at a time
template <class Jobs>
class IdleJobs {
   public:
    /// Calls work(jobs) with jobs that no other thread uses.
    template <class Work>
    void use(const std::shared_ptr<Executor>& executor, const Work& work) {
        std::unique_ptr<Jobs> jobs;
        {
            const std::lock_guard lock(mutex_);
            if (!idle_.empty()) {
                jobs = std::move(idle_.back());
                idle_.pop_back();
            }
        }
        if (!jobs) jobs = std::make_unique<Jobs>(executor);
        work(*jobs);
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(jobs));
    }

   private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<Jobs>> idle_;
};

}  // namespace pelagic::capi
