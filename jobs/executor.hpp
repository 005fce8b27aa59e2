// Where jobs run: the one interface behind which threads stand. An application may bring its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "pelagic/jobs/job_graph.hpp"

namespace pelagic {

/// A job graph bound to an executor: built once, run as often as wanted, one run at a time. Any thread may ask
/// is_done() at any time; the other methods are for one thread at a time.
class GraphRun {
   public:
    /// Waits for a run in flight.
    virtual ~GraphRun() = default;

    /// Starts every stage in its order and returns at once. Allocates nothing in Pelagic's code; oneTBB takes its
    /// tasks from pools of its own.
    /// \pre no run is in flight (asserted)
    virtual void schedule() = 0;

    /// Returns when every stage is done; the calling thread helps. Returns at once if nothing is scheduled. Throws if the
    /// run failed, once it is over, so that the next one may be scheduled: ApplicationJobsError, std::system_error if a thread
    /// with the stack that a job needs could not be had, or what a body threw.
    virtual void complete() = 0;

    /// True if no run is in flight or all of its stages are done. Never blocks.
    virtual bool is_done() const = 0;
};

/// Runs graphs. Several runs of different graphs may be in flight at once; methods may be called from any thread.
class Executor {
   public:
    virtual ~Executor() = default;

    /// \param graph outlives the run and does not change meanwhile
    virtual std::unique_ptr<GraphRun> prepare(const JobGraph& graph) = 0;

    /// Most threads that work on one graph at the same time, the completing one included.
    virtual int thread_limit() const = 0;

    /// Whether work starts before complete(). If not, complete() does it all, and is_done() says no until then.
    virtual bool runs_ahead() const { return thread_limit() > 1; }

    virtual std::string_view name() const = 0;
};

/// No threads: complete() does all the work on the calling thread, in order.
std::shared_ptr<Executor> make_serial_executor();

/// A pool of std::thread, for builds without oneTBB and for ThreadSanitizer. `threads` counts the completing
/// thread too: 1 starts none, so the work is done in complete(). 0 means one per core; range 0 to 1024, else
/// std::invalid_argument. Throws std::system_error if the system has no more threads to give, "8 threads are wanted, and
/// the system gives 3: ...". The threads have stacks of 2 MiB, whatever the system's default is.
std::shared_ptr<Executor> make_thread_executor(int threads = 0);

/// The same on chosen cores: bit i of `cpu_mask` allows CPU i, and 0 means all. On a processor with large and small cores a
/// job on a small one ends last and holds up the frame, and the application may want the largest for itself. The mask is for
/// the pool's threads; the completing one is the application's and stays where it is. With 0 threads there are as many as cores
/// in the mask. Linux, Android and Windows only; elsewhere, and where the mask names no CPU that the process may use,
/// std::invalid_argument.
std::shared_ptr<Executor> make_thread_executor_on(std::uint64_t cpu_mask, int threads = 0);

/// What complete() throws if an application's function broke its promise. The run is over then, and every job was done.
struct ApplicationJobsError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// An application's own job system, as plain functions so that C can give them. Called from any thread. Should one of them throw,
/// or return too early, Pelagic does what is left itself, and complete() throws ApplicationJobsError. A job or task that is called
/// twice, or after its run, does nothing.
struct ApplicationJobs {
    void* user = nullptr;  ///< handed to both

    /// Calls job(work, i) once for each i in [0, count), on any threads, side by side or not, and returns when all are
    /// done. Called several times a frame, from complete() or from a submitted task.
    void (*parallel_for)(void* user, std::size_t count, void (*job)(void* work, std::size_t index), void* work);

    /// Calls task(work) once, on some other thread, soon, and returns at once. None: complete() begins the work. A task
    /// may be called late, even after the run is gone; it calls parallel_for.
    void (*submit)(void* user, void (*task)(void* work), void* work) = nullptr;

    int threads = 1;  ///< what thread_limit() says; 1 to 1024
};

/// Stages one after the other, each a parallel_for of the application. Throws std::invalid_argument without parallel_for, and if
/// threads are out of range.
std::shared_ptr<Executor> make_callback_executor(const ApplicationJobs& jobs);

#if defined(PELAGIC_HAS_TBB)
/// oneTBB: a flow graph with one node a stage, each a parallel loop. Every graph has an arena of `threads` slots, one
/// of them kept for the scheduling and completing thread. 0 means oneTBB's default, one per core that the
/// process may use; range 0 to 1024, else std::invalid_argument, and std::system_error if the system has not so many to
/// give. With 1 the work is done in complete(). All graphs share
/// oneTBB's workers, so one whose threads are taken by another graph may not start before its complete().
std::shared_ptr<Executor> make_tbb_executor(int threads = 0);
#endif

/// oneTBB where this build has it, else the thread executor.
std::shared_ptr<Executor> make_default_executor(int threads = 0);

}  // namespace pelagic
