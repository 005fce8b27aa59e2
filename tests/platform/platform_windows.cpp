#include <windows.h>

#include <malloc.h>

#include "pelagic/tests/platform/platform.hpp"

namespace pelagic {

void* allocate_aligned(std::size_t bytes, std::size_t alignment) { return _aligned_malloc(bytes, alignment); }
void free_aligned(void* memory) { _aligned_free(memory); }

std::size_t bytes_handed_out() {
    auto* const heap = reinterpret_cast<HANDLE>(_get_heap_handle());
    std::size_t bytes = 0;
    PROCESS_HEAP_ENTRY entry{};
    HeapLock(heap);
    while (HeapWalk(heap, &entry))
        if (entry.wFlags & PROCESS_HEAP_ENTRY_BUSY) bytes += entry.cbData;
    HeapUnlock(heap);
    return bytes;
}

bool threads_have_cpu_masks() { return true; }
int cpu_of_this_thread() { return static_cast<int>(GetCurrentProcessorNumber()); }

namespace {
struct Fiber {
    const std::function<void()>* work;
    void* caller;
};
void WINAPI enter_fiber(void* parameter) {
    const auto* const fiber = static_cast<const Fiber*>(parameter);
    (*fiber->work)();
    SwitchToFiber(fiber->caller);
}
}  // namespace

bool run_on_a_fiber(std::size_t stack_bytes, const std::function<void()>& work) {
    Fiber fiber{&work, ConvertThreadToFiber(nullptr)};
    void* const created = CreateFiberEx(0, stack_bytes, 0, &enter_fiber, &fiber);
    if (created) SwitchToFiber(created), DeleteFiber(created);
    ConvertFiberToThread();
    return created != nullptr;
}

// A job object limits only committed memory, and wine's not even that.
bool has_address_space_limits() { return false; }
void limit_address_space(std::size_t) {}

}  // namespace pelagic
