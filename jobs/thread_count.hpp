// Validation of executors' options.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic {

/// Tests set it to run more threads than CPUs, because those meet more interleavings.
inline int min_assumed_cpus = 1;

/// Returns the number of threads to start: `threads`, at most `cpus`, or `cpus` if it is 0. Threads
/// that share a CPU delay each other, and no job waits for another one.
/// \throws std::invalid_argument  if `threads` is outside [0, 1024]
inline int checked_thread_count(int threads, int cpus) {
    if (threads < 0 || threads > 1024)
        throw std::invalid_argument(invalid_value_message("threads", threads, "0 to 1024"));
    return threads == 0 ? cpus : std::min(threads, std::max(cpus, min_assumed_cpus));
}

/// Returns `us`. \throws std::invalid_argument  if `us` is outside [0, 1000]
inline int checked_spin_us(int us) {
    if (us < 0 || us > 1000) throw std::invalid_argument(invalid_value_message("spin_us", us, "0 to 1000"));
    return us;
}

}  // namespace pelagic
