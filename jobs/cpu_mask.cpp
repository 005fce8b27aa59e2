// sched_setaffinity with thread 0, the calling one, works on Linux and on Android, whose C library has no
// pthread_setaffinity_np before API level 36.
#include "pelagic/jobs/cpu_mask.hpp"

#include <bit>
#include <charconv>
#include <stdexcept>
#include <string>

#if defined(__linux__)
#include <sched.h>
#endif

namespace pelagic {
namespace {

[[noreturn]] void refuse(std::uint64_t cpu_mask, const char* needs) {
    char digits[16];
    const auto length =
        static_cast<std::size_t>(std::to_chars(digits, digits + sizeof digits, cpu_mask, 16).ptr - digits);
    throw std::invalid_argument("cpu_mask is 0x" + std::string(digits, length) + ", needs " + needs);
}

#if defined(__linux__)
cpu_set_t cpus_of(std::uint64_t cpu_mask) {
    cpu_set_t cpus;
    CPU_ZERO(&cpus);
    for (int cpu = 0; cpu < 64; ++cpu)
        if (cpu_mask >> cpu & 1) CPU_SET(cpu, &cpus);
    return cpus;
}
#endif

}  // namespace

int checked_cpus(std::uint64_t cpu_mask) {
    if (cpu_mask == 0) return 0;
#if defined(__linux__)
    const cpu_set_t wanted = cpus_of(cpu_mask);
    cpu_set_t here, both;
    CPU_ZERO(&here);
    if (sched_getaffinity(0, sizeof here, &here) != 0)
        return std::popcount(cpu_mask);  // more CPUs than cpu_set_t has
    CPU_AND(&both, &wanted, &here);
    if (CPU_COUNT(&both) == 0) refuse(cpu_mask, "a CPU that this process may use");
    return CPU_COUNT(&both);
#else
    refuse(cpu_mask, "0 on this system, which has no masks");
#endif
}

void keep_this_thread_on(std::uint64_t cpu_mask) {
    if (cpu_mask == 0) return;
#if defined(__linux__)
    // A CPU may be taken away after the check; the thread then runs wherever it may.
    const cpu_set_t cpus = cpus_of(cpu_mask);
    sched_setaffinity(0, sizeof cpus, &cpus);
#endif
}

}  // namespace pelagic
