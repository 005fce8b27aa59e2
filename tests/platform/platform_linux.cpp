#include <malloc.h>
#include <sched.h>
#include <sys/resource.h>

#include <cstdlib>

#include "pelagic/tests/platform/platform.hpp"

namespace pelagic {

void* allocate_aligned(std::size_t bytes, std::size_t alignment) {
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}
void free_aligned(void* memory) { std::free(memory); }

std::size_t bytes_handed_out() { return mallinfo2().uordblks; }

bool threads_have_cpu_masks() { return true; }
int cpu_of_this_thread() { return sched_getcpu(); }

bool has_address_space_limits() { return true; }
void limit_address_space(std::size_t bytes) {
    rlimit room{};
    getrlimit(RLIMIT_AS, &room);
    room.rlim_cur = bytes;
    setrlimit(RLIMIT_AS, &room);
}

}  // namespace pelagic
