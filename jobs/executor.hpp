// Interface of executors, which run job graphs on threads, and the executors of Pelagic. An
// application may implement the interface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "pelagic/jobs/job_graph.hpp"

namespace pelagic {

/// A job graph bound to an executor: built once, run any number of times, one run at a time. Thread
/// safety: any thread may call is_done() at any time; only one thread at a time may call the other
/// methods.
class GraphRun {
   public:
    /// Waits until a run in flight is done.
    virtual ~GraphRun() = default;

    /// Starts a run and returns at once. Stages run in the order of their dependencies. Pelagic
    /// allocates no memory here; oneTBB takes its tasks from its own pools.
    /// \pre no run is in flight (asserted)
    virtual void schedule() = 0;

    /// Waits until every stage is done; the calling thread works too. Returns at once if nothing is
    /// scheduled. A failed run throws after all of its stages are done, so that the next run may be
    /// scheduled.
    /// \throws ApplicationJobsError  if a function of the application failed
    /// \throws std::system_error     if no thread with the stack that a job needs could be created
    /// \throws                       the first exception of a job's body
    virtual void complete() = 0;

    /// Calls schedule() and complete(). Executors of Pelagic with threads do not wake a sleeping
    /// thread for a run that the calling thread completes sooner by itself.
    /// \pre no run is in flight (asserted)
    /// \throws  what complete() throws
    virtual void run() {
        schedule();
        complete();
    }

    /// Returns true if no run is in flight or all of its stages are done. Never blocks.
    virtual bool is_done() const = 0;
};

/// Runs job graphs. Several runs of different graphs may be in flight at once. Thread safety: any
/// thread may call any method.
class Executor {
   public:
    virtual ~Executor() = default;

    /// Binds a graph to this executor.
    /// \param graph  must outlive the result and must not change during that time
    virtual std::unique_ptr<GraphRun> prepare(const JobGraph& graph) = 0;

    /// Returns the maximum number of threads that work on one graph at the same time, including the
    /// thread that calls complete().
    virtual int thread_limit() const = 0;

    /// Returns true if work starts before complete(). If false, complete() does all work, and
    /// is_done() returns false until then.
    virtual bool runs_ahead() const { return thread_limit() > 1; }

    /// Returns a short name for reports, such as "tbb".
    virtual std::string_view name() const = 0;

    /// Sets how long threads look for work before they sleep. 0 saves battery; then frames with
    /// several stages take longer. Has no effect on executors without threads of their own.
    /// oneTBB's own threads look for work for a while longer.
    /// \param us  microseconds, 0 to 1000; default_spin_us at first
    /// \throws std::invalid_argument  if `us` is out of range
    virtual void set_spin_us(int us) { static_cast<void>(us); }
};

/// Stages follow each other within microseconds. See Executor::set_spin_us().
inline constexpr int default_spin_us = 20;

/// Creates an executor without threads: complete() does all work on the calling thread, in order.
std::shared_ptr<Executor> make_serial_executor();

/// Returns the number of threads that the executors below start for 0, and the largest number that
/// they start: one per CPU that the calling thread may use by its affinity and by the process's
/// quota of CPU time (Linux control groups), rounded up. More threads would delay each other.
int default_thread_count();

/// Creates a thread pool, for builds without oneTBB and for ThreadSanitizer. Threads have stacks of
/// 2 MiB, independent of the system's default.
/// \param threads  number of threads including the one that calls complete(); 0 to 1024. 0, or more
///                 than default_thread_count(): that number; 1: starts no thread, and complete()
///                 does all work.
/// \throws std::invalid_argument  if `threads` is out of range
/// \throws std::system_error      if the system does not create the threads: "8 threads are
///                                requested, but the system provides 3: ..."
std::shared_ptr<Executor> make_thread_executor(int threads = 0);

/// Creates a thread pool, see make_thread_executor(), whose threads run on chosen CPUs only. Use it
/// on processors with large and small cores, where a job on a small core delays the frame, or to
/// reserve cores for the application. Linux, Android and Windows only.
/// \param cpu_mask  bit i allows CPU i; 0 allows all. The thread that calls complete() belongs to
///                  the application and is not restricted.
/// \param threads   as for make_thread_executor(), except that only CPUs of the mask count, and one
///                  more for the calling thread unless `threads` is 0
/// \throws std::invalid_argument  if the system does not support masks, or the process may use no
///                                CPU of the mask
std::shared_ptr<Executor> make_thread_executor_on(std::uint64_t cpu_mask, int threads = 0);

/// Thrown by complete() if a function of the application violated its contract. All jobs of the run
/// are done by then.
struct ApplicationJobsError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// An application's job system, as plain functions so that C code can supply them. Pelagic calls
/// them from any thread. If one of them throws or returns too early, Pelagic does the remaining
/// work, and complete() throws ApplicationJobsError. A job or task that is called twice, or after
/// its run, has no effect.
struct ApplicationJobs {
    void* user = nullptr;  ///< passed to both functions

    /// Calls job(work, i) once for each i in [0, count), on any threads, concurrently or not, and
    /// returns when all calls have returned. Called several times a frame, by complete() or by a
    /// submitted task.
    void (*parallel_for)(void* user, std::size_t count, void (*job)(void* work, std::size_t index), void* work);

    /// Queues one call of task(work) on another thread and returns at once. The task calls
    /// parallel_for. It may be called late, even after the run is destroyed. If null, complete()
    /// begins the work.
    void (*submit)(void* user, void (*task)(void* work), void* work) = nullptr;

    int threads = 1;  ///< result of thread_limit(); 1 to 1024
};

/// Creates an executor that runs the stages one after the other, each with the application's
/// parallel_for.
/// \throws std::invalid_argument  if parallel_for is null or `threads` is out of range
std::shared_ptr<Executor> make_callback_executor(const ApplicationJobs& jobs);

#if defined(PELAGIC_HAS_TBB)
/// Creates an executor whose threads are those of oneTBB, in one arena. The program's other arenas
/// share them, so a graph may not start before its complete() while others use the threads.
/// \param threads  0 to 1024. 0: default_thread_count(); 1: complete() does all work.
/// \throws std::invalid_argument  if `threads` is out of range
/// \throws std::system_error      if the system does not create the threads
std::shared_ptr<Executor> make_tbb_executor(int threads = 0);
#endif

/// Creates a oneTBB executor if this build has oneTBB, else a thread executor.
std::shared_ptr<Executor> make_default_executor(int threads = 0);

}  // namespace pelagic
