// Threads with a stack large enough for jobs, independent of the system's default (`ulimit -s`).
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace pelagic {

/// Stack size for any job. The largest job uses 0.8 MiB (docs/api.md, Stacks).
inline constexpr std::size_t job_stack_bytes = std::size_t{2} << 20;

class JobThread {
   public:
    /// Calls `work` on a new thread.
    /// \throws std::system_error  if the system does not create the thread
    explicit JobThread(std::function<void()> work, std::size_t stack_bytes = job_stack_bytes);
    JobThread(JobThread&&) noexcept;
    ~JobThread();  ///< \pre joined

    void join();

   private:
    struct Handle;
    std::unique_ptr<Handle> handle_;
};

/// Checks that `count` threads with such stacks, including the calling thread, can run at once.
/// Call it before a library that ends the program if it cannot create a thread.
/// \throws std::system_error  "8 threads are requested, but the system provides 3: ..."
void need_threads(int count, std::size_t stack_bytes);

}  // namespace pelagic
