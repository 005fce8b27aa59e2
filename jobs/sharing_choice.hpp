// The choice whether a run is shared with workers, by the times that both ways have taken.
#pragma once

#include <cstdint>

namespace pelagic {

/// Chooses for the runs of one graph at one pace. The first runs are shared, because a graph may be
/// long and run only once. Later runs take the way whose time is less; sharing must save a tenth.
/// Times change, so the other way is tried again: after 64 runs, and after twice as many each time
/// that it is slower. The calling thread alone is not tried if it takes twice as long, and runs of
/// more than a millisecond stay shared. Thread safety: as for GraphRun::run().
class SharingChoice {
   public:
    /// Returns whether the next run is shared.
    bool shares() const { return shares_; }

    /// Counts a run. Times are in nanoseconds.
    /// \param time   of the run, in the way that shares() returned
    /// \param alone  estimate of its time on one thread, for a run that was shared
    void count(std::int64_t time, std::int64_t alone);

    /// A trial of a way: caches and branch predictors get warm, and then the least time counts,
    /// because other programs delay some of the runs.
    static constexpr int warm_runs = 4, trial_runs = 8;
    static constexpr int min_patience = 64, max_patience = 4096;  ///< runs until a trial

   private:
    void change(bool is_trial);

    bool shares_ = true, is_trial_ = false, has_run_alone_ = false;
    int runs_ = 0;  ///< since the last change
    int patience_ = min_patience;
    std::int64_t alone_ = 0, shared_ = 0;
};

}  // namespace pelagic
