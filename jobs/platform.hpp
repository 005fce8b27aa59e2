// What jobs ask of the operating system beyond the C++ library. Each system's answers stand in a file of its own, of which
// jobs/CMakeLists.txt takes one: platform_linux.cpp (Android too), platform_macos.cpp, platform_windows.cpp, platform_unknown.cpp.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace pelagic {

/// Addresses [begin, end); empty where the system doesn't say.
struct Stack {
    std::uintptr_t begin = 0, end = 0;
};

/// What the calling thread was given when it began, without pages that guard its end.
Stack stack_of_this_thread();

/// The smallest stack that a thread may ask for.
std::size_t min_stack_bytes();

/// Whether threads can be kept on chosen CPUs.
bool has_cpu_masks();

/// Which of the first 64 CPUs this process may use, a bit each; all where the system doesn't say. \pre has_cpu_masks()
std::uint64_t cpus_of_this_process();

/// Keeps the calling thread on these of the CPUs that its process may use. Where none of them is left it runs wherever it may.
/// \pre has_cpu_masks()
void keep_this_thread_on_cpus(std::uint64_t mask);

/// What std::atomic's wait() and notify_all() promise: returns once the word is found to be another, and whoever changes it wakes
/// those that wait for that. The wait() of g++ 12's library looks before it takes its lock where it knows no futex, as on
/// Windows, and so misses a change that comes between.
void wait_while(const std::atomic<std::uint32_t>& word, std::uint32_t value);
void wake_all(std::atomic<std::uint32_t>& word);

}  // namespace pelagic
