#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <ucontext.h>

#include <cstdlib>
#include <new>
#include <utility>

#include "pelagic/tests/platform/platform.hpp"

namespace pelagic {

void* allocate_aligned(std::size_t bytes, std::size_t alignment) {
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}
void free_aligned(void* memory) { std::free(memory); }

std::size_t bytes_handed_out() { return mallinfo2().uordblks; }

bool threads_have_cpu_masks() { return true; }
int cpu_of_this_thread() { return sched_getcpu(); }

namespace {
thread_local const std::function<void()>* work_of_fiber = nullptr;
void enter_fiber() { (*work_of_fiber)(); }
}  // namespace

bool run_on_a_fiber(std::size_t stack_bytes, const std::function<void()>& work) {
    constexpr std::size_t guard_bytes = 64 * 1024;  // a multiple of any page
    void* const memory = ::mmap(nullptr, guard_bytes + stack_bytes, PROT_READ | PROT_WRITE,
                                MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    ::mprotect(memory, guard_bytes, PROT_NONE);
    ucontext_t fiber{}, caller{};
    ::getcontext(&fiber);
    fiber.uc_stack.ss_sp = static_cast<char*>(memory) + guard_bytes;
    fiber.uc_stack.ss_size = stack_bytes;
    fiber.uc_link = &caller;
    ::makecontext(&fiber, &enter_fiber, 0);
    const auto* const earlier = std::exchange(work_of_fiber, &work);
    ::swapcontext(&caller, &fiber);
    work_of_fiber = earlier;
    ::munmap(memory, guard_bytes + stack_bytes);
    return true;
}

bool has_address_space_limits() { return true; }
void limit_address_space(std::size_t bytes) {
    rlimit room{};
    getrlimit(RLIMIT_AS, &room);
    room.rlim_cur = bytes;
    setrlimit(RLIMIT_AS, &room);
}

}  // namespace pelagic
