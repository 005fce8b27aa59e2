// Validation of executors' options.
#pragma once

#include <stdexcept>
#include <string>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic {

/// Returns `threads`, or default_thread_count() if it is 0.
/// \throws std::invalid_argument  if `threads` is outside [0, 1024]
inline int checked_thread_count(int threads) {
    if (threads < 0 || threads > 1024)
        throw std::invalid_argument(invalid_value_message("threads", threads, "0 to 1024"));
    return threads == 0 ? default_thread_count() : threads;
}

/// Returns `us`. \throws std::invalid_argument  if `us` is outside [0, 1000]
inline int checked_spin_us(int us) {
    if (us < 0 || us > 1000) throw std::invalid_argument(invalid_value_message("spin_us", us, "0 to 1000"));
    return us;
}

}  // namespace pelagic
