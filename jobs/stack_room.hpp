// How much stack the calling thread has left, and what to do where that is too little for a job.
#pragma once

#include <cstddef>
#include <functional>

namespace pelagic {

/// False if less than `bytes` are left of the calling thread's stack. True as well where nobody can tell: on a stack that is
/// not the thread's own (a fiber's), or on a system that does not say. The first call of a thread asks the system.
bool stack_holds(std::size_t bytes);

/// Calls `work` on a thread of its own with at least `bytes` of stack and returns when it is done. Throws what it throws,
/// and std::system_error if the system has no such thread to give.
void run_on_a_stack_of(std::size_t bytes, const std::function<void()>& work);

}  // namespace pelagic
