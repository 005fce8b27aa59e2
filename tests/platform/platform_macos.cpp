#include <malloc/malloc.h>

#include <algorithm>
#include <cstdlib>

#include "pelagic/tests/platform/platform.hpp"

namespace pelagic {

void* allocate_aligned(std::size_t bytes, std::size_t alignment) {
    void* memory = nullptr;
    return posix_memalign(&memory, std::max(alignment, sizeof(void*)), bytes) == 0 ? memory : nullptr;
}
void free_aligned(void* memory) { std::free(memory); }

std::size_t bytes_handed_out() { return mstats().bytes_used; }

bool threads_have_cpu_masks() { return false; }
int cpu_of_this_thread() { return -1; }

bool run_on_a_fiber(std::size_t, const std::function<void()>&) { return false; }

bool has_address_space_limits() { return false; }
void limit_address_space(std::size_t) {}

}  // namespace pelagic
