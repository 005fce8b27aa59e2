// The progress of one run of a graph: which blocks are ready, and which are done. Lock-free.
//
// A core reads a cache line that another core has written in 100 to 300 ns, and a block takes 2 to
// 20 us. So each stage has as many ranges of blocks as there are threads, each with a counter in a
// line of its own. A thread takes the blocks of its own range first, then those of others.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/jobs/run_failure.hpp"

namespace pelagic {

class RunProgress {
   public:
    /// \param graph    must outlive all runs
    /// \param threads  number of threads that work on it, at least 1
    RunProgress(const JobGraph& graph, int threads);

    /// Begins a run. Returns the number of blocks that are ready. \pre is_done()
    std::size_t start();

    /// Runs all blocks on this thread, in order. \pre is_done()
    void run_alone() noexcept;

    /// Position of a thread in the graph.
    struct Place {
        int thread = 0;            ///< 0: the thread that completes the run
        std::uint32_t number = 0;  ///< of the run
        StageId stage = 0;         ///< where the thread looks for work first
    };

    struct Outcome {
        std::size_t blocks = 0;        ///< blocks that were run; 0 if none was ready
        bool is_last = false;          ///< the run is done, and this was its last work
        std::size_t ready_blocks = 0;  ///< blocks of other stages that became ready by this work
    };
    /// A counter of other threads, and the value that this thread has seen.
    struct Interrupt {
        const std::atomic<std::uint32_t>& changes;
        std::uint32_t seen;
        bool has_come() const { return changes.load(std::memory_order_relaxed) != seen; }
    };

    /// Runs blocks of one stage until none of them remains to be taken. The search begins at the
    /// thread's place and continues to later stages, then to earlier ones. Threads begin a run in
    /// different cascades, so that each keeps its cascades in the cache of its core.
    /// \param interrupt  if not null, the thread takes no further block after a change
    Outcome work(Place& place, const Interrupt* interrupt) noexcept;

    bool is_done() const { return unfinished_ends_.load(std::memory_order_acquire) == 0; }

    /// Returns the number of blocks of a run.
    std::size_t blocks() const { return blocks_; }

    /// Throws the first exception of the run's blocks, if there is one. \pre is_done()
    void rethrow_failure() { failure_.rethrow(); }

   private:
    static constexpr std::size_t cache_line = 64;

    struct alignas(cache_line) Range {
        std::atomic<std::size_t> next = 0;
        std::size_t begin = 0, end = 0;
    };
    struct State {
        alignas(cache_line) std::atomic<std::size_t> remaining_blocks = 0, waiting_for = 0;
        alignas(cache_line) std::size_t blocks = 0;  // constant from here on
        std::vector<StageId> followers = {};
        std::vector<Range> ranges = {};
    };

    void make_ready(StageId, Outcome&);
    void end_stage(StageId, Outcome&);
    std::size_t run_blocks(StageId, int thread, const Interrupt*) noexcept;
    void run(StageId, std::size_t block) noexcept;
    StageId first_stage(int thread) const;

    const JobGraph& graph_;
    std::size_t threads_;
    std::vector<State> stages_;
    std::vector<StageId> first_stages_;  ///< stages that wait for none
    std::size_t blocks_ = 0, ends_ = 0;  ///< numbers of blocks, and of stages that none waits for
    alignas(cache_line) std::atomic<std::size_t> unfinished_ends_ = 0;
    std::atomic<std::uint32_t> number_ = 0;
    RunFailure failure_;
};

}  // namespace pelagic
