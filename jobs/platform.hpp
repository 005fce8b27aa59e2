// Operating system functions for jobs that the C++ library lacks. jobs/CMakeLists.txt selects one
// implementation: platform_linux.cpp (Android too), platform_macos.cpp, platform_windows.cpp or
// platform_unknown.cpp.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace pelagic {

/// The addresses [begin, end) of a stack; empty if the system does not provide them.
struct Stack {
    std::uintptr_t begin = 0, end = 0;
};

/// Returns the stack of the calling thread without its guard pages; on Windows, of its current
/// fiber. Other systems know no fibers. The first call of a thread queries the system.
Stack stack_of_this_thread();

/// Returns the minimum stack size of a thread.
std::size_t min_stack_bytes();

/// Returns the number of CPUs that this process may use by its affinity and its quota of CPU time,
/// rounded up; at least 1.
int usable_cpus();

/// Returns true if the system can restrict threads to CPUs.
bool has_cpu_masks();

/// Returns a bit for each of the first 64 CPUs that this process may use, or all bits if the system
/// does not provide the mask. \pre has_cpu_masks()
std::uint64_t cpus_of_this_process();

/// Restricts the calling thread to the CPUs of the mask that its process may use. Has no effect if
/// the process may use none of them. \pre has_cpu_masks()
void keep_this_thread_on_cpus(std::uint64_t mask);

/// Returns the number of the CPU that runs the calling thread, or -1 if the system does not provide
/// it.
int current_cpu();

/// Moves the calling thread to another CPU that it may use, if there is one. Has no effect if the
/// system has no such function.
/// \param stay_away  for threads of Pelagic: the thread may not use `cpu` until it leaves another
///                   one. False: it may use the same CPUs as before.
void leave_cpu(int cpu, bool stay_away);

/// Replacement of std::atomic's wait(): blocks until `word` differs from `value`. A thread that
/// changes `word` must call wake_all() afterwards. Without a futex, as on Windows, the wait() of
/// libstdc++ 12 compares the word before it takes its lock, and misses a change in between.
void wait_while(const std::atomic<std::uint32_t>& word, std::uint32_t value);
/// Wakes all threads that wait for a change of `word`.
void wake_all(std::atomic<std::uint32_t>& word);
/// Wakes at least one of them.
void wake_one(std::atomic<std::uint32_t>& word);

}  // namespace pelagic
