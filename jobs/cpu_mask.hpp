// Which cores a pool's threads may run on.
#pragma once

#include <cstdint>

namespace pelagic {

/// How many of the mask's CPUs this process may use; 0 for an empty mask, which asks for nothing. Throws
/// std::invalid_argument if a mask names none of them, or the system has no masks.
int checked_cpus(std::uint64_t cpu_mask);

/// Keeps the calling thread on the mask's CPUs; an empty mask leaves it as it is. \pre checked_cpus() took the mask
void keep_this_thread_on(std::uint64_t cpu_mask);

}  // namespace pelagic
