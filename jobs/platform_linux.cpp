// Linux and Android. Both support sched_setaffinity with thread 0, the calling thread. Android's C
// library has no pthread_setaffinity_np before API level 36.
#include <limits.h>
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <cstddef>
#include <thread>

#include "pelagic/jobs/cpu_quota.hpp"
#include "pelagic/jobs/platform.hpp"

namespace pelagic {
namespace {

Stack query_stack() {
    pthread_attr_t attributes;
    if (pthread_getattr_np(pthread_self(), &attributes) != 0) return {};
    void* begin = nullptr;
    std::size_t bytes = 0, guard = 0;
    const bool is_known = pthread_attr_getstack(&attributes, &begin, &bytes) == 0;
    pthread_attr_getguardsize(&attributes, &guard);
    pthread_attr_destroy(&attributes);
    // Older C libraries include the guard page in the stack.
    const auto first = reinterpret_cast<std::uintptr_t>(begin);
    return is_known && guard < bytes ? Stack{first + guard, first + bytes} : Stack{};
}

}  // namespace

Stack stack_of_this_thread() {
    thread_local const Stack stack = query_stack();
    return stack;
}

std::size_t min_stack_bytes() { return static_cast<std::size_t>(PTHREAD_STACK_MIN); }

int usable_cpus() {
    cpu_set_t here;
    CPU_ZERO(&here);
    // Fails if the system has more CPUs than cpu_set_t.
    int affinity = static_cast<int>(std::thread::hardware_concurrency());
    if (sched_getaffinity(0, sizeof here, &here) == 0) {
        affinity = 0;
        for (unsigned cpu = 0; cpu < CPU_SETSIZE; ++cpu) affinity += CPU_ISSET(cpu, &here) ? 1 : 0;
    }
    const int quota = cpus_of_quota("");
    return std::max(1, quota == 0 ? affinity : std::min(affinity, quota));
}

bool has_cpu_masks() { return true; }

std::uint64_t cpus_of_this_process() {
    cpu_set_t here;
    CPU_ZERO(&here);
    // Fails if the system has more CPUs than cpu_set_t.
    if (sched_getaffinity(0, sizeof here, &here) != 0) return ~std::uint64_t{0};
    std::uint64_t mask = 0;
    for (int cpu = 0; cpu < 64; ++cpu)
        if (CPU_ISSET(cpu, &here)) mask |= std::uint64_t{1} << cpu;
    return mask;
}

void keep_this_thread_on_cpus(std::uint64_t mask) {
    cpu_set_t cpus;
    CPU_ZERO(&cpus);
    for (int cpu = 0; cpu < 64; ++cpu)
        if (mask >> cpu & 1) CPU_SET(cpu, &cpus);
    sched_setaffinity(0, sizeof cpus, &cpus);
}

int current_cpu() { return sched_getcpu(); }

void leave_cpu(int cpu, bool stay_away) {
    thread_local int left = -1;
    cpu_set_t all;
    CPU_ZERO(&all);
    if (sched_getaffinity(0, sizeof all, &all) != 0) return;
    if (left >= 0) CPU_SET(static_cast<unsigned>(left), &all);
    cpu_set_t others = all;
    CPU_CLR(static_cast<unsigned>(cpu), &others);
    // Fails if there is no other CPU.
    if (sched_setaffinity(0, sizeof others, &others) != 0) return;
    if (stay_away)
        left = cpu;
    else
        sched_setaffinity(0, sizeof all, &all);
}

void wait_while(const std::atomic<std::uint32_t>& word, std::uint32_t value) { word.wait(value); }
void wake_all(std::atomic<std::uint32_t>& word) { word.notify_all(); }
void wake_one(std::atomic<std::uint32_t>& word) { word.notify_one(); }

}  // namespace pelagic
