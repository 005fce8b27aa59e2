// A thread whose stack is as large as jobs need, whatever the system's default is: `ulimit -s 64` makes that 64 KiB.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace pelagic {

/// Room for any job: the largest takes 0.8 MiB (docs/architecture.md, Memory).
inline constexpr std::size_t job_stack_bytes = std::size_t{2} << 20;

class JobThread {
   public:
    /// Calls `work` on a new thread. Throws std::system_error if the system has none to give.
    explicit JobThread(std::function<void()> work, std::size_t stack_bytes = job_stack_bytes);
    JobThread(JobThread&&) noexcept;
    ~JobThread();  ///< \pre joined

    void join();

   private:
    struct Handle;
    std::unique_ptr<Handle> handle_;
};

/// Throws std::system_error, "8 threads are wanted, and the system gives 3: ...", unless `count` more threads with such
/// stacks can run at once, the calling one included. For libraries that end the program where a thread is refused.
void need_threads(int count, std::size_t stack_bytes);

}  // namespace pelagic
