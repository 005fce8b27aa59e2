// Operating system functions for tests: one source file for each system, chosen in
// tests/CMakeLists.txt.
#pragma once

#include <cstddef>
#include <functional>

namespace pelagic {

/// Allocates `bytes` at a multiple of `alignment`, a power of two; returns null if there is no such
/// memory. Does not call operator new.
void* allocate_aligned(std::size_t bytes, std::size_t alignment);
/// Frees the memory; null is allowed.
void free_aligned(void* memory);

/// Returns the number of bytes allocated from the C library's heap.
std::size_t bytes_handed_out();

/// Returns true if threads can be bound to chosen CPUs.
bool threads_have_cpu_masks();
/// Returns the CPU of the calling thread, among all CPUs. \pre threads_have_cpu_masks()
int cpu_of_this_thread();

/// Calls `work` on a fiber, whose stack is no thread's, with a guard page. Returns false, and does
/// not call it, if the system has no fibers.
bool run_on_a_fiber(std::size_t stack_bytes, const std::function<void()>& work);

/// Returns true if the address space of a process can be limited.
bool has_address_space_limits();
/// Limits the address space of this process. \pre has_address_space_limits()
void limit_address_space(std::size_t bytes);

}  // namespace pelagic
