// Windows 8 and later, which say where a thread's stack lies. Masks are those of the process's first group of 64 CPUs.
#include <windows.h>

#include "pelagic/jobs/platform.hpp"

namespace pelagic {
namespace {

// The guard page, and what the system keeps behind it to tell of an overflow.
constexpr std::uintptr_t kept_bytes = 16 << 10;

/// Where threads wait for words whose addresses fall together. The system's own WaitOnAddress stands in no DLL that all programs load.
struct WaitingRoom {
    SRWLOCK lock = SRWLOCK_INIT;
    CONDITION_VARIABLE changed = CONDITION_VARIABLE_INIT;
};

WaitingRoom& room_of(const std::atomic<std::uint32_t>& word) {
    static WaitingRoom rooms[16];
    return rooms[reinterpret_cast<std::uintptr_t>(&word) / 64 % 16];
}

}  // namespace

Stack stack_of_this_thread() {
    ULONG_PTR begin = 0, end = 0;
    GetCurrentThreadStackLimits(&begin, &end);
    return end - begin > kept_bytes ? Stack{begin + kept_bytes, end} : Stack{};
}

std::size_t min_stack_bytes() { return 64 << 10; }  // the granularity of addresses

bool has_cpu_masks() { return true; }

std::uint64_t cpus_of_this_process() {
    DWORD_PTR here = 0, machine = 0;
    // Zero for a process whose threads are in several groups.
    if (!GetProcessAffinityMask(GetCurrentProcess(), &here, &machine) || here == 0) return ~std::uint64_t{0};
    return here;
}

void keep_this_thread_on_cpus(std::uint64_t mask) {
    // A mask with a CPU that the process may not use is refused as a whole.
    SetThreadAffinityMask(GetCurrentThread(), mask & cpus_of_this_process());
}

void wait_while(const std::atomic<std::uint32_t>& word, std::uint32_t value) {
    WaitingRoom& room = room_of(word);
    AcquireSRWLockExclusive(&room.lock);
    while (word == value) SleepConditionVariableSRW(&room.changed, &room.lock, INFINITE, 0);
    ReleaseSRWLockExclusive(&room.lock);
}

void wake_all(std::atomic<std::uint32_t>& word) {
    // Whoever has seen the word as it was is asleep by the time the lock is had.
    WaitingRoom& room = room_of(word);
    AcquireSRWLockExclusive(&room.lock);
    ReleaseSRWLockExclusive(&room.lock);
    WakeAllConditionVariable(&room.changed);
}

}  // namespace pelagic
