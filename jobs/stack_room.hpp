// Check of the remaining stack of the calling thread, and a larger stack for jobs that need it.
#pragma once

#include <cstddef>
#include <functional>

namespace pelagic {

/// Returns false if the remaining stack may be smaller than `bytes`: that of the calling thread is,
/// or the caller is a fiber, whose stack only Windows measures. Returns true if the system provides
/// no stack sizes.
bool stack_holds(std::size_t bytes);

/// Calls `work` on a temporary thread with a stack of at least `bytes` and waits for it.
/// \throws std::system_error  if the system does not create the thread
/// \throws                    the exception of `work`
void run_on_a_stack_of(std::size_t bytes, const std::function<void()>& work);

}  // namespace pelagic
