// Windows 8 and later, which provide the limits of a thread's stack. Masks refer to the process's
// first group of 64 CPUs.
#include <windows.h>

#include <algorithm>
#include <bit>
#include <thread>

#include "pelagic/jobs/platform.hpp"

namespace pelagic {
namespace {

// The guard page and the pages behind it that the system reserves to report a stack overflow.
constexpr std::uintptr_t kept_bytes = 16 << 10;

/// Wait queue of the words whose addresses share a hash. Windows' WaitOnAddress is not used,
/// because no DLL that every program loads exports it.
struct WaitQueue {
    SRWLOCK lock = SRWLOCK_INIT;
    CONDITION_VARIABLE changed = CONDITION_VARIABLE_INIT;
};

WaitQueue& queue_of(const std::atomic<std::uint32_t>& word) {
    static WaitQueue queues[16];
    return queues[reinterpret_cast<std::uintptr_t>(&word) / 64 % 16];
}

}  // namespace

Stack stack_of_this_thread() {
    ULONG_PTR begin = 0, end = 0;
    GetCurrentThreadStackLimits(&begin, &end);
    return end - begin > kept_bytes ? Stack{begin + kept_bytes, end} : Stack{};
}

std::size_t min_stack_bytes() { return 64 << 10; }  // the granularity of addresses

int usable_cpus() {
    const int all = static_cast<int>(std::thread::hardware_concurrency());
    const std::uint64_t here = cpus_of_this_process();
    return std::max(1, here == ~std::uint64_t{0} ? all : std::min(all, std::popcount(here)));
}

bool has_cpu_masks() { return true; }

std::uint64_t cpus_of_this_process() {
    DWORD_PTR here = 0, machine = 0;
    // Zero for a process whose threads are in several groups.
    if (!GetProcessAffinityMask(GetCurrentProcess(), &here, &machine) || here == 0) return ~std::uint64_t{0};
    return here;
}

void keep_this_thread_on_cpus(std::uint64_t mask) {
    // Windows rejects a mask that contains a CPU that the process may not use.
    SetThreadAffinityMask(GetCurrentThread(), mask & cpus_of_this_process());
}

int current_cpu() { return static_cast<int>(GetCurrentProcessorNumber()); }
void leave_cpu(int, bool) {}

void wait_while(const std::atomic<std::uint32_t>& word, std::uint32_t value) {
    WaitQueue& queue = queue_of(word);
    AcquireSRWLockExclusive(&queue.lock);
    while (word == value) SleepConditionVariableSRW(&queue.changed, &queue.lock, INFINITE, 0);
    ReleaseSRWLockExclusive(&queue.lock);
}

void wake_all(std::atomic<std::uint32_t>& word) {
    // Once the lock is acquired, every thread that read the old value sleeps on the condition
    // variable.
    WaitQueue& queue = queue_of(word);
    AcquireSRWLockExclusive(&queue.lock);
    ReleaseSRWLockExclusive(&queue.lock);
    WakeAllConditionVariable(&queue.changed);
}

// Several words share a queue.
void wake_one(std::atomic<std::uint32_t>& word) { wake_all(word); }

}  // namespace pelagic
