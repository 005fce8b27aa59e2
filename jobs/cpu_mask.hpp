// CPU affinity of a pool's threads.
#pragma once

#include <cstdint>

namespace pelagic {

/// Returns the number of CPUs in the mask that this process may use, or 0 for an empty mask.
/// \throws std::invalid_argument  if the mask is not empty and the process may use none of its
///                                CPUs, or the system does not support masks
int checked_cpus(std::uint64_t cpu_mask);

/// Restricts the calling thread to the CPUs of the mask. An empty mask has no effect.
/// \pre checked_cpus() accepted the mask
void keep_this_thread_on(std::uint64_t cpu_mask);

}  // namespace pelagic
