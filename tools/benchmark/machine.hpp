// Names of the processor and the compiler, sizes of caches, and processor time, for benchmarks.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace pelagic::tools {

/// Returns the operating system's name of the processor, or of the board if processors have no
/// names, as on Arm.
std::string cpu_name();

/// Returns the sizes of the data caches of the first core, in bytes, from the first level on. Empty
/// if the system does not report them.
std::vector<std::size_t> cache_sizes();

/// Returns the processor time of the calling thread in seconds. On Windows it advances in steps of 15 ms;
/// in a page it is the time of the clock.
double thread_seconds();

/// Sleeps until a time.
void sleep_until(std::chrono::steady_clock::time_point time);

/// Returns the name of the compiler of this program.
inline std::string compiler_name() {
#if defined(__clang__)
    return "clang++ " __clang_version__;
#else
    return "g++ " __VERSION__;
#endif
}

}  // namespace pelagic::tools
