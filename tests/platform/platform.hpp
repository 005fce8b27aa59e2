// What tests ask of the operating system: a file for each, of which tests/CMakeLists.txt takes one.
#pragma once

#include <cstddef>

namespace pelagic {

/// `bytes` at a multiple of `alignment`, a power of two; null if there is no such memory. Calls no operator new.
void* allocate_aligned(std::size_t bytes, std::size_t alignment);
/// Takes it back, null too.
void free_aligned(void* memory);

/// What the C library's heap has handed out.
std::size_t bytes_handed_out();

/// Whether threads can be kept on chosen CPUs.
bool threads_have_cpu_masks();
/// Where the calling thread runs, among all CPUs. \pre threads_have_cpu_masks()
int cpu_of_this_thread();

/// Whether a process can be given less room.
bool has_address_space_limits();
/// Lets this process have no more addresses than that. \pre has_address_space_limits()
void limit_address_space(std::size_t bytes);

}  // namespace pelagic
