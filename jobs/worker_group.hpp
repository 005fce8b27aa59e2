// Threads that work on runs together with the threads that complete them. An executor derives from
// this class and provides the threads.
//
// Threads look for work for 20 us before they sleep, because stages follow each other within
// microseconds and waking a thread takes longer: 5 to 160 us until it works, and up to 40 us of the
// calling thread in a virtual machine. If cores share no cache, a worker may slow down a short run
// even when it is awake. GraphRun::run() therefore measures both, see SharingChoice.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/run_progress.hpp"
#include "pelagic/jobs/sharing_choice.hpp"

namespace pelagic {

class WorkerGroup {
   public:
    /// \param threads  number of threads that work on a run, with the one that completes it
    explicit WorkerGroup(int threads);
    virtual ~WorkerGroup() = default;

    /// Binds a graph to a group, which the result keeps alive.
    static std::unique_ptr<GraphRun> prepare(const JobGraph& graph, std::shared_ptr<WorkerGroup> group);

    int threads() const { return threads_; }

    /// See Executor::set_spin_us().
    void set_spin_us(int us);

   protected:
    /// Works on all runs until there has been no work for the duration of set_spin_us(). Called by
    /// a thread that wake() has woken.
    /// \param thread  1 to threads() - 1, different from other threads that work
    void work(int thread) noexcept;

   private:
    using Clock = std::chrono::steady_clock;
    class BoundRun;

    struct Run {
        Run(const JobGraph& graph, int threads) : progress(graph, threads) {}

        RunProgress progress;
        SharingChoice paced, in_series;  ///< of run(): workers sleep before it, or are awake
    };

    /// Wakes `count` threads that do not work, each of which calls work() once. Returns the number
    /// of threads, which is less if memory is exhausted; complete() then does the work.
    virtual int wake(int count) noexcept = 0;
    /// Returns whether no one else uses the threads, so that their CPUs may be restricted.
    virtual bool owns_threads() const noexcept { return false; }

    void start(Run&, std::size_t blocks_of_this_thread);
    Clock::rep finish(Run&);
    void start_and_finish(Run&);
    void wake_for(std::size_t blocks) noexcept;
    std::size_t work_while_ready(Run&, RunProgress::Place&, const RunProgress::Interrupt* = nullptr) noexcept;
    bool work_on_all_runs(RunProgress::Place&, std::shared_ptr<Run>& last, std::uint32_t seen) noexcept;
    bool spin_until_change(std::uint32_t seen) const noexcept;
    bool stays_awake(std::uint32_t seen) noexcept;
    std::shared_ptr<Run> unfinished_run(std::size_t& index) noexcept;

    const int threads_;
    std::atomic<Clock::rep> spin_;
    std::mutex mutex_;  ///< of runs_
    std::vector<std::shared_ptr<Run>> runs_;

    std::atomic<Clock::rep> last_end_ = 0;  ///< of run()
    std::atomic<int> runs_in_a_row_ = 0, waking_cpu_ = -1;
    std::atomic<bool> yields_after_waking_ = false;  ///< the last worker began on the waking CPU

    // In separate cache lines, because other cores read them for each stage.
    alignas(64) std::atomic<std::uint32_t> changes_ = 0;  ///< incremented when blocks become ready
    alignas(64) std::atomic<int> awake_ = 0;              ///< workers that work or have been woken
    alignas(64) std::atomic<int> spinning_ = 0;           ///< those of them that look for work
};

}  // namespace pelagic
